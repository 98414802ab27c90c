#!/usr/bin/env python3
"""Measures a running graph: time from the start of this program to the first odometry, then, over SECONDS, the age of each
odometry message when it arrives: the time since the image's stamp (mid-exposure of the left image).

    measure_latency.py SECONDS [WARM_UP_SECONDS]
"""
import statistics
import sys
import time

import rospy
from nav_msgs.msg import Odometry


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def main():
    seconds = float(sys.argv[1])
    warm_up = float(sys.argv[2]) if len(sys.argv) > 2 else 3.0
    begin = time.time()
    arrivals = []
    rospy.init_node("measure_latency", anonymous=True)
    rospy.Subscriber("odom", Odometry, lambda m: arrivals.append((time.time(), m.header.stamp.to_sec())),
                     queue_size=100, tcp_nodelay=True)
    while not arrivals and not rospy.is_shutdown():
        time.sleep(0.01)
    print(f"first odometry {arrivals[0][0] - begin:.2f} s after this program's start")
    time.sleep(warm_up + seconds)
    used = [a for a in arrivals if a[0] > arrivals[0][0] + warm_up]
    ages_ms = [1e3 * (arrival - stamp) for arrival, stamp in used]
    print(f"odometry {len(used) / seconds:.1f} Hz, stamp to arrival: median {statistics.median(ages_ms):.1f} ms, "
          f"p95 {quantile(ages_ms, 0.95):.1f} ms, n {len(ages_ms)}")


main()
