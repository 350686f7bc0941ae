"""The pages make a site, strictly: MkDocs warns of nothing, every page is in the menu, no page asks a network, and the search finds.

    build_site.py ROOT LIBRARY FOLDER

LIBRARY is what tools/docs/setup fetched; exits 77, with the reason, where it is absent.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages

# what the search needs of a page: its box, its list, and elements that hold a text, a link and others
DOCUMENT = """
var module = undefined, exports = undefined;  // a browser has neither
const element = () => ({children: [], appendChild(child) { this.children.push(child); return child; },
                        replaceChildren(...given) { this.children = given; }, addEventListener(_, heard) { this.heard = heard; }});
const box = element(), list = element();
const document = {createElement: element, getElementById: (name) => name.endsWith("query") ? box : list};
const base_url = ".";
"""
# a word, and a page that has to be among the first five places found for it
SEARCHES = {"rosbag": "tools/docs/formats.html", "not_identifiable": "tools/docs/trust.html", "compensat": "tools/docs/compensate.html"}


def found(script, word):
    """The targets of the links that the search shows for a word."""
    ask = f"box.value = {json.dumps(word)}; box.heard(); console.log(JSON.stringify(list.children.map((a) => a.children[0].children[0].href)));"
    done = subprocess.run(["node", "-"], input=DOCUMENT + script + ask, text=True, check=True, stdout=subprocess.PIPE)
    return json.loads(done.stdout)


def check_search(html):
    """What a page fetches lies in the site; the search answers without a server."""
    for page in html.rglob("*.html"):
        fetched = re.findall(r"<(?:script|img|link)[^>]*\b(?:src|href)=[\"']?(https?:[^\"' >]+)", page.read_text())
        if fetched:
            sys.exit(f"{page.relative_to(html)} fetches {fetched[0]}")
    script = (html / "search/main.js").read_text()
    if "XMLHttpRequest" in script or "importScripts" in script:
        sys.exit("the search reads other files, which a page opened as a file may not")
    if not shutil.which("node"):
        print("the search was not tried: node is absent")
        return
    for word, page in SEARCHES.items():
        places = found(script, word)
        if not any(place.startswith("./" + page) for place in places[:5]):
            sys.exit(f"{word}: {page} is not among the first five: {places[:5]}")


def main():
    root, library, folder = (pathlib.Path(given).resolve() for given in sys.argv[1:4])
    if not library.exists():
        print("skipped: MkDocs is absent; tools/docs/setup fetches it")
        sys.exit(77)
    subprocess.run([root / "tools/docs/site", folder], check=True)
    lacking = [page for page in pages.pages(root)
               if not (folder / "html" / page.with_suffix(".html")).exists()
               and not (folder / "html" / page.parent / "index.html").exists()]
    if lacking:
        sys.exit(f"the site lacks {lacking}")
    check_search(folder / "html")


main()
