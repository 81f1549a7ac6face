# SPDX-License-Identifier: BSD-3-Clause
"""Checks every link of the built site: files and places in them are there; addresses of hosts are well formed.

    links.py HTML [--least N]

The network is not asked, so that an address may still lead nowhere. --least: fewer links are an error.
"""
import argparse
import pathlib
import re
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

ATTRIBUTES = {"a": "href", "link": "href", "img": "src", "script": "src", "source": "src", "iframe": "src"}
HOST = re.compile(r"[a-z0-9]([a-z0-9-]*[a-z0-9])?(\.[a-z0-9]([a-z0-9-]*[a-z0-9])?)+")


class Page(HTMLParser):
    """links: (line, address); places: names that a # may name."""

    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], {"", "top"}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.places |= {found[key] for key in ("id", "name") if found.get(key)}
        address = found.get(ATTRIBUTES.get(tag, ""))
        if address is not None:
            self.links.append((self.getpos()[0], address))


def outside(address):
    """What is wrong with an address that leaves the site, or None."""
    parts = urlsplit(address)
    if parts.scheme in ("data", "mailto"):
        return None
    if parts.scheme not in ("http", "https"):
        return f"unknown scheme {parts.scheme}"
    return None if HOST.fullmatch((parts.hostname or "").lower()) else "no host"


def check(folder):
    """(inside, outside, list of what is wrong)."""
    folder = folder.resolve()
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    inside, addresses, wrong = 0, set(), []
    for path, page in pages.items():
        for line, address in page.links:
            place = f"{path.relative_to(folder)}:{line}"
            if re.match(r"[a-z][a-z0-9+.-]*:", address, re.IGNORECASE) or address.startswith("//"):
                addresses.add(address)
                trouble = outside(address)
            else:
                inside += 1
                trouble = missing(folder, pages, path, address)
            if trouble:
                wrong.append(f"{place}: {address}: {trouble}")
    return inside, addresses, wrong, len(pages)


def missing(folder, pages, path, address):
    """What is wrong with a link inside, or None."""
    parts = urlsplit(address)
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if folder not in [target, *target.parents]:
        return "leads out of the site"
    if not target.is_file():
        return "no such file"
    if parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].places:
        return "no such place in the page"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("html", type=pathlib.Path)
    parser.add_argument("--least", type=int, default=1)
    given = parser.parse_args()
    inside, addresses, wrong, pages = check(given.html)
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{pages} pages, {inside} links inside, {len(addresses)} addresses outside (form only), {len(wrong)} dead")
    if inside < given.least:
        print(f"fewer than {given.least} links", file=sys.stderr)
    return 1 if wrong or inside < given.least else 0


if __name__ == "__main__":
    sys.exit(main())
