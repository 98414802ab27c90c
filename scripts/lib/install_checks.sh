#!/usr/bin/env bash
# Checks that what we install works without the source tree: install_checks.sh BUILD_DIR. Prints Test Anything Protocol
# lines, what went wrong on standard error.
#
# Installs BUILD_DIR into an empty folder inside it and uses that as a stranger would: programs, launch files, and
# test/external_package built against the library.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

work_dir=$(absolute_path "$1")/install_checks
prefix=$work_dir/prefix
rm -rf "$work_dir"
mkdir -p "$work_dir"

failures=0
check() {
  local name=$1
  shift
  if "$@" >"$work_dir/$name.log" 2>&1; then
    echo "ok install.$name"
  else
    cat "$work_dir/$name.log" >&2
    echo "not ok install.$name"
    failures=$((failures + 1))
  fi
}

install_package() { cmake --install "${work_dir%/*}" --prefix "$prefix"; }

# as_user COMMAND...: with the install space's environment, and of this package nothing but that.
as_user() (
  set +u
  source "$prefix/setup.bash"
  set -u
  "$@"
)

package_found() { [[ $(as_user rospack find stereo_nav) == "$prefix/share/stereo_nav" ]]; }

# Every program finds its libraries.
programs_complete() {
  local program status=0
  for program in "$prefix"/lib/stereo_nav/*; do
    if as_user ldd "$program" 2>/dev/null | grep "not found"; then
      echo "missing in $program"
      status=1
    fi
  done
  return $status
}

# The nodelets' description is found, and the library it names is where it says.
nodelets_found() {
  local description
  description=$(as_user rospack plugins --attrib=plugin nodelet | awk '$1 == "stereo_nav" {print $2}')
  [[ $description == "$prefix/share/stereo_nav/"* ]] &&
    [[ -f $prefix/$(sed -n 's/.*<library path="\([^"]*\)".*/\1.so/p' "$description") ]]
}

external_package_runs() {
  as_user cmake -S "$STEREO_NAV_ROOT/test/external_package" -B "$work_dir/external" \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 &&
    cmake --build "$work_dir/external" &&
    as_user "$work_dir/external/devel/lib/stereo_nav_user/use_odometry" \
      "$prefix/share/stereo_nav/config/vo_thesis.yaml"
}

check into_prefix install_package
check package_found package_found
check programs_complete programs_complete
check nodelets_found nodelets_found
check external_package external_package_runs
[[ $failures -eq 0 ]]
