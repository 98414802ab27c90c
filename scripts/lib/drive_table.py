#!/usr/bin/env python3
"""The error of a recorded drive at each way-point, beside the thesis' three drives.

usage: drive_table.py DRIVE.bag [--picture PATH.svg] | --duration BAG

DRIVE.bag holds odom, ground_truth/odom and ground_truth/waypoint.
"""
import argparse
import bisect
import sys

import rosbag

import plots
import thesis_drives

LEAST_SHARE_ANSWERED = 0.95  # of the pairs, by one odometry message each


def read_path(bag, topic):
    """(time, x, y) of a topic of nav_msgs/Odometry."""
    path = []
    for _, message, _ in bag.read_messages(topics=[topic, "/" + topic]):
        position = message.pose.pose.position
        path.append((message.header.stamp.to_sec(), position.x, position.y))
    return path


def at(path, time_s):
    """Position at a time, interpolated."""
    after = min(max(bisect.bisect_left([row[0] for row in path], time_s), 1), len(path) - 1)
    (t0, x0, y0), (t1, x1, y1) = path[after - 1], path[after]
    share = min(max((time_s - t0) / (t1 - t0), 0.0), 1.0)
    return x0 + share * (x1 - x0), y0 + share * (y1 - y0)


def draw(picture, estimate, truth):
    def top_view(path):
        return [(x, y) for _, x, y in path]

    plots.lines(picture, "x (m)", "y (m)",
                [("truth", "lines lw 6 lc rgb '#c3ccd4'", top_view(truth)), ("odometry", "lines ls 1", top_view(estimate)),
                 ("way-points", "points ls 2 pt 6", thesis_drives.WAYPOINTS)], "set size ratio -1\n", height_px=520)


def print_table(estimates):
    print("error at the way-points (m)   this drive   thesis: drive 1   drive 2   drive 3")
    for number, (truth, estimate) in enumerate(zip(thesis_drives.WAYPOINTS, estimates), 1):
        theirs = "".join("%10.2f" % thesis_drives.distance(drive[number - 1], truth) for drive in thesis_drives.DRIVES)
        print("  %2d  (%g, %g)%s%10.3f       %s" % (number, *truth, " " * (14 - len("(%g, %g)" % truth)),
                                                    thesis_drives.distance(estimate, truth), theirs))
    rows = [thesis_drives.figures(estimates)] + [thesis_drives.figures(drive) for drive in thesis_drives.DRIVES]
    print("  RMSE                %10.3f       %s" % (rows[0]["rmse_m"], "".join("%10.2f" % row["rmse_m"] for row in rows[1:])))
    print("  error at the end    %10.3f       %s" % (rows[0]["end_error_m"],
                                                   "".join("%10.2f" % row["end_error_m"] for row in rows[1:])))
    print("  ... of the course   %9.1f%%       %s" % (100 * rows[0]["end_error_m"] / thesis_drives.COURSE_LENGTH_M, "".join(
        "%9.0f%%" % (100 * row["end_error_m"] / thesis_drives.COURSE_LENGTH_M) for row in rows[1:])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag", nargs="?")
    parser.add_argument("--picture")
    parser.add_argument("--duration", help="print the length of this bag in whole seconds")
    options = parser.parse_args()
    if options.duration:
        with rosbag.Bag(options.duration) as bag:
            print(int(bag.get_end_time() - bag.get_start_time() + 0.5))
        return
    with rosbag.Bag(options.bag) as bag:
        estimate, truth = read_path(bag, "odom"), read_path(bag, "ground_truth/odom")
        passings = [m.header.stamp.to_sec() for _, m, _ in
                    bag.read_messages(topics=["ground_truth/waypoint", "/ground_truth/waypoint"])]
    if len(estimate) < 2 or len(passings) != len(thesis_drives.WAYPOINTS):
        sys.exit("drive_table.py: %s holds %d odometry messages and %d of 12 way-points; the node graph did not run: see "
                 "the logs beside it" % (options.bag, len(estimate), len(passings)))
    print_table([at(estimate, time_s) for time_s in passings])
    print("  odometry messages   %10d of %d pairs" % (len(estimate), len(truth)))
    if len(estimate) < LEAST_SHARE_ANSWERED * len(truth):
        print("  warning: %d pairs without odometry. Other programs may leave too little of this machine for a drive at real time: "
              "the errors are those of this drive, not of the method. The report below has every pair."
              % (len(truth) - len(estimate)))
    if options.picture:
        draw(options.picture, estimate, truth)


if __name__ == "__main__":
    main()
