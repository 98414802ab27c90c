#!/usr/bin/env bash
# Checks that what we install works without the source tree: install_checks.sh BUILD_DIR. Prints Test Anything Protocol
# lines, what went wrong on standard error.
#
# Installs in both ways that there are, each into an empty folder below BUILD_DIR/.install_checks: `cmake --install` of
# BUILD_DIR, and `catkin_make install` of a workspace. Uses each as another user would: programs, launch files, and the
# package of somebody else in test/external_package, which uses the library and the nodelet.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

# Hidden, since roslaunch looks for every node in all of the package's folder and follows links: that of the workspace leads
# back to the package.
work_dir=$(absolute_path "$1")/.install_checks
workspace=$work_dir/workspace
rm -rf "$work_dir/prefix" "$work_dir/external" "$workspace/install"  # what was compiled is used again
mkdir -p "$workspace/src"

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

# as_user COMMAND...: with the environment of the install space $prefix, and of this package nothing but that.
as_user() (
  set +u
  source "$prefix/setup.bash"
  set -u
  "$@"
)

install_package() { cmake --install "${work_dir%/*}" --prefix "$prefix"; }

# The workspace compiles by the commands of BUILD_DIR, with other places; what these have made is taken over, and only
# what differs compiled. Without catkin_make's habit of waiting until the computer is idle.
catkin_make_install() {
  ln -sfn "$STEREO_NAV_ROOT" "$workspace/src/stereo_nav"
  ln -sfn "$STEREO_NAV_ROOT/test/external_package" "$workspace/src/stereo_nav_user"
  local launcher="/usr/bin/python3;$STEREO_NAV_ROOT/scripts/lib/same_object.py;${work_dir%/*};$workspace" status=0
  if command -v ccache >/dev/null; then launcher+=";ccache"; fi
  rm -f "$workspace/same_object.log"
  catkin_make install -C "$workspace" -j "$(nproc)" -l 1000 -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCMAKE_BUILD_TYPE=Release \
    -DSTEREO_NAV_WERROR=ON -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" || status=$?
  [[ ! -f $workspace/same_object.log ]] || cut -d' ' -f1 "$workspace/same_object.log" | sort | uniq -c
  return $status
}

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

# The nodelets' description is found, and each library it names is where it says.
nodelets_found() {
  local description library libraries
  description=$(as_user rospack plugins --attrib=plugin nodelet | awk '$1 == "stereo_nav" {print $2}')
  [[ $description == "$prefix/share/stereo_nav/"* ]] || return 1
  libraries=$(sed -n 's/.*<library path="\([^"]*\)".*/\1.so/p' "$description")
  [[ -n $libraries ]] || return 1
  for library in $libraries; do
    [[ -f $prefix/$library ]] || { echo "$prefix/$library is missing"; return 1; }
  done
}

# external_programs FOLDER: the other package's programs, one for each library, run on what is installed.
external_programs() (
  share=$prefix/share/stereo_nav
  cd "$work_dir"
  ran=0
  for program in "$1"/use_*; do
    arguments=()
    case ${program##*/} in
      use_odometry) arguments=("$share/config/vo_thesis.yaml") ;;
      use_ros) arguments=("$share/bags/arena_start.bag") ;;
    esac
    echo "$program" "${arguments[@]}"
    as_user "$program" "${arguments[@]}" || { echo "$program failed"; exit 1; }
    ran=$((ran + 1))
  done
  [[ $ran -eq $(find "$STEREO_NAV_ROOT/test/external_package" -name 'use_*.cpp' | wc -l) ]]
)

external_package_runs() {
  as_user cmake -S "$STEREO_NAV_ROOT/test/external_package" -B "$work_dir/external" \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 &&
    cmake --build "$work_dir/external" &&
    external_programs "$work_dir/external/devel/lib/stereo_nav_user"
}

# The other package's launch file loads the nodelet into its own manager, and odometry comes out of that.
external_nodelet_runs() (
  export ROS_MASTER_URI=http://localhost:$((20000 + $$ % 10000)) ROS_HOSTNAME=localhost ROS_HOME=$work_dir/ros_home
  as_user roslaunch -p "${ROS_MASTER_URI##*:}" --pid="$work_dir/roslaunch.pid" \
    "$STEREO_NAV_ROOT/test/external_package/launch/own_manager.launch" &
  trap 'kill -INT "$(cat "$work_dir/roslaunch.pid")"; wait' EXIT
  as_user timeout 120 bash -c 'until rostopic info /odom 2>/dev/null | grep -q "/own_manager "; do sleep 1; done' &&
    as_user timeout 120 rostopic echo -n 1 /odom
)

prefix=$work_dir/prefix
check into_prefix install_package
check package_found package_found
check programs_complete programs_complete
check nodelets_found nodelets_found
check external_package external_package_runs
check external_nodelet external_nodelet_runs

prefix=$workspace/install
check catkin_make catkin_make_install
check catkin_make_package_found package_found
check catkin_make_programs_complete programs_complete
check catkin_make_nodelets_found nodelets_found
check catkin_make_external_package external_programs "$prefix/lib/stereo_nav_user"
[[ $failures -eq 0 ]]
