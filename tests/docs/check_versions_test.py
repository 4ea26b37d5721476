#!/usr/bin/env python3
"""The check of versions finds every file that names another one."""

import pathlib
import tempfile
import unittest

import check_versions

FILES = {
    "CMakeLists.txt": "project(curvefusion VERSION 1.2.3 LANGUAGES CXX)\n",
    "CITATION.cff": "cff-version: 1.2.0\nversion: 1.2.3\n",
    "pyproject.toml": '[project]\nversion = "1.2.3"\n',
    "CHANGELOG.md": "## [Unreleased]\n\n## [1.2.3] - 2026-01-31\n",
    "examples/CMakeLists.txt": "find_package(curvefusion 1.2 REQUIRED)\n",
    "docs/library.md": "`find_package(curvefusion 1.2 REQUIRED)`\n",
}


class CheckVersions(unittest.TestCase):
    def expect(self, changes, *beginnings):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**FILES, **changes}.items():
                (root / name).parent.mkdir(exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            found = list(check_versions.problems(root))
        self.assertEqual(len(found), len(beginnings), found)
        for problem, beginning in zip(found, beginnings):
            self.assertTrue(problem.startswith(beginning), problem)

    def test_the_same_everywhere(self):
        self.expect({})

    def test_no_release_yet(self):
        self.expect({"CHANGELOG.md": "## [Unreleased]\n"})

    def test_citation(self):
        self.expect({"CITATION.cff": "cff-version: 1.2.0\nversion: 1.2.2\n"}, "CITATION.cff: version 1.2.2")

    def test_python_package(self):
        self.expect({"pyproject.toml": '[project]\nversion = "1.3.0"\n'}, "pyproject.toml: version 1.3.0")

    def test_what_users_ask_for(self):
        self.expect({"docs/library.md": "find_package(curvefusion 1.1)\n"}, "docs/library.md: find_package asks for 1.1")
        self.expect({"docs/library.md": "\n"}, "docs/library.md: asks for no version")

    def test_changelog_ahead(self):
        self.expect({"CHANGELOG.md": "## [1.10.0] - 2026-02-01\n"}, "CHANGELOG.md: version 1.10.0")

    def test_changelog_without_versions(self):
        self.expect({"CHANGELOG.md": "# Changelog\n"}, "CHANGELOG.md: has neither")


if __name__ == "__main__":
    unittest.main()
