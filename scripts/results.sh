#!/usr/bin/env bash
# Measure the odometry on every case made from the recordings in $STEREO_NAV_DATA and print Markdown tables.
#
#   scripts/results.sh [--once] [WORK_DIR] [CONFIG...]
#   scripts/results.sh --simulated [WORK_DIR] [CONFIG...]
#
# --simulated: drives through the simulated world instead, before the kind camera and before a webcam, each with and
# without the IMU; errors and consistency alone, no times. It needs no recordings.
#
# WORK_DIR (default: a new temporary folder) keeps the bags and, for each case and configuration, what `evaluate`
# writes. CONFIG: files of config/ (default: vo.yaml vo_thesis.yaml). The package must be built (scripts/build.sh).
# Pinned to one core with taskset; a case with few frames is repeated until its timing rests on about 1000 frames,
# except with --once, which is for the errors alone. At the end vo.yaml is compared with public systems
# (scripts/lib/peers.yaml); the script ends with 1 where it is worse and must not be.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
once=false simulated=false
case ${1:-} in
  --once) once=true; shift ;;
  --simulated) simulated=true; shift ;;
esac
$simulated || [[ -d ${STEREO_NAV_DATA:-} ]] ||
  die "STEREO_NAV_DATA names no folder; set it to the one that holds euroc_mh01_a"
work=$(realpath "${1:-$(mktemp -d)}")
shift || true
configs=("$@")
[[ ${#configs[@]} -gt 0 ]] || configs=(vo.yaml vo_thesis.yaml)
set +u
source "${STEREO_NAV_BUILD:-$STEREO_NAV_ROOT/build}/devel/setup.bash"
set -u
mkdir -p "$work"

# The same drives before both cameras, 640x480 each: the disparity map reaches as near as at 320x240.
simulated_table() {
  sed 's/^disparity_range: .*/disparity_range: 128/' "$STEREO_NAV_ROOT/config/disparity.yaml" >"$work/disparity.yaml"
  echo "| drive | camera | IMU | configuration | frames | lost | ATE m | rel. % | rel. deg/m | NEES 0.2 s | NEES 1 s | NEES 5 s |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
  local drive camera scenario imu config bag out settings options
  local -A seconds=([loop]=20 [turn_in_place]=20)  # these go on in the same way
  for drive in arena corridor loop turn_in_place crowd; do
    for camera in kind webcam; do
      bag=$work/$drive-$camera.bag scenario=$drive settings=(--set rig.image_scale=2)
      [[ $camera == kind ]] || scenario=${drive}_webcam settings=()
      [[ -s $bag ]] || rosrun stereo_nav simulate "$scenario" --output "$bag" --duration "${seconds[$drive]:-1000}" \
        "${settings[@]}" >"$work/$drive-$camera.log" 2>&1 || die "$drive, $camera cannot be made: $(tail -n 1 "$work/$drive-$camera.log")"
      for config in "${configs[@]}"; do
        for imu in yes no; do
          out=$work/$drive-$camera-${config%.yaml}-$imu options=(--disparity-config "$work/disparity.yaml")
          [[ $imu == yes ]] || options+=(--no-imu)
          rosrun stereo_nav evaluate "$bag" --config "$config" "${options[@]}" --output "$out" >"$out.log" 2>&1 ||
            [[ $? -eq 3 ]] || die "$drive, $camera with $config failed: $(tail -n 1 "$out.log")"
          /usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/results_row.py" --simulated "$drive | $camera | $imu" "$config" "$out"
        done
      done
    done
  done
}

if $simulated; then
  simulated_table
  exit
fi
euroc=$STEREO_NAV_DATA/euroc_mh01_a kitti=$STEREO_NAV_DATA/kitti06_a unibo=$STEREO_NAV_DATA/unibo_robot

# name, repetitions, arguments of import_sequence
cases=(
  "euroc|5|--format euroc $euroc"
  "euroc_no_imu|5|--format euroc $euroc --no-imu"
  "euroc_reversed|5|--format euroc $euroc --reverse"
  "euroc_reversed_no_imu|5|--format euroc $euroc --reverse --no-imu"
  "euroc_mirrored|5|--format euroc $euroc --mirror"
  "euroc_mirrored_no_imu|5|--format euroc $euroc --mirror --no-imu"
  "euroc_every_2nd|10|--format euroc $euroc --every 2"
  "euroc_every_2nd_no_imu|10|--format euroc $euroc --every 2 --no-imu"
  "euroc_right_50ms_late|10|--format euroc $euroc --every 2 --right-lag-frames 1"
  "euroc_right_50ms_late_no_imu|10|--format euroc $euroc --every 2 --right-lag-frames 1 --no-imu"
  "kitti|20|--format kitti $kitti"
  "kitti_reversed|20|--format kitti $kitti --reverse"
  "kitti_mirrored|20|--format kitti $kitti --mirror"
  "unibo|3|--format images $unibo"
)

echo "| case | configuration | frames | lost | ATE m | rel. % | rel. deg/m | end % | ms median | ms p95 | ratio | disparity ms |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
for case in "${cases[@]}"; do
  IFS='|' read -r name repeat arguments <<<"$case"
  if $once; then repeat=1; fi
  # shellcheck disable=SC2086  # the arguments are words
  [[ -s $work/$name.bag ]] || rosrun stereo_nav import_sequence $arguments --output "$work/$name.bag" >"$work/$name.log" 2>&1 ||
    die "$name cannot be made: $(tail -n 1 "$work/$name.log")"
  for config in "${configs[@]}"; do
    out=$work/$name-${config%.yaml}
    taskset -c 1 rosrun stereo_nav evaluate "$work/$name.bag" --config "$config" --repeat "$repeat" --output "$out" \
      >"$out.log" 2>&1 || [[ $? -eq 3 ]] || die "$name with $config failed: $(tail -n 1 "$out.log")"
    /usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/results_row.py" "$name" "$config" "$out"
  done
done

echo
echo "Spread of the static board of unibo_robot in the odometry frame:"
for config in "${configs[@]}"; do
  echo "- $config: $("$STEREO_NAV_ROOT/scripts/landmark_spread.py" "$work/unibo-${config%.yaml}/trajectory.kitti" \
    "$unibo/board_track_stereo.txt")"
done

if [[ " ${configs[*]} " == *" vo.yaml "* ]]; then
  echo
  /usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/compare_with_peers.py" "$work"
fi
