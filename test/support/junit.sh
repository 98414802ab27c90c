# shellcheck shell=bash
# Sourced by scripts that run a test program where it may be unable to run at all, or that are the test themselves.

# single_case RESULT.xml FOLDER passed|skipped|failure [MESSAGE]: a JUnit file with one case, named after the file.
single_case() {
  local outcome=""
  [[ $3 == passed ]] || outcome="<$3 message=\"$4\"/>"
  cat >"$1" <<XML
<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="1"><testsuite name="$2" tests="1">
  <testcase classname="$2" name="$(basename "$1" .xml)">$outcome</testcase>
</testsuite></testsuites>
XML
}
