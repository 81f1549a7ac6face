# SPDX-License-Identifier: BSD-3-Clause
"""The public header as data.

A strict reader of the few forms that the header may have: comments, preprocessor lines, opaque handles, callback types
and functions marked DELAM_API. Whatever else stands there (a struct with members, an enumeration, an inline function)
is refused by line, so that the reader is also the rule. A header outside the promise, which is read with the promised
one as `known`, may have structs too:

    typedef struct NAME {
        TYPE member;
        RESULT (*member)(PARAMETERS);
    } NAME;

A member begins on a line of its own. Functions and other structs have pointers to structs only.

The header of a library on top of this one is promised too, and reads `known` without having structs. It alone may take
MPI's types.
"""
import re
from dataclasses import dataclass


class HeaderError(Exception):
    pass


@dataclass
class Parameter:
    type: str  # one space between words, none before '*': "const double*"
    name: str


@dataclass
class Function:
    name: str
    result: str
    parameters: list
    comment: str  # of this function alone, without frame; "" where none stands directly above
    line: int
    callback: bool = False

    def signature(self):
        words = ", ".join(f"{p.type}" for p in self.parameters) or "void"
        return f"{self.result} {self.name}({words})"


@dataclass
class Struct:
    name: str
    members: list  # of Parameter and, where a member is a pointer to a function, of Function
    comment: str
    line: int


@dataclass
class Header:
    path: str
    functions: dict
    callbacks: dict
    handles: list
    constants: dict  # name -> text of the value
    comments: list   # (line, text) of every comment
    structs: dict    # outside the promise alone


BLANK = re.compile(r"\s+")
COMMENT = re.compile(r"/\*.*?\*/", re.S)
DIRECTIVE = re.compile(r"#[^\n]*")
LINKAGE = re.compile(r'extern "C" \{|\}')
HANDLE = re.compile(r"typedef struct (\w+) (\w+);")
CALLBACK = re.compile(r"typedef ([^;{}()]+?)\(\*(\w+)\)\(([^;{}()]*)\);")
FUNCTION = re.compile(r"DELAM_API\s+([^;{}()]+?)(\w+)\(([^;{}()]*)\);")
STRUCT = re.compile(r"typedef struct (\w+) \{\n([^{}]*)\} (\w+);")
MEMBER = re.compile(r"([^;{}()]+?)(\w+)")
POINTER_MEMBER = re.compile(r"([^;{}()]+?)\(\*(\w+)\)\(([^;{}()]*)\)")
CONSTANT = re.compile(r"#define (DELAM_\w+)[ \t]+(\S+)")
NUMBERS = {"int32_t", "int64_t", "double", "uint8_t"}
MPI = {"MPI_Comm", "MPI_Fint"}


def plain(text):
    """A comment without its frame."""
    lines = text[2:-2].split("\n")
    return "\n".join(re.sub(r"^ ?\* ?", "", line) if i else line.lstrip() for i, line in enumerate(lines)).strip()


def squeezed(type_text):
    return re.sub(r"\s*\*\s*", "*", " ".join(type_text.split()))


def parameters_of(text, where):
    text = COMMENT.sub(" ", text)
    if text.strip() == "void":
        return []
    found = []
    for part in text.split(","):
        match = re.fullmatch(r"\s*(.+?)(\w+)\s*", part, re.S)
        if not match or not match.group(1).strip():
            raise HeaderError(f"{where}: parameter '{part.strip()}' needs a type and a name")
        found.append(Parameter(squeezed(match.group(1)), match.group(2)))
    return found


def members_of(text, where, line):
    """Reads the lines between the braces of a struct, the first of which is `line`."""
    members = []
    if COMMENT.search(text):
        raise HeaderError(f"{where}: comments of a struct stand above it")
    *parts, rest = text.split(";")
    if rest.strip():
        raise HeaderError(f"{where}: no ';' after '{rest.strip()}'")
    for part in parts:
        # Behind the ';' of the member before, its line ends.
        gap = part[:len(part) - len(part.lstrip())]
        if members and "\n" not in gap:
            raise HeaderError(f"{where}: member '{part.strip()}' does not begin a line")
        own = line + text.count("\n", 0, text.index(part) + len(gap))
        if match := POINTER_MEMBER.fullmatch(part.strip()):
            members.append(Function(match.group(2), squeezed(match.group(1)), parameters_of(match.group(3), where), "",
                                    own, True))
        elif (match := MEMBER.fullmatch(part.strip())) and match.group(1).strip():
            members.append(Parameter(squeezed(match.group(1)), match.group(2)))
        else:
            raise HeaderError(f"{where}: not a member that a struct may have: {part.strip().splitlines()[0]}")
    names = [member.name for member in members]
    for name in names:
        if names.count(name) > 1:
            raise HeaderError(f"{where}: member {name} is there twice")
    return members


def types_of(member):
    """The types of a parameter or a member; of a function, those of its result and its parameters."""
    return [member.result, *(p.type for p in member.parameters)] if isinstance(member, Function) else [member.type]


def read(path, known=None, promised=False):
    """known: the promised Header, whose handles and callbacks this one may use. promised: this one is as well."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    handles = list(known.handles) if known else []
    callbacks = dict(known.callbacks) if known else {}
    structs = dict(known.structs) if known else {}
    header = Header(str(path), {}, {}, [], {}, [], {})

    def check_types(name, things):
        allowed = NUMBERS | {"void", "char"} | set(handles) | set(callbacks) | set(structs)
        if known and promised:
            allowed |= MPI
        for type_text in (t for thing in things for t in types_of(thing)):
            bare = type_text.replace("const ", "").rstrip("*")
            if bare not in allowed or ((bare in structs or bare in handles) and "*" not in type_text):
                raise HeaderError(f"{where}: {name}: type '{type_text}' is none of the interface's types")

    at = 0
    comment = ""
    while at < len(text):
        line = text.count("\n", 0, at) + 1
        where = f"{path}:{line}"
        if match := BLANK.match(text, at):
            if match.group().count("\n") > 1:
                comment = ""
        elif match := COMMENT.match(text, at):
            comment = plain(match.group())
            header.comments.append((line, comment))
        elif match := DIRECTIVE.match(text, at):
            comment = ""
            if constant := CONSTANT.match(match.group()):
                if constant.group(1) != "DELAM_API":
                    header.constants[constant.group(1)] = constant.group(2)
                    if not re.fullmatch(r"-?\d+", constant.group(2)):
                        raise HeaderError(f"{where}: no integer constant: {match.group()}")
            if re.match(r"#define \w+\(", match.group()):
                raise HeaderError(f"{where}: a macro with arguments: {match.group()}")
        elif match := LINKAGE.match(text, at):
            comment = ""
        elif match := HANDLE.match(text, at):
            header.handles.append(match.group(1))
            handles.append(match.group(1))
            comment = ""
        elif match := CALLBACK.match(text, at) or FUNCTION.match(text, at):
            callback = match.re is CALLBACK
            function = Function(match.group(2), squeezed(match.group(1)), parameters_of(match.group(3), where), comment,
                                line, callback)
            into = header.callbacks if callback else header.functions
            if function.name in header.callbacks or function.name in header.functions:
                raise HeaderError(f"{where}: {function.name} is declared twice")
            into[function.name] = function
            if callback:
                callbacks[function.name] = function
            check_types(function.name, [function])
            comment = ""
        elif known and not promised and (match := STRUCT.match(text, at)):
            struct = Struct(match.group(1), members_of(match.group(2), where, line + 1), comment, line)
            if match.group(3) != struct.name:
                raise HeaderError(f"{where}: struct {struct.name} is named {match.group(3)} at its end")
            if struct.name in structs:
                raise HeaderError(f"{where}: {struct.name} is declared twice")
            header.structs[struct.name] = structs[struct.name] = struct
            check_types(struct.name, struct.members)
            comment = ""
        else:
            raise HeaderError(f"{where}: not a form that the header may have: {text[at:at + 60].splitlines()[0]}")
        at = match.end()
    return header
