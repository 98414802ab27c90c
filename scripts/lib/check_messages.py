#!/usr/bin/env python3
"""check_messages.py GUIDE.md SOURCE...: what the guide quotes as our messages is what the sources print.

A quoted message is the text in backticks that begins a table row; `...` in it stands for what the program fills in. A row
whose message is followed by (ROS) quotes a program of ROS. Sources are C++, with string literals that may be split over
lines and joined with + or <<.
"""
import re
import sys
from pathlib import Path


def printed_text(source):
    """All string literals of a C++ file, those split over lines or operators joined; a gap marks what is filled in."""
    without_comments = re.sub(r'^\s*//.*$', '', source, flags=re.MULTILINE)
    literals = re.findall(r'"((?:[^"\\\n]|\\.)*)"(\s*)(?=(.))?', without_comments, flags=re.DOTALL)
    text = ''
    for literal, _, following in literals:
        text += literal
        if following != '"':
            text += '\0'
    return text.replace('\\"', '"').replace('%%', '%')


def fragments(message):
    return [part.strip() for part in message.split('...') if part.strip()]


def main(guide, *sources):
    texts = [re.sub(r' +', ' ', printed_text(Path(source).read_text())) for source in sources]
    quoted = re.findall(r'^\| `([^`]+)`(?! \(ROS\))', Path(guide).read_text(), flags=re.MULTILINE)
    if not quoted:
        sys.exit(f'{guide} quotes no message')
    missing = [message for message in quoted
               if not all(any(fragment in text for text in texts) for fragment in fragments(message))]
    for message in missing:
        print(f'{guide}: no source prints: {message}')
    return 1 if missing else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
