"""What a page of Markdown holds: its code blocks with their marks, headings and links.

Marks are HTML comments on the lines above a block:

    <!-- not run: REASON -->            the block is not run
    <!-- ends with STATUS: REASON -->   its last command ends with this exit status
    <!-- needs FILE...: REASON -->      files of the shared folder (WARMJOINT_SHARED) lie in the working directory; the block is
                                        skipped where they are absent

`<!-- made as FILE: by the commands of this page -->` on the line above a picture says which of the files that the commands made it is.
`<!-- long page: REASON -->` anywhere in the page gives its test the label `long`.
"""

import dataclasses
import itertools
import pathlib
import re

FENCE = re.compile(r"^```(\w*)\s*$")
MARK = re.compile(r"^<!-- (not run|ends with|needs|made as|long page)\b\s*([^:]*): (.+) -->$")


def is_output(name):
    """Whether a folder at the top of the project holds what was made there and no sources; hidden ones are those of tools."""
    return name in {"runs", "dist"} or name.startswith((".", "build"))


@dataclasses.dataclass
class Block:
    """One fenced block: its language, lines, the line of its fence (from 1), and the marks above it: {kind: (value, reason)}."""

    language: str
    text: str
    line: int
    marks: dict = dataclasses.field(default_factory=dict)


def pages(root):
    """Every page of the project, relative to its root, sorted."""
    found = []
    for path in pathlib.Path(root).rglob("*.md"):
        relative = path.relative_to(root)
        if not is_output(relative.parts[0]):
            found.append(relative)
    return sorted(found)


def blocks(text):
    """The fenced blocks of a page, in order. Raises ValueError where a fence does not close or a mark is not understood."""
    found, open_block, marks = [], None, {}
    for number, line in enumerate(text.splitlines(), 1):
        if open_block is not None:
            if line.strip() == "```":
                found.append(open_block)
                open_block = None
            else:
                open_block.text += line + "\n"
            continue
        fence = FENCE.match(line)
        if fence:
            open_block = Block(fence.group(1), "", number, marks)
        elif line.startswith("```"):
            raise ValueError(f"line {number}: a fence names one language and nothing else: {line}")
        given = MARK.match(line)
        if line.startswith("<!--") and not given:
            raise ValueError(f"line {number}: no mark that tools/docs/pages.py knows: {line}")
        if given:
            kind, value, reason = given.groups()
            marks = {**marks, kind: (value.strip(), reason)}
        else:
            marks = {}
    if open_block is not None:
        raise ValueError(f"line {open_block.line}: the block does not end")
    return found


def prose(text):
    """The page without its fenced blocks, line for line, so that line numbers stay."""
    lines, inside = [], False
    for line in text.splitlines():
        if line.startswith("```"):
            inside = not inside
            lines.append("")
        else:
            lines.append("" if inside else line)
    return lines


def anchor(heading):
    """The name that GitHub gives a heading, which is that of MkDocs wherever neither doubles a hyphen."""
    words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def anchors(text):
    """All anchors of a page."""
    names = []
    for line in prose(text):
        heading = re.match(r"^#{1,6} (.+?)\s*$", line)
        if heading:
            names.append(anchor(heading.group(1)))
    return names


def links(text):
    """(line, text, target) of every link and picture outside of code."""
    found = []
    for number, line in enumerate(prose(text), 1):
        if line.startswith("    "):
            continue
        for match in re.finditer(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)", line):
            before = line[: match.start()]
            if before.count("`") % 2 == 0:
                found.append((number, match.group(1), match.group(2)))
    return found


def made_pictures(text):
    """(line, picture, file that the page's commands make) of every picture that says so."""
    lines = text.splitlines()
    found = []
    for number, (line, below) in enumerate(itertools.pairwise(lines), 1):
        mark = MARK.match(line)
        if mark and mark.group(1) == "made as":
            picture = re.match(r"^!\[.*\]\(([^)]+)\)$", below)
            if not picture:
                raise ValueError(f"line {number}: no picture stands below this mark")
            found.append((number, picture.group(1), mark.group(2).strip()))
    return found
