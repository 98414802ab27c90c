#!/usr/bin/env python3
"""The launcher takes the object of an equal command only, and make still learns of which headers it was made."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LAUNCHER = Path(__file__).resolve().parents[3] / 'scripts' / 'lib' / 'same_object.py'


class SameObjectTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        top = Path(folder.name).resolve()
        self.source, self.build, self.workspace = top / 'package', top / 'package' / 'build', top / 'workspace'
        self.folder = self.workspace / 'build' / 'stereo_nav' / 'src' / 'core'
        for path in (self.source / 'src', self.build / 'src' / 'core', self.workspace / 'src', self.folder):
            path.mkdir(parents=True)
        (self.workspace / 'src' / 'stereo_nav').symlink_to(self.source)
        self.compiler = top / 'c++'
        self.compiler.write_text('#!/bin/sh\necho "compiled $*" >a.o\n')
        self.compiler.chmod(0o755)
        made = self.build / 'src' / 'core' / 'a.o'
        made.write_text('the object of the build\n')
        made.with_name('a.o.d').write_text(f'src/core/a.o: {self.source}/src/a.cpp \\\n {self.source}/include/a.h\n')
        self.add_command(self.command(self.source, self.build, self.build / 'devel'))

    def command(self, source, build, devel, optimisation='-O3'):
        return [self.compiler, optimisation, '-DTEXT="a b"', f'-I{devel}/include', '-iquote', f'{source}/src', '-o', 'a.o', '-c',
                f'{source}/src/a.cpp']

    def add_command(self, command):
        (self.build / 'compile_commands.json').write_text(json.dumps([{
            'directory': str(self.build / 'src' / 'core'),
            'command': ' '.join(str(word).replace('"', '\\"').replace(' ', '\\ ') for word in command)}]))

    def compile(self, **changes):
        """The text of the object, as the workspace asks for it."""
        command = self.command(self.workspace / 'src' / 'stereo_nav', self.workspace / 'build' / 'stereo_nav',
                               self.workspace / 'devel', **changes)
        command[-4:-4] = ['-MD', '-MT', 'stereo_nav/src/core/a.o', '-MF', 'a.o.d']
        subprocess.run([sys.executable, LAUNCHER, self.build, self.workspace, *command], cwd=self.folder, check=True)
        return (self.folder / 'a.o').read_text()

    def test_the_object_of_the_same_command_is_taken_with_its_headers(self):
        self.assertEqual(self.compile(), 'the object of the build\n')
        self.assertEqual((self.folder / 'a.o.d').read_text(), f'stereo_nav/src/core/a.o: {self.source}/src/a.cpp \\\n '
                         f'{self.source}/include/a.h\n')
        self.assertTrue((self.workspace / 'same_object.log').read_text().startswith('taken '))

    def test_another_command_compiles(self):
        self.assertTrue(self.compile(optimisation='-O2').startswith('compiled -O2 '))
        self.assertTrue((self.workspace / 'same_object.log').read_text().startswith('compiled '))

    def test_what_the_build_lacks_is_compiled(self):
        (self.build / 'src' / 'core' / 'a.o').unlink()
        self.assertTrue(self.compile().startswith('compiled '))
        os.remove(self.build / 'compile_commands.json')
        self.assertTrue(self.compile().startswith('compiled '))

    def test_a_failure_of_the_compiler_is_passed_on(self):
        self.compiler.write_text('#!/bin/sh\nexit 3\n')
        run = subprocess.run([sys.executable, LAUNCHER, self.build, self.workspace, self.compiler, '-c', 'b.cpp', '-o', 'b.o'],
                             cwd=self.folder, check=False)
        self.assertEqual(run.returncode, 3)


if __name__ == '__main__':
    unittest.main()
