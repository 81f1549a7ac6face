#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The reference of the C++ headers, from Doxygen's XML of them and of delam.h.

Members wrap functions of C, whose comments have the arrays, units and errors. So each member is described by its own
comment, if it has one, and by the functions that its body calls, with the first sentence of each. A struct is described
by its comment and by the members that return it.

    cpp_reference.py HEADER     prints the header as Doxygen reads it (bindings/cpp/Doxyfile: FILTER_PATTERNS)
"""
import copy
import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[3]
COMMENT_LINE = re.compile(r"^(\s*)// ?(.*)$")
COMMENT_BEHIND = re.compile(r"(;)\s+// (.*)$")
C_FUNCTION = re.compile(r"\bdelam_\w+\b")
SENTENCE_END = re.compile(r"(?<!e\.g)(?<!i\.e)[.:](\s|$)")


class Undocumented(Exception):
    """Public members that have neither a comment nor a function of C, or names that the page leaves out."""


def as_documentation(text):
    """The header with the comments of its namespace as documentation; line numbers stay."""
    lines, inside = [], False
    for line in text.split("\n"):
        inside = inside or line.startswith("namespace delam {")
        if inside:
            line = COMMENT_LINE.sub(lambda found: f"{found[1]}/// {quiet(found[2])}", line)
            line = COMMENT_BEHIND.sub(lambda found: f"{found[1]}  ///< {quiet(found[2])}", line)
        lines.append(line)
    return "\n".join(lines)


def quiet(words):
    """Words in which nothing is a command or a link of Doxygen."""
    return re.sub(r"[\\@<>#%]", r"\\\g<0>", words)


def first_sentence(text):
    end = SENTENCE_END.search(text)
    return (text[:end.start()] if end else text).strip() + "."


class Functions:
    """The functions of delam.h: where the site describes each, and its first sentence."""

    def __init__(self, c_xml):
        self.found = {}
        for path in sorted(c_xml.glob("*_8h.xml")):
            for member in ElementTree.parse(path).iter("memberdef"):
                if member.get("kind") != "function":
                    continue
                paragraph = member.find("detaileddescription/para")
                words = " ".join((paragraph.text or "").split()) if paragraph is not None else ""
                self.found[member.findtext("name")] = (member.get("id"), first_sentence(words))

    def paragraphs(self, names):
        for name in names:
            place, sentence = self.found[name]
            paragraph = ElementTree.Element("para")
            paragraph.text = "C: "
            reference(paragraph, place, name).tail = ". " + sentence
            yield paragraph


def reference(paragraph, place, name):
    node = ElementTree.SubElement(paragraph, "ref", {"refid": place, "kindref": "member"})
    node.text = name
    return node


class Source:
    """The bodies of functions, by the file and the lines that Doxygen names."""

    def __init__(self, folder):
        self.folder = folder
        self.lines = {}

    def body(self, member):
        place = member.find("location")
        name, begin, end = place.get("bodyfile"), int(place.get("bodystart", -1)), int(place.get("bodyend", -1))
        if name is None or end < begin:
            return ""
        if name not in self.lines:
            self.lines[name] = (self.folder / name).read_text(encoding="utf-8").split("\n")
        return "\n".join(self.lines[name][begin - 1:end])


def described(member):
    return any((node.text or "").strip() or len(node) for kind in ("briefdescription", "detaileddescription")
               for node in member.findall(f"{kind}/para"))


def is_only_there(member):
    """True for moves, copies and constructors without a body, which say nothing that the class does not."""
    return re.search(r"=\s*(default|delete)$", member.findtext("argsstring") or "") is not None


def complete(xml, c_xml, include):
    """Adds the functions of C, and for structs the members that return them, to the XML of the headers."""
    functions, source = Functions(c_xml), Source(include)
    trees = {path: ElementTree.parse(path)
             for kind in ("class", "struct", "namespacedelam") for path in sorted(xml.glob(f"{kind}*.xml"))}
    returned, missing = {}, []
    for tree in trees.values():
        for section in tree.iter("sectiondef"):
            for member in section.findall("memberdef[@kind='function']"):
                if is_only_there(member):
                    section.remove(member)
                    continue
                called = [name for name in dict.fromkeys(C_FUNCTION.findall(source.body(member)))
                          if name in functions.found]
                if member.get("prot") == "public" and not called and not described(member):
                    missing.append(member.findtext("definition"))
                member.find("detaileddescription").extend(functions.paragraphs(called))
                for kind in member.findall("type/ref") or []:
                    returned.setdefault(kind.get("refid"), []).append(member)
    if missing:
        raise Undocumented("neither a comment nor a function of C: " + ", ".join(sorted(missing)))
    for path, tree in trees.items():
        compound = tree.find("compounddef")
        if compound.get("kind") == "struct" and compound.get("id") in returned:
            paragraph = ElementTree.Element("para")
            paragraph.text = "Returned by "
            members = returned[compound.get("id")]
            for member in members:
                name = re.sub(r"^.*\bdelam::(\S+)$", r"\1", member.findtext("definition"))
                reference(paragraph, member.get("id"), name).tail = ", " if member is not members[-1] else "."
            compound.find("detaileddescription").append(copy.deepcopy(paragraph))
        tree.write(path, encoding="utf-8", xml_declaration=True)


def left_out(xml, page):
    """The classes, structs, enumerations and functions of the namespace that the page does not show."""
    names = {ElementTree.parse(path).findtext("compounddef/compoundname")
             for kind in ("class", "struct") for path in xml.glob(f"{kind}*.xml")}
    for member in ElementTree.parse(xml / "namespacedelam.xml").iter("memberdef"):
        if member.get("kind") in ("function", "enum"):
            names.add(f"delam::{member.findtext('name')}")
    shown = set(re.findall(r"^```\{doxygen\w+\} (\S+)$", page, re.MULTILINE))
    return sorted(name for name in names if name not in shown)


def made(out, c_xml, page):
    """Runs Doxygen on the headers, completes its XML for the page, and returns the folder of it."""
    out.mkdir(parents=True, exist_ok=True)
    settings = (ROOT / "bindings/cpp/Doxyfile").read_text(encoding="utf-8")
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True,
                   env={**os.environ, "DELAM_DOXYGEN_OUTPUT": str(out)})
    complete(out / "xml", c_xml, ROOT / "bindings/cpp/include")
    missing = left_out(out / "xml", page.read_text(encoding="utf-8"))
    if missing:
        raise Undocumented(f"{page} does not show: {', '.join(missing)}")
    return out / "xml"


if __name__ == "__main__":
    print(as_documentation(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")), end="")
