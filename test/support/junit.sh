# shellcheck shell=bash
# Sourced by scripts that run a test program where it may be unable to run at all.

# single_case RESULT.xml FOLDER skipped|failure MESSAGE: a JUnit file with one case, named after the file.
single_case() {
  cat >"$1" <<XML
<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="1"><testsuite name="$2" tests="1">
  <testcase classname="$2" name="$(basename "$1" .xml)"><$3 message="$4"/></testcase>
</testsuite></testsuites>
XML
}
