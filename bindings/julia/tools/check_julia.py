#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the Julia package with the public header, from the syntax of its files alone: no Julia is needed.

    check_julia.py --parser FOLDER [--header delam.h]     exit 0: they agree; 1: each difference a line; 77: not parsed

FOLDER keeps the parser, which is fetched when it is not there (syntax.py). What is looked at:

raw layer    src/raw.jl has every function, handle, callback type and constant of the header and nothing else. Each
             function is one ccall of the same name with its own arguments in their order; result and arguments are of
             the header's ABI class: integers by width and sign, floats by width, texts, pointers by what they point
             to. Int and its like are refused: their width is the machine's.
callbacks    each @cfunction is marked with the callback type it stands for and has its signature, and the function
             behind it takes that many arguments
the rest     only raw.jl calls C. Calls of Raw.f name functions that are there, with their number of arguments; literal
             ones are of the right class. Names that are used are defined, in the package or in BASE below, and calls
             of the package's own functions are ones that some method takes. What is exported is there, what is
             included too.
"""
import argparse
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = HERE.parent
ROOT = HERE.parents[2]
HEADER = ROOT / "include" / "delam" / "delam.h"
SKIPPED = 77
sys.path[:0] = [str(ROOT / "verify" / "abi"), str(HERE)]

import header as public_header  # noqa: E402
import syntax  # noqa: E402
from names import BASE, FIELDS  # noqa: E402

RAW = "src/raw.jl"
C_SCALARS = {"int32_t": ("integer", 4), "int64_t": ("integer", 8), "uint8_t": ("byte", 1), "double": ("float", 8),
             "char": ("char", 1), "void": ("void", 0)}
JULIA_SCALARS = {"Int32": ("integer", 4), "Cint": ("integer", 4), "Int64": ("integer", 8), "Clonglong": ("integer", 8),
                 "UInt8": ("byte", 1), "Cuchar": ("byte", 1), "Cchar": ("char", 1), "Cdouble": ("float", 8),
                 "Float64": ("float", 8), "Cfloat": ("float", 4), "Float32": ("float", 4), "UInt32": ("unsigned", 4),
                 "UInt64": ("unsigned", 8), "Cuint": ("unsigned", 4), "Int16": ("integer", 2), "Cvoid": ("void", 0),
                 "Nothing": ("void", 0)}
MACHINE_WIDTH = {"Int", "UInt", "Clong", "Culong", "Csize_t", "Cssize_t"}
LITERALS = {"integer_literal": "integer", "float_literal": "float", "string_literal": "text", "char_literal": "char",
            "boolean_literal": "bool"}


def c_class(text, callbacks):
    """ABI class of a type of the header: (kind, width), ("text",) or ("pointer", class of what it points to)."""
    if text in callbacks:
        return "callback", text
    base, stars = text.replace("const ", "").rstrip("*"), text.count("*")
    inner = C_SCALARS.get(base, ("handle", base))
    if base == "char" and stars > 0 and text.startswith("const"):
        inner, stars = ("text",), stars - 1
    elif base == "char" and stars > 0:
        # A buffer of characters is one of bytes.
        inner = ("byte", 1)
    for _ in range(stars):
        inner = "pointer", inner
    return inner


def julia_class(node, callbacks):
    """The same of a type of a ccall; a string says what is wrong with it."""
    if node.type == "parametrized_type_expression":
        name, braces = node.children[0].text, node.children[1].children
        if name not in ("Ptr", "Ref") or len(braces) != 1:
            return f"{node.source()} is no type of a ccall"
        inner = julia_class(braces[0], callbacks)
        return inner if isinstance(inner, str) else ("pointer", inner)
    if node.type != "identifier":
        return f"{node.source()} is no type of a ccall"
    name = node.text
    if name in MACHINE_WIDTH:
        return f"{name} is as wide as the machine's words; Int32 or Int64"
    if name in callbacks:
        return "callback", name
    if name == "Cstring":
        return ("text",)
    return JULIA_SCALARS.get(name, ("handle", name))


def described(kind):
    if kind[0] == "pointer":
        return f"pointer to {described(kind[1])}"
    if kind[0] in ("integer", "unsigned", "float"):
        return f"{kind[0]} of {8 * kind[1]} bits"
    return " ".join(str(word) for word in kind if word != 0 and not (kind[0] in ("byte", "char") and word == 1))


class Signature:
    """What a method takes: positional arguments from least to most (None: any number) and its keywords (None: any)."""

    def __init__(self, call=None):
        arguments = call.child("argument_list") if call else None
        self.names, self.least, self.most, self.keywords = [], 0, 0, set()
        for i, item in enumerate(arguments.children if arguments else []):
            initial = item.type in ("named_argument", "assignment")
            core = item.children[0] if initial else item
            splat = core.type == "splat_expression"
            core = core.children[0] if splat else core
            name = core.children[0] if core.type == "typed_expression" else core
            if i >= arguments.positional:
                if splat:
                    self.keywords = None
                elif self.keywords is not None:
                    self.keywords.add(name.text)
                continue
            self.names.append(name.text)
            if splat:
                self.most = None
                continue
            self.least += 0 if initial else 1
            if self.most is not None:
                self.most += 1

    @classmethod
    def of_fields(cls, count):
        """The constructor that a struct has by itself."""
        made = cls()
        made.least = made.most = count
        return made

    def takes(self, count, keywords, open_ended):
        if self.keywords is not None and not keywords <= self.keywords:
            return False
        if open_ended:
            return self.most is None or count <= self.most
        return self.least <= count and (self.most is None or count <= self.most)


def definition(node):
    """(call, body) of a function_definition or of a short one, else None."""
    if node.type == "function_definition" or node.type == "macro_definition":
        head, body = node.children[0], node.children[1:]
        head = head.children[0] if head.type == "signature" else head
    elif node.type == "assignment":
        head, body = node.children[0], node.children[1:]
    else:
        return None
    while head.type in ("typed_expression", "where_expression"):
        head = head.children[0]
    return (head, body) if head.type == "call_expression" else None


def callee(call):
    """The name of what is called, "" where it is no plain name; A.f gives f."""
    head = call.children[0]
    if head.type == "field_expression":
        head = head.children[-1]
    if head.type == "parametrized_type_expression":
        head = head.children[0]
    return head.text if head.type == "identifier" else ""


class Check(list):
    """The differences, each a line "file:line: text"."""

    def __init__(self, header, trees):
        super().__init__()
        self.header, self.trees = header, trees
        self.used = set()
        self.definition_nodes = set()
        for name, tree in trees.items():
            for node in tree.walk():
                if node.type in ("ERROR", "MISSING"):
                    self.say(name, node, f"is not parsed: {node.source()[:60]!r}")
        if not self:
            self.raw_layer(trees[RAW])
            self.hand_written()
            self.names()

    def say(self, file, node, text):
        self.append(f"{file}:{node.line}: {text}")

    # ---- raw.jl

    def raw_layer(self, tree):
        header = self.header
        module = tree.all("module_definition")
        if len(module) != 1:
            self.say(RAW, tree, "one module is expected")
            return
        seen, constants, handles, functions = {}, {}, set(), None
        for node in module[0].children[1:]:
            found = definition(node)
            if found:
                name = callee(found[0])
                if name in seen:
                    self.say(RAW, node, f"{name} is defined twice")
                seen[name] = node
                if name not in header.functions:
                    self.say(RAW, node, f"{name} is not in the header")
                else:
                    self.raw_function(node, header.functions[name], *found)
            elif node.type == "const_statement" and node.child("assignment"):
                target, _, value = node.child("assignment").children
                constants[target.text] = value
            elif node.type == "struct_definition" and len(node.children) == 1:
                handles.add(node.children[0].source())
            else:
                self.say(RAW, node, f"a {node.type} has no place here")
        for name in header.functions:
            if name not in seen:
                self.say(RAW, module[0], f"{name} of the header is missing")
        for name in sorted(set(header.handles) ^ handles):
            self.say(RAW, module[0], f"handle {name}: {'missing' if name in header.handles else 'not in the header'}")
        library = constants.pop("libdelam", None)
        expected = f"libdelam.so.{header.constants['DELAM_ABI']}"
        if library is None or "".join(leaf.text for leaf in library.walk()) != expected:
            self.say(RAW, library or module[0], f"libdelam is not {expected}")
        functions = constants.pop("FUNCTIONS", None)
        listed = [leaf.text for leaf in functions.walk() if leaf.type == "identifier"] if functions else []
        if listed != list(header.functions):
            self.say(RAW, functions or module[0], "FUNCTIONS are not those of the header, in its order")
        for name in header.callbacks:
            value = constants.pop(name, None)
            if value is None or value.source() != "Ptr{Cvoid}":
                self.say(RAW, value or module[0], f"callback {name} is not Ptr{{Cvoid}}")
        for name in sorted(set(header.constants) | set(constants)):
            have, want = constants.get(name), f"Int32({header.constants.get(name)})"
            if have is None or have.source() != want:
                here = have.source() if have else "missing"
                self.say(RAW, have or module[0], f"{name} is {here}, in the header {want}")

    def raw_function(self, node, function, call, body):
        name = function.name
        own = Signature(call)
        calls = [item for part in body for item in part.all("macrocall_expression")]
        typed = calls[0].child("macro_argument_list") if len(calls) == 1 else None
        typed = typed.children[0] if typed and len(typed.children) == 1 else None
        if (len(body) != 1 or typed is None or calls[0] is not body[0] or typed.type != "typed_expression"
                or calls[0].children[0].source() != "ccall" or typed.children[0].type != "call_expression"):
            self.say(RAW, node, f"{name} is not a single @ccall with a result")
            return
        target, result = typed.children
        if target.children[0].source() != f"libdelam.{name}":
            self.say(RAW, node, f"{name} calls {target.children[0].source()}")
        self.compare(RAW, node, f"{name} returns", c_class(function.result, self.header.callbacks), result)
        items = target.child("argument_list").children
        if len(items) != len(function.parameters):
            self.say(RAW, node, f"{name} passes {len(items)} arguments, the function takes {len(function.parameters)}")
            return
        passed = []
        for item, parameter in zip(items, function.parameters):
            if item.type != "typed_expression":
                self.say(RAW, item, f"{name}: argument {item.source()} has no type")
                return
            passed.append(item.children[0].text)
            if passed[-1].rstrip("_") != parameter.name:
                self.say(RAW, item, f"{name}: argument '{passed[-1]}' is '{parameter.name}' in the header")
            self.compare(RAW, item, f"{name}: argument '{parameter.name}' is",
                         c_class(parameter.type, self.header.callbacks), item.children[1])
        if passed != own.names or own.least != own.most or own.keywords:
            self.say(RAW, node, f"{name} takes ({', '.join(own.names)}) and passes ({', '.join(passed)})")

    def compare(self, file, node, what, expected, kind):
        here = julia_class(kind, self.header.callbacks)
        if isinstance(here, str):
            self.say(file, node, f"{what} {described(expected)}; {here}")
        elif here != expected:
            self.say(file, node, f"{what} {described(expected)}, here {kind.source()}")

    # ---- everything else against raw.jl

    def hand_written(self):
        header = self.header
        known = set(header.functions) | set(header.handles) | set(header.callbacks) | set(header.constants)
        known |= {"libdelam", "FUNCTIONS"}
        for file, tree in self.trees.items():
            if file == RAW:
                continue
            called = set()
            for node in tree.all("call_expression") + tree.all("broadcast_call_expression"):
                if node.children[0].text == "ccall":
                    self.say(file, node, "calls C by itself; raw.jl alone does")
                if self.of_raw(node.children[0]):
                    called.add(id(node.children[0]))
                    self.raw_call(file, node, node.children[0].children[-1].text)
            for node in tree.all("macrocall_expression"):
                name = node.children[0].source()
                if name == "ccall":
                    self.say(file, node, "calls C by itself; raw.jl alone does")
            qualified = set()
            for node in tree.all("field_expression"):
                if not self.of_raw(node):
                    continue
                name = node.children[-1].text
                qualified.add(id(node.children[-1]))
                if name not in known:
                    self.say(file, node, f"Raw.{name} is not there")
                elif name in header.functions and id(node) not in called:
                    self.say(file, node, f"Raw.{name} is named but not called")
            for leaf in tree.all("identifier"):
                if leaf.text in known - {"libdelam", "FUNCTIONS"} and id(leaf) not in qualified:
                    self.say(file, leaf, f"{leaf.text} is used without Raw")
            self.cfunctions(file, tree)

    @staticmethod
    def of_raw(node):
        """Raw.x or Delam.Raw.x"""
        return node.type == "field_expression" and node.children[0].source() in ("Raw", "Delam.Raw")

    def raw_call(self, file, node, name):
        function = self.header.functions.get(name)
        if function is None:
            return
        self.used.add(name)
        arguments = node.child("argument_list")
        items = arguments.children if arguments else []
        if (node.type != "call_expression" or arguments is None or arguments.positional != len(items)
                or node.child("do_clause") or any(i.type in ("splat_expression", "named_argument") for i in items)):
            self.say(file, node, f"Raw.{name} is called with more than plain arguments")
            return
        if len(items) != len(function.parameters):
            self.say(file, node, f"Raw.{name} takes {len(function.parameters)} arguments, here {len(items)}")
            return
        for item, parameter in zip(items, function.parameters):
            expected = c_class(parameter.type, self.header.callbacks)
            plain = item.children[-1] if item.type == "unary_expression" else item
            literal = LITERALS.get(plain.type)
            if item.type == "call_expression" and item.children[0].text in ("length", "size"):
                literal = "integer"
            if item.text == "C_NULL":
                fits = expected[0] in ("pointer", "callback", "text")
            elif item.type == "call_expression" and item.children[0].source().split("{")[0] == "Ref":
                fits = expected[0] == "pointer"
            elif literal is None:
                continue
            else:
                fits = literal == expected[0] or literal == "integer" and expected[0] == "float"
            if not fits:
                self.say(file, item, f"Raw.{name}: argument '{parameter.name}' is {described(expected)}, "
                                     f"here {item.source()}")

    def cfunctions(self, file, tree):
        marked = set()
        for node in tree.all("typed_expression"):
            macro = node.children[0]
            if macro.type != "macrocall_expression" or macro.children[0].source() != "cfunction":
                continue
            marked.add(id(macro))
            kind = node.children[-1]
            callback = self.header.callbacks.get(kind.children[-1].text) if self.of_raw(kind) else None
            if callback is None:
                self.say(file, node, f"@cfunction stands for {kind.source()}, which is no callback of the header")
                continue
            arguments = macro.child("argument_list")
            items = arguments.children if arguments else []
            if len(items) != 3 or items[0].type != "identifier" or items[2].type != "tuple_expression":
                self.say(file, node, "@cfunction(name, Result, (Arguments...,)) is expected")
                continue
            what = f"{callback.name}:"
            self.compare(file, node, f"{what} returns", c_class(callback.result, self.header.callbacks), items[1])
            kinds = items[2].children
            if len(kinds) != len(callback.parameters):
                self.say(file, node, f"{what} takes {len(callback.parameters)} arguments, here {len(kinds)}")
                continue
            for kind, parameter in zip(kinds, callback.parameters):
                self.compare(file, node, f"{what} argument '{parameter.name}' is",
                             c_class(parameter.type, self.header.callbacks), kind)
            behind = [Signature(found[0]) for tree in self.trees.values() for item in tree.walk()
                      if (found := definition(item)) and callee(found[0]) == items[0].text]
            if not any(method.takes(len(kinds), set(), False) for method in behind):
                self.say(file, node, f"{what} no {items[0].text} with {len(kinds)} arguments is there")
        for node in tree.all("macrocall_expression"):
            if node.children[0].source() == "cfunction" and id(node) not in marked:
                self.say(file, node, "@cfunction does not say which callback of the header it stands for")

    # ---- names, calls of the package's own functions, exports, includes

    def names(self):
        """Without regard to scope: this finds what is misspelt or forgotten, not what is shadowed."""
        own = {file: tree for file, tree in self.trees.items() if file != RAW}
        methods, fields, defined = {}, set(), set()
        for tree in own.values():
            for node in tree.walk():
                self.collect(node, methods, fields, defined)
        known = defined | BASE | set(methods)
        behind_points = known | fields | FIELDS
        for file, tree in own.items():
            skipped = set()
            for node in tree.walk():
                if node.type == "field_expression":
                    last = node.children[-1]
                    skipped.add(id(last))
                    if not self.of_raw(node) and last.text not in behind_points:
                        self.say(file, node, f"nothing here has a field {last.text}")
                elif node.type in ("quote_expression", "macro_identifier"):
                    skipped.update(id(leaf) for leaf in node.walk())
                elif node.type == "binary_expression" and node.children[1].text == "-->":
                    # An attribute of a plot.
                    skipped.add(id(node.children[0]))
                elif node.type in ("named_argument", "named_field", "assignment"):
                    skipped.add(id(node.children[0]))
                elif node.type in ("using_statement", "import_statement"):
                    skipped.update(id(leaf) for leaf in node.walk())
                elif node.type == "identifier" and id(node) not in skipped:
                    if node.text not in known:
                        self.say(file, node, f"{node.text} is not defined")
            self.calls(file, tree, methods)
        main = self.trees.get("src/Delam.jl")
        if main is None:
            return
        for node in main.all("export_statement"):
            for leaf in node.children:
                if leaf.text not in defined | set(methods):
                    self.say("src/Delam.jl", leaf, f"{leaf.text} is exported and not there")
        included = {f"src/{node.all('content')[0].text}" for node in main.all("call_expression")
                    if node.children[0].text == "include"}
        sources = {file for file in self.trees if file.startswith("src/")} - {"src/Delam.jl"}
        for name in sorted(included ^ sources):
            self.say("src/Delam.jl", main, f"{name} is {'not there' if name in included else 'not included'}")

    def collect(self, node, methods, fields, defined):
        found = definition(node)
        if found and callee(found[0]):
            signature = Signature(found[0])
            self.definition_nodes.add(id(found[0]))
            # What is added to a function of Julia is one method among others.
            if found[0].children[0].type != "field_expression":
                methods.setdefault(callee(found[0]), []).append(signature)
            defined.update(signature.names)
            defined.update(signature.keywords or ())
            arguments = found[0].child("argument_list")
            for item in arguments.children if arguments else []:
                core = item.children[0] if item.type in ("named_argument", "splat_expression") else item
                core = core.children[0] if core.type in ("typed_expression", "splat_expression") else core
                defined.update(leaf.text for leaf in core.all("identifier"))
        elif node.type == "function_definition":
            defined.update(leaf.text for leaf in node.children[0].all("identifier"))
            methods.setdefault(node.children[0].source(), [])
        elif node.type == "assignment" and node.children[0].type in ("identifier", "open_tuple", "tuple_expression",
                                                                      "typed_expression"):
            target = node.children[0]
            defined.update(leaf.text for leaf in (target.children[:1] if target.type == "typed_expression" else
                                                  target.all("identifier")))
        elif node.type in ("for_binding", "let_binding"):
            defined.update(leaf.text for leaf in node.children[0].all("identifier"))
        elif node.type == "arrow_function_expression":
            defined.update(leaf.text for leaf in node.children[0].all("identifier"))
        elif node.type == "do_clause" and node.child("argument_list"):
            defined.update(leaf.text for leaf in node.child("argument_list").all("identifier"))
        elif node.type == "catch_clause" and node.children and node.children[0].type == "identifier":
            defined.add(node.children[0].text)
        elif node.type == "where_expression":
            defined.update(leaf.text for leaf in node.children[-1].all("identifier"))
        elif node.type in ("struct_definition", "abstract_definition"):
            head = node.children[0]
            name = head.all("identifier")[0]
            defined.add(name.text)
            members = [item for item in node.children[1:] if item.type in ("identifier", "typed_expression")]
            fields.update(item.children[0].text if item.children else item.text for item in members)
            defined.update(leaf.text for item in members for leaf in item.all("identifier")[:1])
            if node.type == "struct_definition":
                inner = [item for item in node.walk() if (found := definition(item)) and callee(found[0]) == name.text]
                if not inner:
                    methods.setdefault(name.text, []).append(Signature.of_fields(len(members)))
        elif node.type in ("using_statement", "import_statement"):
            defined.update(leaf.text for leaf in node.all("identifier"))
        elif node.type == "module_definition":
            defined.add(node.children[0].text)
        elif node.type == "tuple_expression":
            fields.update(item.children[0].text for item in node.children if item.type == "named_field")

    def calls(self, file, tree, methods):
        for node in tree.all("call_expression"):
            name = callee(node)
            if name not in methods or name in BASE or id(node) in self.definition_nodes:
                continue
            if node.children[0].type == "field_expression" and node.children[0].children[0].text != "Delam":
                continue
            arguments = node.child("argument_list")
            count, keywords, open_ended = 1 if node.child("do_clause") else 0, set(), False
            for i, item in enumerate(arguments.children if arguments else []):
                if item.type == "splat_expression":
                    open_ended = True
                elif item.type == "named_argument":
                    keywords.add(item.children[0].text)
                elif i >= arguments.positional:
                    keywords.add(item.text or item.children[-1].text)
                else:
                    count += 1
            if not any(method.takes(count, keywords, open_ended) for method in methods[name]):
                words = f" and {', '.join(sorted(keywords))}" if keywords else ""
                self.say(file, node, f"no method of {name} takes {count} arguments{words}")


def package_files():
    """{name: text} of the package, its tests, the example in its manual, those of examples/ and the benchmark."""
    files = [path for folder in ("src", "ext", "test") for path in sorted((PACKAGE / folder).glob("*.jl"))]
    texts = {path.relative_to(PACKAGE).as_posix(): path.read_text(encoding="utf-8") for path in files}
    readme = (PACKAGE / "MANUAL.md").read_text(encoding="utf-8")
    texts["MANUAL.md"] = "\n".join(re.findall(r"^```julia\n(.*?)^```", readme, re.MULTILINE | re.DOTALL))
    for path in sorted([*(ROOT / "examples").glob("*/*.jl"), *(ROOT / "verify" / "bench" / "calls").glob("*.jl")]):
        texts[path.relative_to(ROOT).as_posix()] = path.read_text(encoding="utf-8")
    return texts


def main():
    parser = argparse.ArgumentParser(description="compares the Julia package with the public header")
    parser.add_argument("--parser", type=pathlib.Path, required=True, help="folder that keeps the parser")
    parser.add_argument("--header", type=pathlib.Path, default=HEADER)
    options = parser.parse_args()
    try:
        trees = syntax.parse(package_files(), syntax.fetch(options.parser))
    except syntax.Unavailable as reason:
        print(f"skipped: the Julia files were not parsed: {reason}")
        sys.exit(SKIPPED)
    header = public_header.read(options.header)
    check = Check(header, trees)
    for line in check:
        print(line)
    left = sorted(set(header.functions) - check.used)
    print(f"{len(trees)} files, {len(header.functions)} functions, {len(header.callbacks)} callbacks: "
          f"{len(check) or 'no'} differences; {len(left)} functions are reached through Raw alone: "
          f"{', '.join(left) or 'none'}")
    sys.exit(1 if check else 0)


if __name__ == "__main__":
    main()
