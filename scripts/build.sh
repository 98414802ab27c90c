#!/usr/bin/env bash
# Install what is missing, configure, build.
#
#   scripts/build.sh [--tests | --unit-tests] [BUILD_DIR]
#
# BUILD_DIR is build/ in the package unless given. Afterwards
#   source BUILD_DIR/devel/setup.bash
# gives `rosrun stereo_nav ...` and `roslaunch stereo_nav ...`. --tests builds the test programs, too;
# --unit-tests only those of the unit tests and what they need.
# Works from any folder, as root or with sudo, any number of times.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

build_dir=""
targets=(all)
groups=(build)
for argument in "$@"; do
  case $argument in
    --tests) targets=(all tests) groups=(build test) ;;
    --unit-tests) targets=(stereo_nav_unit_tests) groups=(build test) ;;
    -h | --help) usage; exit 0 ;;
    -*) die "unknown option '$argument'. See scripts/build.sh --help" ;;
    *) [[ -z $build_dir ]] || die "one BUILD_DIR expected, found '$build_dir' and '$argument'"
       build_dir=$(absolute_path "$argument") ;;
  esac
done
build_dir=${build_dir:-$STEREO_NAV_ROOT/build}

"$STEREO_NAV_ROOT/scripts/install_dependencies.sh" "${groups[@]}"

say "building in $build_dir"
configure "$build_dir"
cmake --build "$build_dir" --parallel "$(nproc)" --target "${targets[@]}"
say "done. Next: source $build_dir/devel/setup.bash"
