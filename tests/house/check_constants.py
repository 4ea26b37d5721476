#!/usr/bin/env python3
"""Checks that every constant of the algorithms tells where it comes from: in the comment behind it, or in that above the
constants it stands among, a word that says so (chosen, derived, measured, fitted) or a source (a year, CurveFusion). What
is computed from other constants tells it by itself. Prints those that do not and exits with 1."""

import pathlib
import re
import sys

FOLDERS = ("fusion", "graph")
DECLARATION = re.compile(r"\s*(?:static |inline )*constexpr [\w:<>, ]+ k[A-Z]\w*\s*(?:=|\[|\{)")
ORIGIN = re.compile(r"\b(chosen|derived|measured|fitted|curvefusion|(?:19|20)\d\d)\b", re.IGNORECASE)
COMPUTED = re.compile(r"=.*(\bk(?!Millimetre\b)[A-Z]\w*|sizeof|numeric_limits|numbers::)")


def constants_without_origin(text):
    """Line number and line of each."""
    found = []
    comment = ""  # the last one that had lines of its own
    is_told = False  # by the comment above the constants that follow one another
    in_comment = in_group = in_declaration = False
    for number, line in enumerate(text.split("\n"), 1):
        code, _, behind = line.partition("//")
        if in_declaration:  # its further lines
            in_declaration = ";" not in code
            continue
        if not code.strip():
            comment = comment + behind if in_comment and behind else behind
            in_comment = bool(behind)
            in_group = in_group and in_comment
            continue
        if not DECLARATION.match(line):
            in_comment = in_group = False
            continue
        in_declaration = ";" not in code
        if in_comment or not in_group:
            is_told = in_comment and bool(ORIGIN.search(comment))
        in_group, in_comment = True, False
        if not (is_told or ORIGIN.search(behind) or COMPUTED.search(code)):
            found.append((number, line.strip()))
    return found


def main(root):
    missing = 0
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            for number, line in constants_without_origin(path.read_text(encoding="utf-8")):
                print(f"{path.relative_to(root)}:{number}: where does this come from? {line}")
                missing += 1
    if missing:
        print(f"{missing} constants without origin: say in their comment whether they are chosen, derived, measured or "
              "fitted, and on what, or name the source")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
