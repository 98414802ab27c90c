#!/usr/bin/env bash
# Runs a command beside a ROS master of its own, inside the virtual machine: with_master.sh COMMAND...
set -euo pipefail
export ROS_MASTER_URI=http://localhost:11411 ROS_HOSTNAME=localhost ROS_HOME=/tmp/ros_home ROS_LOG_DIR=/tmp/ros_home/log
mkdir -p "$ROS_LOG_DIR"
# Otherwise ROS' programs in Python load all of setuptools, which looks at every installed package: half a minute here.
export SETUPTOOLS_USE_DISTUTILS=stdlib
rosmaster --core -p 11411 >/tmp/rosmaster.log 2>&1 &
master=$!
trap 'kill $master' EXIT
until (: </dev/tcp/localhost/11411) 2>/dev/null; do
  kill -0 $master || { cat /tmp/rosmaster.log && exit 1; }
  sleep 0.5
done
"$@"
