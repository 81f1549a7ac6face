# SPDX-License-Identifier: BSD-3-Clause
"""Checks every link of the built site: files and places in them are there; addresses of hosts are well formed. The same
of the documents of the repository, which people read without the site (of_documents).

    links.py HTML [--least N]

The network is not asked, so that an address may still lead nowhere. --least: fewer links are an error.
"""
import argparse
import os
import pathlib
import re
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

from stage import places_of

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


# [words](link "title"), [words]: link in a line of its own, <https://host>
WRITTEN = re.compile(r"""\]\(\s*<?([^()<>\s]+)>?(?:\s+"[^"]*")?\s*\)|"""
                     r"^ {0,3}\[[^\]]+\]:\s*<?(\S+?)>?\s*$|<(https?:[^>\s]*)>", re.M)
FENCED = re.compile(r"(?ms)^(`{3,}|~{3,}).*?^\1`*\s*$")
SPAN = re.compile(r"(?<!`)(`+)(?!`)(?:(?!\1).)*?(?<!`)\1(?!`)")


def of_document(root, name, files):
    """The links of a document, and what is wrong with each of them or None. files: of the repository, with folders."""
    path = root / name
    text = FENCED.sub("", path.read_text(encoding="utf-8"))
    text = re.sub(r"(?m)^    .*$", "", text)
    for found in WRITTEN.finditer(SPAN.sub(lambda span: "`" if "](" in span[0] else span[0], text)):
        link = next(group for group in found.groups() if group)
        if re.match(r"[a-z][a-z0-9+.-]*:", link, re.IGNORECASE):
            trouble = outside(link)
            yield link, f"{link}: {trouble}" if trouble else None
            continue
        place, _, anchor = link.partition("#")
        target = pathlib.Path(os.path.normpath(path.parent / unquote(place))) if place else path
        if root not in [target, *target.parents]:
            yield link, f"{place} leads out of the repository"
        elif not target.exists():
            yield link, f"{place} is not there"
        elif target.relative_to(root) not in files:
            yield link, f"{place} is not in the repository"
        else:
            target = target / "README.md" if target.is_dir() else target
            there = not anchor or target.is_file() and unquote(anchor) in places_of(target.read_text(encoding="utf-8"))
            yield link, None if there else f"{target.relative_to(root)} has no heading #{anchor}"


def of_documents(root, names):
    """How many links the documents of a repository have, and what is wrong. names: of all of its files."""
    root = pathlib.Path(root).resolve()
    files = {pathlib.Path(name) for name in names}
    files |= {parent for name in files for parent in name.parents}
    documents = [name for name in names if name.endswith(".md")]
    checked = [(name, trouble) for name in documents for _, trouble in of_document(root, name, files)]
    return len(checked), [f"{name}: {trouble}" for name, trouble in checked if trouble]


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
