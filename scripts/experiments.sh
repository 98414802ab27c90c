#!/usr/bin/env bash
# The experiments of the thesis and the curves beyond them, on simulated drives with exact ground truth.
#
#   scripts/experiments.sh [--seeds N] [--build BUILD_DIR] [SNAKEMAKE_ARGUMENT...]
#
# Writes docs/experiments.md with its plots, no figure by hand. Incremental: what was made before is used again. N is 5
# unless given. Further arguments go to snakemake, e.g. `--profile workflow/profile/slurm` for a cluster, or a target:
# `scripts/experiments.sh recordings --config bags=a.bag,b.bag configs=vo.yaml,vo_thesis.yaml` evaluates any recordings
# with any configurations and collects one table, BUILD_DIR/experiments/recordings.csv.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib/environment.sh"

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d'; }

seeds=5 build_dir=$STEREO_NAV_ROOT/build arguments=() recordings=false settings=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --seeds) shift; seeds=${1:?--seeds needs a number} ;;
    --build) shift; build_dir=$(absolute_path "${1:?--build needs a folder}") ;;
    -h | --help) usage; exit 0 ;;
    recordings) recordings=true; arguments+=(recordings) ;;
    --config) while [[ $# -gt 1 && $2 == *=* ]]; do shift; settings+=("$1"); done ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
[[ $seeds =~ ^[1-9][0-9]*$ ]] || die "--seeds must be a number above 0, not '$seeds'"
command -v snakemake >/dev/null || "$STEREO_NAV_ROOT/scripts/install_dependencies.sh" experiments
[[ -x $build_dir/devel/lib/stereo_nav/simulate ]] || "$STEREO_NAV_ROOT/scripts/build.sh" "$build_dir"
# shellcheck disable=SC1091
set +u && source "$build_dir/devel/setup.bash" && set -u

out=$build_dir/experiments
mkdir -p "$out"
snakemake --snakefile "$STEREO_NAV_ROOT/workflow/Snakefile" --directory "$out" --cores all --keep-going \
  "${arguments[@]}" --config "output=$out" "seeds=$seeds" "${settings[@]}"
$recordings && exit 0
/usr/bin/python3 "$STEREO_NAV_ROOT/workflow/report.py" "$out" "$STEREO_NAV_ROOT/docs"
