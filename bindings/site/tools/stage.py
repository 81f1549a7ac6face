# SPDX-License-Identifier: BSD-3-Clause
"""Gathers what Sphinx reads: the pages of the site, and the documents of the tree from where they are.

A page `pages/X.md` becomes `X.md`, a document `PATH.md` of the tree `tree/PATH.md`. Links keep their meaning: those to
a document lead to its page, those to a folder to its README, or to a list of its files, those to any other file to
a copy of it. What is linked is gathered as well, so that no link leads out of the site, unless it names a host.
"""
import os
import re
import shutil
import subprocess

from blocks import FENCE

LINK = re.compile(r"(\]\()([^()\s]+)(\))")  # its words may have begun in an earlier line
CODE = re.compile(r"(`+[^`]*`+)")
RUN = re.compile(r"^(`{3,}\{figure\}) run:(\S+)$")
HEADING = re.compile(r"^#{1,6} +(.+?) *#*$")
SCHEME = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


class StageError(Exception):
    """A link that leads nowhere."""


def places_of(text):
    """The names of the headings of a document, as GitHub and MyST make them."""
    found, fence = set(), None
    for line in text.splitlines():
        match = FENCE.match(line)
        if match and (fence is None or match[1] == fence and not match[2]):
            fence = match[1] if fence is None else None
        elif fence is None and (heading := HEADING.match(line)):
            words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1])
            name = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
            again = next(k for k in range(99) if (f"{name}-{k}" if k else name) not in found)
            found.add(f"{name}-{again}" if again else name)
    return found


class Stage:
    """root: of the sources; out: the folder to fill; results: where the blocks of the pages have run, None: unknown."""

    def __init__(self, root, site, out, results):
        self.root, self.site, self.out, self.results = root, site, out, results
        self.pages = site / "pages"
        self.documents, self.todo, self.files, self.generated = {}, [], set(), {}
        self.places, self.wanted = {}, []
        self.links = {"inside": 0, "outside": set()}
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)

    def staged(self, path):
        """Where a file of the tree is in the stage."""
        if self.pages in path.parents:
            return path.relative_to(self.pages)
        return "tree" / path.relative_to(self.root)

    def gather(self):
        """All pages, and what they link."""
        for path in sorted(self.pages.rglob("*.md")):
            self.want(path)
        while self.todo:
            path = self.todo.pop()
            text = self.listing(path) if path.is_dir() else path.read_text(encoding="utf-8")
            source = path / "index.md" if path.is_dir() else path
            self.places[path] = places_of(text)
            self.put(self.documents[path], self.rewritten(text, source))
        for place, path, anchor in self.wanted:
            if anchor not in self.places.get(path, {anchor}):
                raise StageError(f"{place}: {path.relative_to(self.root)} has no heading #{anchor}")

    def put(self, name, text):
        target = self.out / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def want(self, path):
        """The name in the stage of a document or a folder that is linked."""
        if path not in self.documents:
            self.documents[path] = self.staged(path / "index.md" if path.is_dir() else path)
            self.todo.append(path)
        return self.documents[path]

    def listing(self, folder):
        """A page that lists the files of a folder without a README."""
        listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=folder,
                                capture_output=True, text=True, check=False)
        names = listed.stdout.split("\n") if listed.returncode == 0 else os.listdir(folder)
        lines = [f"- [{name}]({name})" for name in sorted(name for name in names if name)]
        return f"# {folder.relative_to(self.root)}\n\nThe files of this folder:\n\n" + "\n".join(lines) + "\n"

    def rewritten(self, text, source):
        """The text with the links of the stage."""
        lines, fence = [], None
        for number, line in enumerate(text.splitlines(), 1):
            match = FENCE.match(line)
            if fence is None and match:
                fence = match[1]
                line = self.figure(line, source, number)
            elif fence is not None:
                fence = None if match and match[1] == fence and not match[2] else fence
            elif not line.startswith("    "):
                line = self.line(line, source, number)
            lines.append(line)
        return "\n".join(lines) + "\n"

    def line(self, text, source, number):
        def link(match):
            return match[1] + self.target(match[2], source, number) + match[3]

        # Code that looks like a link is none; the text of a link may be code.
        code = [span for span in CODE.findall(text) if "](" in span]
        for k, span in enumerate(code):
            text = text.replace(span, f"\0{k}\0", 1)
        text = LINK.sub(link, text)
        for k, span in enumerate(code):
            text = text.replace(f"\0{k}\0", span)
        return text

    def figure(self, line, source, number):
        """A picture that the blocks of a page have made: `run:FILE`, or `run:/PAGE/FILE` of another page."""
        match = RUN.match(line)
        if not match or self.results is None:
            return line
        page = source.relative_to(self.pages)
        name = page.stem if len(page.parts) == 1 else str(page.parent)
        picture = match[2].lstrip("/") if match[2].startswith("/") else f"{name}/{match[2]}"
        made = self.results / "pages" / picture
        if not made.is_file():
            raise StageError(f"{page}:{number}: no block makes {match[2]}")
        kept = self.out / "made" / picture
        kept.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(made, kept)
        return f"{match[1]} /{kept.relative_to(self.out)}"

    def target(self, link, source, number):
        """A link of the stage in the place of a link of the tree."""
        if SCHEME.match(link):
            self.links["outside"].add(link)
            return link
        place = f"{source.relative_to(self.root)}:{number}"
        if link.startswith("#"):
            self.wanted.append((place, source, link[1:]))
            return link
        self.links["inside"] += 1
        path, _, anchor = link.partition("#")
        found = self.generated_page(path, source) or self.file(path, source, place)
        if anchor:
            self.wanted.append((place, (source.parent / path).resolve(), anchor))
        here = (self.documents.get(source) or self.staged(source)).parent
        return os.path.relpath(found, here) + (f"#{anchor}" if anchor else "")

    def generated_page(self, path, source):
        """The name of the page that build.py makes of a file that a page links; None: it makes none."""
        linked = (source.parent / path).resolve()
        if self.pages not in source.parents or self.root not in linked.parents:
            return None
        return self.generated.get(str(linked.relative_to(self.root)))

    def file(self, path, source, place):
        linked = (source.parent / path).resolve()
        if not linked.exists() or self.root not in [linked, *linked.parents]:
            raise StageError(f"{place}: {path} is not there")
        if linked.is_dir():
            readme = linked / "README.md"
            return self.want(readme if readme.is_file() else linked)
        if linked.suffix == ".md":
            return self.want(linked)
        kept = self.out / self.staged(linked)
        kept.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(linked, kept)
        self.files.add(kept)
        return self.staged(linked)
