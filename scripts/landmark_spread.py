#!/usr/bin/python3
"""How still does a still object stand in the odometry frame?

  landmark_spread.py TRAJECTORY.kitti TRACK.txt

TRACK holds one line `frame time x y z ...` for each frame that saw the object: its position in the left optical frame,
metres; `#` starts a comment. TRAJECTORY is what `evaluate` writes: the left camera's pose in its first one, a line a
frame. The object stands still, so whatever its position in the first camera frame moves is error of odometry and track.
"""
import sys
from math import dist, sqrt


def read_rows(path):
    with open(path) as file:
        rows = [line.split() for line in file if line.strip() and not line.startswith("#")]
    return [[float(value) for value in row] for row in rows]


def transformed(pose, point):
    """pose: the upper three rows of a 4x4 matrix, row by row."""
    return [sum(pose[4 * r + c] * point[c] for c in range(3)) + pose[4 * r + 3] for r in range(3)]


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    poses = read_rows(sys.argv[1])
    track = [row for row in read_rows(sys.argv[2]) if int(row[0]) < len(poses)]
    if not track:
        print(f"landmark_spread: no line of {sys.argv[2]} has a pose in {sys.argv[1]}", file=sys.stderr)
        return 2
    positions = [transformed(poses[int(row[0])], row[2:5]) for row in track]
    mean = [sum(axis) / len(positions) for axis in zip(*positions)]
    distances = [dist(position, mean) for position in positions]
    rms = sqrt(sum(d * d for d in distances) / len(distances))
    print(f"frames {len(positions)}  spread {rms:.4f} m RMS, {max(distances):.4f} m at most, "
          f"end - start {dist(positions[-1], positions[0]):.4f} m")
    return 0


if __name__ == "__main__":
    sys.exit(main())
