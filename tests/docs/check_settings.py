#!/usr/bin/env python3
"""Compares the settings that the documents list with those of the program: names and defaults in the tables of every page.

A row of a table begins with one or more settings in code type, `section.name` or, below a line that begins with "Section
`section`", `name` alone; a name after the first may leave its section out. The third column holds their defaults."""

import pathlib
import re
import subprocess
import sys
import tomllib

from report import report

SECTION = re.compile(r"^Section `(\w+)`")
NAME = re.compile(r"`((?:\w+\.)?\w+)`")


def settings(program):
    """section -> name -> default; where both profiles have a section, that of the best one."""
    found = {}
    for profile in ("paper", "best"):
        text = subprocess.run([program, "config", "--profile", profile], check=True, capture_output=True, text=True).stdout
        for section, values in tomllib.loads(text).items():
            if isinstance(values, dict):
                found[section] = values
    return found


def is_default(text, value):
    if isinstance(value, bool):
        return text == str(value).lower()
    if isinstance(value, str):
        return text == value
    try:
        return abs(float(text) - float(value)) < 1e-12
    except ValueError:
        return False


def listed(text):
    """(section, name, default) of all rows of a page that list settings."""
    section_of_page = None
    for line in text.splitlines():
        if line.startswith("## "):
            section_of_page = None
        section_of_page = match.group(1) if (match := SECTION.match(line)) else section_of_page
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("| `") or len(cells) < 3:
            continue
        names = NAME.findall(cells[0])
        if not names or ("." not in names[0] and section_of_page is None):
            continue
        section = section_of_page
        defaults = [default.strip() for default in cells[2].split(",")]
        for i, name in enumerate(names):
            if "." in name:
                section, name = name.split(".")
            yield section, name, defaults[i] if i < len(defaults) else "nothing"


def problems(root, known):
    rows = 0
    for page in sorted((root / "docs").glob("*.md")):
        for section, name, default in listed(page.read_text(encoding="utf-8")):
            # Tables of files' fields look alike; a section of the program's makes it a setting.
            if section not in known:
                continue
            rows += 1
            if name not in known[section]:
                yield f"{page.name}: there is no setting {section}.{name}"
            elif not is_default(default, known[section][name]):
                yield f"{page.name}: the default of {section}.{name} is {known[section][name]}, not {default}"
    if rows < 50:  # chosen: far fewer than there are, so that a change of the tables' form is noticed
        yield f"only {rows} settings were found in the documents"


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: check_settings.py PROGRAM SOURCE_FOLDER")
    return report(problems(pathlib.Path(sys.argv[2]), settings(sys.argv[1])), "settings in the documents")


if __name__ == "__main__":
    sys.exit(main())
