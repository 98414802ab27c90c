#!/usr/bin/env python3
"""Figures of one evaluated drive over the arena's way-points, as JSON on standard output.

usage: measure_run.py EVALUATED_FOLDER TRUTH.bag
"""
import json
import math
import sys

import rosbag

import drive_table
import thesis_drives


def main():
    folder, truth_path = sys.argv[1:3]
    with open(folder + "/trajectory.tum") as file:
        estimate = [tuple(float(value) for value in line.split()[:3]) for line in file if line[0] != "#"]
    with open(folder + "/summary.json") as file:
        summary = json.load(file)
    with rosbag.Bag(truth_path) as bag:
        passings = [(m.header.stamp.to_sec(), (m.point.x, m.point.y)) for _, m, _ in
                    bag.read_messages(topics=["ground_truth/waypoint"])]
    figures = thesis_drives.figures([drive_table.at(estimate, time_s) for time_s, _ in passings], [p for _, p in passings])
    figures["path_ratio"] = sum(math.hypot(b[1] - a[1], b[2] - a[2]) for a, b in zip(estimate, estimate[1:])) / \
        summary["path_length_m"]
    for key in ("ate_rmse_m", "features_mean", "inliers_mean", "frames", "frames_lost"):
        figures[key] = summary[key]
    json.dump(figures, sys.stdout)


if __name__ == "__main__":
    main()
