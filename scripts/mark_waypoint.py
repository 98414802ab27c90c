#!/usr/bin/env python3
"""Writes down where the odometry is whenever the robot passes a way-point: on the Enter key or the service ~mark.

Subscribes odom (nav_msgs/Odometry). Parameters:
  ~output (string, default waypoints.csv)  one line for each mark: time, x, y, and the true position where known
  ~truth  (string, default none)           file with the true positions, "x y" or "x,y" on each line, in order
Service ~mark (std_srvs/Trigger). At the end (Ctrl-C, or the last true position) the errors are printed.
"""
import math
import sys
import threading

import rospy
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger, TriggerResponse


def read_positions(path):
    """[(x, y)] of a text file. Raises ValueError that names the line."""
    positions = []
    with open(path) as file:
        for number, line in enumerate(file, 1):
            words = line.split("#")[0].replace(",", " ").split()
            if not words:
                continue
            try:
                x, y = (float(word) for word in words)
            except ValueError:
                raise ValueError("%s, line %d: expected two numbers, found '%s'" % (path, number, line.strip()))
            positions.append((x, y))
    return positions


def summary(marks):
    """Text with the error at each mark and the RMSE; marks are (x, y, truth or None)."""
    errors = [math.hypot(x - truth[0], y - truth[1]) for x, y, truth in marks if truth]
    if not errors:
        return "%d marks; no true positions to compare with (~truth)" % len(marks)
    lines = ["%2d  (%.2f, %.2f) instead of (%g, %g): %.3f m" % (i, x, y, *truth, math.hypot(x - truth[0], y - truth[1]))
             for i, (x, y, truth) in enumerate(marks, 1) if truth]
    rmse = math.sqrt(sum(error ** 2 for error in errors) / len(errors))
    return "\n".join(lines + ["RMSE %.3f m, error at the end %.3f m" % (rmse, errors[-1])])


class Marker:
    def __init__(self):
        self.truth = read_positions(rospy.get_param("~truth")) if rospy.has_param("~truth") else []
        self.file = open(rospy.get_param("~output", "waypoints.csv"), "w", buffering=1)
        self.file.write("time_s,x_m,y_m,true_x_m,true_y_m\n")
        self.latest = None
        self.marks = []
        self.lock = threading.Lock()
        rospy.Subscriber("odom", Odometry, self.remember)
        rospy.Service("~mark", Trigger, self.serve)

    def remember(self, message):
        self.latest = message

    def mark(self):
        """(success, what to tell)."""
        with self.lock:
            if self.latest is None:
                return False, "nothing came on %s yet: does the odometry run?" % rospy.resolve_name("odom")
            position = self.latest.pose.pose.position
            truth = self.truth[len(self.marks)] if len(self.marks) < len(self.truth) else None
            self.marks.append((position.x, position.y, truth))
            self.file.write("%.6f,%.4f,%.4f,%s\n" % (self.latest.header.stamp.to_sec(), position.x, position.y,
                                                     "%g,%g" % truth if truth else ","))
            text = "way-point %d at (%.3f, %.3f)" % (len(self.marks), position.x, position.y)
        if self.truth and len(self.marks) == len(self.truth):
            # Not before the service has answered.
            threading.Timer(0.5, rospy.signal_shutdown, ["all way-points marked"]).start()
        return True, text

    def serve(self, _):
        success, text = self.mark()
        return TriggerResponse(success, text)

    def watch_keys(self):
        for _ in sys.stdin:
            print(self.mark()[1])


def main():
    rospy.init_node("mark_waypoint")
    try:
        marker = Marker()
    except (OSError, ValueError) as error:
        sys.exit("mark_waypoint: %s" % error)
    print("Enter marks a way-point, Ctrl-C ends")
    threading.Thread(target=marker.watch_keys, daemon=True).start()
    rospy.spin()
    print(summary(marker.marks))


if __name__ == "__main__":
    main()
