#!/usr/bin/env python3
"""Opens a report in headless Chromium and checks what a reader relies on.

    tests/browser/check_report.py RUN|SUITE.yaml [--warmjoint build/warmjoint] [--shots FOLDER] [--opt-in]

RUN is a directory of `warmjoint run`; its report is made first. Of a suite, three realizations are run. Checked: no
error on the console, no request to anywhere, every picture there, with an alt text, and large enough to read, the
table's numbers equal to `compare --format json`, nothing wider than a phone but what scrolls by itself, rows that keep
their names in sight, headings and regions named, links that can be reached with the keyboard. --shots keeps pictures of
the page, narrow and wide, light and dark. --opt-in, for ctest: only where WARMJOINT_BROWSER_TEST is set. Exit status 0:
all holds; 1: something does not; 77: not opted in, or no browser here.
Installs nothing: Debian's package is `chromium`; the environment variable CHROMIUM names another browser.
"""

import atexit
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

from barriers import check_barriers
from page_checks import SIZES, arguments_of, check_pictures, check_silence, check_widths, in_browser, keep_shot, show

TABLES = """[...document.querySelectorAll('table')].filter(table => !table.closest('#list')).map(table => ({
  caption: table.caption ? table.caption.innerText : '',
  head: [...table.tHead.rows[0].cells].map(cell => cell.innerText),
  rows: [...table.tBodies[0].rows].map(row => [...row.cells].map(cell => cell.innerText)),
  headed: [...table.tBodies[0].rows].every(row => row.querySelector('th[scope=row]')?.innerText)}))"""
# a change of scheme changes the sources: decoding what was there before fails, and is tried again
DECODED = """Promise.all([...document.images].map(async image => {
  for (let tries = 0; tries < 50; ++tries) {
    try { return await image.decode() } catch { await new Promise(done => setTimeout(done, 100)) }
  }
  throw new Error('not decoded: ' + image.alt)}))"""
STOPS = """[...document.querySelectorAll('a[href], summary, button, select, [tabindex="0"]')]"""
# scrolled to its end, a table still shows what its rows are of; afterwards it is as it was
NAMELESS = """[...document.querySelectorAll('.scroll')].filter(box => box.querySelector('table')).filter(box => {
  box.scrollLeft = box.scrollWidth;
  const left = box.getBoundingClientRect().left, name = box.querySelector('tbody th').getBoundingClientRect();
  box.scrollLeft = 0;
  return name.left < left - 1 || name.left > left + 40}).map(box => box.getAttribute('aria-label'))"""
SMALL = "[...document.images].filter(image => image.width < 600 && image.width < image.naturalWidth / 2).map(i => i.alt)"


def shown_number(text):
    """The number that a cell begins with, and half of its last digit; None for words."""
    digits = text.split()[0] if text.split() else ""
    try:
        value = float(digits)
    except ValueError:
        return None
    mantissa, _, exponent = digits.partition("e")
    decimals = len(mantissa.partition(".")[2])
    # trailing zeros that %g leaves out: at least three digits are right
    return value, max(0.5 * 10 ** (int(exponent or 0) - decimals), 0) + 5e-4 * abs(value)


def check_numbers(browser, checks, board):
    held = json.loads(browser.value("document.getElementById('board').textContent"))
    checks.expect(held == board, "the page's data block differs from compare --format json")
    rows = {row["identifier"]: row for row in board["rows"]}
    tables = browser.value(TABLES)
    checks.expect(len(tables) >= 2, "the leaderboard's tables are missing")
    columns = {
        "NPE median": lambda row: 100 * row["npe"]["continuous"]["median"],
        "NPE rms": lambda row: 100 * row["npe"]["continuous"]["rms"],
        "discrete NPE": lambda row: 100 * row["npe"]["discrete"]["median"],
        "RMSE": lambda row: row["rmse"]["median"],
        "MAE": lambda row: row["mae"]["median"],
        "Fit %": lambda row: row["fit"]["median"],
        "FPE": lambda row: row["fpe"]["median"],
    }
    compared = 0
    for table in tables:
        checks.expect(table["caption"], "a table has no caption")
        checks.expect(table["headed"], f"{table['caption']}: a row has no head")
        # rows of one variant have numbers of their own
        whole = table["head"][0] in ("#", "identifier")
        name_column = table["head"].index("identifier") if whole else None
        for cells in table["rows"]:
            row = rows.get(cells[name_column]) if name_column is not None else None
            for head, cell in zip(table["head"], cells):
                key = next((key for key in columns if row and (head == key or head.startswith(key + " "))), None)
                if key is None or (key == "NPE median" and head != "NPE median"):
                    continue
                expected, shown = columns[key](row), shown_number(cell)
                if expected is None or not math.isfinite(expected):
                    continue
                compared += 1
                checks.expect(shown and abs(shown[0] - expected) <= shown[1],
                              f"{cells[name_column]}, {head}: the page says {cell}, compare {expected}")
    checks.expect(compared >= 3 * len(rows), f"only {compared} numbers were found in the tables")


def check_reading(browser, checks):
    """What keyboards and screen readers need."""
    tree = browser.call("Accessibility.getFullAXTree")["nodes"]
    seen = [(node["role"]["value"], node.get("name", {}).get("value", "")) for node in tree if not node.get("ignored")]
    for role in ("main", "navigation", "region", "table", "image", "link", "heading"):
        checks.expect(any(role == each for each, _ in seen), f"no {role} for screen readers")
    for role, name in seen:
        if role in ("navigation", "region", "table", "image", "link", "heading"):
            checks.expect(name.strip(), f"a {role} has no name")
    checks.expect(browser.value("document.documentElement.lang") == "en", "the page's language is not said")
    levels = browser.value("[...document.querySelectorAll('h1,h2,h3,h4')].map(h => +h.tagName[1])")
    checks.expect(levels.count(1) == 1 and all(b - a <= 1 for a, b in zip(levels, levels[1:])), f"headings jump: {levels}")
    # every link and every region that scrolls is reached by Tab, and shows it
    stops = browser.value(f"{STOPS}.length")
    reached = set()
    for _ in range(stops + 1):
        for kind in ("keyDown", "keyUp"):
            browser.call("Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9)
        reached.add(browser.value(f"{STOPS}.indexOf(document.activeElement)"))
        outline = browser.value("getComputedStyle(document.activeElement).outlineStyle")
        checks.expect(outline != "none" or browser.value("document.activeElement === document.body"),
                      "the focus does not show")
    checks.expect(reached >= set(range(stops)), f"Tab reaches {sorted(reached)} of {stops} places")


def look(browser, checks, name, scheme, folder):
    show(browser, name, features=[{"name": "prefers-color-scheme", "value": scheme}])
    check_widths(browser, checks, name)
    nameless = browser.value(NAMELESS)
    checks.expect(not nameless, f"{name}: rows lose their names where {nameless} scroll")
    small = browser.value(SMALL)
    checks.expect(not small, f"{name}: too small to read: {small}")
    browser.value(DECODED)
    paper = browser.value("getComputedStyle(document.body).backgroundColor")
    checks.expect(("255" in paper) == (scheme == "light"), f"{scheme}: the paper is {paper}")
    keep_shot(browser, folder, f"report_{name}_{scheme}")


def check_list(browser, checks):
    """The table of realizations sorts by a click on a heading, and shows what is chosen."""
    column = """[...document.querySelectorAll('#list tbody tr')].filter(row => !row.hidden).map(row => row.cells[%d].textContent)"""
    heads = browser.value("[...document.querySelectorAll('#list thead th')].map(head => head.textContent)")
    npe, identifier = heads.index("NPE"), heads.index("identifier")
    for order in ("ascending", "descending"):
        browser.value(f"document.querySelectorAll('#list thead button')[{npe}].click()")
        shown = [shown_number(cell)[0] for cell in browser.value(column % npe) if cell != "-"]
        checks.expect(shown == sorted(shown, reverse=order == "descending"), f"not {order}: {shown[:5]}")
    names = sorted(set(browser.value(column % identifier)))
    all_rows = len(browser.value(column % identifier))
    if len(names) > 1:
        browser.value(f"""(list => {{ list.value = '{names[0]}'; list.dispatchEvent(new Event('change')) }})(
          [...document.querySelectorAll('#choose label')].find(label => label.textContent.startsWith('identifier')).querySelector('select'))""")
        left = browser.value(column % identifier)
        checks.expect(left and len(left) < all_rows and set(left) == {names[0]}, f"the filter shows {set(left)}")
        said = browser.value("document.getElementById('shown').textContent")
        checks.expect(said.startswith(f"{len(left)} of {all_rows} "), f"'{said}' of {len(left)} rows")


def main():
    arguments = arguments_of(__doc__, "run")
    if arguments.what.is_file():
        scratch = pathlib.Path(tempfile.mkdtemp(prefix="warmjoint-report-"))
        atexit.register(shutil.rmtree, scratch, ignore_errors=True)
        subprocess.run([arguments.warmjoint, "run", str(arguments.what), "--realizations", "3", "-o", str(scratch / "run")],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        arguments.what = scratch / "run"
    run = arguments.what
    subprocess.run([arguments.warmjoint, "report", str(run)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    compared = subprocess.run([arguments.warmjoint, "compare", str(run), "--format", "json"], check=True,
                              capture_output=True)
    url = (run / "report.html").resolve().as_uri()

    def work(browser, checks):
        browser.open(url)
        for name in SIZES:
            for scheme in ("light", "dark"):
                look(browser, checks, name, scheme, arguments.shots)
        check_numbers(browser, checks, json.loads(compared.stdout))
        check_pictures(browser, checks)
        check_reading(browser, checks)
        check_list(browser, checks)
        check_barriers(browser, checks)
        check_silence(browser, checks, url)

    return in_browser(work)


if __name__ == "__main__":
    sys.exit(main())
