# SPDX-License-Identifier: BSD-3-Clause
"""Julia files as syntax trees, by tree-sitter and its grammar of Julia, which node runs.

Both come from the npm registry as parser/package-lock.json pins them, by hash, through the ordinary client; the three
files that are needed stay in a folder of the build tree, so that the network is needed once.
"""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

PARSER = pathlib.Path(__file__).resolve().parent / "parser"
LOCK = PARSER / "package-lock.json"
FILES = ("web-tree-sitter/tree-sitter.js", "web-tree-sitter/tree-sitter.wasm",
         "tree-sitter-julia/tree-sitter-julia.wasm")


class Unavailable(Exception):
    """What is missing for the files to be parsed."""


def node():
    return shutil.which("node") or shutil.which("nodejs")


def fetch(folder):
    """The parser in `folder`, fetched unless it is there already in the versions of the lock file."""
    if node() is None:
        raise Unavailable("node is not installed (Debian: nodejs)")
    folder = pathlib.Path(folder)
    stamp = folder / LOCK.name
    if stamp.exists() and stamp.read_bytes() == LOCK.read_bytes():
        return folder
    npm = shutil.which("npm")
    if npm is None:
        raise Unavailable("npm is not installed (Debian: npm)")
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder) as work:
        for file in ("package.json", LOCK.name):
            shutil.copy(PARSER / file, work)
        command = [npm, "ci", "--ignore-scripts", "--omit=peer", "--omit=optional", "--no-audit", "--no-fund",
                   "--fetch-retries=1", "--fetch-timeout=60000"]
        try:
            done = subprocess.run(command, cwd=work, capture_output=True, text=True, timeout=240)
        except subprocess.TimeoutExpired:
            raise Unavailable("the npm registry does not answer") from None
        if done.returncode != 0:
            # What comes but is not what was pinned is no absence.
            if "EINTEGRITY" in done.stderr:
                raise RuntimeError(f"npm: the parser is not the one of {LOCK.name}:\n{done.stderr}")
            first = next((line for line in done.stderr.splitlines() if "error" in line.lower()), "no reason given")
            raise Unavailable(f"npm could not fetch the parser: {first}")
        for file in FILES:
            os.replace(pathlib.Path(work) / "node_modules" / file, folder / pathlib.Path(file).name)
    shutil.copy(LOCK, stamp)
    return folder


class Node:
    """A node of a tree. children: without punctuation and comments; text: of a leaf, "" otherwise; positional: of a
    list of arguments, how many children stand before its semicolon."""

    __slots__ = ("type", "line", "children", "text", "positional", "below")

    def __init__(self, data):
        self.type, self.line, _, content = data
        self.below = None
        self.text = content if isinstance(content, str) else ""
        nodes = [] if isinstance(content, str) else [Node(item) for item in content]
        self.children, self.positional = [], None
        for node in nodes:
            if node.type == ";" and self.positional is None:
                self.positional = len(self.children)
            if node.text != node.type and not node.type.endswith("comment"):
                self.children.append(node)
        if self.positional is None:
            self.positional = len(self.children)

    def walk(self):
        """This node and all below it, in the order of the text."""
        if self.below is None:
            self.below, left = [], [self]
            while left:
                node = left.pop()
                self.below.append(node)
                left.extend(reversed(node.children))
        return self.below

    def all(self, kind):
        return [node for node in self.walk() if node.type == kind]

    def child(self, kind):
        return next((node for node in self.children if node.type == kind), None)

    def source(self):
        """The text without blanks, for messages and for comparing."""
        if not self.children:
            return self.text
        inside = [child.source() for child in self.children]
        if self.type == "field_expression":
            return ".".join(inside)
        if self.type == "curly_expression":
            return "{" + ",".join(inside) + "}"
        if self.type in ("argument_list", "tuple_expression"):
            return "(" + ",".join(inside) + ")"
        if self.type == "typed_expression":
            return "::".join(inside)
        return "".join(inside)


def parse(texts, folder):
    """{name: Node} of {name: text}; `folder` as fetch has it."""
    done = subprocess.run([node(), str(PARSER / "parse.js"), str(folder)], input=json.dumps(texts), capture_output=True,
                          text=True)
    if done.returncode != 0:
        raise RuntimeError(f"node {PARSER / 'parse.js'}:\n{done.stderr}")
    return {name: Node(data) for name, data in json.loads(done.stdout).items()}
