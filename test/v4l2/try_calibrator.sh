#!/usr/bin/env bash
# Inside the virtual machine, beside a ROS master: the documented calibration command with its window on a virtual
# screen, on the real capture node. Arguments: folder of the programs, seconds to run. Leaves /vm-out/calibrator.png.
set -euo pipefail
programs=$1 seconds=$2
export DISPLAY=:1 LIBGL_ALWAYS_SOFTWARE=1 PYTHONUNBUFFERED=1
Xvfb :1 -screen 0 1024x768x24 >/tmp/xvfb.log 2>&1 &
pids=($!)
trap 'kill "${pids[@]}"' EXIT
"$programs/v4l2_test_checkerboard" & pids+=($!)
sleep 1
"$programs/stereo_capture" _left/device:=/dev/video10 _right/device:=/dev/video11 _width:=320 _height:=240 \
  _rate_hz:=2.0 _max_skew_s:=0.1 _stall_timeout_s:=30.0 _load_image_proc:=false & pids+=($!)
/usr/bin/python3 /usr/lib/camera_calibration/cameracalibrator.py --size 8x6 --square 0.051 --approximate 0.02 \
  right:=/camera/right/image_raw left:=/camera/left/image_raw \
  right_camera:=/camera/right left_camera:=/camera/left & pids+=($!)
sleep "$seconds"
import -window root /vm-out/calibrator.png
