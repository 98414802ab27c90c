#!/usr/bin/env bash
# The pictures of the documents: rviz on a simulated drive, without a screen (Xvfb, OpenGL in software).
#
#   scripts/screenshot.sh [--view robot|offline] [--at SECONDS] [--output FILE.png] [ROBOT_LAUNCH_ARGUMENT...]
#
# Starts robot.launch simulated:=true and visualise.launch, takes the picture SECONDS (default 18) after the first odometry.
# Default output: docs/images/rviz_VIEW.png. Needs the built package in the environment
# (source BUILD_DIR/devel/setup.bash), and rviz, Xvfb and ImageMagick: scripts/install_dependencies.sh visualise
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

view=robot at=18 output="" arguments=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --view) shift; view=${1:?--view needs a name} ;;
    --at) shift; at=${1:?--at needs seconds} ;;
    --output) shift; output=${1:?--output needs a file} ;;
    -h | --help) usage; exit 0 ;;
    -*) die "unknown option '$1'. See scripts/screenshot.sh --help" ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
output=${output:-$STEREO_NAV_ROOT/docs/images/rviz_$view.png}
for tool in rviz Xvfb import convert roslaunch; do
  command -v "$tool" >/dev/null || die "$tool is not installed. See scripts/screenshot.sh --help"
done

work=$(mktemp -d)
processes=()
finish() {
  for pid in "${processes[@]}"; do kill -INT "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
export ROS_HOME=$work/ros_home ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:$((20000 + RANDOM % 10000))

# -displayfd: Xvfb looks for a free display itself and says which.
Xvfb -displayfd 3 -screen 0 1400x850x24 3>"$work/display" >"$work/xvfb.log" 2>&1 &
processes+=($!)
until [[ -s $work/display ]]; do sleep 0.1; done
DISPLAY=:$(<"$work/display")
export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1 XDG_RUNTIME_DIR=$work

roscore -p "${ROS_MASTER_URI##*:}" >"$work/roscore.log" 2>&1 &
processes+=($!)
until rosparam list >/dev/null 2>&1; do
  kill -0 "${processes[-1]}" 2>/dev/null || die "roscore ended at once: $(tail -n 1 "$work/roscore.log")"
  sleep 0.2
done
show() {
  roslaunch stereo_nav visualise.launch view:="$view" >"$work/visualise.log" 2>&1 &
  viewer=$!
  processes+=("$viewer")
}
show
# rviz first: what it draws over time, such as the truth, is then complete.
again=true
until rostopic info /path 2>/dev/null | grep -q rviz && kill -0 "$viewer" 2>/dev/null; do
  if ! kill -0 "$viewer" 2>/dev/null; then
    cat "$work/visualise.log" >&2
    # On a busy machine it may die of a signal while it starts.
    $again && grep -q 'process has died \[pid [0-9]*, exit code -[0-9]*, cmd [^ ]*/rviz ' "$work/visualise.log" ||
      die "rviz has ended"
    say "rviz has died while it started; it is started once more"
    again=false
    rosnode cleanup <<<y >/dev/null 2>&1 || true  # the first one's subscriptions
    show
  fi
  sleep 0.5
done
roslaunch stereo_nav robot.launch simulated:=true "${arguments[@]}" >"$work/robot.log" 2>&1 &
processes+=($!)
timeout 120 rostopic echo -n1 /odom >/dev/null || { cat "$work/robot.log" >&2; die "no odometry comes"; }
say "odometry runs; the picture is taken in $at s"
sleep "$at"
mkdir -p "$(dirname "$output")"
import -window root "$work/screen.png"
convert "$work/screen.png" -strip +dither -colors 200 "PNG8:$output"
say "$output, $(($(stat -c %s "$output") / 1024)) kB"
