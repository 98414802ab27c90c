#!/usr/bin/env python3
"""check_links.py FILE.md...: every relative link leads to a tracked place, every #anchor to a heading."""
import re
import sys
from pathlib import Path
from urllib.parse import unquote


def without_code(text):
    text = re.sub(r'^(```|~~~).*?^\1', '', text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r'`[^`\n]*`', lambda match: match.group(0) if '](' in match.group(0) else '', text)


def anchors(path):
    """The anchors that a hosting site makes of the headings: lower case, words joined by hyphens."""
    text = re.sub(r'^(```|~~~).*?^\1', '', path.read_text(), flags=re.MULTILINE | re.DOTALL)
    found, seen = set(), {}
    for heading in re.findall(r'^#+ +(.+?) *#*$', text, flags=re.MULTILINE):
        slug = re.sub(r'[^\w\- ]', '', re.sub(r'[`*]', '', heading).lower()).replace(' ', '-')
        repeated = seen.get(slug, 0)
        seen[slug] = repeated + 1
        found.add(f'{slug}-{repeated}' if repeated else slug)
    return found


def broken_links(path):
    for target in re.findall(r'\]\(<?([^)>\s]+)>?(?:\s+"[^"]*")?\)', without_code(path.read_text())):
        if re.match(r'[a-z][a-z0-9+.-]*:', target):
            continue
        file_part, _, anchor = unquote(target).partition('#')
        place = (path.parent / file_part) if file_part else path
        if not place.exists():
            yield f'{path}: no such file: {target}'
        elif anchor and place.suffix == '.md' and anchor not in anchors(place):
            yield f'{path}: no such heading: {target}'


def main(paths):
    broken = [problem for path in paths for problem in broken_links(Path(path))]
    print('\n'.join(broken))
    return 1 if broken else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
