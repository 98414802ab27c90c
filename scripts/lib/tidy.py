#!/usr/bin/env python3
"""tidy.py [BUILD_DIR [FILE...]]: clang-tidy over the sources of src/ (or those that are compiled together with these) as
BUILD_DIR (build/ unless given) compiles them: in batches, since most of the time goes into the headers.

Runs one process a core. Prints what clang-tidy finds, each finding once, and exits with status 1 where there is one, with
77 where clang-tidy 14 is not installed.
"""
import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def units(build_dir):
    """What the build compiles of src/: (file that the compiler is given, sources in it), those that take longest first."""
    database = build_dir / 'compile_commands.json'
    if not database.exists():
        sys.exit(f'{database} is missing: build first (scripts/build.sh {build_dir})')
    found = []
    for entry in json.loads(database.read_text()):
        path = Path(entry['file']).resolve()
        # A batch of sources is a generated file that includes them.
        batch = re.findall(r'^#include "(.*)"$', path.read_text(), re.MULTILINE) if 'Unity' in path.parts else [path]
        sources = [source for source in map(Path, batch) if ROOT / 'src' in source.parents]
        if sources:
            found.append((path, sources))
    return sorted(found, key=lambda unit: ('<ros/' not in ''.join(map(Path.read_text, unit[1])), -len(unit[1])))


def findings(tool, build_dir, path):
    """(text of a finding with its notes) of one file; an empty list where it is clean."""
    run = subprocess.run([tool, '--quiet', '--extra-arg=-Wno-everything', '-p', str(build_dir), str(path)], stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, universal_newlines=True, check=False)
    blocks = re.split(r'^(?=\S[^\n]*: (?:warning|error): )', run.stdout, flags=re.MULTILINE)
    found = [block.strip().replace(f'{ROOT}/', '') for block in blocks if re.match(r'\S[^\n]*: (?:warning|error): ', block)]
    if run.returncode and not found:
        found = [f'{path.relative_to(ROOT)}: clang-tidy failed: {run.stderr.strip()}']
    return found


def main(arguments):
    build_dir = Path(arguments[0] if arguments else ROOT / 'build').resolve()
    tool = shutil.which('clang-tidy-14')
    if not tool:
        print('clang-tidy-14 is not installed')
        return 77
    wanted = {Path(argument).resolve() for argument in arguments[1:]}
    paths = [path for path, sources in units(build_dir) if not wanted or wanted.intersection(sources)]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(lambda path: findings(tool, build_dir, path), paths)
        found = sorted({finding for result in results for finding in result})
    print('\n'.join(found))
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
