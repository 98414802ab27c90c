#!/usr/bin/env python3
"""build_times.py [BUILD_DIR]: where the processor time of a build goes, by target and by header.

Compiles all that BUILD_DIR (build/ unless given) compiles once more, one file after the other and without ccache: with its own
compiler for the time of each target, then with clang++ -ftime-trace for the headers. The time of a header includes the headers
that it is the first to include. Prints two tables; needs clang++, and a machine that does nothing else.
"""
import json
import re
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LINES = 15


def processor_s():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def compile_once(entry, output, compiler=None, options=()):
    """Processor seconds; the command is the build's own but for the output, and the compiler where one is given."""
    words = [word.replace('\\"', '"') for word in entry['command'].split()]
    words = [word for word in words if 'ccache' not in word and word != '-Werror']
    words[words.index('-o') + 1] = str(output)
    before = processor_s()
    run = subprocess.run([compiler or words[0], *words[1:], *options], cwd=entry['directory'], check=False, stderr=subprocess.DEVNULL)
    if run.returncode:
        print(f'{words[-1]} is left out: {compiler or words[0]} does not compile it', file=sys.stderr)
    return processor_s() - before


def headers_of(trace):
    """(header, seconds) of one file of -ftime-trace."""
    for event in json.loads(trace.read_text())['traceEvents']:
        if event['name'] == 'Source' and not event['args']['detail'].endswith('.cpp'):
            yield re.sub(r'^.*/(include|src)/', '', event['args']['detail']), event['dur'] / 1e6


def table(title, times, counts):
    total = sum(times.values())
    print(f'| {title} | times | s |\n|---|---|---|')
    for name, seconds in times.most_common(LINES):
        print(f'| `{name}` | {counts[name]} | {seconds:.1f} |')
    return total


def main(arguments):
    build_dir = Path(arguments[0] if arguments else ROOT / 'build').resolve()
    targets, target_files, headers, header_files = Counter(), Counter(), Counter(), Counter()
    with tempfile.TemporaryDirectory() as folder:
        for entry in json.loads((build_dir / 'compile_commands.json').read_text()):
            output = Path(folder) / 'file.o'
            target = re.search(r'CMakeFiles/([^/]+)\.dir/', entry['command']).group(1)
            targets[target] += compile_once(entry, output)
            target_files[target] += 1
            trace = output.with_suffix('.json')
            trace.write_text('{"traceEvents": []}')
            compile_once(entry, output, 'clang++', ['-ftime-trace', '-w'])
            for header, seconds in headers_of(trace):
                headers[header] += seconds
                header_files[header] += 1
    total = table('target', targets, target_files)
    print(f'\nAll {len(targets)} targets: {total / 60:.1f} processor minutes.\n')
    table('header', headers, header_files)


if __name__ == '__main__':
    main(sys.argv[1:])
