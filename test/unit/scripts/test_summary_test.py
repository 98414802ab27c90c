#!/usr/bin/env python3
"""The summary of the tests must not lose a failure: whatever ctest was to run is passed, failed or skipped."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SUMMARY = Path(__file__).resolve().parents[3] / 'scripts' / 'lib' / 'test_summary.py'

GTEST_XML = '''<testsuites><testsuite name="Depth">
  <testcase classname="Depth" name="good" result="completed"/>
  <testcase classname="Depth" name="bad" result="completed"><failure message="1 is not 2"/></testcase>
  <testcase classname="Depth" name="left_out" result="skipped"><skipped message="file.cpp:3&#10;no data"/></testcase>
</testsuite></testsuites>'''


class SummaryTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.results = Path(self.folder.name) / 'build' / 'test_results'
        self.results.mkdir(parents=True)
        self.tests, self.log = [], ''

    def tearDown(self):
        self.folder.cleanup()

    def add_test(self, name, status, xml_name=None, xml=None):
        """A test in ctest's listing, its line in ctest's log (None: never run), and its JUnit file."""
        command = ['run_tests.py']
        if xml_name:
            command.append(str(self.results / xml_name))
            if xml is not None:
                (self.results / xml_name).write_text(xml)
        self.tests.append({'name': name, 'command': command})
        if status:
            number = len(self.tests)
            self.log += f'{number}/9 Test #{number}: {name} ....{status}    0.10 sec\n'

    def summary(self, **environment):
        if self.tests:
            (self.results / 'unit.json').write_text(json.dumps({'tests': self.tests}))
            (self.results / 'unit.log').write_text(self.log)
        environment = {**os.environ, 'STEREO_NAV_FAIL_ON_SKIP': '0', **environment}
        run = subprocess.run([sys.executable, SUMMARY, self.results], env=environment, stdout=subprocess.PIPE,
                             universal_newlines=True, check=False)
        return run.stdout.splitlines(), run.returncode

    def test_counts_the_cases_of_a_googletest(self):
        self.add_test('depth', '***Failed', 'gtest-depth.xml', GTEST_XML)
        lines, status = self.summary()
        self.assertEqual(lines, ['SKIPPED build: Depth.left_out (no data)', 'FAILED build: Depth.bad',
                                 '1 passed, 1 failed, 1 skipped'])
        self.assertEqual(status, 1)

    def test_a_test_without_result_has_failed(self):
        self.add_test('crashed', '***Exception: SegFault', 'gtest-crashed.xml')
        self.add_test('hung', '***Timeout', 'gtest-hung.xml')
        self.add_test('never_run', None, 'gtest-never_run.xml')
        self.add_test('empty', '   Passed', 'gtest-empty.xml', '<testsuites/>')
        self.add_test('truncated', '***Failed', 'gtest-truncated.xml', '<testsuites><test')
        self.assertEqual(self.summary()[0][-1], '0 passed, 5 failed, 0 skipped')

    def test_a_bad_exit_after_good_cases_has_failed(self):
        self.add_test('leaks', '***Failed', 'gtest-leaks.xml',
                      '<testsuites><testcase classname="Leaks" name="good"/></testsuites>')
        lines, status = self.summary()
        self.assertEqual(lines, ['FAILED build: leaks (Failed)', '1 passed, 1 failed, 0 skipped'])
        self.assertEqual(status, 1)

    def test_a_rostest_counts_as_the_cases_of_its_node(self):
        self.add_test('rostest', '   Passed', 'rostest-graph.xml',
                      '<testsuite><testcase classname="rostest.runner.RosTest" name="testpose"/></testsuite>')
        (self.results / 'rosunit-pose.xml').write_text(
            '<testsuites><testcase classname="Pose" name="x"/><testcase classname="Pose" name="y"/></testsuites>')
        self.assertEqual(self.summary(), (['2 passed, 0 failed, 0 skipped'], 0))

    def test_a_rostest_whose_node_left_nothing_has_failed(self):
        self.add_test('rostest', '***Failed', 'rostest-graph.xml',
                      '<testsuite><testcase classname="rostest.runner.RosTest" name="testpose">'
                      '<failure>did not generate test results</failure></testcase></testsuite>')
        self.assertEqual(self.summary()[0][-1], '0 passed, 1 failed, 0 skipped')

    def test_plain_tests_and_checks_count(self):
        self.add_test('script', '   Passed')
        self.add_test('no_tool', '***Skipped')
        (self.results / 'lint.tap').write_text('ok links\nnot ok format\nok xml # SKIP no xmllint\n')
        self.assertEqual(self.summary()[0][-1], '2 passed, 1 failed, 2 skipped')

    def test_skips_fail_only_where_that_is_asked_for(self):
        self.add_test('script', '   Passed')
        self.add_test('no_data', '***Skipped')
        self.assertEqual(self.summary()[1], 0)
        lines, status = self.summary(STEREO_NAV_FAIL_ON_SKIP='1')
        self.assertEqual((lines[-1], status), ('1 passed, 0 failed, 1 skipped', 1))

    def test_nothing_run_is_no_success(self):
        self.assertEqual(self.summary(), (['0 passed, 0 failed, 0 skipped'], 1))


if __name__ == '__main__':
    unittest.main()
