#!/usr/bin/env python3
"""Compares the version in all files of a source folder that name it with that of CMakeLists.txt, and the changelog with
both. Prints what differs and exits with 1."""

import pathlib
import re
import sys
import tomllib

from report import report

PROJECT = re.compile(r"^project\(curvefusion VERSION (\d+\.\d+\.\d+)", re.MULTILINE)
CITED = re.compile(r"^version: (.*)$", re.MULTILINE)
# What users are told to ask for: major and minor part, with which find_package is content.
WANTED = re.compile(r"find_package\(curvefusion (\d+(?:\.\d+)*)")
ASKING = ("examples/CMakeLists.txt", "docs/library.md")
RELEASE = re.compile(r"^## \[(\d+\.\d+\.\d+)\] - \d{4}-\d{2}-\d{2}$", re.MULTILINE)
UNRELEASED = "## [Unreleased]"


def problems(root):
    read = {name: (root / name).read_text(encoding="utf-8") for name in
            ("CMakeLists.txt", "CITATION.cff", "pyproject.toml", "CHANGELOG.md", *ASKING)}
    version = PROJECT.search(read["CMakeLists.txt"])[1]
    for name, found in (("CITATION.cff", CITED.search(read["CITATION.cff"])[1]),
                        ("pyproject.toml", tomllib.loads(read["pyproject.toml"])["project"]["version"])):
        if found != version:
            yield f"{name}: version {found}, of CMakeLists.txt {version}"
    for name in ASKING:
        wanted = WANTED.findall(read[name])
        if not wanted:
            yield f"{name}: asks for no version of curvefusion"
        for found in wanted:
            if found != version.rpartition(".")[0]:
                yield f"{name}: find_package asks for {found}, the version is {version}"
    releases = RELEASE.findall(read["CHANGELOG.md"])
    if UNRELEASED not in read["CHANGELOG.md"] and not releases:
        yield f"CHANGELOG.md: has neither {UNRELEASED} nor a version with its date"
    if releases and tuple(map(int, releases[0].split("."))) > tuple(map(int, version.split("."))):
        yield f"CHANGELOG.md: version {releases[0]}, of CMakeLists.txt {version}"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_versions.py SOURCE_FOLDER")
    return report(problems(pathlib.Path(sys.argv[1])), "versions")


if __name__ == "__main__":
    sys.exit(main())
