#!/usr/bin/env python3
"""Downloads a source distribution and runs nothing of it.

    tools/setup/fetch_sdist.py REQUIREMENTS FOLDER

REQUIREMENTS names one: "name==version --hash=sha256:...". `pip download` would execute the build back end that it
asks for, whose packages no hash pins; here the link is read from the index that pip is configured with (PIP_INDEX_URL,
pip's configuration files, or pip's own default), and what it leads to must have that sha256. Prints the archive's path.
Exit status 1: not found, or another sha256; nothing is left then.
"""

import hashlib
import html.parser
import os
import pathlib
import re
import subprocess
import sys
import urllib.parse
import urllib.request

MOST = 64 << 20  # bytes of an index page or archive


class Links(html.parser.HTMLParser):
    """The links of an index page: PEP 503."""

    def __init__(self):
        super().__init__()
        self.links = []

    def handle_starttag(self, tag, attributes):
        target = dict(attributes).get("href")
        if tag == "a" and target:
            self.links.append(target)


def index_url():
    """The index that pip would take."""
    if os.environ.get("PIP_INDEX_URL"):
        return os.environ["PIP_INDEX_URL"]
    for key in ("download.index-url", "global.index-url"):
        answer = subprocess.run([sys.executable, "-m", "pip", "config", "get", key], capture_output=True, text=True)
        if answer.returncode == 0 and answer.stdout.strip():
            return answer.stdout.strip()
    from pip._internal.models.index import PyPI

    return PyPI.simple_url


def read(url):
    """The bytes behind a link; https, or whatever the user's own configuration names."""
    request = urllib.request.Request(url, headers={"Accept": "text/html, */*;q=0.1"})
    with urllib.request.urlopen(request, timeout=60) as answer:
        data = answer.read(MOST + 1)
    if len(data) > MOST:
        sys.exit(f"error: {url} has more than {MOST >> 20} MiB")
    return data


def requirement(path):
    """Name, version and sha256 of the one requirement."""
    text = pathlib.Path(path).read_text()
    found = re.findall(r"^([A-Za-z0-9._-]+)==(\S+) --hash=sha256:([0-9a-f]{64})$", text, re.MULTILINE)
    if len(found) != 1:
        sys.exit(f"error: {path} must hold one line name==version --hash=sha256:...; it has {len(found)}")
    return found[0]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    name, version, digest = requirement(sys.argv[1])
    page = index_url().rstrip("/") + "/" + re.sub(r"[-_.]+", "-", name).lower() + "/"
    links = Links()
    links.feed(read(page).decode())

    archive = f"{name}-{version}.tar.gz"
    for link in links.links:
        url = urllib.parse.urldefrag(urllib.parse.urljoin(page, link)).url
        if urllib.parse.unquote(url.rsplit("/", 1)[-1]) != archive:
            continue
        data = read(url)
        if hashlib.sha256(data).hexdigest() != digest:
            sys.exit(f"error: {archive} from the index has sha256 {hashlib.sha256(data).hexdigest()}, not {digest}")
        target = pathlib.Path(sys.argv[2]) / archive
        target.write_bytes(data)
        print(target)
        return
    sys.exit(f"error: the index has no {archive}")


if __name__ == "__main__":
    main()
