#!/usr/bin/env bash
# Drive the simulated robot to goals by its cameras alone, with each localisation, and print a row for each course: the table of
# docs/results_driving.md.
#
#   scripts/closed_loop_results.sh [--seeds N] [WORK_DIR]
#
# N seeds for each course, 20 unless given: some hours. WORK_DIR (default: a new temporary folder) keeps goals, trace and picture of
# each run; what is there already is not run again. The package must be built (scripts/build.sh).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
seeds=20
if [[ ${1:-} == --seeds ]]; then
  seeds=${2:?--seeds needs a number}
  shift 2
fi
work=$(realpath "${1:-$(mktemp -d)}")
set +u
source "${STEREO_NAV_BUILD:-$STEREO_NAV_ROOT/build}/devel/setup.bash"
set -u

declare -A courses=([arena]="arena" [random]="loop --random 10" [box]="goals/box_in_way" [dead_end]="goals/dead_end" [crossing]="goals/crossing")
for course in arena random box dead_end crossing; do
  for odometry in truth vo.yaml; do
    for ((seed = 1; seed <= seeds; ++seed)); do
      out=$work/$course-${odometry%.yaml}-$seed
      [[ -f $out/summary.json ]] && continue
      # shellcheck disable=SC2086  # a scenario and its options
      rosrun stereo_nav closed_loop ${courses[$course]} --odometry "$odometry" --seed "$seed" --output "$out" \
        --set rig.samples_per_pixel=1 --set timing.rate_hz=15 >"$work/log" 2>&1 || [[ $? -eq 1 ]] || cat "$work/log"
    done
  done
done
"$STEREO_NAV_ROOT/scripts/lib/closed_loop_table.py" "$work"
