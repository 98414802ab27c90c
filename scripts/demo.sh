#!/usr/bin/env bash
# One command: a simulated robot drives the course of the thesis, the whole node graph runs on its cameras and IMU at
# real time, and the error against the truth is shown.
#
#   scripts/demo.sh [--rviz] [--config NAME] [BUILD_DIR]
#
# --config is a file of config/ (default vo.yaml; vo_thesis.yaml is the method as published). --rviz shows the drive.
# Results are in BUILD_DIR/demo. Installs what is missing and builds first. Works from any folder, any number of times.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

rviz=false config=vo.yaml build_dir=$STEREO_NAV_ROOT/build
while [[ $# -gt 0 ]]; do
  case $1 in
    --rviz) rviz=true ;;
    --config) shift; config=${1:?--config needs a name} ;;
    -h | --help) usage; exit 0 ;;
    -*) die "unknown option '$1'. See scripts/demo.sh --help" ;;
    *) build_dir=$(absolute_path "$1") ;;
  esac
  shift
done
[[ -f $STEREO_NAV_ROOT/config/$config ]] || die "no config/$config; there are: $(cd "$STEREO_NAV_ROOT/config" && echo vo*.yaml)"

seconds_before=$SECONDS
"$STEREO_NAV_ROOT/scripts/build.sh" "$build_dir"
build_seconds=$((SECONDS - seconds_before))
# shellcheck disable=SC1091
set +u && source "$build_dir/devel/setup.bash" && set -u

out=$build_dir/demo
mkdir -p "$out"
export ROS_HOME=$out/ros ROS_MASTER_URI=http://localhost:$((11400 + $$ % 1000))
processes=()
stop_all() {
  for pid in "${processes[@]}"; do kill -INT "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
}
trap stop_all EXIT

demo_start=$SECONDS
say "rendering the arena"
rosrun stereo_nav simulate arena --output "$out/arena.bag"
duration=$(/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/drive_table.py" --duration "$out/arena.bag")

say "driving it at real time: roslaunch stereo_nav replay.launch, ${duration} s"
roscore -p "${ROS_MASTER_URI##*:}" >"$out/roscore.log" 2>&1 &
master=$!
processes+=("$master")
until rosparam list >/dev/null 2>&1; do
  kill -0 "$master" 2>/dev/null || die "roscore ended at once; see $out/roscore.log"
  sleep 0.2
done
rosparam set /use_sim_time true
rm -f "$out/drive.bag"
rosbag record -q -O "$out/drive.bag" odom ground_truth/odom ground_truth/waypoint >"$out/record.log" 2>&1 &
recorder=$!
processes+=("$recorder")
if $rviz; then
  rosrun rviz rviz -d "$STEREO_NAV_ROOT/config/rviz/offline.rviz" >"$out/rviz.log" 2>&1 &
  processes+=($!)
fi
roslaunch stereo_nav replay.launch bag:="$out/arena.bag" config:="$STEREO_NAV_ROOT/config/$config" exit_at_end:=true \
  >"$out/roslaunch.log" 2>&1 &
graph=$!
processes+=("$graph")
launched=$SECONDS
while kill -0 "$graph" 2>/dev/null; do
  [[ -t 1 ]] && printf '\r  %3d s of about %d s' $((SECONDS - launched)) $((duration + 5))
  ((SECONDS - launched < duration + 120)) || die "the drive does not end; see $out/roslaunch.log"
  sleep 1
done
[[ -t 1 ]] && echo
kill -INT "$recorder" && wait "$recorder" || true

say "measuring"
rosrun stereo_nav evaluate "$out/arena.bag" --config "$config" --output "$out/report" >"$out/evaluate.log" 2>&1 ||
  die "evaluate failed; see $out/evaluate.log"
/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/drive_table.py" "$out/drive.bag" --picture "$out/path.svg"
cat <<END
picture of the live drive   $out/path.svg
report (same bag, offline)  $out/report/report.html
time: installing and building ${build_seconds} s, demo $((SECONDS - demo_start)) s
END
