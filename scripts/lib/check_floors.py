#!/usr/bin/env python3
"""check_floors.py [PACKAGE_FOLDER]: holds the includes and the links of the rooms against src/floors.txt.

Prints one line for each violation and exits with status 1 where there is one. What is checked:

* Includes: a room includes rooms of lower floors only, except where the table says so, and in quotes. Below floor 5
  nothing of ROS: of other libraries only those that are named here.
* Public headers (include/stereo_nav) include only public headers. Every included file exists.
* Links: a room links a library of each room that it includes, by its own declaration, and no library of a room that it
  does not include or may not use.
* Exports: catkin_package() exports the libraries of exactly those rooms that have public headers, and each is used by
  test/external_package/use_ROOM.cpp.
"""
import re
import sys
from collections import defaultdict, namedtuple
from pathlib import Path

FIRST_FLOOR_WITH_ROS = 5
PACKAGE = 'stereo_nav'
# Folders of headers that any floor may include; those of the standard library and of the system have no folder.
LIBRARIES = {'Eigen', 'arpa', 'asm', 'boost', 'ceres', 'fmt', 'linux', 'netinet', 'nlohmann', 'opencv2', 'sys', 'yaml-cpp'}
# Headers that a microcontroller's tools compile, too, which know no rooms: they include those beside them by their bare names.
ON_A_CONTROLLER = 'src/sensors/base/controller'

Room = namedtuple('Room', 'name floor')
Target = namedtuple('Target', 'name room is_library links')


class Table:
    """src/floors.txt, its patterns expanded to the folders that exist."""

    def __init__(self, root):
        self.path = root / 'src' / 'floors.txt'
        self.problems = []
        self.rooms = {}
        self.exceptions = set()  # (pattern, pattern)
        self.unused_exceptions = set()
        for number, line in enumerate(self.path.read_text().splitlines(), 1):
            line = line.split('#')[0].strip()
            if line:
                self._read(root, number, line)
        self.unused_exceptions = set(self.exceptions)

    def _read(self, root, number, line):
        room = re.fullmatch(r'(\S+) +(\d+)', line)
        exception = re.fullmatch(r'(\S+) -> (\S+): *(.*)', line)
        if room:
            self._add_room(root, number, room.group(1), int(room.group(2)))
        elif exception and exception.group(3):
            self.exceptions.add((exception.group(1), exception.group(2)))
        elif exception:
            self._say(number, f'the exception {exception.group(1)} -> {exception.group(2)} has no reason')
        else:
            self._say(number, f'neither "ROOM FLOOR" nor "ROOM -> ROOM: REASON": {line}')

    def _add_room(self, root, number, pattern, floor):
        if pattern.endswith('/*'):
            parent = root / 'src' / pattern[:-2]
            names = [f'{pattern[:-2]}/{folder.name}' for folder in sorted(parent.glob('*')) if folder.is_dir()]
        else:
            names = [pattern] if (root / 'src' / pattern).is_dir() else []
        if not names:
            self._say(number, f'there is no folder src/{pattern}')
        for name in names:
            self.rooms[name] = Room(name, floor)

    def _say(self, number, text):
        self.problems.append(f'src/floors.txt:{number}: {text}')

    def room_of(self, path):
        """The room of a path below src/ or include/stereo_nav/: its longest prefix in the table, or None."""
        folder = path.parent
        while folder != folder.parent:
            if folder.as_posix() in self.rooms:
                return self.rooms[folder.as_posix()]
            folder = folder.parent
        return None

    def may_use(self, user, used):
        if user == used or used.floor < user.floor:
            return True
        for exception in self.exceptions:
            if all(self._matches(pattern, room) for pattern, room in zip(exception, (user, used))):
                self.unused_exceptions.discard(exception)
                return True
        return False

    @staticmethod
    def _matches(pattern, room):
        return room.name == pattern or (pattern.endswith('/*') and room.name.rpartition('/')[0] == pattern[:-2])


def calls(text, names):
    """The calls of CMake functions of these names: (name, list of arguments)."""
    text = re.sub(r'#.*', '', text)
    for name, arguments in re.findall(r'\b(%s)\s*\(([^()]*)\)' % '|'.join(names), text):
        yield name, arguments.split()


def section(arguments, keyword):
    """The arguments behind a keyword up to the next one."""
    if keyword not in arguments:
        return []
    rest = arguments[arguments.index(keyword) + 1:]
    end = next((i for i, word in enumerate(rest) if re.fullmatch('[A-Z_]+', word)), len(rest))
    return rest[:end]


def read_targets(root, table):
    """What the CMakeLists.txt of the rooms declare."""
    targets = {}
    for room in table.rooms.values():
        path = root / 'src' / room.name / 'CMakeLists.txt'
        if not path.exists():
            continue
        text = path.read_text()
        for name, arguments in calls(text, ['stereo_nav_library', 'stereo_nav_program']):
            targets[arguments[0]] = Target(arguments[0], room, name == 'stereo_nav_library',
                                           set(section(arguments, 'LINK')))
        for _, arguments in calls(text, ['target_link_libraries']):
            if arguments[0] in targets:
                targets[arguments[0]].links.update(arguments[1:])
    return targets


class Checker:
    def __init__(self, root):
        self.root = root
        self.table = Table(root)
        self.problems = list(self.table.problems)
        self.targets = read_targets(root, self.table)
        self.libraries_of = defaultdict(set)
        for target in self.targets.values():
            if target.is_library:
                self.libraries_of[target.room].add(target.name)
        self.included = defaultdict(dict)  # room -> room that it includes -> place of the first include

    def run(self):
        for top, public in (('src', False), (f'include/{PACKAGE}', True)):
            for path in sorted((self.root / top).rglob('*')):
                if path.suffix in ('.h', '.cpp'):
                    self.check_file(path, path.relative_to(self.root / top), public)
        self.check_links()
        self.check_exports()
        for user, used in sorted(self.table.unused_exceptions):
            self.problems.append(f'src/floors.txt: nothing uses the exception {user} -> {used}: remove it')
        return self.problems

    def check_file(self, path, path_in_top, public):
        room = self.table.room_of(path_in_top)
        place = path.relative_to(self.root).as_posix()
        if room is None:
            self.problems.append(f'{place}: its folder is no room of src/floors.txt: move the file or add the room')
            return
        for number, line in enumerate(path.read_text().splitlines(), 1):
            include = re.match(r'\s*#\s*include\s*(["<])([^">]+)[">]', line)
            if include:
                self.check_include(room, f'{place}:{number}', include.group(1) == '"', include.group(2), public)

    def check_include(self, room, place, quoted, header, public):
        generated = re.match(rf'{PACKAGE}/[A-Z]\w*\.h$', header)
        if not quoted and not generated and header.startswith(f'{PACKAGE}/'):
            self.problems.append(f'{place}: <{header}> is a header of the package: include it in quotes')
            return
        foreign = not quoted and '/' in header and header.split('/')[0] not in LIBRARIES
        if generated or foreign:
            if room.floor < FIRST_FLOOR_WITH_ROS:
                self.problems.append(f'{place}: {room.name} (floor {room.floor}) includes {header}, which is of ROS (or of '
                                     f'a library that check_floors.py does not know): that is allowed from floor '
                                     f'{FIRST_FLOOR_WITH_ROS} on')
            return
        if not quoted:
            return
        folder = str(Path(place).parent)
        if folder == ON_A_CONTROLLER and (self.root / folder / header).exists():
            return
        is_public = header.startswith(f'{PACKAGE}/')
        if public and not is_public:
            self.problems.append(f'{place}: a public header includes the private header {header}: make that one public, '
                                 'too, or include it in the source file')
        if not (self.root / ('include' if is_public else 'src') / header).exists():
            self.problems.append(f'{place}: there is no {header}: headers are included as "{PACKAGE}/ROOM/header.h" '
                                 'where they are public, else as "ROOM/header.h"')
            return
        used = self.table.room_of(Path(header[len(PACKAGE) + 1:] if is_public else header))
        if used is None or used == room:
            return
        self.included[room].setdefault(used, place)
        if not self.table.may_use(room, used):
            self.problems.append(f'{place}: {room.name} (floor {room.floor}) may not use {used.name} (floor '
                                 f'{used.floor}): move what is used to a lower floor, or the user to a higher one')

    def check_links(self):
        for room in self.table.rooms.values():
            targets = [target for target in self.targets.values() if target.room == room]
            linked = set().union(*(target.links for target in targets))
            place = f'src/{room.name}/CMakeLists.txt'
            for used, include in sorted(self.included[room].items()):
                if targets and self.libraries_of[used] and not linked & self.libraries_of[used]:
                    self.problems.append(f'{place}: {room.name} includes {used.name} ({include}) but does not link '
                                         f'{" or ".join(sorted(self.libraries_of[used]))}')
            for name in sorted(linked & set(self.targets)):
                used = self.targets[name].room
                if not self.table.may_use(room, used):
                    self.problems.append(f'{place}: {room.name} (floor {room.floor}) may not link {name} of '
                                         f'{used.name} (floor {used.floor})')
                elif used != room and used not in self.included[room]:
                    self.problems.append(f'{place}: {room.name} links {name} but includes nothing of {used.name}')
            if room.floor < FIRST_FLOOR_WITH_ROS and '${catkin_LIBRARIES}' in linked:
                self.problems.append(f'{place}: {room.name} (floor {room.floor}) links catkin_LIBRARIES, which are of '
                                     f'ROS: that is allowed from floor {FIRST_FLOOR_WITH_ROS} on')

    def check_exports(self):
        exported = set()
        for _, arguments in calls((self.root / 'CMakeLists.txt').read_text(), ['catkin_package']):
            exported.update(section(arguments, 'LIBRARIES'))
        for name in sorted(exported - set(self.targets)):
            self.problems.append(f'CMakeLists.txt: catkin_package() exports {name}, which no room declares')
        for room in sorted(self.libraries_of):
            has_headers = any((self.root / 'include' / PACKAGE / room.name).glob('*.h'))
            for name in sorted(self.libraries_of[room]):
                self.check_export(room, name, name in exported, has_headers)

    def check_export(self, room, name, exported, has_headers):
        if exported and not has_headers:
            self.problems.append(f'CMakeLists.txt: catkin_package() exports {name}, but there are no headers in '
                                 f'include/{PACKAGE}/{room.name}')
        if has_headers and not exported:
            self.problems.append(f'CMakeLists.txt: there are public headers in include/{PACKAGE}/{room.name}, but '
                                 f'catkin_package() does not export {name}')
        user = self.root / 'test' / 'external_package' / f'use_{name[len(PACKAGE) + 1:]}.cpp'
        if exported and (not user.exists() or f'<{PACKAGE}/{room.name}/' not in user.read_text()):
            self.problems.append(f'{user.relative_to(self.root)}: missing, or it includes no header of {room.name}: each '
                                 'exported library is used there by a small program of its own')


def main(arguments):
    problems = Checker(Path(arguments[0] if arguments else '.').resolve()).run()
    print('\n'.join(problems))
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
