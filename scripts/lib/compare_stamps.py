#!/usr/bin/env python3
"""Compares the frames an emulated IMU sent with those a reader received: number and time.

usage: compare_stamps.py SENT.csv RECEIVED.csv
Both hold `time, yaw, pitch, roll` lines; times of one steady clock. Ends with an error when a frame is missing.
"""
import sys

SETTLE_S = 3.0


def read_times(path):
    with open(path, encoding="ascii") as lines:
        return [float(line.split(",")[0]) for line in lines if not line.startswith("#")]


def main():
    sent, received = read_times(sys.argv[1]), read_times(sys.argv[2])
    print(f"frames sent {len(sent)}, received {len(received)}, lost {len(sent) - len(received)}")
    if len(sent) != len(received):
        return 1
    errors = [r - s for s, r in zip(sent, received) if s - sent[0] > SETTLE_S]
    mean = sum(errors) / len(errors)
    spread = (sum((e - mean) ** 2 for e in errors) / len(errors)) ** 0.5
    steps = [b - a for a, b in zip(errors, errors[1:])]
    jitter = (sum(step * step for step in steps) / len(steps)) ** 0.5
    print(f"stamp minus sending time after {SETTLE_S:.0f} s: mean {mean * 1e3:.3f} ms, standard deviation {spread * 1e3:.4f} ms, "
          f"largest {max(abs(e) for e in errors) * 1e3:.3f} ms; between successive frames {jitter * 1e3:.4f} ms RMS")
    return 0


sys.exit(main())
