#!/usr/bin/env python3
"""scripts/test.sh with a cmake and a ctest that only pretend: which steps it takes, what it says, what it ends with."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[3] / 'scripts' / 'test.sh'

# Functions that bash takes before any program. All calls are kept in $CALLS.
PRETEND = {
    'BASH_FUNC_cmake%%': '() { echo "cmake $*" >>"$CALLS"; [[ "$*" != *$BROKEN* ]] || return 1; echo "[ 50%] Building a.o"; }',
    'BASH_FUNC_ctest%%': '''() {
        if [[ "$*" == *--show-only* ]]; then echo '{"tests": [{"name": "first"}, {"name": "second"}]}'; return; fi
        echo "ctest $*" >>"$CALLS"
        [[ "$*" != *-LE* || -z $BESIDE ]] || until grep -q -- "$BESIDE" "$CALLS"; do sleep 0.01; done
        echo "1/2 Test #1: first .....   Passed    1.50 sec"
        echo "2/2 Test #2: second ....***Failed    0.50 sec"
        return 8
    }'''}


class TestScriptTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = Path(folder.name) / 'build'
        self.calls = Path(folder.name) / 'calls'

    def run_script(self, *arguments, broken='nothing', beside=''):
        environment = {**os.environ, **PRETEND, 'CALLS': str(self.calls), 'BROKEN': broken, 'BESIDE': beside,
                       'STEREO_NAV_FAIL_ON_SKIP': '0'}
        run = subprocess.run([SCRIPT, *arguments, self.build], env=environment, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, universal_newlines=True, check=False)
        return run.stdout.splitlines(), run.returncode, self.calls.read_text() if self.calls.exists() else ''

    def test_the_unit_tier_builds_and_runs_unit_tests_only(self):
        lines, status, calls = self.run_script('--unit')
        self.assertRegex(lines[0], r'^== 2 steps, about \d+ min in all \(typical of two cores\)$')
        self.assertRegex(calls, r'--target stereo_nav_unit_tests\nctest -L \^unit\$ --parallel \d+ .*\n$')
        self.assertTrue(any(line.startswith('== [2/2] unit tests, about ') for line in lines), lines)
        self.assertEqual((lines[-1], status), ('1 passed, 1 failed, 0 skipped', 1))
        self.assertIn('FAILED build: second (Failed)', lines)
        table = lines.index('== summary')
        self.assertEqual(lines[table + 1], '   seconds  step')
        self.assertIn('       1.5  build: first', lines[table:])

    def test_durations_are_kept_for_the_next_run(self):
        self.run_script('--unit')
        names = [line.split(' ', 1)[1] for line in (self.build / 'test_seconds.txt').read_text().splitlines()]
        self.assertEqual(names, ['build of the unit tests', 'unit tests'])
        self.assertIn('(as last time)', self.run_script('--unit')[0][0])

    def test_sanitizers_come_after_the_graph(self):
        lines, _, calls = self.run_script('--sanitize', '--tsan')
        self.assertIn('--target all tests', calls)
        self.assertEqual([call.split(' --timeout')[0].split(' --parallel')[0] for call in calls.splitlines() if 'ctest' in call],
                         ['ctest -L ^unit$', 'ctest -LE ^unit$', 'ctest -R _gtest_ -L ^unit$', 'ctest -R _gtest_ -L ^tsan$'])
        self.assertIn('-DSTEREO_NAV_SANITIZE=thread', calls)
        self.assertEqual(lines[-1], '4 passed, 4 failed, 0 skipped')

    def test_the_builds_with_sanitizers_begin_beside_the_graph(self):
        _, _, calls = self.run_script('--sanitize', '--tsan', beside='build-tsan --target stereo_nav_tsan_tests')
        graph = calls.index('ctest -LE')
        self.assertLess(graph, calls.index('ctest -R'))
        for kind, target in (('asan', 'unit'), ('tsan', 'tsan')):
            self.assertIn(f'cmake --build {self.build}-{kind} --target stereo_nav_{target}_tests\n', calls)
            self.assertIn(f'cmake --build {self.build}-{kind} --parallel {os.cpu_count()} --target stereo_nav_{target}_tests\n',
                          calls[graph:])

    def test_a_failed_build_is_a_failure_and_its_duration_is_not_learnt(self):
        lines, status, calls = self.run_script('--unit', broken='--build')
        self.assertEqual((lines[-2:], status), (['FAILED build: build', '0 passed, 1 failed, 0 skipped'], 1))
        self.assertNotIn('ctest', calls)
        self.assertFalse((self.build / 'test_seconds.txt').exists())

    def test_options_that_contradict_each_other_are_refused(self):
        lines, status, _ = self.run_script('--unit', '--demo')
        self.assertEqual(status, 2)
        self.assertIn('--unit builds neither', lines[0])

    def tearDown(self):
        for kind in ('asan', 'tsan'):
            shutil.rmtree(f'{self.build}-{kind}', ignore_errors=True)


if __name__ == '__main__':
    unittest.main()
