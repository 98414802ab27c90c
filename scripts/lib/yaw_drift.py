#!/usr/bin/env python3
"""Change of the IMU's yaw over a recording at rest, as JSON. usage: yaw_drift.py BAG"""
import json
import math
import sys

import rosbag

STEP_S = 10.0  # between the points of the curve

with rosbag.Bag(sys.argv[1]) as bag:
    yaws = [(m.header.stamp.to_sec(), 2 * math.atan2(m.orientation.z, m.orientation.w))
            for _, m, _ in bag.read_messages(topics=["imu/data"])]
start_s, start = yaws[0]
changes = [(time_s - start_s, math.degrees((yaw - start + math.pi) % (2 * math.pi) - math.pi)) for time_s, yaw in yaws]
curve, due_s = [], 0.0
for time_s, change in changes:
    if time_s >= due_s:
        curve.append((time_s, change))
        due_s += STEP_S
json.dump({"drift_deg": changes[-1][1], "duration_s": changes[-1][0], "curve": curve}, sys.stdout)
