#!/usr/bin/env bash
# Measures robot.launch with simulated devices (320x240, 30 Hz): time to the first odometry, latency from the image's stamp
# to the odometry, time that Ctrl-C takes.
#
#   scripts/measure_robot.sh [--seconds S] [--disparity] [ROSLAUNCH_ARGUMENT...]
#
# --disparity has somebody subscribe to camera/disparity, so that the disparity nodelet works. The arguments are those of
# launch/robot.launch, e.g. config:=FILE nodelet:=false. Says the machine's load before and after.
# Needs the built package in the environment (source BUILD_DIR/devel/setup.bash). The master has a port of its own.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

seconds=20 disparity=false arguments=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --seconds) shift; seconds=${1:?--seconds needs a number} ;;
    --disparity) disparity=true ;;
    -h | --help) usage; exit 0 ;;
    -*) die "unknown option '$1'. See scripts/measure_robot.sh --help" ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

work=$(mktemp -d)
processes=()
finish() {
  for pid in "${processes[@]}"; do kill -INT "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
export ROS_HOME=$work/ros_home ROS_HOSTNAME=localhost
port=$((20000 + RANDOM % 10000))
export ROS_MASTER_URI=http://localhost:$port

load() { cut -d' ' -f1-3 /proc/loadavg; }
echo "load before: $(load)"
if $disparity; then
  (until rosparam list >/dev/null 2>&1; do sleep 0.2; done; exec rostopic hz /camera/disparity) >/dev/null 2>&1 &
  processes+=($!)
fi
# The measuring program waits for the master that roslaunch starts, so that its clock runs from the same moment.
roslaunch -p "$port" stereo_nav robot.launch simulated:=true "${arguments[@]}" >"$work/robot.log" 2>&1 &
robot=$!
processes+=("$robot")
/usr/bin/python3 "$STEREO_NAV_ROOT/scripts/lib/measure_latency.py" "$seconds" 2>"$work/measure.log" ||
  { cat "$work/measure.log" "$work/robot.log" >&2; die "the measurement failed"; }
timeout 5 rostopic echo -n 20 /diagnostics 2>/dev/null >"$work/diagnostics" || true
awk '/key: "(pairs published|pairs dropped as too late|frames|frames dropped|frames lost|latency median \[ms\]|latency p95 \[ms\])"/ {
       key = $0; sub(/.*key: /, "", key); getline; sub(/.*value: /, ""); last[key] = $0 }
     END { for (key in last) print "  " key " " last[key] }' "$work/diagnostics" | sort
begin=$(date +%s.%N)
kill -INT "$robot"
wait "$robot" || true
echo "Ctrl-C to the end of roslaunch: $(awk "BEGIN {printf \"%.2f\", $(date +%s.%N) - $begin}") s"
grep -c 'escalating' "$work/robot.log" | sed 's/^/nodes that had to be ended the hard way: /' || true
echo "load after: $(load)"
