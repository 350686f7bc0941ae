"""The pages make a site, strictly: MkDocs warns of nothing, and every page is in the menu.

    build_site.py ROOT LIBRARY FOLDER

LIBRARY is what tools/docs/setup fetched; exits 77, with the reason, where it is absent.
"""

import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/docs"))

import pages


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


main()
