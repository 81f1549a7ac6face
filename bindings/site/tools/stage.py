# SPDX-License-Identifier: BSD-3-Clause
"""Gathers what Sphinx reads: the pages of the site, and the documents of the tree from where they are.

A page `pages/X.md` becomes `X.md`, a document `PATH.md` of the tree `tree/PATH.md`. Links keep their meaning: those to a
document lead to its page, those to a folder to its README, or to a list of its files, those to any other file to
a copy of it. What is linked is gathered as well, so that no link leads out of the site, unless it names a host.
"""
import os
import re
import shutil
import subprocess

from blocks import FENCE

LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^()\s]+)(\))")
CODE = re.compile(r"(`+[^`]*`+)")
RUN = re.compile(r"^(`{3,}\{figure\}) run:(\S+)$")
SCHEME = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


class StageError(Exception):
    """A link that leads nowhere."""


class Stage:
    """root: of the sources; out: the folder to fill; results: where the blocks of the pages have run."""

    def __init__(self, root, site, out, results):
        self.root, self.site, self.out, self.results = root, site, out, results
        self.pages = site / "pages"
        self.documents, self.todo, self.files, self.generated = {}, [], set(), set()
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
            self.put(self.documents[path], self.rewritten(text, source))

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
                parts = CODE.split(line)
                parts[::2] = [self.line(part, source, number) for part in parts[::2]]
                line = "".join(parts) if len(parts) == 1 or "](" not in line else self.line(line, source, number)
            lines.append(line)
        return "\n".join(lines) + "\n"

    def line(self, text, source, number):
        def link(match):
            return match[1] + self.target(match[2], source, number, match[1].startswith("!")) + match[3]
        return LINK.sub(link, text)

    def figure(self, line, source, number):
        """A picture that the blocks of a page have made."""
        match = RUN.match(line)
        if not match:
            return line
        page = source.relative_to(self.pages)
        name = page.stem if len(page.parts) == 1 else str(page.parent)
        made = self.results / "pages" / name / match[2]
        if not made.is_file():
            raise StageError(f"{page}:{number}: no block makes {match[2]}")
        kept = self.out / "made" / name / match[2]
        kept.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(made, kept)
        return f"{match[1]} /{kept.relative_to(self.out)}"

    def target(self, link, source, number, picture):
        """A link of the stage in the place of a link of the tree."""
        if SCHEME.match(link):
            self.links["outside"].add(link)
            return link
        if link.startswith("#"):
            return link
        self.links["inside"] += 1
        path, _, anchor = link.partition("#")
        found = self.generated_page(path, source) or self.file(path, source, number, picture)
        here = (self.documents.get(source) or self.staged(source)).parent
        return os.path.relpath(found, here) + (f"#{anchor}" if anchor else "")

    def generated_page(self, path, source):
        """The name of a page that build.py makes, if this is one."""
        if self.pages not in source.parents:
            return None
        wanted = os.path.normpath(source.relative_to(self.pages).parent / path)
        return wanted if wanted in self.generated else None

    def file(self, path, source, number, picture):
        linked = (source.parent / path).resolve()
        if not linked.exists() or self.root not in [linked, *linked.parents]:
            raise StageError(f"{source.relative_to(self.root)}:{number}: {path} is not there")
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
