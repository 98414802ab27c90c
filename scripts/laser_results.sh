#!/usr/bin/env bash
# Measure the laser odometry on simulated robots with exact truth and on CARMEN logs with corrected poses.
#
#   scripts/laser_results.sh [WORK_DIR [FOLDER]]
#
# FOLDER (default: $STEREO_NAV_DATA) holds planar_sim/*.bag and carmen/*.log.gz. WORK_DIR (default: a new temporary folder) keeps
# bags and what `evaluate` writes. Prints a row for each recording, with wheels and gyroscope, by the laser alone, and by range
# flow (config/laser_range_flow.yaml): errors over 5 and 10 m, % and deg/m; steps that are more than 0.3 m or 10 degrees off; NEES
# of relative poses over 1 and 5 s (3 is expected) and the share of them inside 95 %; ms a scan. The package must be built
# (scripts/build.sh).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
folder=${2:-${STEREO_NAV_DATA:-}}
[[ -d $folder/planar_sim ]] || die "$folder/planar_sim is no folder; name the one that holds planar_sim and carmen, or set STEREO_NAV_DATA"
work=$(realpath "${1:-$(mktemp -d)}")
mkdir -p "$work"
set +u
source "${STEREO_NAV_BUILD:-$STEREO_NAV_ROOT/build}/devel/setup.bash"
set -u

bags=("$folder"/planar_sim/*.bag)
for log in "$folder"/carmen/*.log.gz; do
  [[ -f $log ]] || continue
  bag=$work/$(basename "$log" .log.gz).bag
  rosrun stereo_nav import_sequence --format carmen "$log" --output "$bag" >/dev/null || die "$log cannot be imported"
  bags+=("$bag")
done
results=()
for bag in "${bags[@]}"; do
  for how in with_prior no_prior range_flow; do
    result=$work/$(basename "$bag" .bag)-$how
    arguments=()
    if [[ $how == no_prior ]]; then arguments=(--no-prior); fi
    if [[ $how == range_flow ]]; then arguments=(--config laser_range_flow.yaml); fi
    rosrun stereo_nav evaluate "$bag" --method laser --segments 5,10 --output "$result" "${arguments[@]}" >"$result.log" ||
      die "$bag cannot be evaluated, see $result.log"
    results+=("$result")
  done
done
/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/laser_table.py" "${results[@]}"
