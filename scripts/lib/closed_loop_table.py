#!/usr/bin/python3
"""Collects the runs of scripts/closed_loop_results.sh: a row for each course and localisation.

usage: closed_loop_table.py WORK_DIR
"""
import collections
import json
import pathlib
import statistics
import sys

NAMES = {'truth': 'the truth', 'vo': '`vo.yaml`'}


def main():
    runs = collections.defaultdict(list)
    for path in sorted(pathlib.Path(sys.argv[1]).glob('*/summary.json')):
        course, odometry, _ = path.parent.name.rsplit('-', 2)
        runs[course, odometry].append(json.loads(path.read_text()))
    print('| course | localisation | runs | goals reached | missed unnoticed | named failures | collisions | median time s |')
    print('|---|---|---|---|---|---|---|---|')
    for (course, odometry), summaries in runs.items():
        total = {key: sum(run[key] for run in summaries)
                 for key in ('goals', 'reached', 'wrong', 'named_failures', 'collisions')}
        duration = statistics.median(run['duration_s'] for run in summaries)
        print(f'| {course} | {NAMES.get(odometry, odometry)} | {len(summaries)} | {total["reached"]} of {total["goals"]} | '
              f'{total["wrong"]} | {total["named_failures"]} | {total["collisions"]} | {duration:.0f} |')


if __name__ == '__main__':
    main()
