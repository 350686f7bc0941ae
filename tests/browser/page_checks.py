"""What every check of a page in Chromium needs: its arguments, a count of what was looked at, and a browser."""

import argparse
import base64
import os
import pathlib
import sys

from chromium import Browser, find_browser

SIZES = {"phone": (390, 844), "desktop": (1280, 900)}
# tables and commands that are cut at the right edge, but for the list of realizations, which scrolls
CUT = """[...document.querySelectorAll('.scroll, pre')].filter(box => !box.closest('#list, details') && box.scrollWidth > box.clientWidth + 1)
  .map(box => box.textContent.trim().slice(0, 40))"""

WIDE = """[...document.querySelectorAll('body *')].filter(e => !e.closest('.scroll, pre, .skip, .chart') &&
  e.getBoundingClientRect().right > innerWidth + 1).map(e => e.tagName + ' ' + e.textContent.slice(0, 40))"""


class Checks:
    """Counts what was looked at, and remembers what did not hold."""

    def __init__(self):
        self.count, self.failures = 0, []

    def expect(self, holds, message):
        self.count += 1
        if not holds:
            self.failures.append(message)
            print(f"FAIL: {message}", file=sys.stderr)


def check_silence(browser, checks, url):
    for event in browser.events:
        method, what = event["method"], event["params"]
        if method == "Runtime.exceptionThrown":
            checks.expect(False, f"exception: {what['exceptionDetails']['text']}")
        if method == "Runtime.consoleAPICalled":
            checks.expect(what["type"] not in ("error", "warning"), f"console: {what}")
        if method == "Log.entryAdded":
            checks.expect(what["entry"]["level"] not in ("error", "warning"), f"log: {what['entry']['text']}")
        if method == "Network.requestWillBeSent":
            target = what["request"]["url"]
            checks.expect(target == url or target.startswith("data:"), f"request to {target[:100]}")


def show(browser, size, **media):
    """Takes a screen of that size, and shows the page for those media: media="print", features=[...]."""
    width, height = SIZES[size]
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=size == "phone")
    browser.call("Emulation.setEmulatedMedia", **{"media": "", "features": [], **media})


def check_widths(browser, checks, size, printed=False):
    """Nothing is wider than the screen but what scrolls by itself; on a desktop nothing is cut."""
    wide = browser.value(WIDE)
    checks.expect(not wide, f"{size}: wider than the screen: {wide[:5]}")
    cut = browser.value(CUT) if size == "desktop" and not printed else []
    checks.expect(not cut, f"{size}: cut at the right edge: {cut}")


def check_pictures(browser, checks):
    """Every picture is drawn, and an alt text says what it shows."""
    alts = browser.value("[...document.images].map(image => image.complete && image.naturalWidth > 0 ? image.alt : 'not drawn')")
    checks.expect(alts and all(len(alt) > 30 for alt in alts), f"pictures that are not drawn or without words: {alts}")


def keep_shot(browser, folder, name):
    """Keeps a picture of the page, where a folder is given."""
    if folder:
        shot = browser.call("Page.captureScreenshot", format="png", captureBeyondViewport=True)
        (folder / f"{name}.png").write_bytes(base64.b64decode(shot["data"]))


def arguments_of(doc, what):
    """Of a check of `what`; ends with 77 where it is not asked for, or no browser is here."""
    parser = argparse.ArgumentParser(description=doc.split("\n", maxsplit=1)[0])
    parser.add_argument("what", metavar=what, type=pathlib.Path)
    parser.add_argument("--warmjoint", default="build/warmjoint")
    parser.add_argument("--shots", type=pathlib.Path, help="a folder for pictures of the page")
    parser.add_argument("--opt-in", action="store_true", help="do nothing unless WARMJOINT_BROWSER_TEST is set")
    arguments = parser.parse_args()
    if arguments.opt_in and not os.environ.get("WARMJOINT_BROWSER_TEST"):
        print("not asked for: set WARMJOINT_BROWSER_TEST=1 to open pages in Chromium", file=sys.stderr)
        sys.exit(77)
    if not find_browser():
        print("no Chromium here: install the package chromium, or set CHROMIUM", file=sys.stderr)
        sys.exit(77)
    if arguments.shots:
        arguments.shots.mkdir(parents=True, exist_ok=True)
    return arguments


def in_browser(work):
    """Calls work(browser, checks); says what did not hold, and gives the exit status."""
    checks, browser = Checks(), Browser(find_browser())
    try:
        work(browser, checks)
    finally:
        browser.close()
    print(f"{checks.count - len(checks.failures)} of {checks.count} checks hold")
    return 1 if checks.failures else 0
