#!/usr/bin/env python3
"""The check of the floors: a package that keeps the rules is clean, and each kind of violation is found and named."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parents[3] / 'scripts' / 'lib' / 'check_floors.py'

# A small package: core and eval below sim, ros and one program above.
CLEAN = {
    'src/floors.txt': 'core 1\neval 2\nvision 2\nsim 3\nros 5\ntools/* 7\n# a comment\n'
                      'sim -> ros: a reason that the test needs.\n',
    'CMakeLists.txt': 'catkin_package(\n  LIBRARIES stereo_nav_core\n  DEPENDS OpenCV)\n',
    'include/stereo_nav/core/pose.h': '#include <Eigen/Core>\n',
    'src/core/pose.cpp': '#include "stereo_nav/core/pose.h"\n#include "core/detail.h"\n',
    'src/core/detail.h': '',
    'src/core/CMakeLists.txt': 'stereo_nav_library(stereo_nav_core SOURCES pose.cpp LINK yaml-cpp)\n',
    'src/eval/error.h': '#include "stereo_nav/core/pose.h"\n',
    'src/eval/error.cpp': '#include "eval/error.h"\n',
    'src/eval/CMakeLists.txt': 'stereo_nav_library(stereo_nav_eval\n  SOURCES error.cpp\n  LINK stereo_nav_core)\n',
    'src/vision/image.h': '',
    'src/vision/CMakeLists.txt': 'stereo_nav_library(stereo_nav_vision SOURCES image.cpp)\n',
    'src/sim/world.cpp': '#include "eval/error.h"\n#include "ros/messages.h"\n',
    'src/sim/CMakeLists.txt': 'stereo_nav_library(stereo_nav_sim SOURCES world.cpp LINK stereo_nav_eval stereo_nav_ros)\n',
    'src/ros/messages.h': '#include <ros/time.h>\n#include <sensor_msgs/Image.h>\n#include "stereo_nav/VoStatus.h"\n',
    'src/ros/CMakeLists.txt': 'stereo_nav_library(stereo_nav_ros SOURCES messages.cpp LINK ${catkin_LIBRARIES})\n',
    'src/tools/show/show.cpp': '#include "sim/world.h"\n',
    'src/sim/world.h': '',
    'src/tools/show/CMakeLists.txt': 'stereo_nav_program(show SOURCES show.cpp LINK stereo_nav_sim Boost::x)\n',
    'test/external_package/use_core.cpp': '#include <stereo_nav/core/pose.h>\n',
}


class FloorsTest(unittest.TestCase):
    def problems(self, **changes):
        """What is said of the clean package with these files in the place of its own (None: no such file)."""
        files = {**CLEAN, **changes}
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                if text is not None:
                    path = Path(folder) / name
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_text(text)
            run = subprocess.run([sys.executable, str(CHECK), folder], stdout=subprocess.PIPE, universal_newlines=True,
                                 check=False)
        self.assertEqual(run.returncode, 1 if run.stdout.strip() else 0)
        return run.stdout.strip()

    def assert_only_problem(self, pattern, **changes):
        problems = self.problems(**changes)
        self.assertRegex(problems, pattern)
        self.assertEqual(len(problems.splitlines()), 1, problems)

    def test_a_clean_package_is_clean(self):
        self.assertEqual(self.problems(), '')

    def test_an_include_upwards(self):
        self.assert_only_problem(
            r'^src/core/pose\.cpp:2: core \(floor 1\) may not use vision \(floor 2\)',
            **{'src/core/pose.cpp': '#include "core/detail.h"\n#include "vision/image.h"\n',
               'src/core/CMakeLists.txt': 'stereo_nav_library(stereo_nav_core SOURCES pose.cpp LINK yaml-cpp)\n',
               'src/vision/CMakeLists.txt': ''})

    def test_an_include_sideways(self):
        problems = self.problems(**{'src/eval/error.cpp': '#include "vision/image.h"\n'})
        self.assertIn('src/eval/error.cpp:1: eval (floor 2) may not use vision (floor 2)', problems)

    def test_an_include_without_a_link(self):
        self.assert_only_problem(
            r'^src/tools/show/CMakeLists\.txt: tools/show includes sim \(src/tools/show/show\.cpp:1\) but does not link '
            r'stereo_nav_sim',
            **{'src/tools/show/CMakeLists.txt': 'stereo_nav_program(show SOURCES show.cpp LINK Boost::x)\n'})

    def test_a_link_upwards(self):
        problems = self.problems(**{'src/core/CMakeLists.txt':
                                    'stereo_nav_library(stereo_nav_core SOURCES pose.cpp LINK stereo_nav_sim)\n'})
        self.assertIn('core (floor 1) may not link stereo_nav_sim of sim (floor 3)', problems)

    def test_a_link_of_target_link_libraries(self):
        problems = self.problems(**{'src/core/CMakeLists.txt': CLEAN['src/core/CMakeLists.txt'] +
                                    'target_link_libraries(stereo_nav_core PUBLIC stereo_nav_sim)\n'})
        self.assertIn('core (floor 1) may not link stereo_nav_sim of sim (floor 3)', problems)

    def test_a_link_that_nothing_needs(self):
        self.assert_only_problem(
            r'tools/show links stereo_nav_eval but includes nothing of eval',
            **{'src/tools/show/CMakeLists.txt':
               'stereo_nav_program(show SOURCES show.cpp LINK stereo_nav_eval stereo_nav_sim)\n'})

    def test_ros_below_its_floor(self):
        for header in ('<ros/time.h>', '<sensor_msgs/Image.h>', '"stereo_nav/VoStatus.h"', '<stereo_nav/VoStatus.h>'):
            self.assert_only_problem(r'^src/vision/image\.h:1: vision \(floor 2\) includes .* which is of ROS',
                                     **{'src/vision/image.h': f'#include {header}\n'})

    def test_a_library_of_ros_that_the_package_does_not_depend_on(self):
        self.assert_only_problem(r'vision \(floor 2\) includes topic_tools/parse\.h, which is of ROS',
                                 **{'src/vision/image.h': '#include <topic_tools/parse.h>\n'})

    def test_libraries_that_any_floor_may_use(self):
        self.assertEqual(self.problems(**{'src/vision/image.h': '#include <opencv2/core.hpp>\n#include <sys/stat.h>\n'
                                          '#include <vector>\n#include <Eigen/Core>\n'}), '')

    def test_a_header_of_the_package_in_angle_brackets(self):
        self.assert_only_problem(r'^src/vision/image\.h:1: <stereo_nav/core/pose\.h> is a header of the package',
                                 **{'src/vision/image.h': '#include <stereo_nav/core/pose.h>\n'})

    def test_a_link_to_ros_below_its_floor(self):
        self.assert_only_problem(
            r'vision \(floor 2\) links catkin_LIBRARIES',
            **{'src/vision/CMakeLists.txt': 'stereo_nav_library(stereo_nav_vision LINK ${catkin_LIBRARIES})\n'})

    def test_a_public_header_with_a_private_one(self):
        self.assert_only_problem(
            r'^include/stereo_nav/core/pose\.h:1: a public header includes the private header core/detail\.h',
            **{'include/stereo_nav/core/pose.h': '#include "core/detail.h"\n'})

    def test_a_header_that_does_not_exist_or_lacks_its_room(self):
        for header in ('core/missing.h', 'detail.h', 'stereo_nav/core/missing.h'):
            self.assert_only_problem(rf'^src/core/detail\.h:1: there is no {header}',
                                     **{'src/core/detail.h': f'#include "{header}"\n'})

    def test_a_file_outside_of_the_rooms(self):
        self.assert_only_problem(r'^src/loose/file\.cpp: its folder is no room', **{'src/loose/file.cpp': ''})

    def test_a_room_without_a_folder(self):
        self.assert_only_problem(r'^src/floors\.txt:1: there is no folder src/attic',
                                 **{'src/floors.txt': 'attic 2\n' + CLEAN['src/floors.txt']})

    def test_an_exception_without_a_reason(self):
        self.assert_only_problem(r'^src/floors\.txt:\d+: the exception eval -> vision has no reason',
                                 **{'src/floors.txt': CLEAN['src/floors.txt'] + 'eval -> vision:\n'})

    def test_an_exception_that_nothing_uses(self):
        self.assert_only_problem(r'nothing uses the exception eval -> vision',
                                 **{'src/floors.txt': CLEAN['src/floors.txt'] + 'eval -> vision: Reason.\n'})

    def test_a_line_that_is_none(self):
        self.assert_only_problem(r'^src/floors\.txt:\d+: neither',
                                 **{'src/floors.txt': CLEAN['src/floors.txt'] + 'eval uses vision\n'})

    def test_an_exported_library_without_headers(self):
        problems = self.problems(**{'CMakeLists.txt': 'catkin_package(LIBRARIES stereo_nav_core stereo_nav_eval)\n'})
        self.assertIn('exports stereo_nav_eval, but there are no headers in include/stereo_nav/eval', problems)

    def test_public_headers_of_a_library_that_is_not_exported(self):
        self.assert_only_problem(r'public headers in include/stereo_nav/eval, but catkin_package\(\) does not export',
                                 **{'include/stereo_nav/eval/all.h': ''})

    def test_an_exported_library_that_no_room_declares(self):
        self.assert_only_problem(r'exports stereo_nav_ghost, which no room declares',
                                 **{'CMakeLists.txt': 'catkin_package(LIBRARIES stereo_nav_core stereo_nav_ghost)\n'})

    def test_an_exported_library_that_the_external_package_does_not_use(self):
        for text in (None, '#include <stereo_nav/eval/all.h>\n'):
            self.assert_only_problem(r'^test/external_package/use_core\.cpp: missing, or it includes no header of core',
                                     **{'test/external_package/use_core.cpp': text})


if __name__ == '__main__':
    unittest.main()
