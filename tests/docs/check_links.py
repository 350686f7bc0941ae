"""Every link inside the documents leads somewhere: to a file or folder of the project, and to a heading that exists.

    check_links.py ROOT [--external]

A link from `code` to a source file promises that the file holds that word. --external also asks every http(s) link; the
ctest entry `docs.external_links` does so for those who ask (WARMJOINT_EXTERNAL_LINKS=1), and skips otherwise (77).
"""

import os
import pathlib
import re
import sys
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages

SOURCES = {".h", ".cc", ".py", ".cmake"}
README_LINES = 120  # what a newcomer reads in two minutes


def inside_problem(root, page, words, target):
    """What is wrong with a link inside the project; empty where nothing is."""
    path, _, name = target.partition("#")
    file = (root / page.parent / path).resolve() if path else root / page
    if not file.exists():
        return f"{target}: there is no such file"
    if root != file and root not in file.parents:
        return f"{target}: leads out of the project"
    if name:
        readme = file / "README.md" if file.is_dir() else file
        known = pages.anchors(readme.read_text()) if readme.suffix == ".md" else []
        if name not in known:
            return f"{target}: {readme.name} has no heading '{name}'; it has: {', '.join(known)}"
        if "--" in name:
            return f"{target}: GitHub and MkDocs name this heading differently; word it without signs between spaces"
    code = re.fullmatch(r"`([A-Za-z_]\w*)`", words)
    if code and file.suffix in SOURCES and not re.search(rf"\b{code.group(1)}\b", file.read_text()):
        return f"{target}: does not hold {code.group(1)}"
    return ""


def external_problem(target):
    try:
        request = urllib.request.Request(target, method="HEAD", headers={"User-Agent": "warmjoint link check"})
        with urllib.request.urlopen(request, timeout=20) as answer:
            return "" if answer.status < 400 else f"{target}: answers {answer.status}"
    except (OSError, ValueError) as error:
        return f"{target}: {error}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    external = "--external" in sys.argv
    if external and not os.environ.get("WARMJOINT_EXTERNAL_LINKS"):
        print("skipped: WARMJOINT_EXTERNAL_LINKS=1 asks every link to other sites")
        sys.exit(77)
    problems, counted = [], 0
    length = len((root / "README.md").read_text().splitlines())
    if length >= README_LINES:
        problems.append(f"README.md has {length} lines; below {README_LINES}: move what few readers need to a page")
    for page in pages.pages(root):
        for line, words, target in pages.links((root / page).read_text()):
            outside = target.startswith(("http://", "https://", "mailto:"))
            if outside != external:
                continue
            counted += 1
            problem = external_problem(target) if outside else inside_problem(root, page, words, target)
            if problem:
                problems.append(f"{page}:{line}: {problem}")
    print("\n".join(problems) or f"{counted} links lead somewhere")
    sys.exit(1 if problems or not counted else 0)


main()
