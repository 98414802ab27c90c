#!/usr/bin/env python3
"""The progress of scripts/test.sh: what it says before, during and after the steps, and that no line of a failure is lost."""
import contextlib
import io
import json
import os
import pty
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[3] / 'scripts' / 'lib'
PROGRESS = SCRIPTS / 'progress.py'
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))
import progress  # noqa: E402

NAMES = ['_ctest_stereo_nav_gtest_core_test', '_ctest_stereo_nav_rostest_test_rostest_replay.test', 'v4l2_cameras']

CTEST_LOG = '''Test project /somewhere/build
    Start 1: _ctest_stereo_nav_gtest_core_test
    Start 2: _ctest_stereo_nav_rostest_test_rostest_replay.test
1/3 Test #1: _ctest_stereo_nav_gtest_core_test ........................   Passed   10.00 sec
    Start 3: v4l2_cameras
2/3 Test #2: _ctest_stereo_nav_rostest_test_rostest_replay.test .......***Failed   30.00 sec
core.cpp:3: Failure, 1 is not 2

3/3 Test #3: v4l2_cameras .............................................   Passed   60.00 sec

67% tests passed, 1 tests failed out of 3
'''


class ProgressTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = Path(folder.name) / 'build'
        self.results = self.build / 'test_results'
        self.results.mkdir(parents=True)
        self.seconds = self.build / 'test_seconds.txt'
        self.listing = self.results / 'graph.json'
        self.listing.write_text(json.dumps({'tests': [{'name': name} for name in NAMES]}))

    def run_progress(self, *arguments, text=''):
        run = subprocess.run([sys.executable, PROGRESS, *map(str, arguments)], input=text, stdout=subprocess.PIPE,
                             universal_newlines=True, check=True)
        return run.stdout

    def on_a_terminal(self, *arguments, text=''):
        """What is written to a terminal of 80 columns."""
        terminal, end = pty.openpty()
        process = subprocess.Popen([sys.executable, PROGRESS, *map(str, arguments)], stdin=subprocess.PIPE, stdout=end,
                                   env={**os.environ, 'COLUMNS': '80'})
        os.close(end)
        process.stdin.write(text.encode())
        process.stdin.close()
        written = b''
        with contextlib.suppress(OSError):  # a terminal whose other end is closed gives an error
            while True:
                written += os.read(terminal, 4096)
        self.assertEqual(process.wait(), 0)
        os.close(terminal)
        return written.decode().replace('\r\n', '\n')

    def know_costs(self):
        folder = self.build / 'Testing' / 'Temporary'
        folder.mkdir(parents=True)
        (folder / 'CTestCostData.txt').write_text(f'{NAMES[0]} 2 10\n{NAMES[1]} 2 30\n{NAMES[2]} 2 60\n---\n{NAMES[1]}\n')

    def test_the_plan_holds_every_step_and_the_sum(self):
        self.seconds.write_text('20 build\n100 unit tests\n')
        self.assertEqual(self.run_progress('plan', self.seconds, 'build', 'unit tests').splitlines(),
                         ['== 2 steps, about 2 min in all (as last time)', '     [1/2] build, about 20 s',
                          '     [2/2] unit tests, about 2 min'])

    def test_every_step_of_the_script_has_a_default(self):
        script = (SCRIPTS.parent / 'test.sh').read_text()
        steps = [name for line in re.findall(r'^.*\bsteps\+?=\(.*$', script, re.MULTILINE)
                 for name in re.findall(r'"([^"]+)"', line)]
        self.assertGreater(len(steps), 5)
        self.assertEqual(sorted(steps), sorted(progress.read_seconds(progress.DEFAULTS)))
        self.assertIn('typical of two cores', self.run_progress('plan', self.seconds, 'build'))
        self.assertIn('never measured', self.run_progress('plan', self.seconds, 'something new'))

    def test_a_step_is_announced_and_its_duration_learnt(self):
        self.assertRegex(self.run_progress('begin', self.seconds, '1/8', 'build'), r'^== \[1/8\] build, about \d+ min\n$')
        self.assertEqual(self.run_progress('end', self.seconds, '1/8', 'build', '7'), '== [1/8] build took 7 s\n')
        self.run_progress('end', self.seconds, '2/8', 'unit tests', '123')
        self.assertEqual(self.run_progress('begin', self.seconds, '1/8', 'build'), '== [1/8] build, about 7 s\n')
        self.assertEqual(self.seconds.read_text(), '7 build\n123 unit tests\n')

    def test_without_a_terminal_every_line_passes_and_says_what_remains(self):
        self.know_costs()
        self.seconds.write_text('600 graph\n')
        lines = self.run_progress('follow', self.seconds, 'graph', self.listing, text=CTEST_LOG).splitlines()
        self.assertEqual([line.split(', about')[0] for line in lines], CTEST_LOG.splitlines())
        self.assertTrue(lines[3].endswith('10.00 sec, about 9 min left'), lines[3])
        self.assertTrue(lines[5].endswith('30.00 sec, about 6 min left'), lines[5])
        self.assertTrue(lines[8].endswith('60.00 sec'), lines[8])

    def test_a_terminal_shows_one_line_in_place_and_all_of_a_failure(self):
        self.seconds.write_text('600 graph\n')
        written = self.on_a_terminal('follow', self.seconds, 'graph', self.listing, text=CTEST_LOG)
        in_place = [part.strip() for part in written.replace('\n', '\r').split('\r')]
        self.assertIn('0 of 3 done, running core_test 0 s, replay.test 0 s, about 10 min left', in_place)
        self.assertIn('1 of 3 done, running replay.test 0 s, about 7 min left', in_place)
        self.assertIn('core.cpp:3: Failure, 1 is not 2', in_place)
        self.assertTrue(any('***Failed' in part for part in in_place))
        self.assertNotIn('Passed ', written)
        self.assertTrue(all(len(part) < 80 for part in in_place if ' done' in part))

    def test_a_build_is_shown_by_its_percentage_and_its_warnings_stay(self):
        self.seconds.write_text('600 build\n')
        text = '[  5%] Building core.cpp.o\ncore.cpp:1: warning: odd\n[ 10%] Linking core\n'
        self.assertEqual(self.run_progress('follow', self.seconds, 'build', text=text), text)
        written = self.on_a_terminal('follow', self.seconds, 'build', text=text)
        self.assertIn('5 %, Building core.cpp.o, about 10 min left', written)
        self.assertIn('10 %, Linking core, about 9 min left', written)
        self.assertIn('core.cpp:1: warning: odd\n', written)

    def test_what_remains_counts_down_while_a_test_runs(self):
        self.know_costs()
        tests = progress.TestProgress(600.0, self.listing, now=0.0)
        tests.take(f'   Start 3: {NAMES[2]}', 0.0)
        self.assertAlmostEqual(tests.left_s(0.0), 600.0)
        self.assertAlmostEqual(tests.left_s(30.0), 420.0)
        self.assertAlmostEqual(tests.left_s(1000.0), 240.0)
        self.assertEqual(tests.text(30.0), '0 of 3 done, running v4l2_cameras 30 s')

    def test_the_line_without_an_end_is_passed_on(self):
        self.assertEqual(self.run_progress('follow', self.seconds, 'build', text='no end'), 'no end\n')

    def test_the_table_has_all_steps_and_the_slowest_tests(self):
        (self.results / 'graph.log').write_text(CTEST_LOG)
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            progress.main('table', 'build=30', 'a = b=70', '--', str(self.results))
        self.assertEqual([line.split(None, 1) for line in output.getvalue().splitlines()],
                         [['seconds', 'step'], ['30', 'build'], ['70', 'a = b'], ['100', 'all'],
                          ['seconds', 'the slowest tests (3)'], ['60.0', 'build: v4l2_cameras'],
                          ['30.0', 'build: replay.test'], ['10.0', 'build: core_test']])


if __name__ == '__main__':
    unittest.main()
