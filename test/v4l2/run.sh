#!/usr/bin/env bash
# Runs a GoogleTest program on the virtual cameras of vm.sh: run.sh SECONDS RESULT.xml COMMAND...
# The result is the program's own JUnit file; where the machine cannot run, one skipped case that says why.
set -euo pipefail

seconds=$1 result=$2
shift 2
folder=$(dirname "${BASH_SOURCE[0]}")
name=$(basename "$result" .xml)
mkdir -p "$(dirname "$result")"
rm -f "$result"

# single_case OUTCOME MESSAGE: a JUnit file with one case.
single_case() {
  cat >"$result" <<XML
<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="1"><testsuite name="v4l2" tests="1">
  <testcase classname="v4l2" name="$name"><$1 message="$2"/></testcase>
</testsuite></testsuites>
XML
}

if ! reason=$("$folder/vm.sh" --check); then
  echo "$reason"
  single_case skipped "$reason"
  exit 0
fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
status=0
GTEST_OUTPUT=xml:/vm-out/result.xml
"$folder/vm.sh" --out "$out" --seconds "$seconds" -- env GTEST_OUTPUT=$GTEST_OUTPUT "$@" || status=$?
if [[ -s $out/result.xml ]]; then
  cp "$out/result.xml" "$result"
else
  single_case failure "the machine ended with status $status and no result"
fi
exit "$status"
