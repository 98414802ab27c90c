#!/usr/bin/env bash
# Install the Debian packages that are missing, as root or with sudo.
#
#   scripts/install_dependencies.sh [GROUP...]
#
# GROUP: build (what building and running needs, the default), visualise (rviz, and the aggregator of diagnostics), test,
# experiments. The lists are in scripts/dependencies/.
# Says nothing and needs no network when everything is there.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

groups=("$@")
[[ $# -gt 0 ]] || groups=(build)
for group in "${groups[@]}"; do
  [[ " build visualise test experiments " == *" $group "* ]] ||
    die "unknown group '$group': build, visualise, test or experiments"
done

source /etc/os-release
list="$STEREO_NAV_ROOT/scripts/dependencies/$ID-${VERSION_ID:-}.txt"
if [[ ! -f $list ]]; then
  echo "install_dependencies.sh: no list for ${PRETTY_NAME:-this system} (there are ones for Debian 12 and Ubuntu 20.04" \
    "with ROS Noetic). Install what package.xml names, e.g. with rosdep; going on with what is there." >&2
  exit 0
fi

# Debian marks a package that is there as "ii"; virtual and removed-but-configured ones do not count.
missing=()
while read -r package group; do
  [[ " ${groups[*]} " == *" $group "* ]] || continue
  [[ $(dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null) == ii* ]] || missing+=("$package")
done < <(grep '^[^#]' "$list")
[[ ${#missing[@]} -gt 0 ]] || exit 0

say "installing ${#missing[@]} missing packages: ${missing[*]}"
as_root=()
if [[ $EUID -ne 0 ]]; then
  command -v sudo >/dev/null || die "neither root nor sudo. As root: apt-get install ${missing[*]}"
  as_root=(sudo)
fi
# Unreachable foreign sources are no reason to stop: what counts is whether the installation succeeds.
"${as_root[@]}" apt-get update -qq || echo "install_dependencies.sh: apt-get update had errors, going on" >&2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
  die "apt-get could not install them (its messages are above). Without ROS packages: is this system's 'main' (Debian)" \
    "or ROS Noetic's apt source (Ubuntu 20.04) enabled?"
