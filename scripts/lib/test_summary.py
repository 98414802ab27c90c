#!/usr/bin/env python3
"""Adds up test results: test_summary.py RESULTS_DIR...

Each folder holds what one run of the tests left behind:
  NAME.json  the tests that ctest was to run (ctest --show-only=json-v1)
  NAME.log   what ctest said about them
  */*.xml    the JUnit files that GoogleTest and rostest wrote
  NAME.tap   checks that are no ctest tests: "ok NAME", "not ok NAME", "ok NAME # SKIP reason"
A test without a JUnit file (crashed, timed out, never started) is a failure. Prints the names of what failed or was
skipped; the last line is "N passed, N failed, N skipped". The exit status is 1 when anything failed, or, with
STEREO_NAV_FAIL_ON_SKIP=1, when anything was skipped.
"""
import json
import os
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

PASSED, FAILED, SKIPPED = 'passed', 'failed', 'skipped'


def junit_cases(path):
    """(name, outcome, detail) of each test case in a JUnit file; a broken file is one failed case."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        return [(path.stem, FAILED, f'no readable result: {error}')]
    cases = []
    for case in root.iter('testcase'):
        name = f"{case.get('classname', '')}.{case.get('name', '')}"
        outcome, detail = PASSED, ''
        skipped = case.find('skipped')
        if skipped is not None or case.get('result') in ('skipped', 'suppressed'):
            outcome, detail = SKIPPED, (skipped.get('message') or '') if skipped is not None else ''
        if case.find('failure') is not None or case.find('error') is not None:
            outcome = FAILED
        cases.append((name, outcome, detail.strip().split('\n')[-1]))
    return cases


def rostest_cases(path):
    """The cases of a rostest: those of its test nodes, and its own where a node left no result."""
    cases = []
    for name, outcome, detail in junit_cases(path):
        node_result = path.parent / f"rosunit-{name.split('.test', 1)[-1]}.xml"
        if outcome == PASSED and node_result.exists():
            cases += junit_cases(node_result)
        else:
            cases.append((name, outcome, detail))
    return cases


def ctest_statuses(log):
    """Test name -> its result according to ctest."""
    pattern = re.compile(r'^ *\d+/\d+ Test +#\d+: (\S+) \.* *(?:\*\*\*)?([A-Z][A-Za-z ]*[a-z])', re.MULTILINE)
    return dict(pattern.findall(log.read_text(errors='replace'))) if log.exists() else {}


def ctest_results(listing):
    """Results of the tests in a ctest listing."""
    statuses = ctest_statuses(listing.with_suffix('.log'))
    results = []
    for test in json.loads(listing.read_text())['tests']:
        name, status = test['name'], statuses.get(test['name'], 'never run')
        result_files = [Path(word) for word in test.get('command', []) if word.endswith('.xml')]
        cases = []
        if result_files and result_files[0].exists():
            read_cases = rostest_cases if result_files[0].name.startswith('rostest-') else junit_cases
            cases = read_cases(result_files[0])
        elif status in ('Passed', 'Skipped') and not result_files:
            cases = [(name, PASSED if status == 'Passed' else SKIPPED, '')]
        # A status that no case accounts for: crash, time-out, or a complaint at exit such as a leak.
        if status not in ('Passed', 'Skipped') or not cases:
            if not any(outcome == FAILED for _, outcome, _ in cases):
                cases.append((name, FAILED, 'no test case' if status == 'Passed' else status))
        results += cases
    return results


def tap_results(path):
    results = []
    for line in path.read_text(errors='replace').splitlines():
        match = re.match(r'(not )?ok (.*?)(?: # SKIP (.*))?$', line)
        if match:
            outcome = FAILED if match.group(1) else SKIPPED if match.group(3) else PASSED
            results.append((match.group(2), outcome, match.group(3) or ''))
    return results


def main(folders):
    results = []
    for folder in map(Path, folders):
        found = [result for listing in sorted(folder.glob('*.json')) for result in ctest_results(listing)]
        found += [result for path in sorted(folder.glob('*.tap')) for result in tap_results(path)]
        results += [(f'{folder.parent.name}: {name}', outcome, detail) for name, outcome, detail in found]

    for wanted in (SKIPPED, FAILED):
        for name, outcome, detail in results:
            if outcome == wanted:
                print(f'{wanted.upper()} {name}' + (f' ({detail})' if detail else ''))
    count = {wanted: sum(outcome == wanted for _, outcome, _ in results) for wanted in (PASSED, FAILED, SKIPPED)}
    fail_on_skip = os.environ.get('STEREO_NAV_FAIL_ON_SKIP') == '1'
    if fail_on_skip and count[SKIPPED]:
        print('Skipped tests count as failures here (STEREO_NAV_FAIL_ON_SKIP=1).')
    print(f'{count[PASSED]} passed, {count[FAILED]} failed, {count[SKIPPED]} skipped')
    return 1 if count[FAILED] or not count[PASSED] or (fail_on_skip and count[SKIPPED]) else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
