#!/usr/bin/env python3
"""The demo's table: known errors come out, and a drive with many unanswered pairs says so."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import Odometry

LIB = Path(__file__).resolve().parents[3] / 'scripts' / 'lib'
sys.path.insert(0, str(LIB))
import thesis_drives  # noqa: E402

STEPS = 10  # pairs from one way-point to the next


def odometry(time_s, x, y):
    message = Odometry()
    message.header.stamp = rospy.Time.from_sec(time_s)
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    return message


class DriveTableTest(unittest.TestCase):
    def table_of(self, answered_of_ten):
        """What is printed of a drive that is 0.5 m off to the left all the way."""
        with tempfile.TemporaryDirectory() as folder:
            path = folder + '/drive.bag'
            with rosbag.Bag(path, 'w') as bag:
                for number, (x, y) in enumerate(thesis_drives.WAYPOINTS):
                    for step in range(STEPS):
                        time_s = 1.0 + number + step / STEPS
                        stamp = rospy.Time.from_sec(time_s)
                        bag.write('/ground_truth/odom', odometry(time_s, x, y), stamp)
                        if step < answered_of_ten:
                            bag.write('/odom', odometry(time_s, x, y + 0.5), stamp)
                    passing = PointStamped()
                    passing.header.stamp = rospy.Time.from_sec(1.0 + number)
                    bag.write('/ground_truth/waypoint', passing, passing.header.stamp)
            return subprocess.run([sys.executable, str(LIB / 'drive_table.py'), path], check=True, text=True,
                                  stdout=subprocess.PIPE).stdout

    def test_errors_are_those_of_the_drive(self):
        table = self.table_of(10)
        self.assertRegex(table, r'RMSE +0\.500 +1\.25 +2\.48 +2\.09')
        self.assertRegex(table, r'error at the end +0\.500')
        self.assertRegex(table, r'odometry messages +120 of 120 pairs')
        self.assertNotIn('warning', table)

    def test_unanswered_pairs_are_warned_of(self):
        self.assertIn('warning: 36 pairs without odometry', self.table_of(7))


if __name__ == '__main__':
    unittest.main()
