#!/usr/bin/env python3
"""Checks the documents of a source folder: links and images resolve, pages are short, each is listed in the index,
and revisions stand in the lab notebook alone. Prints what is wrong and exits with 1."""

import pathlib
import re
import sys

from report import report

INDEX = "docs/README.md"
NOTEBOOK = "docs/lab_notebook.md"  # history: as long as it gets, with revisions
MAX_LINES = 250  # what is read in one sitting
OTHER_PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")

LINK = re.compile(r"\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]*`")
HEADING = re.compile(r"^#{1,6} +(.+?)\s*$", re.MULTILINE)
# As git abbreviates revisions, in code type.
REVISION = re.compile(r"`(?=[a-f]*[0-9])[0-9a-f]{7,40}`")


def anchors(text):
    """The anchors of all headings, as GitHub and GitLab make them."""
    found = {}
    for heading in HEADING.findall(FENCE.sub("", text)):
        slug = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower().replace("`", "")
        slug = re.sub(r"[^\w\- ]", "", slug).replace(" ", "-")
        count = found.get(slug, 0)
        found[slug] = count + 1
        if count:
            found[f"{slug}-{count}"] = 1
    return set(found)


def links(text):
    return LINK.findall(CODE.sub("", FENCE.sub("", text)))


def broken_link(root, page, link):
    """Why a link does not resolve; None where it does or leads out of the project."""
    if re.match(r"[a-z]+:", link):
        return None
    path, _, anchor = link.partition("#")
    target = (root / page).parent / path if path else root / page
    if not target.exists():
        return "there is no such file"
    if anchor and target.suffix == ".md" and anchor not in anchors(target.read_text(encoding="utf-8")):
        return "there is no such heading"
    return None


def problems(root):
    docs = sorted(p.relative_to(root).as_posix() for p in (root / "docs").rglob("*.md"))
    texts = {page: (root / page).read_text(encoding="utf-8") for page in docs + list(OTHER_PAGES)}
    for page, text in texts.items():
        for link in links(text):
            reason = broken_link(root, page, link)
            if reason:
                yield f"{page}: link to {link}: {reason}"
    listed = {(root / INDEX).parent / link.partition("#")[0] for link in links(texts[INDEX])}
    listed = {path.resolve() for path in listed}
    for page in docs:
        if page != INDEX and (root / page).resolve() not in listed:
            yield f"{page}: is not listed in {INDEX}"
        if page == NOTEBOOK:
            continue
        lines = texts[page].count("\n")
        if lines > MAX_LINES:
            yield f"{page}: {lines} lines, the limit is {MAX_LINES}; split it, or move history to {NOTEBOOK}"
        for revision in REVISION.findall(texts[page]):
            yield f"{page}: revision {revision} belongs to {NOTEBOOK}"
    images = [path for path in (root / "docs" / "images").rglob("*") if path.is_file()]
    used = {((root / page).parent / link).resolve() for page, text in texts.items() for link in links(text)}
    for image in sorted(images):
        if image.resolve() not in used:
            yield f"{image.relative_to(root).as_posix()}: no page shows it"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_docs.py SOURCE_FOLDER")
    return report(problems(pathlib.Path(sys.argv[1])), "documents")


if __name__ == "__main__":
    sys.exit(main())
