#!/usr/bin/env bash
# Build everything and run the tests.
#
#   scripts/test.sh [--unit] [--lint] [--install] [--demo] [--sanitize] [--tsan] [--all] [BUILD_DIR]
#
# Every unit test and rostest, built in BUILD_DIR (build/ in the package unless given). With
#   --unit      the unit tests and those of the scripts only, and nothing built that they do not need
# Beside them, each with a build folder of its own next to BUILD_DIR:
#   --lint      package, formatting, scripts, launch files, documents (scripts/lint.sh)
#   --install   what is installed works without the source tree, for another package, too
#   --demo      scripts/demo.sh
#   --sanitize  the unit tests under AddressSanitizer and UndefinedBehaviourSanitizer
#   --tsan      the unit tests labelled tsan under ThreadSanitizer
#   --all       all of these except --unit
# Says before each step how long it will take: as long as the last time, which BUILD_DIR/test_seconds.txt holds. At the
# end a table of the steps and of the slowest tests.
# The last line is "N passed, N failed, N skipped"; the exit status is 0 when nothing failed.
#
# STEREO_NAV_DATA=DIR           where the real recordings are; tests that need them are skipped without
# STEREO_NAV_FAIL_ON_SKIP=1     a skipped test makes the run fail
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

unit=false lint=false install=false demo=false sanitize=false tsan=false build_dir=""
for argument in "$@"; do
  case $argument in
    --unit) unit=true ;;
    --lint) lint=true ;;
    --install) install=true ;;
    --demo) demo=true ;;
    --sanitize) sanitize=true ;;
    --tsan) tsan=true ;;
    --all) lint=true install=true demo=true sanitize=true tsan=true ;;
    -h | --help)
      usage
      exit 0
      ;;
    -*) die "unknown option '$argument'. See scripts/test.sh --help" ;;
    *)
      [[ -z $build_dir ]] || die "one BUILD_DIR expected, found '$build_dir' and '$argument'"
      build_dir=$(absolute_path "$argument")
      ;;
  esac
done
build_dir=${build_dir:-$STEREO_NAV_ROOT/build}
! $unit || ! { $install || $demo; } || die "--unit builds neither what --install nor what --demo needs"

# What will be done, in this order. progress.py keeps the durations under these names.
if $unit; then steps=("build of the unit tests"); else steps=("build"); fi
steps+=("unit tests")
$unit || steps+=("tests of the whole graph")
! $lint || steps+=("checks without a compiler")
! $install || steps+=("what is installed")
! $demo || steps+=("the demo")
! $sanitize || steps+=("build under address,undefined" "unit tests under address,undefined")
! $tsan || steps+=("build under thread" "unit tests under thread")
asan=("$build_dir-asan" "address,undefined" stereo_nav_unit_tests unit)  # folder, sanitizers, target, label
thread=("$build_dir-tsan" thread stereo_nav_tsan_tests tsan)
beside=""   # the process of build_beside
results=()  # folders that the summary reads
took=()     # "STEP=SECONDS" of what is done
seconds_file=$build_dir/test_seconds.txt

progress() { /usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/progress.py" "$@"; }

# timed STEP COMMAND...: runs it; says before how long it will take and afterwards how long it took.
timed() {
  local step=$1 start=$SECONDS status=0 number=$((${#took[@]} + 1))
  shift
  progress begin "$seconds_file" "$number/${#steps[@]}" "$step"
  "$@" || status=$?
  took+=("$step=$((SECONDS - start))")
  [[ $status -ne 0 ]] || progress end "$seconds_file" "$number/${#steps[@]}" "$step" $((SECONDS - start))
  return $status
}

# fresh_results BUILD_DIR: an empty folder for the results of this run; old ones must not count.
fresh_results() {
  rm -rf "$1/test_results"
  mkdir -p "$1/test_results"
  results+=("$1/test_results")
}

# must BUILD_DIR NAME COMMAND...: something whose failure is a failed test rather than the end of the run.
must() {
  local build_dir=$1 name=$2
  shift 2
  if "$@"; then return 0; fi
  echo "not ok $name" >>"$build_dir/test_results/steps.tap"
  return 1
}

# build STEP COMMAND...
build() {
  local step=$1
  shift
  "$@" 2>&1 | progress follow "$seconds_file" "$step"
}

# run_ctest STEP BUILD_DIR NAME CTEST_ARGUMENT...: the tests that the arguments select. What fails shows in the summary.
run_ctest() (
  local step=$1 name=$3
  cd "$2"
  shift 3
  ctest "$@" --show-only=json-v1 >"test_results/$name.json"
  ctest "$@" --timeout 600 --output-on-failure --no-label-summary 2>&1 | tee "test_results/$name.log" |
    progress follow "$seconds_file" "$step" "test_results/$name.json" || true
)

# tap NAME COMMAND...: a script that prints the Test Anything Protocol.
tap() {
  local name=$1
  shift
  "$@" | tee "$build_dir/test_results/$name.tap" || true
}

demo() {
  if must "$build_dir" "demo" "$STEREO_NAV_ROOT/scripts/demo.sh" "$build_dir"; then
    echo "ok demo" >>"$build_dir/test_results/steps.tap"
  fi
}

# Unit tests only, since the nodes of ROS are not instrumented. The normal build checks the warnings; on instrumented code
# GCC gives false ones.
configure_sanitized() { configure "$1" -DSTEREO_NAV_SANITIZE="$2" -DSTEREO_NAV_WERROR=OFF; }

# build_sanitized STEP BUILD_DIR SANITIZERS TARGET
build_sanitized() {
  must "$2" "configure" configure_sanitized "$2" "$3" &&
    must "$2" "build" build "$1" cmake --build "$2" --parallel "$(nproc)" --target "$4"
}

# build_beside [BUILD_DIR SANITIZERS TARGET]...: begins these builds in the background, where they give way to the tests of
# the whole graph, which mostly wait. Their own steps do what is left when these tests end, and say what fails.
build_beside() {
  set -m  # a process group of its own, which end_builds_beside ends
  (
    chrt --idle --pid 0 "$BASHPID"
    while [[ $# -gt 0 ]]; do
      if configure_sanitized "$1" "$2"; then cmake --build "$1" --target "$3" || true; fi
      shift 3
    done
  ) >"$build_dir/build_beside.log" 2>&1 &
  beside=$!
  set +m
}

end_builds_beside() {
  [[ -n $beside ]] || return 0
  kill -TERM -- "-$beside" 2>/dev/null || true
  wait "$beside" 2>/dev/null || true
  beside=""
}

# sanitized_tests BUILD_DIR SANITIZERS TARGET LABEL
sanitized_tests() {
  fresh_results "$1"
  timed "build under $2" build_sanitized "build under $2" "$1" "$2" "$3" || return 0
  timed "unit tests under $2" run_ctest "unit tests under $2" "$1" unit -R _gtest_ -L "^$4\$" --parallel "$(nproc)"
}

# Everything that ROS writes stays in the build folder; no node asks a name server who this machine is.
trap end_builds_beside EXIT
export ROS_HOME=$build_dir/ros_home ROS_HOSTNAME=localhost
unset ROS_IP ROS_NAMESPACE
fresh_results "$build_dir"
progress plan "$seconds_file" "${steps[@]}"
scope=--tests
! $unit || scope=--unit-tests
if timed "${steps[0]}" must "$build_dir" "build" build "${steps[0]}" "$STEREO_NAV_ROOT/scripts/build.sh" $scope "$build_dir"; then
  timed "unit tests" run_ctest "unit tests" "$build_dir" unit -L '^unit$' --parallel "$(nproc)"
  if ! $unit; then
    builds=()
    ! $sanitize || builds+=("${asan[@]:0:3}")
    ! $tsan || builds+=("${thread[@]:0:3}")
    [[ ${#builds[@]} -eq 0 ]] || build_beside "${builds[@]}"
    timed "tests of the whole graph" run_ctest "tests of the whole graph" "$build_dir" graph -LE '^unit$' --parallel "$(nproc)"
    end_builds_beside
  fi
  if $lint; then timed "checks without a compiler" tap lint "$STEREO_NAV_ROOT/scripts/lint.sh"; fi
  if $install; then
    timed "what is installed" tap install "$STEREO_NAV_ROOT/scripts/lib/install_checks.sh" "$build_dir"
  fi
  if $demo; then timed "the demo" demo; fi
  export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_stack_use_after_return=1:strict_string_checks=1}
  export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
  if $sanitize; then sanitized_tests "${asan[@]}"; fi
  if $tsan; then sanitized_tests "${thread[@]}"; fi
fi

say "summary"
progress table "${took[@]}" -- "${results[@]}"
/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/test_summary.py" "${results[@]}"
