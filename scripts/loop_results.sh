#!/usr/bin/env bash
# Measure the recognition of places in the simulator, with exact truth.
#
#   scripts/loop_results.sh [WORK_DIR [SEEDS]]
#
# Three laps of the furnished room with the thesis' cameras, with free-running ones and with webcams, the office, then a corridor of
# like doors, in which no loop must be found, with SEEDS seeds (default: 20). WORK_DIR (default: a new temporary folder) keeps what `find_loops` writes; recordings
# are removed. Prints what `find_loops` prints. Takes about 40 minutes. The package must be built (scripts/build.sh).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
work=$(realpath "${1:-$(mktemp -d)}")
seeds=${2:-20}
mkdir -p "$work"
set +u
source "${STEREO_NAV_BUILD:-$STEREO_NAV_ROOT/build}/devel/setup.bash"
set -u

# measure SCENARIO SEED [ARGUMENTS OF simulate...]
measure() {
  local bag=$work/$1_$2.bag
  rosrun stereo_nav simulate "$1" --seed "$2" --output "$bag" "${@:3}" >/dev/null || die "$1 cannot be simulated"
  rosrun stereo_nav find_loops "$bag" --output "$work/$1_$2" || die "$bag cannot be searched for loops"
  rm "$bag"
}

measure three_laps 1
measure three_laps 2 --set timing.free_running=true --set timing.rate_hz=12 --set sensor.rolling_shutter_ms=20
measure three_laps_webcam 1 --set timing.rate_hz=10
measure office 1 --set timing.rate_hz=8
for ((seed = 1; seed <= seeds; ++seed)); do
  measure like_doors "$seed" --set timing.rate_hz=6
done
