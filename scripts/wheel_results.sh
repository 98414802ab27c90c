#!/usr/bin/env bash
# Calibrate the wheels of OptiOdom's robot from the odd-numbered runs of all sets in a folder, and judge them on the even ones.
#
#   scripts/wheel_results.sh [WORK_DIR [FOLDER]]
#
# FOLDER (default: $STEREO_NAV_DATA/optiodom) holds SET_metadata.csv and SET_run-NN.csv. WORK_DIR (default: a new temporary
# folder) keeps bags, rig files and what `evaluate` writes. Prints a row for each set: mean end error of the even runs with
# nominal and calibrated wheels, % of the path, and the NEES of the relative poses over 5 s. The package must be built
# (scripts/build.sh).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
folder=${2:-${STEREO_NAV_DATA:-}/optiodom}
[[ -d $folder ]] || die "$folder is no folder; name the one with SET_run-NN.csv, or set STEREO_NAV_DATA"
work=$(realpath "${1:-$(mktemp -d)}")
mkdir -p "$work"
set +u
source "${STEREO_NAV_BUILD:-$STEREO_NAV_ROOT/build}/devel/setup.bash"
set -u

odd=()
for run in "$folder"/*_run-*.csv; do
  name=$(basename "$run" .csv)
  rosrun stereo_nav import_sequence --format optiodom "$run" --output "$work/$name.bag" --rig "$work/nominal.yaml" >/dev/null ||
    die "$run cannot be imported"
  number=$((10#${name##*-}))
  if ((number % 2 == 1)); then odd+=("$work/$name.bag"); fi
done
rosrun stereo_nav calibrate_wheels "${odd[@]}" --rig "$work/nominal.yaml" --output "$work/calibrated.yaml" >"$work/calibration.log"
for bag in "$work"/*_run-*.bag; do
  name=$(basename "$bag" .bag)
  if ((10#${name##*-} % 2 == 1)); then continue; fi
  for rig in nominal calibrated; do
    rosrun stereo_nav evaluate "$bag" --method wheel --rig "$work/$rig.yaml" --ground-truth-sigma-m 0.001 \
      --ground-truth-sigma-deg 0.1 --output "$work/$name-$rig" >"$work/$name-$rig.log" || die "$name failed"
  done
done
/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/wheel_table.py" "$work"
