#!/usr/bin/env bash
# Plays a recording through the whole graph and measures it: frames, latency of the odometry, CPU of each process.
#
#   scripts/measure_graph.sh [--hz] BAG [ROSLAUNCH_ARGUMENT...]
#
# The arguments are those of launch/replay.launch, e.g. nodelet:=false config:=FILE. --hz also runs `rostopic hz` on the
# rectified images, the disparity and the odometry; it receives every message, so that latency and CPU mean little then.
# Needs the built package in the environment (source BUILD_DIR/devel/setup.bash). The master has a port of its own.
set -euo pipefail

hz=false
if [[ ${1:-} == --hz ]]; then
  hz=true
  shift
fi
[[ $# -ge 1 ]] || { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d' >&2; exit 2; }
bag=$(realpath "$1")
shift

work=$(mktemp -d)
export ROS_HOME=$work/ros_home ROS_HOSTNAME=localhost
export ROS_MASTER_URI=http://localhost:$((20000 + RANDOM % 10000))
log=$work/roslaunch.log
roslaunch stereo_nav replay.launch "bag:=$bag" "$@" >"$log" 2>&1 &
launch=$!
helpers=()
finish() {
  [[ ${#helpers[@]} -eq 0 ]] || kill -INT "${helpers[@]}" 2>/dev/null || true
  kill -INT "$launch" 2>/dev/null || true
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT

until grep -q 'playback starts' "$log"; do
  kill -0 "$launch" 2>/dev/null || { cat "$log" >&2; exit 1; }
  sleep 0.2
done
topics=(/camera/left/image_rect /camera/right/image_rect /camera/disparity /odom)
if $hz; then
  for topic in "${topics[@]}"; do
    rostopic hz --wall-time --window 100000 "$topic" >"$work/hz${topic//\//_}" 2>&1 &
    helpers+=($!)
  done
fi

# NAME TICKS of each node; one that ends meanwhile is left out.
cpu_ticks() {
  local pid name
  for pid in $(pgrep -P "$launch"); do
    name=$(tr '\0' '\n' 2>/dev/null <"/proc/$pid/cmdline" | sed -n 's/^__name:=//p') || continue
    [[ -z $name ]] || echo "$name $(awk '{print $14 + $15}' "/proc/$pid/stat" 2>/dev/null)"
  done 2>/dev/null
}
cpu_ticks >"$work/before"
start=$(date +%s.%N)
until grep -q 'player.*has finished' "$log"; do
  cpu_ticks >"$work/now"
  ! grep -q "^player " "$work/now" || mv "$work/now" "$work/after"
  sleep 0.5
done
end=$(date +%s.%N)
sleep 1.5

echo "== CPU in % of one core, over $(awk "BEGIN {printf \"%.1f\", $end - $start}") s"
join <(sort "$work/before") <(sort "$work/after") |
  awk -v hz="$(getconf CLK_TCK)" -v s="$(awk "BEGIN {print $end - $start}")" '{printf "%-20s %6.1f\n", $1, 100 * ($3 - $2) / hz / s}'
echo "== odometry"
timeout 5 rostopic echo -n1 /diagnostics | grep -A1 'key:' | sed -n 's/.*key: "\(.*\)"/\1/p;s/.*value: "\(.*\)"/    \1/p'
if $hz; then
  for topic in "${topics[@]}"; do
    echo "== rostopic hz $topic"
    grep -A1 'average rate' "$work/hz${topic//\//_}" | tail -2
  done
fi
