#!/usr/bin/env bash
# The default odometry on the real recordings, held against public systems and the robot's static board:
#   recordings_test.sh BUILD_DIR RESULT.xml
# What is measured and compared is that of scripts/results.sh, without its times.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$top/test/support/junit.sh"
build_dir=$1 result=$2
mkdir -p "$(dirname "$result")"
rm -f "$result"
if [[ ! -d ${STEREO_NAV_DATA:-} ]]; then
  single_case "$result" recordings skipped "STEREO_NAV_DATA names no folder of recordings"
  exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

status=0
STEREO_NAV_BUILD=$build_dir "$top/scripts/results.sh" --once "$work" vo.yaml >"$work/table" || status=$?
cat "$work/table"
/usr/bin/python3 "$top/scripts/lib/compare_with_peers.py" "$work" --junit "$result" >/dev/null || status=$?
[[ -s $result ]] || single_case "$result" recordings failure "results.sh ended with status $status and no result"
# The best of the peers, fovis, has 0.013 m.
if ! awk '/^- vo.yaml:/ {for (i = 1; i < NF; ++i) if ($i == "spread") good = $(i + 1) <= 0.013} END {exit !good}' "$work/table"; then
  single_case "${result%.xml}-board.xml" recordings failure "the static board spreads by more than 0.013 m"
  status=1
fi
exit "$status"
