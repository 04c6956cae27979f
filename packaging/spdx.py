#!/usr/bin/env python3
"""Gives each source a line with its license, as SPDX has it, at the end of its first comment; --check says which lack it.

The license is that of the file LICENSE. As long as no source has such a line, --check asks for none.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORDS = "SPDX-License-Identifier: BSD-3-Clause"
COMMENTS = {"//": ("*.h", "*.cpp", "*.cpp.in", "*.glsl", "*.vert", "*.frag", "*.comp"),
            "#": ("*.py", "*.pyi", "*.cmake", "CMakeLists.txt")}
# Inputs and what tests compare byte for byte are no sources.
LEFT_OUT = re.compile(r"^(tests/data|tests/fuzz/(corpus|found)|docs)/")


def tagged(text, mark):
    """The text with its line: behind the first lines of comment, or before all others."""
    lines = text.split("\n")
    at = 1 if lines[0].startswith(("#!", "#version")) else 0  # of programs and shaders
    while at < len(lines) and lines[at].startswith(mark):
        at += 1
    lines.insert(at, f"{mark} {WORDS}")
    return "\n".join(lines)


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(f"spdx.py: expected --check or nothing, got {' '.join(sys.argv[1:])}")
    lacking, having = [], 0
    for mark, patterns in COMMENTS.items():
        names = subprocess.run(["git", "ls-files", "-z", *patterns], cwd=ROOT, capture_output=True, text=True, check=True)
        for name in filter(None, names.stdout.split("\0")):
            path = ROOT / name
            if LEFT_OUT.match(name) or path.is_symlink() or not path.exists():
                continue
            text = path.read_text(encoding="utf-8")
            if WORDS in text and path != Path(__file__).resolve():
                having += 1
            elif path != Path(__file__).resolve():
                lacking.append((path, mark, text))
    if check:
        if having and lacking:
            sys.exit("\n".join(f"{path.relative_to(ROOT)}: has no line {WORDS}; packaging/spdx.py writes it"
                               for path, _, _ in lacking))
        print(f"{having} sources name their license, {len(lacking)} do not")
        return
    for path, mark, text in lacking:
        path.write_text(tagged(text, mark), encoding="utf-8")
    print(f"{len(lacking)} sources name their license now, {having} did before")


main()
