"""What axe-core finds that would keep people out of a page."""

import pathlib
import subprocess

VIOLATIONS = """axe.run(document, {resultTypes: ['violations']}).then(found => found.violations.map(one =>
  one.id + ': ' + one.help + ' at ' + one.nodes.slice(0, 3).map(node => node.target.join(' ')).join(', ')))"""


def axe_script():
    """The text of axe-core, fetched on first use; nothing where it cannot be."""
    here = pathlib.Path(__file__).resolve().parent
    folder = here.parents[1] / "build/deps/axe"
    subprocess.run([here.parents[1] / "tools/setup/packages_of_python", "axe-core", folder, here / "requirements.txt"], check=False)
    script = folder / "axe_playwright_python/axe.min.js"
    return script.read_text(encoding="utf-8") if script.exists() else ""


def check_barriers(browser, checks):
    """Every rule of axe-core: WCAG A and AA, and good practice."""
    script = axe_script()
    checks.expect(script, "axe-core cannot be fetched")
    if script:
        browser.value(script + ";0")
        found = browser.value(VIOLATIONS)
        checks.expect(not found, f"barriers: {found}")
