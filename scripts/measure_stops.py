#!/usr/bin/env python3
"""Measures how long a base drives on when something ends or stands still: its driver, base_bridge, the cable, the ROS master,
cmd_vel_mux.

  scripts/measure_stops.py [--trials 100] [--programs build/devel/lib/stereo_nav] [--rig test/rostest/base_rig.yaml] [--output FILE.csv]

Runs a ROS master of its own, base_emulator and base_bridge. Each trial drives at --speed, lets one of them end at a random
moment, and takes from the emulator's log when its wheels were told to stand and how far they rolled. Both are counted from the
last cmd_vel that was published before it ended. What is frozen goes on after two seconds, when the driver has long been silent: what
waited in its sockets must not drive. Prints a table; the status is 1 where one trial took longer than 0.35 s, or
rolled farther than v x 0.35 s + v^2/(2 a) + 2 cm.
"""
import argparse
import csv
import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time

ACCELERATION = 3.0  # m/s^2, of base_emulator
MOST_S = 0.35
MARGIN_M = 0.02
PATIENCE_S = 60.0
RATE_HZ = 20.0
PULLED_AFTER_S = 3.0  # after the port was opened
FROZEN = {"bridge frozen": "bridge", "mux frozen": "mux"}  # case: who is
CASES = ("driver stopped", "node killed", "cable pulled", "master gone", *FROZEN)


def drive(speed, topic):
    """The driver: publishes velocities between the lines `go` and `stop` of its input, and prints when."""
    import rospy
    from geometry_msgs.msg import Twist
    rospy.init_node("driver", anonymous=True, disable_signals=True)
    publisher = rospy.Publisher(topic, Twist, queue_size=1, tcp_nodelay=True)
    message = Twist()
    message.linear.x = speed
    os.set_blocking(sys.stdin.fileno(), False)
    print("ready", flush=True)
    going = False
    while True:
        line = sys.stdin.readline()
        if line:
            going = line.strip() == "go"
        if going:
            print("%.9f" % time.monotonic(), flush=True)
            publisher.publish(message)
        time.sleep(1.0 / RATE_HZ)


class Log:
    """What the emulator has written: [time, mode, held, speed, way, ...]."""

    def __init__(self, path):
        self.path = path

    def rows(self):
        with open(self.path) as file:
            lines = file.read().split("\n")[1:-1]
        return [[float(word) for word in line.split(",")] for line in lines]

    def last(self):
        with open(self.path, "rb") as file:
            file.seek(0, os.SEEK_END)
            file.seek(max(0, file.tell() - 2000))
            lines = file.read().decode().split("\n")[:-1]
        return [float(word) for word in lines[-1].split(",")] if len(lines) > 1 else None


def held(row):
    return max(abs(speed) for speed in row[2::3])


def speed_of(row):
    return sum(abs(speed) for speed in row[3::3]) / len(row[3::3])


def way_of(row):
    return sum(abs(way) for way in row[4::3]) / len(row[4::3])


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end:
            raise RuntimeError("waited %g s in vain: %s" % (PATIENCE_S, what))
        time.sleep(0.01)


class Graph:
    """Master, emulator, bridge, driver and, in its case, cmd_vel_mux, each of which can end and come again."""

    def __init__(self, options, folder, with_mux):
        self.options = options
        self.folder = folder
        self.with_mux = with_mux
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % self.port, ROS_HOME=folder)
        self.serial = os.path.join(folder, "base")
        self.programs = options.programs
        self.processes = {}
        self.stamps = []
        self.log = None
        self.number = 0

    def start(self, name, command, **more):
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self.processes[name] = subprocess.Popen(command, env=self.environment, **{**quiet, **more})

    def end(self, name):
        process = self.processes.pop(name, None)
        if process:
            process.kill()
            process.wait()

    def start_master(self):
        self.start("master", ["rosmaster", "--core", "-p", str(self.port)])
        def answers():
            with socket.socket() as probe:
                return probe.connect_ex(("127.0.0.1", self.port)) == 0
        wait_for(answers, "rosmaster answers")

    def start_emulator(self, more):
        self.number += 1
        self.log = Log(os.path.join(self.folder, "wheels_%d.csv" % self.number))
        self.start("emulator", [os.path.join(self.programs, "base_emulator"), "--rig", self.options.rig, "--link",
                                self.serial, "--log", self.log.path, "--acceleration", str(ACCELERATION), *more])
        wait_for(lambda: os.path.exists(self.log.path), "base_emulator writes its log")

    def start_bridge(self):
        self.start("bridge", [os.path.join(self.programs, "base_bridge"), "_rig:=" + self.options.rig,
                              "_config:=" + os.path.join(self.options.source, "config/base.yaml"),
                              "_port:=" + self.serial, "_retry_s:=0.1"])

    def start_mux(self):
        self.start("mux", [os.path.join(self.programs, "cmd_vel_mux"), "_rig:=" + self.options.rig])

    def start_driver(self):
        topic = "cmd_vel_auto" if self.with_mux else "cmd_vel"
        self.start("driver", [sys.executable, os.path.abspath(__file__), "--drive", topic, "--speed", str(self.options.speed)],
                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.processes["driver"].stdout.readline()

    def tell_driver(self, word):
        self.processes["driver"].stdin.write(word + "\n")
        self.processes["driver"].stdin.flush()

    def read_stamps(self):
        """All moments at which the driver has published so far."""
        os.set_blocking(self.processes["driver"].stdout.fileno(), False)
        while True:
            line = self.processes["driver"].stdout.readline()
            if not line.endswith("\n"):
                return
            self.stamps.append(float(line))

    def drive_at_speed(self):
        self.tell_driver("go")
        def fast():
            row = self.log.last()
            return row and speed_of(row) > 0.97 * self.options.speed
        wait_for(fast, "the emulated base drives")

    def close(self):
        for name in list(self.processes):
            self.end(name)


def prepare(graph, case):
    """Brings the graph up for a trial, as far as it is not."""
    pull = ("--wait-for-reader", "--unplug-at", str(PULLED_AFTER_S), "--unplug-for", "1000") if case == "cable pulled" else ()
    starts = {"master": graph.start_master, "emulator": lambda: graph.start_emulator(pull), "bridge": graph.start_bridge}
    if graph.with_mux:
        starts["mux"] = graph.start_mux
    for name, start in {**starts, "driver": graph.start_driver}.items():
        if name not in graph.processes:
            start()
    graph.drive_at_speed()
    time.sleep(random.uniform(0.3, 0.4))  # it no longer accelerates


def freeze(process, graph):
    """Lets it stand still while the driver falls silent, and go on; returns when that began."""
    process.send_signal(signal.SIGSTOP)
    frozen_s = time.monotonic()
    time.sleep(1.5)  # many velocities wait in its socket
    graph.tell_driver("stop")
    time.sleep(0.5)
    process.send_signal(signal.SIGCONT)
    time.sleep(0.5)  # in which it might drive
    return frozen_s


def let_end(graph, case):
    """Ends what the case names; returns when, or None where the base obeys up to its stop."""
    if case == "driver stopped":
        graph.tell_driver("stop")
        return None
    if case in FROZEN:
        return freeze(graph.processes[FROZEN[case]], graph)
    if case == "node killed":
        graph.end("bridge")
        return time.monotonic()
    if case == "cable pulled":
        pulled_s = graph.log.rows()[0][0] + PULLED_AFTER_S
        if time.monotonic() > pulled_s:
            raise RuntimeError("the base had not reached its speed when the cable was pulled: this machine is too busy")
        wait_for(lambda: time.monotonic() > pulled_s, "the cable is pulled")
        return pulled_s
    graph.end("master")
    graph.processes["bridge"].wait(PATIENCE_S)  # it watches the master, ends by itself, and stops the base first
    graph.end("bridge")
    return None


def trial(graph, case):
    """(seconds to zero, metres rolled, metres allowed)"""
    prepare(graph, case)
    ended = let_end(graph, case)
    wait_for(lambda: held(graph.log.last()) == 0.0 and speed_of(graph.log.last()) < 0.005, "the emulated base stands")
    graph.read_stamps()
    rows = graph.log.rows()
    moving = max(i for i, row in enumerate(rows) if held(row) > 0.0)
    zero_s = rows[moving + 1][0]
    last_s = max(stamp for stamp in graph.stamps if stamp < (ended or zero_s))
    at_last = min(rows, key=lambda row: abs(row[0] - last_s))
    v = speed_of(at_last)
    allowed = v * MOST_S + v * v / (2 * ACCELERATION) + MARGIN_M
    result = (zero_s - last_s, way_of(rows[-1]) - way_of(at_last), allowed)
    clean(graph, case)
    return result


def clean(graph, case):
    graph.tell_driver("stop")
    if case == "cable pulled":
        graph.end("emulator")
    if case == "master gone":
        graph.end("driver")


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def main():
    source = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=100, help="of each case")
    parser.add_argument("--programs", default=os.path.join(source, "build/devel/lib/stereo_nav"), help="their folder")
    parser.add_argument("--rig", default=os.path.join(source, "test/rostest/base_rig.yaml"))
    parser.add_argument("--speed", type=float, default=0.9, help="m/s")
    parser.add_argument("--case", choices=CASES, action="append", help="only these")
    parser.add_argument("--output", help="CSV file of all trials")
    parser.add_argument("--drive", metavar="TOPIC", help=argparse.SUPPRESS)
    options = parser.parse_args()
    options.source = source
    if options.drive:
        return drive(options.speed, options.drive)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # and end what was started
    good = True
    lines = []
    print("| what ended | trials | to zero: median, worst (s) | rolled: median, worst (m) | allowed (m) |\n|---|---|---|---|---|")
    for case in options.case or CASES:
        with tempfile.TemporaryDirectory() as folder:
            graph = Graph(options, folder, case == "mux frozen")
            try:
                results = [trial(graph, case) for _ in range(options.trials)]
            finally:
                graph.close()
        seconds, metres, allowed = zip(*results)
        bad = sum(s > MOST_S or m > a for s, m, a in results)
        good = good and bad == 0
        print("| %s | %d%s | %.3f, %.3f | %.3f, %.3f | %.3f |" % (
            case, len(results), ", %d too long" % bad if bad else "", percentile(seconds, 0.5), max(seconds),
            percentile(metres, 0.5), max(metres), min(allowed)), flush=True)
        lines += [(case, "%.4f" % s, "%.4f" % m, "%.4f" % a) for s, m, a in results]
    if options.output:
        with open(options.output, "w", newline="") as file:
            csv.writer(file).writerows([("what ended", "to zero (s)", "rolled (m)", "allowed (m)"), *lines])
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
