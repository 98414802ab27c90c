#!/usr/bin/env bash
# Build everything and run the tests.
#
#   scripts/test.sh [--lint] [--install] [--demo] [--sanitize] [--tsan] [--all] [BUILD_DIR]
#
# Always: every unit test and rostest, built in BUILD_DIR (build/ in the package unless given). Beside them, each with a
# build folder of its own next to BUILD_DIR:
#   --lint      package, formatting, scripts, launch files, documents (scripts/lint.sh)
#   --install   what is installed works without the source tree, for another package, too
#   --demo      scripts/demo.sh
#   --sanitize  the unit tests under AddressSanitizer and UndefinedBehaviourSanitizer
#   --tsan      the unit tests labelled tsan under ThreadSanitizer
#   --all       all of these
# The last line is "N passed, N failed, N skipped"; the exit status is 0 when nothing failed.
#
# STEREO_NAV_DATA=DIR           where the real recordings are; tests that need them are skipped without
# STEREO_NAV_FAIL_ON_SKIP=1     a skipped test makes the run fail
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

lint=false install=false demo=false sanitize=false tsan=false build_dir=""
for argument in "$@"; do
  case $argument in
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
results=()  # folders that the summary reads

# fresh_results BUILD_DIR: an empty folder for the results of this run; old ones must not count.
fresh_results() {
  rm -rf "$1/test_results"
  mkdir -p "$1/test_results"
  results+=("$1/test_results")
}

# step BUILD_DIR NAME COMMAND...: a step whose failure is a failed test rather than the end of the run.
step() {
  local build_dir=$1 name=$2
  shift 2
  if "$@"; then return 0; fi
  echo "not ok $name" >>"$build_dir/test_results/steps.tap"
  return 1
}

# run_ctest BUILD_DIR NAME CTEST_ARGUMENT...: the tests that the arguments select. What fails shows in the summary.
run_ctest() (
  local name=$2
  cd "$1"
  shift 2
  ctest "$@" --show-only=json-v1 >"test_results/$name.json"
  ctest "$@" --timeout 600 --output-on-failure 2>&1 | tee "test_results/$name.log" || true
)

# Everything that ROS writes stays in the build folder; no node asks a name server who this machine is.
run_tests() {
  export ROS_HOME=$build_dir/ros_home ROS_HOSTNAME=localhost
  unset ROS_IP ROS_NAMESPACE
  say "unit tests"
  run_ctest "$build_dir" unit -R '_gtest_' --parallel "$(nproc)"
  # One at a time: a graph of nodes wants the cores for itself.
  say "tests of the whole graph"
  run_ctest "$build_dir" graph -E '_gtest_'
}

# sanitized_tests BUILD_DIR SANITIZERS CTEST_ARGUMENT...: unit tests only, since the nodes of ROS are not instrumented.
sanitized_tests() {
  local dir=$1 sanitizers=$2
  shift 2
  fresh_results "$dir"
  say "unit tests under -fsanitize=$sanitizers, building in $dir"
  # The normal build checks the warnings; on instrumented code GCC gives false ones.
  step "$dir" "configure" configure "$dir" -DSTEREO_NAV_SANITIZE="$sanitizers" -DSTEREO_NAV_WERROR=OFF || return 0
  local targets
  targets=$(cd "$dir" && ctest -N -R '_gtest_' "$@" | sed -n 's/.*_ctest_stereo_nav_gtest_//p')
  [[ -n $targets ]] || return 0
  # shellcheck disable=SC2086  # one word a target
  step "$dir" "build" cmake --build "$dir" --parallel "$(nproc)" --target $targets || return 0
  run_ctest "$dir" unit -R '_gtest_' "$@" --parallel "$(nproc)"
}

fresh_results "$build_dir"
if step "$build_dir" "build" "$STEREO_NAV_ROOT/scripts/build.sh" --tests "$build_dir"; then
  run_tests
  if $lint; then
    say "checks without a compiler"
    "$STEREO_NAV_ROOT/scripts/lint.sh" | tee "$build_dir/test_results/lint.tap" || true
  fi
  if $install; then
    say "what is installed"
    "$STEREO_NAV_ROOT/scripts/lib/install_checks.sh" "$build_dir" | tee "$build_dir/test_results/install.tap" || true
  fi
  if $demo; then
    say "the demo"
    if step "$build_dir" "demo" "$STEREO_NAV_ROOT/scripts/demo.sh" "$build_dir"; then
      echo "ok demo" >>"$build_dir/test_results/steps.tap"
    fi
  fi
  export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_stack_use_after_return=1:strict_string_checks=1}
  export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
  if $sanitize; then sanitized_tests "$build_dir-asan" address,undefined; fi
  if $tsan; then sanitized_tests "$build_dir-tsan" thread -L tsan; fi
fi

say "summary"
/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/test_summary.py" "${results[@]}"
