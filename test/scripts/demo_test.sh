#!/usr/bin/env bash
# The demo, as a visitor runs it: demo_test.sh BUILD_DIR. The table must be there, the drive near the truth.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build_dir=$1

output=$("$top/scripts/demo.sh" "$build_dir" 2>&1) || { echo "$output"; exit 1; }
echo "$output"
fail() { echo "demo_test: $*"; exit 1; }

[[ $(grep -cE '^ +[0-9]+ +\([0-9.]+, -?[0-9.]+\) +[0-9.]+' <<<"$output") -eq 12 ]] || fail "no line for each way-point"
grep -q 'error at the way-points (m) *this drive *thesis: drive 1 *drive 2 *drive 3' <<<"$output" || fail "no table"
# 3 % of the course, at most; the thesis' drives have 1.25 m and more.
awk '$1 == "RMSE" {found = 1; good = $2 < 0.35 && $3 == 1.25} END {exit !(found && good)}' <<<"$output" || fail "RMSE"
grep -qE 'installing and building [0-9]+ s, demo [0-9]+ s' <<<"$output" || fail "times are not told"
for file in path.svg report/report.html; do
  [[ -s $build_dir/demo/$file ]] || fail "no $file"
done
