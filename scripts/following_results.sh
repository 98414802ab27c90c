#!/usr/bin/env bash
# Drive the courses with each follower and with the works' own forms, and run the loops of speed: the tables of
# docs/results_driving.md.
#
#   scripts/following_results.sh [WORK_DIR [FOLDER]]
#
# FOLDER (default: $STEREO_NAV_DATA/courses) holds corner.csv, s_curve.csv and eight.csv. WORK_DIR (default: a new temporary
# folder) keeps a picture and the samples of each run. The package must be built (scripts/build.sh).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
folder=${2:-${STEREO_NAV_DATA:-}/courses}
[[ -f $folder/corner.csv ]] || die "$folder holds no corner.csv; name the folder of the courses, or set STEREO_NAV_DATA"
work=$(realpath "${1:-$(mktemp -d)}")
set +u
source "${STEREO_NAV_BUILD:-$STEREO_NAV_ROOT/build}/devel/setup.bash"
set -u

# drive NAME ARGUMENT...: rows of the three courses at 1 and 2 m/s. A published form that does not arrive has its row, too.
drive() {
  local name=$1 speed course
  shift
  for speed in 1 2; do
    for course in corner s_curve eight; do
      { rosrun stereo_nav follow "$folder/$course.csv" --speed "$speed" --output "$work/$name-$course-$speed" "$@" || true; } |
        tail -n +"$header"
      header=3
    done
  done
}

say "following (pictures in $work)"
header=1
drive holonomic --law holonomic
drive pursuit --law pursuit
drive stanley --law stanley --wheelbase 0.5
drive pursuit-steered --law pursuit --wheelbase 0.5
drive pursuit-published --law pursuit --as-published
drive stanley-published --law stanley --as-published --wheelbase 0.5

say "what the followers do not know: odometry 100 ms old; noise of 5 mm and 0.5 deg; dead time 80 ms and lag 120 ms instead of 40 and 80"
header=1
for law in holonomic pursuit "stanley --wheelbase 0.5"; do
  name=${law%% *}
  # shellcheck disable=SC2086  # two words of one law
  for case in "late --odometry-age 0.1" "noise --noise-m 0.005 --noise-deg 0.5" "slow --drive-dead-time 0.08 --drive-lag 0.12"; do
    rosrun stereo_nav follow "$folder/s_curve.csv" --speed 2 --law $law ${case#* } --output "$work/$name-${case%% *}" |
      tail -n +"$header" | sed "s/| s_curve |/| s_curve, ${case%% *} |/"
    header=3
  done
done

say "loops of speed"
rosrun stereo_nav speed_loop --output "$work/speed_loop.csv"
rosrun stereo_nav speed_loop --as-published --output "$work/speed_loop_published.csv" | tail -1
