#!/usr/bin/env python3
"""check_sizes.py FILE...: files, functions and classes of C++ that are too large to be read at once.

Prints one line for each violation and exits with status 1 where there is one: a file of more than 350 lines, a function
of more than 60 lines (from its name to its closing brace), a class whose member functions are defined in more than one
.cpp file. Reads text that clang-format has laid out: braces are counted, nothing is compiled.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

MAX_FILE_LINES = 350
MAX_FUNCTION_LINES = 60

# What can stand before a brace that opens no function.
NO_FUNCTION = re.compile(r'\b(namespace|class|struct|enum|union|if|for|while|switch|do|else|try|catch)\b(?!.*\boperator\b)')

# White space and access specifiers before a declaration.
BEFORE_HEAD = re.compile(r'(?:\s|\b(?:public|private|protected):)*')


def without_text(code):
    """The code with comments, literals and preprocessor lines blanked; every character keeps its line."""
    def blank(match):
        return re.sub(r'[^\n]', ' ', match.group(0))
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|'
                         r'^[ \t]*#(?:[^\n]*\\\n)*[^\n]*', re.DOTALL | re.MULTILINE)
    return pattern.sub(blank, code)


def functions(code):
    """The functions of a file: (qualified name as it is written, first line, last line)."""
    code = without_text(code)
    scopes = []  # one entry for each open brace: (kind, name, first line)
    start = 0    # where the text since the last ; { or } begins
    line = 1
    line_of_start = 1
    depth = 0    # of parentheses: an initialiser list or a lambda as an argument opens no scope of its own
    for position, character in enumerate(code):
        if character == '\n':
            line += 1
        elif character in '([':
            depth += 1
        elif character in ')]':
            depth -= 1
        elif character == '{' and depth == 0:
            head = code[start:position]
            first = line_of_start + BEFORE_HEAD.match(head).group(0).count('\n')
            scopes.append((*scope_of(head.rstrip(), scopes), first))
            if scopes[-1][0] != 'initialiser':
                start, line_of_start = position + 1, line
        elif character == '}' and depth == 0 and scopes:
            kind, name, first = scopes.pop()
            if kind == 'function':
                yield name, first, line
            if kind != 'initialiser':
                start, line_of_start = position + 1, line
        elif character == ';' and depth == 0:
            start, line_of_start = position + 1, line


def scope_of(head, scopes):
    """What a brace behind this text opens: (kind, name)."""
    if any(kind in ('function', 'inside') for kind, _, _ in scopes):
        return 'inside', ''
    if scopes and scopes[-1][0] == 'initialiser':
        return 'initialiser', ''
    head = head[BEFORE_HEAD.match(head).end():]
    head = re.sub(r'^template\s*<.*?>\s*(?=\w)', '', head, flags=re.DOTALL)
    if '(' in head and not NO_FUNCTION.match(head):
        signature = head.split('(', 1)[0]
        if '=' in signature and 'operator' not in signature:
            lambda_name = re.search(r'(\w+)\s*=\s*\[[^\]]*\]\s*$', signature)
            return ('function', lambda_name.group(1)) if lambda_name else ('initialiser', '')
        # A constructor's list: a member with braces follows a comma or the colon, the body follows a value.
        if re.search(r'\)\s*(?:noexcept\s*)?:(?!:).*[\s,][\w<>:]+$', head, re.DOTALL):
            return 'initialiser', ''
        name = re.search(r'(?:\w+(?:<[^<>]*>)?::)*(?:operator\s*\S+|~?\w+)\s*$', signature)
        return 'function', name.group(0).strip() if name else signature
    if NO_FUNCTION.match(head) or head.startswith(('extern', 'inline namespace')) or not head:
        return 'scope', ''
    return 'initialiser', ''


def check(paths):
    files_of_class = defaultdict(set)
    for path in paths:
        text = path.read_text()
        lines = text.count('\n')
        if lines > MAX_FILE_LINES:
            yield f'{path}: {lines} lines, at most {MAX_FILE_LINES}: split it by what its parts do'
        for name, first, last in functions(text):
            if last - first + 1 > MAX_FUNCTION_LINES:
                yield (f'{path}:{first}: {name}() has {last - first + 1} lines, at most {MAX_FUNCTION_LINES}: give its '
                       'steps names of their own')
            if path.suffix == '.cpp' and '::' in name:
                files_of_class[name.rsplit('::', 1)[0]].add(str(path))
    for name, files in sorted(files_of_class.items()):
        if len(files) > 1:
            yield (f'the member functions of {name} are in {", ".join(sorted(files))}: a class that needs several files has '
                   'several jobs; two classes need two names')


def main(arguments):
    problems = list(check([Path(argument) for argument in arguments]))
    print('\n'.join(problems))
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
