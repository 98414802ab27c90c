# shellcheck shell=bash
# Sourced by the scripts of this folder: where the package is, which tools count, how to report.

# The package's top folder, whatever folder the script is called from.
STEREO_NAV_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

# ROS's code generators need the distribution's own python3: a pyenv, conda or /usr/local one has none of their modules.
export PATH=/usr/bin:$PATH

# ROS 1 comes from the distribution itself (Debian) or from /opt/ros/noetic (Ubuntu 20.04).
if [[ -f /opt/ros/noetic/setup.bash && -z ${ROS_DISTRO:-} ]]; then
  set +u  # ROS's own setup files read variables that may be unset
  source /opt/ros/noetic/setup.bash
  set -u
fi

say() { echo "== $*"; }

die() {
  echo "${0##*/}: $*" >&2
  exit 2
}

# absolute_path PATH: PATH seen from the caller's folder; it need not exist.
absolute_path() { realpath -m -- "$1"; }

# configure BUILD_DIR [CMAKE_ARGUMENT...]: one way to configure for all scripts.
configure() {
  local build_dir=$1 launcher=""
  shift
  mkdir -p "$build_dir"
  command -v ccache >/dev/null && launcher=ccache
  cmake -S "$STEREO_NAV_ROOT" -B "$build_dir" \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DSTEREO_NAV_WERROR=ON -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" "$@" >"$build_dir/configure.log" 2>&1 && return
  cat "$build_dir/configure.log" >&2
  echo "The configuration failed. If $build_dir was made by another checkout or compiler, remove it and try again." >&2
  return 1
}
