#!/usr/bin/env python3
"""Every command of the documents is executed by something: doc_commands.py ROOT (for lint.sh).

A command is a line of a code block that names no language, of README.md, docs/*.md and bags/README.md. test/docs/commands.yaml
says of each how it is executed: by test/docs/run_commands.py, by a test or script (which must then hold its
program and arguments), or by hand, with the reason. What text quotes in backticks must at least exist: scripts,
programs, launch files and their arguments.
"""
import re
import sys
from collections import Counter
from pathlib import Path

import yaml

TABLE = 'test/docs/commands.yaml'


def documents(root):
    return [root / 'README.md', *sorted((root / 'docs').glob('*.md')), root / 'bags' / 'README.md']


def code_blocks(text):
    """Blocks of lines in fences without a language, or indented by four and more after an empty line."""
    fence, block, previous = None, [], ''
    for line in text.splitlines():
        opening = re.match(r'\s*```(\w*)', line)
        indented = re.match(r' {4,}\S', line) and (block or not previous.strip() or previous.startswith('#'))
        if opening and fence is None:
            fence, block = opening.group(1), []
        elif opening:
            if not fence:
                yield block
            fence, block = None, []
        elif fence is not None or indented:
            block.append(line.strip())
        elif block:
            yield block
            block = []
        previous = line
    if block and fence is None:
        yield block


def commands(text):
    """Commands of a document in their order: continued lines joined, comments taken off."""
    found = []
    for block in code_blocks(text):
        for line in '\n'.join(block).replace('\\\n', ' ').splitlines():
            command = re.sub(r'(^|\s)#.*', '', line)
            command = ' '.join(command.split())
            if command:
                found.append(command)
    return found


def table(root):
    """command -> its entry."""
    entries = yaml.safe_load((root / TABLE).read_text())
    return {entry['command']: entry for entry in entries}


def words_to_hold(command):
    """What a test that executes `command` has in its text: the program and the names of its arguments."""
    words = re.findall(r'[\w.]+\.launch|[\w/]+\.(?:sh|py)\b|\w+_test\b', command)
    run = re.search(r'rosrun \w+ (\S+)', command)
    words += [run.group(1)] if run else []
    words += re.findall(r'(?<=\s)--[a-z][a-z-]*|(?<=\s)\w+(?=:=)', command)
    # A private parameter, _NAME:=VALUE, may as well be set by a launch file.
    return [Path(word).name.lstrip('_') for word in words] or [command.split()[0]]


def entry_problems(root, command, entry):
    kinds = [kind for kind in ('run', 'until', 'by', 'by_hand') if kind in entry]
    if len(kinds) != 1:
        yield f'{TABLE}: one of run, until, by, by_hand expected for: {command}'
    if 'by' in entry:
        texts = [root / path for path in entry['by'].split()]
        missing = [str(path) for path in texts if not path.exists()]
        text = ''.join(path.read_text() for path in texts if path.exists())
        missing += [word for word in words_to_hold(command) if word not in text and word not in entry.get('but', '')]
        if missing:
            yield f'{TABLE}: {entry["by"]} does not execute "{command}": no {", ".join(missing)}'


def launch_arguments(path):
    return re.findall(r'<arg name="(\w+)"', path.read_text())


def programs(root):
    text = ''.join(path.read_text() for folder in ('src/nodes', 'src/tools') for path in (root / folder).rglob('CMakeLists.txt'))
    text += (root / 'CMakeLists.txt').read_text()
    return set(re.findall(r'(?:stereo_nav_program|add_executable)\((\w+)', text)) | set(
        Path(name).name for name in re.findall(r'scripts/\w+\.py', text))


def existence_problems(root, document, text):
    """Scripts, programs, launch files and arguments that `text` speaks of and that do not exist."""
    for script in re.findall(r'(?<![\w/.])(?:scripts|test)/[\w/]+\.(?:sh|py)\b', text):
        if not (root / script).exists():
            yield f'{document}: no such script: {script}'
    for program in re.findall(r'rosrun stereo_nav ([a-z][\w.]*\w)', text):
        if program not in programs(root):
            yield f'{document}: no such program: {program}'
    for launch, arguments in re.findall(r'(?:roslaunch stereo_nav |`)(\w+\.launch)((?:\s+(?:\\\s+)?\w+:=\S*)*)', text):
        path = root / 'launch' / launch
        if not path.exists():
            yield f'{document}: no such launch file: {launch}'
            continue
        for argument in re.findall(r'(\w+):=', arguments):
            if argument not in launch_arguments(path):
                yield f'{document}: {launch} has no argument {argument}'


def problems(root):
    entries, used = table(root), set()
    for command, count in Counter(entry['command'] for entry in yaml.safe_load((root / TABLE).read_text())).items():
        if count > 1:
            yield f'{TABLE}: {count} entries for: {command}'
    for document in documents(root):
        text = document.read_text()
        for command in commands(text):
            used.add(command)
            if command not in entries:
                yield f'{document.relative_to(root)}: nothing executes: {command} (see {TABLE})'
        yield from existence_problems(root, document.relative_to(root), text)
    for command, entry in entries.items():
        if command not in used:
            yield f'{TABLE}: no document has: {command}'
        yield from entry_problems(root, command, entry)


def main(root):
    found = list(problems(root))
    for problem in found:
        print(problem)
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main(Path(sys.argv[1])))
