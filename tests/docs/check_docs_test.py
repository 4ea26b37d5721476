#!/usr/bin/env python3
"""The check of the documents finds every kind of defect, and nothing in documents without one."""

import pathlib
import tempfile
import unittest

import check_docs

INDEX = "# Documents\n\n[a page](page.md), [notebook](lab_notebook.md)\n\n![picture](images/picture.png)\n"


class CheckDocs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "docs" / "images").mkdir(parents=True)
        for page in check_docs.OTHER_PAGES:
            self.write(page, "# Title\n")
        self.write("docs/README.md", INDEX)
        self.write("docs/page.md", "# A page\n\n## Its `part`, one of two\n")
        self.write("docs/lab_notebook.md", "# Lab notebook\n\nAt `1a2b3c4`.\n" + "line\n" * 300)
        self.write("docs/images/picture.png", "")

    def write(self, name, text):
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).write_text(text, encoding="utf-8")

    def append(self, name, text):
        path = self.root / name
        self.write(name, path.read_text(encoding="utf-8") + text)

    def expect(self, *endings):
        found = list(check_docs.problems(self.root))
        self.assertEqual(len(found), len(endings), found)
        for problem, ending in zip(found, endings):
            self.assertIn(ending, problem)

    def test_sound_documents(self):
        self.expect()

    def test_links_that_resolve(self):
        self.append("README.md", "[a](docs/page.md#its-part-one-of-two) [b](https://example.org/x) [c](#title)\n")
        self.append("README.md", "```\n[in code](nowhere.md)\n```\n`[too](nowhere.md)`\n")
        self.expect()

    def test_missing_file(self):
        self.append("docs/page.md", "[gone](gone.md)\n")
        self.expect("docs/page.md: link to gone.md: there is no such file")

    def test_missing_heading(self):
        self.append("docs/page.md", "[gone](lab_notebook.md#gone)\n")
        self.expect("there is no such heading")

    def test_heading_inside_code_is_none(self):
        self.append("docs/page.md", "```\n# gone\n```\n[gone](#gone)\n")
        self.expect("there is no such heading")

    def test_missing_image(self):
        self.append("docs/page.md", "![gone](images/gone.png)\n")
        self.expect("there is no such file")

    def test_unlisted_page(self):
        self.write("docs/other.md", "# Another page\n")
        self.expect("docs/other.md: is not listed in docs/README.md")

    def test_long_page(self):
        self.append("docs/page.md", "line\n" * check_docs.MAX_LINES)
        self.expect("the limit is 250")

    def test_revision(self):
        self.append("docs/page.md", "At revision `1a2b3c4`, of `1000` bytes.\n")
        self.expect("revision `1a2b3c4` belongs to docs/lab_notebook.md")

    def test_unused_image(self):
        self.write("docs/images/other.png", "")
        self.expect("docs/images/other.png: no page shows it")

    def test_unused_picture_in_a_folder(self):
        self.write("docs/images/folder/other.png", "")
        self.expect("docs/images/folder/other.png: no page shows it")


if __name__ == "__main__":
    unittest.main()
