#!/usr/bin/python3
"""Prints a page as Doxygen 1.9 understands it. GitHub makes anchors of headings by itself; Doxygen needs them written
down, unique over all pages: `page-heading`."""

import pathlib
import re
import sys

FENCE = re.compile(r"(^```.*?^```)", re.MULTILINE | re.DOTALL)
TITLE = re.compile(r"^# .*", re.MULTILINE)
HEADING = re.compile(r"^(#{2,6}) +(.+?)[ \t]*$", re.MULTILINE)
# Of links only: Doxygen ends their text with the line.
LINK_TEXT = re.compile(r"\[([^\[\]]*\n[^\[\]]*)\]\(")
INDEX = re.compile(r"\]\([^)\s]*README\.md\)")
LINK = re.compile(r"\]\(([^)#\s]*)#([^)\s]+)\)")


def slug(heading):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower().replace("`", "")
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def page_filter(page):
    seen = {}

    def with_anchor(match):
        anchor = slug(match[2])
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        title = match[2].replace("`", "")  # Doxygen shows its own code for code type in headings
        return f"{match[1]} {title} {{#{page}-{anchor}{f'-{count}' if count else ''}}}"

    def with_page(match):
        if re.match(r"[a-z]+:", match[1]):
            return match[0]
        return f"](#{pathlib.PurePath(match[1]).stem if match[1] else page}-{match[2]})"

    def text_filter(text):
        text = TITLE.sub(lambda match: match[0].replace("`", ""), text)
        text = LINK_TEXT.sub(lambda match: "[" + re.sub(r"\s*\n\s*", " ", match[1]) + "](", text)
        text = LINK.sub(with_page, HEADING.sub(with_anchor, text))
        return INDEX.sub("](@ref index)", text)

    return text_filter


def main():
    path = pathlib.Path(sys.argv[1])
    text = path.read_text(encoding="utf-8")
    of_page = page_filter(path.stem)
    text = "".join(part if part.startswith("```") else of_page(part) for part in FENCE.split(text))
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
