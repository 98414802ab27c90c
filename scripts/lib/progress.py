#!/usr/bin/env python3
"""Says what a run of several steps will do, how far it is and how long it takes.

  progress.py plan SECONDS_FILE STEP...              the steps and how long each will take
  progress.py begin SECONDS_FILE NUMBER/ALL STEP     which step comes
  progress.py follow SECONDS_FILE STEP [LIST.json]   filter for the output of make or ctest (whose tests LIST.json holds)
  progress.py end SECONDS_FILE NUMBER/ALL STEP SECONDS
  progress.py table STEP=SECONDS... -- RESULTS_DIR...

SECONDS_FILE holds a line "SECONDS STEP" for each step, as long as it took the last time it was good (`end` writes it); a
step that it lacks takes what test_seconds.txt beside this script says. On a terminal `follow` shows one line in place and
leaves out what went well, else it passes on every line and adds what remains to those of finished tests.
"""
import json
import os
import re
import select
import shutil
import sys
import time
from pathlib import Path

DEFAULTS = Path(__file__).resolve().parent / 'test_seconds.txt'
SLOWEST = 10

# "  Start  3: NAME" and " 3/38 Test  #3: NAME ....   Passed   12.34 sec"
STARTED = re.compile(r'^ *Start +\d+: (\S+)')
FINISHED = re.compile(r'^ *(\d+)/(\d+) Test +#\d+: (\S+) \.* *(\**[A-Z][A-Za-z:() ]*?) +([\d.]+) sec')
BUILDING = re.compile(r'^\[ *(\d+)%\] (.*)')


def read_seconds(path):
    """Step -> seconds."""
    pairs = [line.split(' ', 1) for line in path.read_text().splitlines()] if path.exists() else []
    return {step: float(seconds) for seconds, step in pairs}


def duration(seconds):
    """'45 s' or '18 min'."""
    return f'{seconds:.0f} s' if seconds < 90 else f'{seconds / 60:.0f} min'


def short_name(test):
    """A test's name without what catkin puts before it."""
    return re.sub(r'^_ctest_\w+?_(?:gtest|rostest)_(?:test_rostest_)?', '', test)


class Typical:
    """How long steps take."""

    def __init__(self, path):
        self.path = path
        self.learnt = read_seconds(path)
        self.shipped = read_seconds(DEFAULTS)

    def seconds(self, step):
        """Nothing for a step that was never measured."""
        return self.learnt.get(step, self.shipped.get(step))

    def about(self, step):
        seconds = self.seconds(step)
        return f'about {duration(seconds)}' if seconds is not None else 'never measured'

    def learn(self, step, seconds):
        self.learnt[step] = seconds
        self.path.write_text(''.join(f'{value:.0f} {name}\n' for name, value in self.learnt.items()))


def plan(typical, steps):
    total = sum(typical.seconds(step) or 0 for step in steps)
    origin = 'as last time' if all(step in typical.learnt for step in steps) else 'typical of two cores'
    noun = 'step' if len(steps) == 1 else 'steps'
    print(f'== {len(steps)} {noun}, about {duration(total)} in all ({origin})')
    for number, step in enumerate(steps, 1):
        print(f'     [{number}/{len(steps)}] {step}, {typical.about(step)}')


class TestProgress:
    """What ctest says, as how far it is."""

    def __init__(self, typical_s, listing, now):
        self.typical_s, self.start = typical_s, now
        self.done, self.count, self.running = 0, 0, {}
        self.costs = {}
        if listing:
            self.costs = {test['name']: None for test in json.loads(listing.read_text())['tests']}
            self.count = len(self.costs)
            self.read_costs(listing.parent.parent / 'Testing' / 'Temporary' / 'CTestCostData.txt')

    def read_costs(self, path):
        """ctest's own record, "NAME RUNS SECONDS"; a test that it does not know costs as much as the others on average."""
        for line in path.read_text().splitlines() if path.exists() else []:
            words = line.split()
            if len(words) == 3 and words[0] in self.costs and float(words[1]) > 0:
                self.costs[words[0]] = float(words[2])
        known = [cost for cost in self.costs.values() if cost is not None]
        mean = sum(known) / len(known) if known else 1.0
        self.costs = {name: mean if cost is None else max(cost, 0.01) for name, cost in self.costs.items()}
        self.all_costs = sum(self.costs.values())

    def take(self, line, now):
        """Takes a line of ctest in; whether it is one that says no more than how far ctest is."""
        started = STARTED.match(line)
        if started:
            self.running[started.group(1)] = now
            return True
        finished = FINISHED.match(line)
        if not finished:
            return False
        self.done, self.count = int(finished.group(1)), int(finished.group(2))
        self.running.pop(finished.group(3), None)
        self.costs.pop(finished.group(3), None)
        return finished.group(4) in ('Passed', '***Skipped')

    def left_s(self, now):
        """Nothing when it cannot be told."""
        if self.typical_s is None or not self.count:
            return None
        if not self.costs:
            return self.typical_s * (1 - self.done / self.count)
        passed = sum(min(now - since, self.costs.get(name, 0)) for name, since in self.running.items())
        return self.typical_s * max(0.0, sum(self.costs.values()) - passed) / self.all_costs

    def text(self, now):
        running = ', '.join(f'{short_name(name)} {now - since:.0f} s' for name, since in self.running.items())
        return f'{self.done} of {self.count} done' + (f', running {running}' if running else '')


class BuildProgress:
    """What make says, as how far it is."""

    def __init__(self, typical_s, now):
        self.typical_s, self.start = typical_s, now
        self.percent, self.what = None, ''

    def take(self, line, now):
        built = BUILDING.match(line)
        if built:
            self.percent, self.what = int(built.group(1)), built.group(2)
        return bool(built)

    def left_s(self, now):
        """By the pace until now, once there is one."""
        if self.percent is None:
            return self.typical_s
        if self.percent >= 20:
            return (now - self.start) * (100 - self.percent) / self.percent
        return self.typical_s and self.typical_s * (100 - self.percent) / 100

    def text(self, now):
        return f'{self.percent} %, {self.what}' if self.percent is not None else ''


class Display:
    """Lines, and on a terminal one that is written over in place."""

    def __init__(self, output):
        self.output, self.terminal, self.shown = output, output.isatty(), 0

    def line(self, text):
        self.clear()
        self.output.write(text + '\n')
        self.output.flush()

    def in_place(self, text):
        width = shutil.get_terminal_size().columns - 1
        text = text if len(text) <= width else text[:width - 3] + '...'
        self.output.write('\r' + text.ljust(self.shown) + ('\r' + text if len(text) < self.shown else ''))
        self.output.flush()
        self.shown = len(text)

    def clear(self):
        if self.shown:
            self.in_place('')
            self.output.write('\r')


def lines_or_ticks(source):
    """Lines of a file descriptor without their ends; nothing after each second without one."""
    rest = b''
    while True:
        if not select.select([source], [], [], 1.0)[0]:
            yield None
            continue
        chunk = os.read(source, 65536)
        *lines, rest = (rest + chunk).split(b'\n')
        for line in lines if chunk else [rest] if rest else []:
            yield line.decode(errors='replace')
        if not chunk:
            return


def follow(progress, display, source, clock=time.monotonic):
    for line in lines_or_ticks(source):
        now = clock()
        only_progress = line is not None and progress.take(line, now)
        left_s = progress.left_s(now)
        left = f', about {duration(left_s)} left' if left_s else ''
        if line is not None and not (only_progress and display.terminal):
            display.line(line + (left if FINISHED.match(line) else ''))
        if display.terminal and progress.text(now):
            display.in_place('   ' + progress.text(now) + left)
    display.clear()


def slowest_tests(folders):
    """(seconds, name) of all tests in the logs that ctest left in the folders, the slowest first."""
    times = []
    for folder in folders:
        for log in sorted(folder.glob('*.log')):
            found = map(FINISHED.match, log.read_text(errors='replace').splitlines())
            times += [(float(match.group(5)), f'{folder.parent.name}: {short_name(match.group(3))}') for match in found if match]
    return sorted(times, reverse=True)


def table(steps, folders):
    """`steps` holds (name, seconds)."""
    print('   seconds  step')
    for name, seconds in steps + [('all', sum(seconds for _, seconds in steps))]:
        print(f'  {seconds:8.0f}  {name}')
    tests = slowest_tests(folders)[:SLOWEST]
    if tests:
        print(f'   seconds  the slowest tests ({len(tests)})')
    for seconds, name in tests:
        print(f'  {seconds:8.1f}  {name}')


def main(command, *arguments):
    if command == 'table':
        split = arguments.index('--')
        pairs = [argument.rsplit('=', 1) for argument in arguments[:split]]
        table([(name, float(seconds)) for name, seconds in pairs], list(map(Path, arguments[split + 1:])))
        return
    typical = Typical(Path(arguments[0]))
    if command == 'plan':
        plan(typical, arguments[1:])
    elif command == 'begin':
        print(f'== [{arguments[1]}] {arguments[2]}, {typical.about(arguments[2])}')
    elif command == 'end':
        typical.learn(arguments[2], float(arguments[3]))
        print(f'== [{arguments[1]}] {arguments[2]} took {float(arguments[3]):.0f} s')
    elif command == 'follow':
        step, now = arguments[1], time.monotonic()
        progress = (TestProgress(typical.seconds(step), Path(arguments[2]), now) if len(arguments) > 2
                    else BuildProgress(typical.seconds(step), now))
        follow(progress, Display(sys.stdout), sys.stdin.fileno())
    else:
        sys.exit(f'unknown command {command}: plan | begin | follow | end | table')


if __name__ == '__main__':
    main(*sys.argv[1:])
