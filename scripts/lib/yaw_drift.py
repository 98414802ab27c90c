#!/usr/bin/env python3
"""Change of the IMU's yaw over a recording at rest, as JSON. usage: yaw_drift.py BAG"""
import json
import math
import sys

import rosbag

with rosbag.Bag(sys.argv[1]) as bag:
    yaws = [(m.header.stamp.to_sec(), 2 * math.atan2(m.orientation.z, m.orientation.w))
            for _, m, _ in bag.read_messages(topics=["imu/data"])]
change = (yaws[-1][1] - yaws[0][1] + math.pi) % (2 * math.pi) - math.pi
json.dump({"drift_deg": math.degrees(change), "duration_s": yaws[-1][0] - yaws[0][0]}, sys.stdout)
