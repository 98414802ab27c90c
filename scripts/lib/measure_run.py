#!/usr/bin/env python3
"""Figures of one evaluated drive, as JSON on standard output.

usage: measure_run.py EVALUATED_FOLDER SIGNALS.bag

SIGNALS.bag holds the drive's ground_truth/odom and, where the scenario has way-points, ground_truth/waypoint. Errors at
the way-points are those of the arena's twelve; a drive without them has none (null).
"""
import csv
import json
import math
import sys

import rosbag

import drive_table
import thesis_drives

WAYPOINT_FIGURES = ("rmse_x_m", "rmse_y_m", "rmse_m", "end_error_m")


def distance(row):
    return math.dist([float(row[key]) for key in ("x_m", "y_m", "z_m")],
                     [float(row["true_" + key]) for key in ("x_m", "y_m", "z_m")])


def first_stop(messages):
    """Index of the message at which the robot stands again after its first motion."""
    moved = False
    for index, message in enumerate(messages):
        twist = message.twist.twist
        fast = abs(twist.linear.x) > 0.02 or abs(twist.angular.z) > 0.05
        at_rest = abs(twist.linear.x) < 1e-4 and abs(twist.angular.z) < 1e-3
        if moved and at_rest:
            return index
        moved = moved or fast
    return len(messages) - 1


def at_waypoints(folder, bag):
    with open(folder + "/trajectory.tum") as file:
        estimate = [tuple(float(value) for value in line.split()[:3]) for line in file if line[0] != "#"]
    passings = [(m.header.stamp.to_sec(), (m.point.x, m.point.y)) for _, m, _ in
                bag.read_messages(topics=["ground_truth/waypoint"])]
    if len(passings) != len(thesis_drives.WAYPOINTS) or len(estimate) < 2:
        return {key: None for key in WAYPOINT_FIGURES + ("waypoints",)}
    positions = [drive_table.at(estimate, time_s) for time_s, _ in passings]
    return {**thesis_drives.figures(positions, [truth for _, truth in passings]), "waypoints": positions}


def path_length(frames, prefix=""):
    points = [[float(row[prefix + key]) for key in ("x_m", "y_m", "z_m")] for row in frames]
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def main():
    folder, signals = sys.argv[1:3]
    with open(folder + "/frames.csv") as file:
        frames = [row for row in csv.DictReader(file) if row["true_x_m"]]
    with open(folder + "/summary.json") as file:
        summary = json.load(file)
    with rosbag.Bag(signals) as bag:
        figures = at_waypoints(folder, bag)
        stop = first_stop([m for _, m, _ in bag.read_messages(topics=["ground_truth/odom"])])
    errors = [distance(row) for row in frames]
    length_m = path_length(frames, "true_")
    figures.update({
        "path_length_m": length_m,
        "path_ratio": path_length(frames) / length_m if length_m > 0.1 else None,
        "path_rmse_m": math.sqrt(sum(error ** 2 for error in errors) / len(errors)),
        "final_error_m": errors[-1],
        "final_rotation_deg": float(frames[-1]["rotation_error_deg"]),
        "largest_error_m": max(errors),
        "first_stop_error_m": errors[min(stop, len(errors) - 1)],
        "first_stop_rotation_deg": float(frames[min(stop, len(errors) - 1)]["rotation_error_deg"]),
    })
    for key in ("ate_rmse_m", "features_mean", "inliers_mean", "frames", "frames_lost"):
        figures[key] = summary[key]
    json.dump(figures, sys.stdout)


if __name__ == "__main__":
    main()
