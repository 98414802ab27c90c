#!/usr/bin/env bash
# scripts/screenshot.sh makes a picture of rviz with a drive in it: screenshot_test.sh BUILD_DIR RESULT.xml
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$top/test/support/junit.sh"
build_dir=$1 result=$2
mkdir -p "$(dirname "$result")"
rm -f "$result"
for tool in rviz Xvfb import convert; do
  command -v "$tool" >/dev/null && continue
  single_case "$result" scripts skipped "$tool is not installed"
  exit 0
done
# shellcheck disable=SC1091
set +u && source "$build_dir/devel/setup.bash" && set -u
picture=$(mktemp --suffix=.png)
trap 'rm -f "$picture"' EXIT
# fail MESSAGE: ends the test.
fail() { single_case "$result" scripts failure "$1"; echo "$1"; exit 1; }

"$top/scripts/screenshot.sh" --at 4 --output "$picture" || fail "screenshot.sh ended with status $?"
read -r size colours < <(identify -format '%wx%h %k\n' "$picture")
echo "$size, $colours colours"
[[ $size == 1400x850 ]] || fail "$size is not the size of the screen"
# An empty window has about 60; camera image, disparity and features bring the rest.
[[ $colours -ge 150 ]] || fail "the window is nearly empty: $colours colours"
single_case "$result" scripts passed
