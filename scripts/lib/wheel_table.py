#!/usr/bin/env python3
"""The table of scripts/wheel_results.sh: a row for each set of runs that were evaluated in WORK_DIR."""
import json
import pathlib
import sys


def summaries(work):
    """{set: {rig: [summary of a run]}}"""
    sets = {}
    for path in sorted(pathlib.Path(work).glob('*_run-*-*/summary.json')):
        run, rig = path.parent.name.rsplit('-', 1)
        name = run.split('_run-')[0]
        sets.setdefault(name, {}).setdefault(rig, []).append(json.loads(path.read_text()))
    return sets


def mean(runs, value):
    return sum(value(run) for run in runs) / len(runs)


def main():
    print('| set | runs | path m | end %, nominal | end %, calibrated | NEES over 5 s (3 expected) | worst run |')
    print('|---|---|---|---|---|---|---|')
    for name, rigs in summaries(sys.argv[1]).items():
        nees = [run['nees']['5']['mean'] for run in rigs['calibrated']]
        print(f"| {name} | {len(nees)} | {mean(rigs['nominal'], lambda run: run['path_length_m']):.1f} "
              f"| {mean(rigs['nominal'], lambda run: run['end_error_percent']):.2f} "
              f"| {mean(rigs['calibrated'], lambda run: run['end_error_percent']):.2f} "
              f"| {sum(nees) / len(nees):.2f} | {max(nees):.2f} |")


if __name__ == '__main__':
    main()
