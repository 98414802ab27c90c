#!/usr/bin/env python3
"""A simulated recording with the IMU of another one of the same drive: images cost much more than the rest.

usage: change_imu.py IMAGES.bag SIGNALS.bag OUTPUT.bag
"""
import heapq
import sys

import rosbag

IMU_TOPICS = ["imu/data", "imu_quat"]


def main():
    images, signals, output = sys.argv[1:4]
    with rosbag.Bag(images) as with_images, rosbag.Bag(signals) as with_imu, rosbag.Bag(output, "w") as result:
        others = [topic for topic in with_images.get_type_and_topic_info().topics if topic not in IMU_TOPICS]
        streams = [with_images.read_messages(topics=others, raw=True, return_connection_header=True),
                   with_imu.read_messages(topics=IMU_TOPICS, raw=True, return_connection_header=True)]
        for topic, message, time, header in heapq.merge(*streams, key=lambda entry: entry[2]):
            result.write(topic, message, time, raw=True, connection_header=header)


if __name__ == "__main__":
    main()
