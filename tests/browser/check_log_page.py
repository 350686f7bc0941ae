#!/usr/bin/env python3
"""Opens the page of a log in headless Chromium and checks what a reader relies on.

    tests/browser/check_log_page.py LOG|estimate.json|SCENARIO.yaml [--warmjoint build/warmjoint] [--shots FOLDER] [--opt-in]

Makes the page by `warmjoint report`, of a scenario after simulating it. Checked on a phone and on a desktop: no error on the console, no request to anywhere, charts that
are drawn within 3 s and zoom together, a box that hides its series, nothing wider than the screen but what scrolls by itself, pictures
with alt texts, every section there without JavaScript. --shots keeps pictures of the page. Exit statuses as check_report.py.
"""

import pathlib
import subprocess
import sys
import tempfile
import time

from barriers import check_barriers
from page_checks import SIZES, arguments_of, check_pictures, check_silence, check_widths, in_browser, keep_shot, show

SECTIONS = ("verdict", "next", "parameters", "recording", "pictures", "tests", "assumptions", "mujoco", "terms", "repeat")
DRAWN = """[...document.querySelectorAll('.chart')].length === 3 && [...document.querySelectorAll('.chart')].every(chart =>
  [...chart.querySelectorAll('canvas')].some(canvas =>
    canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.some((v, i) => i % 4 === 3 && v > 0)))"""
LABELS = """[...document.querySelectorAll('.chart')].map(chart =>
  [...chart.querySelectorAll('.dygraph-axis-label-x')].map(label => label.textContent).join(' '))"""


def check_charts(browser, checks):
    whole = browser.value(LABELS)
    browser.value("document.querySelector('.chart').scrollIntoView({block: 'center'})")
    left, top, width, height = browser.value(
        "(r => [r.left, r.top, r.width, r.height])(document.querySelector('.chart').getBoundingClientRect())")
    for kind, share in (("mousePressed", 0.4), ("mouseMoved", 0.7), ("mouseReleased", 0.7)):
        browser.call("Input.dispatchMouseEvent", type=kind, x=left + share * width, y=top + height / 2, button="left", clickCount=1)
    near = browser.value(LABELS)
    checks.expect(near != whole and len(set(near)) == 1, f"a drag does not zoom all charts: {near}")
    for name in ("whole", "in", "later", "earlier", "out"):
        before = browser.value(LABELS)
        browser.value(f"document.getElementById('zoom-{name}').click()")
        after = browser.value(LABELS)
        checks.expect(after != before and len(set(after)) == 1, f"the button zoom-{name} shows {after} after {before}")
    picture = "document.querySelector('.chart canvas').toDataURL()"
    before = browser.value(picture)
    browser.value("document.getElementById('show-kept').click()")
    checks.expect(browser.value(picture) != before, "a box hides nothing")


MEDIA = {"light": {}, "dark": {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}, "print": {"media": "print"}}


def look(browser, checks, url, size, media, shots):
    show(browser, size, **MEDIA[media])
    start = time.monotonic()
    browser.open(url)
    if media == "print":
        checks.expect(browser.value("getComputedStyle(document.getElementById('recording')).display") == "none", "charts are printed")
    else:
        while not browser.value(DRAWN) and time.monotonic() - start < 10:
            time.sleep(0.05)
        took = time.monotonic() - start
        print(f"{size}, {media}: charts drawn after {took:.2f} s")
        checks.expect(took < 3, f"{size}: the charts are drawn after {took:.1f} s")
    check_widths(browser, checks, size, printed=media == "print")
    check_pictures(browser, checks)
    keep_shot(browser, shots, f"log_{size}_{media}")


def check_without_scripts(browser, checks, url):
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    browser.open(url)
    root = browser.call("DOM.getDocument", depth=0)["root"]["nodeId"]
    for section in SECTIONS:
        found = browser.call("DOM.querySelector", nodeId=root, selector=f"#{section}")["nodeId"]
        text = browser.call("DOM.getOuterHTML", nodeId=found)["outerHTML"] if found else ""
        checks.expect(len(text) > 100, f"without JavaScript the section {section} is not there")


def main():
    arguments = arguments_of(__doc__, "log")
    with tempfile.TemporaryDirectory(prefix="warmjoint-log-page-") as scratch:
        page, log = pathlib.Path(scratch) / "log.html", arguments.what
        if log.suffix == ".yaml":
            subprocess.run([arguments.warmjoint, "simulate", str(log), "-o", scratch + "/simulated"], check=True, stdout=subprocess.DEVNULL)
            log = pathlib.Path(scratch) / "simulated/recording.csv"
        subprocess.run([arguments.warmjoint, "report", str(log), "-o", str(page)], check=True, stdout=subprocess.DEVNULL)

        def work(browser, checks):
            checks.expect(page.stat().st_size < 6_000_000, f"the page has {page.stat().st_size} bytes")
            for size in SIZES:
                for media in ("print", "light", "dark"):
                    look(browser, checks, page.as_uri(), size, media, arguments.shots)
            check_charts(browser, checks)
            check_barriers(browser, checks)
            check_silence(browser, checks, page.as_uri())
            check_without_scripts(browser, checks, page.as_uri())

        return in_browser(work)


if __name__ == "__main__":
    sys.exit(main())
