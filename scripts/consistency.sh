#!/usr/bin/env bash
# Hold the covariances of the odometry against its errors on simulated drives and print a Markdown table.
#
#   scripts/consistency.sh [WORK_DIR [SEEDS [CONFIG]]]
#
# Five drives, before the kind camera and before a webcam, cameras synchronised and free-running, with and without IMU, SEEDS
# times (default: 2, that is 80 runs); the cameras differ from their calibration as real ones do (calibration_error.scale=1),
# in each run by other values. WORK_DIR (default: a new temporary folder) keeps the summaries, and with KEEP_BAGS=1 the
# recordings; what it holds is not made again. CONFIG: a file of config/ (default: vo.yaml). The package must be built
# (scripts/build.sh).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
work=$(realpath "${1:-$(mktemp -d)}")
seeds=${2:-2} config=${3:-vo.yaml}
set +u
source "${STEREO_NAV_BUILD:-$STEREO_NAV_ROOT/build}/devel/setup.bash"
set -u
mkdir -p "$work"
longest_s=20

# drive camera clocks seed
run() {
  local name=$1-$2-$3-$4 scenario=$1 settings=(--set calibration_error.scale=1) imu options
  [[ $2 == kind ]] || scenario=${1}_webcam
  [[ $3 == synchronised ]] || settings+=(--set timing.free_running=true)
  [[ ! -s $work/$name-imu/summary.json || ! -s $work/$name-alone/summary.json ]] || return 0
  [[ -s $work/$name.bag ]] || rosrun stereo_nav simulate "$scenario" --output "$work/$name.bag" --seed "$4" --duration "$longest_s" \
    "${settings[@]}" >"$work/$name.log" 2>&1 || die "$name cannot be made: $(tail -n 1 "$work/$name.log")"
  for imu in imu alone; do
    options=()
    [[ $imu == imu ]] || options=(--no-imu)
    rosrun stereo_nav evaluate "$work/$name.bag" --config "$config" "${options[@]}" --output "$work/$name-$imu" >"$work/$name-$imu.log" 2>&1 ||
      [[ $? -eq 3 ]] || die "$name, $imu failed: $(tail -n 1 "$work/$name-$imu.log")"
  done
  [[ ${KEEP_BAGS:-0} == 1 ]] || rm "$work/$name.bag"
}

number=0
for ((round = 0; round < seeds; ++round)); do
  for drive in arena corridor loop turn_in_place crowd; do
    for camera in kind webcam; do
      for clocks in synchronised free; do
        run "$drive" "$camera" "$clocks" $((++number))
      done
    done
  done
done
/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/consistency_table.py" "$work"
