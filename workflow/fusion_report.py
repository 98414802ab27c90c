#!/usr/bin/env python3
"""Write docs/fusion_experiments.md from what fusion_experiment measured: fusion_report.py OUTPUT_DIR DOCS_DIR."""
import csv
import glob
import math
import os
import sys

# The work of 2024 at its twenty poses, by its own table: root mean square errors, and its formula.
PUBLISHED = (0.203, 0.173, 13.0, 0.003, 0.157)

HEAD = """# What each sensor adds

Written by `scripts/experiments.sh fusion`; no figure by hand. Simulated drives with exact truth, the filter with
[config/fusion/planar.yaml](../config/fusion/planar.yaml): mecanum wheels whose radii are off by 3 % and that slip 1 cm on a metre, a gyroscope
with a bias, a laser of 360 beams at 10 Hz up to 12 m (1 % noise), stereo images of 320 x 240 at 10 Hz, four range finders with errors of
up to 5 cm against a map of what stands there (`range_correction`). On the robot the laser odometry is helped by wheels and gyroscope, the visual one by
the gyroscope: a set without these has the odometry without them. IMU and ranges alone tell no way, so that each set has an odometry. Errors in x, y and
yaw are root mean squares over {office} drives (office, corridor) with other noise, other wheels and other biases.
"""


def read(folder, course):
    """{set of sensors: [row of each drive]}, in the order of the files."""
    rows = {}
    for path in sorted(glob.glob(os.path.join(folder, "fusion", course + "__seed*.csv"))):
        with open(path, encoding="utf-8") as file:
            for row in csv.DictReader(file):
                rows.setdefault(row["sensors"], []).append(
                    {key: value if key == "sensors" else float(value) for key, value in row.items()})
    return rows


def rms(rows, name):
    return math.sqrt(sum(row[name] ** 2 for row in rows) / len(rows))


def mean(rows, name):
    return sum(row[name] for row in rows) / len(rows)


def spread(rows, name):
    """Standard deviation of a signed error: how far apart the drives end."""
    middle = mean(rows, name)
    return math.sqrt(sum((row[name] - middle) ** 2 for row in rows) / max(1, len(rows) - 1))


def table(names, rows):
    return "\n".join(["| " + " | ".join(names) + " |", "|---" * len(names) + "|"] +
                     ["| " + " | ".join(cells) + " |" for cells in rows]) + "\n"


def poses(course):
    """Errors at the twenty poses of each set."""
    names = ["sensors", "x m", "y m", "yaw deg", "abs(sum)/sqrt(N) x", "y"]
    rows = [["the work of 2024: laser and IMU"] + ["%g" % value for value in PUBLISHED]]
    for sensors, drives in course.items():
        rows.append([sensors] + ["%.3f" % rms(drives, name) for name in ("rmse_x_m", "rmse_y_m")] +
                    ["%.2f" % rms(drives, "rmse_yaw_deg")] +
                    ["%.3f" % rms(drives, name) for name in ("published_x_m", "published_y_m")])
    return table(names, rows)


def whole(course):
    """Errors over the whole way, with what stereo changes."""
    names = ["sensors", "x m", "y m", "yaw deg", "NEES (3)", "inside 95 %", "with stereo: x m", "y m", "yaw deg", "place, with / without"]
    rows = []
    for sensors, drives in course.items():
        if "stereo" in sensors:
            continue
        parts = sensors.split()
        at = len(parts) - 1 if parts[-1] == "ranges" else len(parts)
        with_stereo = course[" ".join(parts[:at] + ["stereo"] + parts[at:])]
        figures = [[rms(some, name) for name in ("whole_x_m", "whole_y_m", "whole_yaw_deg")] for some in (drives, with_stereo)]
        place = [math.hypot(*some[:2]) for some in figures]
        rows.append([sensors, "%.3f" % figures[0][0], "%.3f" % figures[0][1], "%.2f" % figures[0][2], "%.1f" % mean(drives, "nees"),
                     "%.0f" % mean(drives, "inside_95_percent"), "%.3f" % figures[1][0], "%.3f" % figures[1][1], "%.2f" % figures[1][2],
                     "%.2f" % (place[1] / place[0])])
    return table(names, rows)


def repeated(course):
    """Where ten drives of one course end."""
    names = ["sensors", "error at the end: x m", "y m", "yaw deg", "standard deviation: x m", "y m", "yaw deg"]
    rows = []
    for sensors, drives in course.items():
        rows.append([sensors] + ["%.3f" % rms(drives, "end_x_m"), "%.3f" % rms(drives, "end_y_m"), "%.2f" % rms(drives, "end_yaw_deg"),
                                 "%.3f" % spread(drives, "end_x_m"), "%.3f" % spread(drives, "end_y_m"),
                                 "%.2f" % spread(drives, "end_yaw_deg")])
    return table(names, rows)


TEXT = """{head}
## Twenty poses in an office
95 m around an office (`office`), at twenty poses equally far apart along it. The work's robot drove another course, in a real room; its figures are
those of its own table, computed right (it published those of the last two columns). Warning: in abs(sum)/sqrt(N) errors of opposite signs
cancel.

{poses}
## What stereo adds in the office
Over the whole way.

{office}
## A corridor in which the laser is blind
40 m along a corridor of 66 x 2 m with nothing on its floor (`long_corridor`), over the whole way.

{corridor}
## The same course {drives} times
The course of the thesis, 11.6 m (`arena`): root mean square of the error at the end, and how far apart the drives end.

{repeated}"""


def main(folder, docs):
    """Collect and write."""
    office, corridor, arena = (read(folder, course) for course in ("office", "long_corridor", "arena"))
    drives = [len(next(iter(course.values()))) for course in (office, arena)]
    text = TEXT.format(head=HEAD.format(office=drives[0]), poses=poses(office), office=whole(office), corridor=whole(corridor),
                       drives=drives[1], repeated=repeated(arena))
    with open(os.path.join(docs, "fusion_experiments.md"), "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
