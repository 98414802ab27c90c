#!/usr/bin/env bash
# Runs a GoogleTest program on the virtual cameras of vm.sh: run.sh SECONDS RESULT.xml [--skip-idle] COMMAND...
# The result is the program's own JUnit file; where the machine cannot run, one skipped case that says why.
set -euo pipefail

seconds=$1 result=$2 options=()
shift 2
if [[ $1 == --skip-idle ]]; then options=("$1") && shift; fi
folder=$(dirname "${BASH_SOURCE[0]}")
source "$folder/../support/junit.sh"
mkdir -p "$(dirname "$result")"
rm -f "$result"

if ! reason=$("$folder/vm.sh" --check); then
  echo "$reason"
  single_case "$result" v4l2 skipped "$reason"
  exit 0
fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
status=0
GTEST_OUTPUT=xml:/vm-out/result.xml
"$folder/vm.sh" --out "$out" --seconds "$seconds" "${options[@]}" -- env GTEST_OUTPUT=$GTEST_OUTPUT "$@" || status=$?
if [[ -s $out/result.xml ]]; then
  cp "$out/result.xml" "$result"
else
  single_case "$result" v4l2 failure "the machine ended with status $status and no result"
fi
exit "$status"
