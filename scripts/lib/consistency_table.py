#!/usr/bin/python3
"""Table of the consistency of many runs: consistency_table.py FOLDER

FOLDER holds DRIVE-CAMERA-CLOCKS-SEED-IMU/summary.json, as scripts/consistency.sh writes them. Each row pools the pieces of its
runs: the mean normalised estimation error squared of translation and rotation as a share of what is expected (1 is right, more
is too sure), and how many pieces are inside the ellipsoid of 95 %.
"""
import collections
import glob
import json
import os
import sys

INTERVALS = ("0.2", "1", "5")


def pooled(summaries, interval):
    """Translation and rotation of the expectation, percent inside; nothing without a piece."""
    entries = [summary["nees"][interval] for summary in summaries if summary["nees"][interval]["pairs"]]
    pieces = sum(entry["pairs"] for entry in entries)
    if not pieces:
        return "-"
    mean = {key: sum(entry[key] * entry["pairs"] for entry in entries) / pieces
            for key in ("translation", "rotation", "inside_95_percent")}
    return "%.2f / %.2f, %.0f %%" % (mean["translation"] / 3.0, mean["rotation"] / 3.0, mean["inside_95_percent"])


def row(name, summaries):
    lost = sum(summary["frames_lost"] for summary in summaries)
    frames = sum(summary["frames"] for summary in summaries)
    cells = [name, str(len(summaries)), "%d / %d" % (lost, frames)]
    return "| " + " | ".join(cells + [pooled(summaries, interval) for interval in INTERVALS]) + " |"


def main(folder):
    runs = {}
    for path in sorted(glob.glob(os.path.join(folder, "*", "summary.json"))):
        with open(path) as file:
            runs[tuple(os.path.basename(os.path.dirname(path)).split("-"))] = json.load(file)
    print("| | runs | frames lost | 0.2 s | 1 s | 5 s |")
    print("|---|---|---|---|---|---|")
    for column, of in ((0, "drive"), (1, "camera"), (2, "clocks"), (4, "IMU")):
        groups = collections.defaultdict(list)
        for name, summary in runs.items():
            groups[name[column]].append(summary)
        for value, summaries in groups.items():
            print(row("%s %s" % (of, value), summaries))
    print(row("all", list(runs.values())))


if __name__ == "__main__":
    main(sys.argv[1])
