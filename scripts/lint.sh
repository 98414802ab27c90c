#!/usr/bin/env bash
# Check what no compiler checks: package, formatting, floors, sizes, scripts, launch files, documents.
#
#   scripts/lint.sh [--tidy [BUILD_DIR [FILE...]]]
#
# --tidy runs clang-tidy instead, over all sources of src/ or over those that are compiled together with these; .clang-tidy
# lists the checks. It needs nothing compiled: BUILD_DIR (build/ unless given) is configured, and its messages are generated.
#
# Prints one line a check in the Test Anything Protocol, what is wrong on standard error. A check whose tool is missing
# is skipped. Works on the files that git tracks.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"
cd "$STEREO_NAV_ROOT"

failures=0

# check NAME COMMAND...: runs the command, status 0 is good, 77 means that a tool is missing (last line says which).
check() {
  local name=$1 output status=0
  shift
  output=$("$@" 2>&1) || status=$?
  case $status in
    0) echo "ok lint.$name" ;;
    77) echo "ok lint.$name # SKIP ${output##*$'\n'}" ;;
    *)
      printf '%s\n' "$output" >&2
      echo "not ok lint.$name"
      failures=$((failures + 1))
      ;;
  esac
}

need() { command -v "$1" >/dev/null || { echo "$1 is not installed"; exit 77; }; }

# CMakeLists.txt says what it must not complain about; a checkout may be in a folder of any name.
catkin_lint_check() (
  need catkin_lint
  catkin_lint -W2 --strict --quiet --offline --ignore package_path_name .
)

# Another major version of clang-format formats differently.
format_check() (
  formatter=$(command -v clang-format-14 || command -v clang-format || true)
  [[ -n $formatter ]] || { echo "clang-format 14 is not installed"; exit 77; }
  "$formatter" --version | grep -q 'version 14\.' || { echo "$("$formatter" --version) found, 14 wanted"; exit 77; }
  unformatted=$(git ls-files -z '*.h' '*.cpp' | xargs -0 -r "$formatter" --dry-run 2>&1 | sed -n 's/:[0-9].*//p' | sort -u)
  [[ -z $unformatted ]] && return
  echo "not formatted:" "${unformatted//$'\n'/ }"
  echo "To format: $formatter -i FILE..."
  return 1
)

shell_check() (
  need shellcheck
  git ls-files -z '*.sh' .ci/run | xargs -0 -r shellcheck --severity=warning --external-sources --source-path=SCRIPTDIR
)

xml_check() (
  need xmllint
  git ls-files -z '*.xml' '*.launch' '*.test' '*.html' '*.svg' | xargs -0 -r xmllint --noout
)

yaml_check() (
  /usr/bin/python3 -c 'import yaml' || { echo "python3-yaml is not installed"; exit 77; }
  git ls-files -z '*.yaml' .clang-tidy .clang-format |
    xargs -0 -r /usr/bin/python3 -c 'import sys, yaml
for path in sys.argv[1:]:
    text = open(path).read().replace("%YAML:1.0", "")  # the header of OpenCV'"'"'s own files
    try:
        list(yaml.compose_all(text))
    except yaml.YAMLError as error:
        sys.exit(f"{path}: {error}")'
)

tidy_check() (
  configure "$1"
  cmake --build "$1" --target stereo_nav_generate_messages_cpp >"$1/generate.log" || { cat "$1/generate.log"; exit 1; }
  /usr/bin/python3 scripts/lib/tidy.py "$@"
)

python_check() (
  git ls-files -z '*.py' | xargs -0 -r /usr/bin/python3 -c 'import ast, sys
for path in sys.argv[1:]:
    ast.parse(open(path).read(), path)'
)

# Nothing that only exists on the machine where it was written. (A path after a variable, "$dir"/root/x, is none.)
path_check() (
  ! git grep -nIP '(?<![\w.~}-])(?<![\w}]")/(work|home|root|Users)/[\w.-]+' -- . ':!LICENSE'
)

floor_check() (/usr/bin/python3 scripts/lib/check_floors.py .)

size_check() (
  git ls-files -z 'src/*.h' 'src/*.cpp' 'include/*.h' | xargs -0 -r /usr/bin/python3 scripts/lib/check_sizes.py
)

# Every public class, function and field is documented; no documentation is wrong.
doxygen_check() (
  need doxygen
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  warnings=$({ cat Doxyfile; echo "OUTPUT_DIRECTORY=$folder"; } | doxygen - 2>&1 >/dev/null)
  [[ -z $warnings ]] && return
  printf '%s\n' "${warnings//$PWD\//}"
  return 1
)

link_check() (
  git ls-files -z '*.md' | xargs -0 -r /usr/bin/python3 scripts/lib/check_links.py
)

message_check() (
  git ls-files -z 'src/*.cpp' | xargs -0 /usr/bin/python3 scripts/lib/check_messages.py docs/troubleshooting.md
)

command_check() (
  /usr/bin/python3 -c 'import yaml' || { echo "python3-yaml is not installed"; exit 77; }
  /usr/bin/python3 scripts/lib/doc_commands.py .
)

case ${1:-} in
  --tidy)
    check clang_tidy tidy_check "$(absolute_path "${2:-build}")" "${@:3}"
    [[ $failures -eq 0 ]]
    exit
    ;;
  "") ;;
  *) die "unknown option '$1': --tidy or nothing" ;;
esac

check catkin_lint catkin_lint_check
check clang_format format_check
check shellcheck shell_check
check xml xml_check
check yaml yaml_check
check python python_check
check machine_paths path_check
check floors floor_check
check sizes size_check
check doxygen doxygen_check
check links link_check
check messages message_check
check commands command_check
[[ $failures -eq 0 ]]
