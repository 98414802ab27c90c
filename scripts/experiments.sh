#!/usr/bin/env bash
# The experiments of the thesis and the curves beyond them, on simulated drives with exact ground truth.
#
#   scripts/experiments.sh [--seeds N] [--build BUILD_DIR] [--output DIR] [--cores N] [SNAKEMAKE_ARGUMENT...]
#
# Writes docs/experiments.md with its plots and docs/fusion_experiments.md, no figure by hand. Incremental: what was made before is used again, unless
# the sources that it comes from have changed. N seeds are driven for each point, 5 unless given. Everything is made in
# DIR, BUILD_DIR/experiments unless given. With `--config keep_bags=true` the simulated recordings stay there, and another
# odometry is measured without simulating again. workflow/config.yaml lists all that `--config` takes.
#
# `scripts/experiments.sh fusion` makes docs/fusion_experiments.md alone: what the filter makes of each set of sensors.
#
# Further arguments go to snakemake, e.g. `--profile workflow/profile/slurm` for a cluster, or a target:
# `scripts/experiments.sh recordings --config bags=a.bag,b.bag configs=vo.yaml,vo_thesis.yaml` evaluates any recordings
# with any configurations and collects one table, DIR/recordings.csv.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

# absolute_list NAME=PATH,PATH...: with the files that exist as seen from here; snakemake runs elsewhere.
absolute_list() {
  local item result=() items
  IFS=, read -ra items <<<"${1#*=}"
  for item in "${items[@]}"; do
    if [[ -e $item ]]; then result+=("$(absolute_path "$item")"); else result+=("$item"); fi
  done
  (IFS=, && echo "${1%%=*}=${result[*]}")
}

seeds=5 build_dir=$STEREO_NAV_ROOT/build out="" cores=all arguments=() settings=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --seeds) shift; seeds=${1:?--seeds needs a number} ;;
    --build) shift; build_dir=$(absolute_path "${1:?--build needs a folder}") ;;
    --output) shift; out=$(absolute_path "${1:?--output needs a folder}") ;;
    --cores) shift; cores=${1:?--cores needs a number} ;;
    -h | --help) usage; exit 0 ;;
    --config) while [[ $# -gt 1 && $2 == *=* ]]; do
        shift
        case $1 in bags=* | configs=*) settings+=("$(absolute_list "$1")") ;; *) settings+=("$1") ;; esac
      done ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
[[ $seeds =~ ^[1-9][0-9]*$ ]] || die "--seeds must be a number above 0, not '$seeds'"
command -v snakemake >/dev/null || "$STEREO_NAV_ROOT/scripts/install_dependencies.sh" experiments
[[ -x $build_dir/devel/lib/stereo_nav/simulate ]] || "$STEREO_NAV_ROOT/scripts/build.sh" "$build_dir"
# shellcheck disable=SC1091
set +u && source "$build_dir/devel/setup.bash" && set -u

out=${out:-$build_dir/experiments}
mkdir -p "$out"
snakemake --snakefile "$STEREO_NAV_ROOT/workflow/Snakefile" --directory "$out" --cores "$cores" --keep-going --show-failed-logs \
  "${arguments[@]}" --config "output=$out" "docs=$STEREO_NAV_ROOT/docs" "seeds=$seeds" "${settings[@]}"
