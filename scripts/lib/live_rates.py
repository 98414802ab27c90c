#!/usr/bin/env python3
"""Plays a recording at real time through the whole graph of nodes and counts what comes out of it, as JSON.

usage: live_rates.py RECORDING.bag

launch/replay.launch runs on a master of its own. For each topic: messages per second in every window of 15 s of wall
time, as `rostopic hz` would show them, and how many there were in all.
"""
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

WINDOW_S = 15.0
TOPICS = ["camera/left/image_rect", "camera/right/image_rect", "camera/disparity", "odom"]


def rates(arrivals):
    """Messages per second in whole windows from the first arrival on; the last one ends at the last message."""
    if len(arrivals) < 2:
        return []
    windows = max(1, round((arrivals[-1] - arrivals[0]) / WINDOW_S))
    length_s = WINDOW_S if windows > 1 else arrivals[-1] - arrivals[0]
    bounds = [arrivals[0] + i * length_s for i in range(windows)] + [arrivals[-1]]
    counts = [sum(start < arrival <= end for arrival in arrivals) for start, end in zip(bounds, bounds[1:])]
    return [count / (end - start) for count, start, end in zip(counts, bounds, bounds[1:])]


def wait_for_master(graph, log):
    import rosgraph

    for _ in range(600):
        if rosgraph.is_master_online():
            return
        if graph.poll() is not None:
            break
        time.sleep(0.1)
    with open(log) as file:
        sys.exit("live_rates.py: the graph does not start:\n" + file.read())


def listen(graph):
    """Arrival times by topic, until the graph ends."""
    import rospy

    rospy.init_node("live_rates", disable_signals=True)
    arrivals = {topic: [] for topic in TOPICS}
    for topic in TOPICS:
        rospy.Subscriber(topic, rospy.AnyMsg, lambda _, times=arrivals[topic]: times.append(time.monotonic()),
                         queue_size=100, buff_size=2 ** 24)
    graph.wait()
    return arrivals


def main():
    bag = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(ROS_HOME=folder, ROS_HOSTNAME="localhost",
                          ROS_MASTER_URI="http://localhost:%d" % random.randint(20000, 29999))
        log = folder + "/roslaunch.log"
        # The thesis' configuration: the default one has no use for the disparity map.
        command = ["roslaunch", "stereo_nav", "replay.launch", "bag:=" + bag, "exit_at_end:=true",
                   "config:=" + os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../config/vo_thesis.yaml")]
        with open(log, "w") as output:
            graph = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
        try:
            wait_for_master(graph, log)
            arrivals = listen(graph)
        finally:
            if graph.poll() is None:
                graph.send_signal(signal.SIGINT)
                graph.wait()
    if not arrivals["odom"]:
        sys.exit("live_rates.py: no odometry came out of the graph")
    import rosbag

    with rosbag.Bag(bag) as recording:
        pairs = recording.get_message_count("camera/left/image_raw")
        duration_s = recording.get_end_time() - recording.get_start_time()
    json.dump({"window_s": WINDOW_S, "pairs": pairs, "duration_s": duration_s,
               "rates_hz": {topic: rates(times) for topic, times in arrivals.items()},
               "messages": {topic: len(times) for topic, times in arrivals.items()}}, sys.stdout)


if __name__ == "__main__":
    main()
