"""Each page can be read in ten minutes and on any screen: its words, its widths.

    check_sizes.py ROOT

- A page has at most 1,500 words. Boards, which programs write, may have more, and so may the list of changes.
- A line of prose or code has at most 120 columns, without the targets of its links; a cell of a table has as many in two lines.
"""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages

WORDS = 1500  # why: ten minutes at 150 words a minute, a usual speed for technical text
WIDTH = 120  # why: half of a screen of 1920 pixels in a monospaced type of 8 pixels, beside an editor
CELL = 2 * WIDTH


def is_board(page):
    """Whether a program writes the whole page."""
    return page.parent.name == "boards"


def words(text):
    """How many words a page has: what holds a letter or a digit."""
    return sum(bool(re.search(r"\w", word)) for word in text.split())


def shown(line):
    """The line without the targets of its links."""
    return re.sub(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\])\([^)\s]+\)", r"\1", line)


def cells(row):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", row)]


def too_wide(text):
    """(line, columns, bound) of what is wider than its bound."""
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        fence = line.startswith("```")
        inside ^= fence
        if inside or fence:
            width, bound = len(line), WIDTH
        elif line.startswith("|"):
            width, bound = max(map(len, cells(shown(line)))), CELL
        elif line.startswith(("<!--", "![")):  # a mark or a picture has to stand on one line
            continue
        else:
            width, bound = len(shown(line)), WIDTH
        if width > bound:
            yield number, width, bound


def problems(root, page):
    text = (root / page).read_text()
    if not is_board(page):
        yield from (f"{page}:{line}: {width} columns, at most {bound}" for line, width, bound in too_wide(text))
    if not is_board(page) and page.name != "CHANGELOG.md" and (count := words(text)) > WORDS:
        yield f"{page}: {count} words, at most {WORDS}: make it two pages"


def main():
    # what the checks find in a page that breaks both bounds
    wide = "word " * 40 + "\n| " + "x" * 241 + " |\n```sh\n" + "y" * 121 + "\n```\n[short](" + "z" * 200 + ")\n"
    assert [(line, bound) for line, _, bound in too_wide(wide)] == [(1, WIDTH), (2, CELL), (4, WIDTH)], list(too_wide(wide))

    root = pathlib.Path(sys.argv[1]).resolve()
    found = [problem for page in pages.pages(root) for problem in problems(root, page)]
    print("\n".join(found) or f"{len(pages.pages(root))} pages have their sizes")
    sys.exit(1 if found else 0)


main()
