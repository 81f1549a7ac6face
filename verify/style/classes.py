# SPDX-License-Identifier: BSD-3-Clause
"""Finds the classes of C++ files: the public methods that each declares, and the files in which its members are defined.
Reads tokens, not the layout; what a macro writes it does not see."""

import re

import scanner

SCOPE = re.compile(r"(?:(?:inline|typedef)\s+)*(?P<kind>namespace|class|struct|union|extern\s*\"\")(?!\w)(?P<rest>[^=(]*)$")
FOREIGN = re.compile(r"(?:friend|extern(?:\s*\"\")?)\s")  # before what is no member, but may have a body
NOTHING = re.compile(r"(?:using|typedef|static_assert|enum)\b")
ACCESS = re.compile(r"\s*(public|protected|private)\s*:")
# The name of an operator; that of a conversion ends with its type.
OPERATOR = re.compile(r"\boperator\s*(?:\(\s*\)|\[\s*\]|\"\"\s*\w+|[^\s\w(]+|\w[^(]*)")
CONDITION = re.compile(r"\b(?:alignas|decltype|explicit|requires|__attribute__)\s*$")  # the brackets behind belong to it
NAME = re.compile(r"(?P<of>(?:\w+\s*::\s*)*)(?P<name>~?\s*\w+)\s*$")
POINTER = re.compile(r"\s*(?:\w+\s*::\s*)*[*&]")  # what stands in brackets where the name of a function should be


class Class:
    """A class. methods: names of those that are public, an overload again, but not what overrides a base's."""

    def __init__(self, key, file, line):
        self.key, self.file, self.line, self.methods = key, file, line, []
        self.elsewhere = set()  # other files in which members are defined


def behind(text, n):
    """The place behind the bracket that closes the one at n."""
    depth = 0
    for m in re.compile(r"[(){}\[\]]").finditer(text, n):
        depth += 1 if m.group() in "({[" else -1
        if depth == 0:
            return m.end()
    raise ValueError("a bracket that nothing closes")


def behind_angles(text, n):
    """The place behind the angle bracket that closes the one at n. Comparisons within stand in round brackets."""
    depth = 0
    while n < len(text):
        if text[n] in "([{":
            n = behind(text, n)
            continue
        depth += {"<": 1, ">": 0 if text[n - 1] == "-" else -1}.get(text[n], 0)
        n += 1
        if depth == 0:
            break
    return n


def plain(head):
    """A declaration up to its parameters or value without attributes, conditions and what stands in angle brackets."""
    head = OPERATOR.sub("operator_", head, count=1)
    n = 0
    while (m := re.compile(r"[<=({\[]").search(head, n)) is not None:
        c, n = m.group(), m.start()
        condition = CONDITION.search(head[:n])
        if c == "<":
            head = head[:n] + head[behind_angles(head, n):]
        elif c in "({" and condition:  # of a requires-expression, parameters and body follow one another
            end = behind(head, n)
            again = re.compile(r"\s*[({\[]").match(head, end) if condition.group().startswith("requires") else None
            if again and re.search(r"\brequires\s+requires\s*$", head[:n]):
                end = behind(head, again.end() - 1)
            head = head[:condition.start()] + " " + head[end:]
            n = condition.start()
        elif c == "[" and head[n:n + 2] == "[[":
            head = head[:n] + head[behind(head, n):]
        else:
            break
    return re.sub(r"\b(?:template|requires)\b", " ", head).strip()


class Declaration:
    """What a declaration declares. of: the class before the name; tail: the text behind the parameters, None without."""

    def __init__(self, head):
        self.of, self.name, self.tail, self.foreign = "", "", None, False
        if re.match(r"(?:extern\s+)?template\b(?!\s*<)", head):
            return  # an instantiation
        text = plain(head)
        while (m := FOREIGN.match(text)) is not None:
            self.foreign, text = True, text[m.end():]
        if NOTHING.match(text):
            return
        m = re.search(r"[=({\[]", text)
        end = m.start() if m else len(text)
        if m and m.group() == "(":
            inside, self.tail = text[end + 1:behind(text, end) - 1], text[behind(text, end):]
            if POINTER.match(inside):  # a pointer to a function, or a function that returns one
                self.tail = inside if re.search(r"\w\s*\(", inside) else None
                text = re.sub(r"^.*?(\w+)\s*(?:[(\[].*)?$", r"\1", inside.strip(), flags=re.S)
                end = len(text)
        if (m := NAME.search(text[:end])) is not None:
            self.of, self.name = (re.sub(r"\s", "", m[k]) for k in ("of", "name"))
        else:
            self.tail = None

    def counts(self, owner):
        """True if it is a method in the class of this name, no constructor and none that overrides another."""
        if self.tail is None or self.foreign or self.name == owner or self.name.startswith("~"):
            return False
        return re.search(r"\b(?:override|final)\b|=\s*delete\b", re.split(r"(?<!:):(?!:)", self.tail)[0]) is None


class Reader:
    """Reads a file: its classes, and the members that it defines outside of them as (scope, class)."""

    def __init__(self, file, text):
        self.file, self.code = file, scanner.bare(text)
        self.classes, self.defined = [], []
        self.read(0, len(self.code), "", None, False)

    def read(self, n, end, scope, of, public):
        """Reads the declarations between two places, those of a namespace or of class `of`."""
        start, mark = n, re.compile(r"[;{(\[]|(?<!:):(?!:)")
        while (m := mark.search(self.code, n, end)) is not None:
            n, c = m.end(), m.group()
            if c in "([":
                n = behind(self.code, m.start())
            elif c == "{":
                n = behind(self.code, m.start())
                if self.braces(start, m.start(), n, scope, of, public):
                    start = n
                else:  # a value: the declaration goes on
                    self.code = self.code[:m.start()] + scanner.blank_braces(self.code[m.start():n]) + self.code[n:]
            elif c == ";":
                self.note(Declaration(self.code[start:m.start()].strip()), False, scope, of, public)
                start = n
            elif of and (access := ACCESS.fullmatch(self.code[start:n])) is not None:
                public, start = access[1] == "public", n

    def braces(self, start, brace, end, scope, of, public):
        """Reads a declaration with braces; false: the braces are only a value in it."""
        head = self.code[start:brace].strip()
        if (m := SCOPE.match(plain(head))) is not None:
            name = re.sub(r"\bfinal\s*$", "", re.split(r"(?<!:):(?!:)", m["rest"])[0])
            name = re.sub(r"\s", "", "".join(NAME.search(name).groups())) if name.strip() else ""
            if m["kind"].startswith("extern"):
                self.read(brace + 1, end - 1, scope, None, False)
            elif m["kind"] == "namespace":
                self.read(brace + 1, end - 1, f"{scope}{name or '(' + self.file + ')'}::", None, False)
            elif name:
                first = brace - len(self.code[start:brace].lstrip())
                found = Class(scope + name, self.file, self.code.count("\n", 0, first) + 1)
                self.classes.append(found)
                self.read(brace + 1, end - 1, found.key + "::", found, m["kind"] != "class")
            return True
        declared = Declaration(head)
        if declared.tail is None or scanner.initialises_member(head):
            return False
        self.note(declared, True, scope, of, public)
        return True

    def note(self, declared, with_body, scope, of, public):
        """Notes a method of class `of`, or a member that is defined outside of its class."""
        if of is not None:
            if public and declared.counts(of.key.split("::")[-1]):
                of.methods.append(declared.name)
        elif declared.of and (with_body or declared.tail is None or "=" in declared.tail):
            self.defined.append((scope, declared.of[:-2]))


def find(texts):
    """The classes of these files, whose texts stand under their names."""
    readers = [Reader(file, text) for file, text in texts.items()]
    found = [c for reader in readers for c in reader.classes]
    known = {c.key: c for c in reversed(found)}  # a template stands before its specialisations
    for reader in readers:
        for scope, of in reader.defined:
            while scope and scope + of not in known:
                scope = re.sub(r"[^:]*::$", "", scope)
            owner = known.get(scope + of)
            if owner is not None and owner.file != reader.file:
                owner.elsewhere.add(reader.file)
    return found
