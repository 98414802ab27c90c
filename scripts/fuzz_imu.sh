#!/usr/bin/env bash
# Fuzz the two decoders of the IMU with libFuzzer, AddressSanitizer and UndefinedBehaviourSanitizer.
#
#   scripts/fuzz_imu.sh [SECONDS] [BUILD_DIR]      (default: 600 seconds for each protocol, build/fuzz)
#
# Needs clang. Inputs that reach new code are kept, minimised, in test/fuzz/corpus; the unit tests
# FuzzCorpus of imu_test run them again with every test run. A finding ends the script with an error and leaves the input
# in BUILD_DIR.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
seconds=${1:-600}
build=${2:-$root/build/fuzz}
command -v clang++ >/dev/null || {
  echo "fuzz_imu.sh: clang++ not found: sudo apt-get install clang" >&2
  exit 2
}
mkdir -p "$build"

sources=("$root"/test/fuzz/imu_fuzz_main.cpp "$root"/test/fuzz/imu_decoder_fuzz.cpp)
for name in angle_protocol angle_gate frame_decoder module_angles raw_protocol; do sources+=("$root/src/sensors/imu/$name.cpp"); done
includes=(-I"$root/include" -iquote "$root/src" -I"$root/test" -isystem "$(pkg-config --variable=prefix eigen3)/include/eigen3")

for protocol in angles:kAngles raw:kRaw; do
  name=${protocol%%:*}
  clang++ -std=c++17 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all "${includes[@]}" \
    -DSTEREO_NAV_FUZZ_PROTOCOL="${protocol##*:}" "${sources[@]}" -o "$build/fuzz_$name"
done
# fuzz NAME: fuzzes for the given time, then makes the corpus again, with few and small inputs, since it is part of the package.
fuzz() {
  local name=$1 corpus=$root/test/fuzz/corpus/$1
  mkdir -p "$corpus" "$build/work_$name"
  rm -rf "$build/minimal_$name"
  mkdir "$build/minimal_$name"
  "$build/fuzz_$name" -max_total_time="$seconds" -max_len=600 -print_final_stats=1 \
    -artifact_prefix="$build/finding_$name-" "$build/work_$name" "$corpus" 2>"$build/$name.log" || return 1
  "$build/fuzz_$name" -merge=1 -max_len=600 "$build/minimal_$name" "$corpus" "$build/work_$name" 2>/dev/null || return 1
  rm -f "$corpus"/*
  cp "$build/minimal_$name"/* "$corpus"/
}

# Both at once.
fuzz angles &
angles=$!
fuzz raw &
raw=$!
status=0
wait $angles || status=1
wait $raw || status=1
for name in angles raw; do
  echo "$name, $seconds s: $(grep -oE "stat::number_of_executed_units: .*" "$build/$name.log" || echo "FINDING")"
  grep -E "SUMMARY|Test unit written" "$build/$name.log" || true
  echo "  $(find "$root/test/fuzz/corpus/$name" -type f | wc -l) inputs in the corpus"
done
exit $status
