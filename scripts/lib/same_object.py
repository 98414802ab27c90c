#!/usr/bin/env python3
"""A compiler launcher that takes what another build has compiled by the same command.

usage: same_object.py BUILD_DIR WORKSPACE [LAUNCHER] COMPILER ARGUMENT...

WORKSPACE is a catkin workspace in which src/stereo_nav is a link to the sources of BUILD_DIR. Where BUILD_DIR holds an object
whose command is the same but for these places, the object is copied; any other command is run. Says which in
WORKSPACE/same_object.log.
"""
import json
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path


def without_dependencies(command):
    """(command without what asks for a list of the headers, {'-MT': TARGET, '-MF': FILE})."""
    rest, options, words = [], {}, iter(command)
    for word in words:
        if word in ('-MT', '-MF'):
            options[word] = next(words)
        elif word != '-MD':
            rest.append(word)
    return rest, options


def moved(text, build, workspace):
    """A folder or argument of the workspace as BUILD_DIR has it."""
    for there, here in ((workspace / 'build' / 'stereo_nav', build), (workspace / 'devel', build / 'devel'),
                        (workspace / 'src' / 'stereo_nav', (workspace / 'src' / 'stereo_nav').resolve())):
        text = text.replace(str(there), str(here))
    return text


def same_object(command, folder, build, workspace):
    """The object of BUILD_DIR that was made by the same command in the same folder; nothing where there is none."""
    database = build / 'compile_commands.json'
    wanted = [moved(word, build, workspace) for word in command]
    for entry in json.loads(database.read_text()) if database.exists() else []:
        if entry['directory'] == moved(folder, build, workspace) and shlex.split(entry['command']) == wanted:
            made = Path(entry['directory']) / wanted[wanted.index('-o') + 1]
            return made if made.exists() else None
    return None


def copy(made, output, dependencies):
    """The object, and the list of its headers, by which make knows when it is out of date."""
    shutil.copy(made, output)
    headers = made.with_name(made.name + '.d')
    if '-MF' in dependencies and headers.exists():
        names = headers.read_text().split(':', 1)[1]
        Path(dependencies['-MF']).write_text(f"{dependencies.get('-MT', output)}:{names}")


def main(build, workspace, *command):
    build, workspace = Path(build), Path(workspace)
    compilation, dependencies = without_dependencies(command)
    launcher = os.path.basename(compilation[0]) == 'ccache'
    made = None
    if '-c' in compilation and '-o' in compilation:
        made = same_object(compilation[launcher:], os.getcwd(), build, workspace)
    with open(workspace / 'same_object.log', 'a') as log:
        log.write(f"{'taken' if made else 'compiled'} {compilation[-1]}\n")
    if not made:
        return subprocess.run(command, check=False).returncode
    copy(made, compilation[compilation.index('-o') + 1], dependencies)
    return 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
