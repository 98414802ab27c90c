#!/usr/bin/env python3
"""Print a row for each folder that `evaluate --method laser --segments 5,10` wrote: laser_results.sh."""
import json
import os
import sys


def figure(value, digits):
    """A number, or a dash where it is not known."""
    return '-' if value is None else f'{value:.{digits}f}'


def row(folder):
    """The figures of one run."""
    with open(os.path.join(folder, 'summary.json'), encoding='utf-8') as file:
        summary = json.load(file)
    with open(os.path.join(folder, 'timing.json'), encoding='utf-8') as file:
        timing = json.load(file)['frame_time_ms']
    five, ten = summary['segments']['5'], summary['segments']['10']
    cells = [os.path.basename(folder), figure(five['translation_percent'], 2), figure(ten['translation_percent'], 2),
             figure(ten['rotation_deg_per_m'], 3), str(summary['steps_off'])]
    for interval in ('1', '5'):
        nees = summary['nees'][interval]
        cells += [figure(nees['mean'], 1), figure(nees['inside_95_percent'], 0)]
    return cells + [figure(timing['median'], 2), figure(timing['p99'], 1)]


def main():
    """Print the table."""
    names = ['recording', '5 m %', '10 m %', 'deg/m', 'steps off', 'NEES 1 s', 'inside %', 'NEES 5 s', 'inside %', 'ms', 'p99 ms']
    print('| ' + ' | '.join(names) + ' |')
    print('|---' * len(names) + '|')
    for folder in sys.argv[1:]:
        print('| ' + ' | '.join(row(folder)) + ' |')


if __name__ == '__main__':
    main()
