#!/usr/bin/env python3
"""The thesis' table of a block's distance, from depth_at's lines for two disparity ranges, as JSON.

usage: triangulation.py TRUTH.bag RANGE_32.txt RANGE_64.txt
"""
import bisect
import json
import statistics
import sys

import rosbag

THESIS = {1.5: -56, 1.8: 1.8, 2.1: 2.12, 2.4: 2.4, 2.7: 2.73, 3.0: 2.98, 3.3: 3.3, 3.6: 3.64, 3.9: 3.95, 4.2: 4.15, 4.5: 4.51,
          4.8: 4.87, 5.1: 5.12, 5.4: 5.22, 5.7: 5.58, 6.0: 6.08, 6.3: 6.39, 6.6: 6.63, 6.9: 6.93, 7.2: 7.29}
BLOCK_X_M = 7.3
CAMERA_X_M = 0.1


def at_rest(truth):
    """True distance (rounded to the stops) by stamp, where the robot stands."""
    with rosbag.Bag(truth) as bag:
        return [(m.header.stamp.to_sec(), BLOCK_X_M - CAMERA_X_M - m.pose.pose.position.x) for _, m, _ in
                bag.read_messages(topics=["ground_truth/odom"]) if abs(m.twist.twist.linear.x) < 1e-4]


def by_distance(rest, path):
    """depth_at's distances, for every true distance."""
    stamps = [stamp for stamp, _ in rest]
    result = {}
    with open(path) as file:
        for line in file:
            words = line.split()
            if len(words) != 2:
                continue
            stamp, depth = float(words[0]), float(words[1])
            index = min(bisect.bisect_left(stamps, stamp - 1e-3), len(stamps) - 1)
            if abs(stamps[index] - stamp) < 2e-3 and depth == depth:
                result.setdefault(round(rest[index][1], 1), []).append(depth)
    return result


def rmse(rows, key):
    errors = [row[key][0] - row["true_m"] for row in rows if row[key]]
    return (sum(error ** 2 for error in errors) / len(errors)) ** 0.5


def main():
    rest = at_rest(sys.argv[1])
    measured = {"32": by_distance(rest, sys.argv[2]), "64": by_distance(rest, sys.argv[3])}
    rows = []
    for true_m, thesis_m in sorted(THESIS.items()):
        row = {"true_m": true_m, "thesis_m": thesis_m}
        for key, values in measured.items():
            depths = values.get(true_m, [])
            row[key] = [statistics.mean(depths), statistics.pstdev(depths)] if len(depths) >= 3 else None
        rows.append(row)
    json.dump({"rows": rows, "rmse_32_m": rmse(rows, "32"), "rmse_64_m": rmse(rows, "64")}, sys.stdout)


if __name__ == "__main__":
    main()
