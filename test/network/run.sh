#!/usr/bin/env bash
# Runs a GoogleTest program on the base station of two machines on a network of their own: run.sh RESULT.xml COMMAND...
#
# The machines are the network namespaces `robot` (10.0.0.1, where the master will be) and `base` (10.0.0.2); a bridge in
# a third one, `air`, joins them. While the bridge is down packets vanish, as between radios out of reach, and no
# interface of either machine notices:
#   ip netns exec robot COMMAND...      a command on the robot
#   ip -n air link set bridge down      cuts the link; up joins it again
#
# All of it lives in namespaces of this run (mounts, processes, network), so that the kernel takes everything away with
# it, however it ends, and several runs do not meet. Root is not needed where users may make namespaces. Where nobody
# may, the result is one skipped case that says why.
set -euo pipefail
export PATH=$PATH:/usr/sbin:/sbin
folder=$(dirname "${BASH_SOURCE[0]}")
source "$folder/../support/junit.sh"

# Inside: makes the network and runs the command on the base.
if [[ $1 == --inside ]]; then
  shift
  mount -t tmpfs tmpfs /run
  for machine in air robot base; do
    ip netns add "$machine"
    ip -n "$machine" link set lo up
  done
  ip -n air link add bridge type bridge
  ip -n air link set bridge up
  for machine in robot base; do
    ip -n air link add "$machine" type veth peer name eth0 netns "$machine"
    ip -n air link set "$machine" master bridge up
    ip -n "$machine" link set eth0 up
  done
  ip -n robot address add 10.0.0.1/24 dev eth0
  ip -n base address add 10.0.0.2/24 dev eth0
  [[ $# -gt 0 ]] || exit 0  # a trial, whether this host can do it
  export ROS_MASTER_URI=http://10.0.0.1:11311 ROS_IP=10.0.0.2
  unset ROS_HOSTNAME ROS_NAMESPACE
  # Not exec: this shell, the first process in here, collects orphans and takes all others with it.
  ip netns exec base "$@"
  exit
fi

result=$1
shift
mkdir -p "$(dirname "$result")"
rm -f "$result"
isolated=(unshare --mount --net --pid --fork --kill-child --mount-proc)
[[ $EUID -eq 0 ]] || isolated+=(--user --map-root-user)
if ! reason=$("${isolated[@]}" "${BASH_SOURCE[0]}" --inside 2>&1); then
  reason="no network namespaces here: $(tail -n 1 <<<"$reason" | tr -d '"<>&')"
  echo "$reason"
  single_case "$result" network skipped "$reason"
  exit 0
fi
status=0
GTEST_OUTPUT=xml:$result "${isolated[@]}" "${BASH_SOURCE[0]}" --inside "$@" || status=$?
[[ -s $result ]] || single_case "$result" network failure "the test ended with status $status and no result"
exit "$status"
