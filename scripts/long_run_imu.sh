#!/usr/bin/env bash
# Long run of the IMU chain over a pseudo-terminal: every frame that the emulated module sends must arrive, with a stamp
# close to when it was sent.
#
#   scripts/long_run_imu.sh [SECONDS] [BUILD_DIR]      (default: 600 seconds, build)
#
# Runs the thesis' protocol (100 Hz, 115200 baud, batches of 16 ms, module at rest that drifts 2.9 degrees in 600 s) and
# the raw protocol (1 kHz, 1 Mbaud) side by side; prints both reports and a line each for frames and stamps.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
seconds=${1:-600}
build=${2:-$root/build}
bin=$build/devel/lib/stereo_nav
work=$(mktemp -d)
pids=()
clean_up() {
  local pid
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  rm -rf "$work"
}
trap clean_up EXIT

# start NAME READER_SECONDS EMULATOR_OPTION... -- READER_OPTION...
start() {
  local name=$1 emulator=() reader=()
  shift
  while [[ $1 != -- ]]; do
    emulator+=("$1")
    shift
  done
  shift
  reader=("$@")
  "$bin/imu_emulator" --link "$work/$name" --log "$work/$name.csv" --wait-for-reader \
    --duration "$seconds" "${emulator[@]}" >"$work/$name.sent" &
  pids+=($!)
  while [[ ! -e $work/$name ]]; do sleep 0.05; done
  "$bin/imu_drift" --port "$work/$name" --duration "$((seconds + 60))" --output "$work/out_$name" "${reader[@]}" \
    >"$work/$name.report" 2>"$work/$name.errors" &
  reader_pids[$name]=$!
}

declare -A reader_pids
start angles --protocol angles --rate 100 --yaw-drift 0.004833 --angle-noise 0.02 --batch 0.016 -- --protocol angles
start raw --protocol raw --rate 1000 --baud 1000000 --gyro-noise 0.001 --batch 0.001 -- --protocol raw --baud 1000000
wait "${pids[@]}"
sleep 1
status=0
for name in angles raw; do
  kill -INT "${reader_pids[$name]}"
  wait "${reader_pids[$name]}" || true
  echo "== $name: $(tail -1 "$work/$name.sent")"
  sed "s|$work/||" "$work/$name.report"
  python3 "$root/scripts/lib/compare_stamps.py" "$work/$name.csv" "$work/out_$name/samples.csv" || status=1
done
exit $status
