#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""contract_lint.py HEADER [SYMBOLS]: is every public function and callback documented in full? One line for each gap;
exit code 1 if there is any.

A comment stands directly above each of them, says what it does, and ends with a line in brackets (the notation is
explained at the head of the header):

    [unit jump L, traction F/L2; null traction; status argument, problem; source NAME YEAR; since 0.1]

Checked for each function, from its signature:
    what    some words besides the brackets; every parameter named in them or in the brackets, but for the ones that the
            head of the header explains once (EXPLAINED, and the object itself)
    shape   each array of numbers is followed by [..] where it is named; an output of one number is written *name
    unit    each parameter of type double has one; texts and integers have none. What goes in has a range: an interval,
            a bound, a condition, or finite
    null    there when a pointer that is no handle is taken; names pointers only
    owns    there when a pointer outlives the call: handles that are made, texts that are given, callbacks
    status  known words only; every function that returns a status; with --sources, what the façade's own lines return
            is listed
    thread  there when no object, and so no context, is taken
    source  there when numbers are computed for the caller or solved for
    since   a version, the one of symbols.txt

Structs (outside the promise) have a comment directly above, without brackets, that says what they are; every member is
named in it or in the comment above a struct or function that uses the struct.

Callbacks are the host's: their own statuses are not in src/capi, their numbers need no source, and each has a thread;
owns is there when a text is given, status is '-' where nothing is returned. "returned" among the statuses: the running
call returns what the callback did, which it or an earlier call for the same object was given.
"""
import argparse
import glob
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import gate  # noqa: E402
import header as headers  # noqa: E402

FIELDS = ("unit", "null", "owns", "status", "thread", "source", "since", "deprecated")
STATUSES = {"not_converged", "cancelled", "limit", "argument", "handle", "mesh", "problem", "state", "memory",
            "numerical", "snapshot", "file", "internal"}
USUAL = {"handle", "memory", "internal"}
EXPLAINED = {"out", "capacity", "index_base", "user", "interface_index", "index", "body", "context"}
ONE_UNIT = r"(?:1|L2|L3|L|F/L2|F/L3|F/L|F L|F|L/F|rad|t|of key|of unit|of factors)"
UNIT = re.compile(rf"(\w+) ({ONE_UNIT}(?: or {ONE_UNIT})*)(?: ((?:[<>]=? |in |finite|sum |not ).*))?")
SINCE = re.compile(r"\d+\.\d+")


def fields_of(comment):
    """The brackets at the end of a comment as a dictionary, and the words before them. None: there are none."""
    match = None
    for start in re.finditer(r"^\[(?=(?:" + "|".join(FIELDS) + r") )", comment, re.M):
        match = re.compile(r"\[(.*)\]$", re.S).match(comment, start.start())
    if not match:
        return None, comment
    fields = {}
    for part in " ".join(match.group(1).split()).split("; "):
        key, _, value = part.partition(" ")
        if key in fields:
            key = f"second {key}"
        fields[key] = value.strip()
    return fields, comment[:match.start()].strip()


def is_handle(type_text, header):
    return type_text.replace("const ", "").rstrip("*") in header.handles


def pointee(type_text):
    return type_text.replace("const ", "").rstrip("*")


def split(value):
    """At commas outside of intervals such as [0, 1)."""
    return [word.strip() for word in re.split(r",(?![^\[(]*[\])])", value) if word.strip()]


def own_statuses(folder):
    """function -> statuses that its own lines in src/capi give, with those of helpers of the façade by name."""
    found = {}
    for path in sorted(glob.glob(os.path.join(folder, "**/*.cpp"), recursive=True)):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        definition = r"^(?:int32_t|int64_t|void|const char\*) (delam_\w+)\([^{]*\{(?:[^\n]*\}$|.*?^\})"
        for match in re.finditer(definition, text, re.S | re.M):
            body = match.group()
            words = {w.lower() for w in re.findall(r"DELAM_ERROR_(\w+)", body)}
            if re.search(r"\brequire_(?!handle|nothing|material)\w+\(|\b(?:copy_out|fronts_of|set_material)\(", body):
                words.add("argument")
            if re.search(r"\brequire_handle\(", body):
                words.add("handle")
            if re.search(r"\b(?:require_patterns|require_materials?|validate|body_matrix)\(", body):
                words.add("problem")
            found[match.group(1)] = words
    return found


def passed_statuses(folder):
    """function -> statuses that it lets pass: those of listed.hpp (src/capi), or a list in its own lines (src/petsc)."""
    found = {}
    path = os.path.join(folder, "listed.hpp")
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            rows = re.findall(r"Listed (\w+) =\s*Listed::of\(([^)]*)\)", file.read())
        found = {"delam_" + name: words_of(text) for name, text in rows}
    for path in sorted(glob.glob(os.path.join(folder, "**/*.cpp"), recursive=True)):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for match in re.finditer(r"^int32_t (delam_\w+)\([^{]*\{\n\s*return (?:call|here)\(\w+,\s*\{([^}]*)\}", text, re.M):
            found[match.group(1)] = words_of(match.group(2))
    return found


def words_of(text):
    return {w.lower() for w in re.findall(r"DELAM_(?:ERROR_)?(\w+)", text)}


def unused_passed(folder):
    """Rows of listed.hpp that no function takes."""
    text = "".join(open(path, encoding="utf-8").read() for path in sorted(glob.glob(os.path.join(folder, "**/*.cpp"), recursive=True)))
    for name in passed_statuses(folder):
        short = name[len("delam_"):]
        body = re.search(rf"^int32_t {name}\([^{{]*\{{(?:[^\n]*\}}$|.*?^\}})", text, re.S | re.M)
        if os.path.exists(os.path.join(folder, "listed.hpp")) and (body is None or
                                                                    f"listed::{short}," not in body.group()):
            yield name


def fuzzed_statuses(path):
    """function -> statuses that its row in the table of the fuzz target (verify/fuzz/api_calls.hpp) lets pass."""
    rows = re.findall(r'\{"(delam_\w+)", Subject::\w+,\s*(may::[^,]*),', open(path).read())
    return {name: set(re.findall(r"may::(\w+)", terms)) - {"usual"} for name, terms in rows}


def named(name, prose):
    return re.search(rf"(?<![\w]){re.escape(name)}(?![\w])", prose) is not None


def has_shape(name, prose):
    """name followed by [..], perhaps behind other names of the same shape: 'jump, traction: [count][dimension]'."""
    return re.search(rf"(?<!\w){re.escape(name)}(?:,?\s+(?:and )?\*?\w+(?=[\s,:\[]))*:?\s*\[", prose) is not None


def check(function, header, listed, implemented, fuzzed=None, passed=None):
    gaps = []
    callback = function.callback
    fields, prose = fields_of(function.comment)
    if not function.comment:
        return ["no comment directly above"]
    if fields is None:
        return ["no line in brackets at the end of the comment"]
    if len(re.findall(r"[A-Za-z]{2,}", prose)) < 3:
        gaps.append(f"what: the comment does not say what the {'callback' if callback else 'function'} does")
    for key in fields:
        if key not in FIELDS:
            gaps.append(f"'{key}' is not a field; known are {', '.join(FIELDS)}")
    order = [FIELDS.index(key) for key in fields if key in FIELDS]
    if order != sorted(order):
        gaps.append(f"fields are in the order {', '.join(FIELDS)}")
    for key, value in fields.items():
        if not value:
            gaps.append(f"{key}: empty")

    parameters = function.parameters
    destroys = function.name.endswith("_destroy")
    handles = [p for p in parameters if is_handle(p.type, header) and (p.type.count("*") == 1 or destroys)]
    pointers = [p for p in parameters if "*" in p.type or p.type in header.callbacks]
    everything = prose + " " + " ".join(fields.values())
    for position, p in enumerate(parameters):
        own = position == 0 and is_handle(p.type, header)
        if not own and p.name not in EXPLAINED and not named(p.name, everything):
            gaps.append(f"what: parameter {p.name} is not named")
        if p.type.endswith("*") and pointee(p.type) in headers.NUMBERS and p.type.count("*") == 1:
            if not has_shape(p.name, prose) and f"*{p.name}" not in prose:
                gaps.append(f"shape: {p.name} has no [..] where it is named, nor is it written *{p.name}")

    units, ranges = {}, {}
    for entry in split(fields.get("unit", "")):
        match = UNIT.fullmatch(entry)
        if match:
            units[match.group(1)] = match.group(2)
            ranges[match.group(1)] = match.group(3)
        else:
            gaps.append(f"unit: '{entry}' is not a parameter with a unit of the header")
    doubles = [p.name for p in parameters if pointee(p.type) == "double"]
    for name in doubles:
        if name not in units:
            gaps.append(f"unit: none for {name}")
    for name in (p.name for p in parameters if p.type in ("double", "const double*")):
        if name in units and not ranges[name]:
            gaps.append(f"unit: {name} has no range; finite where any number will do")
    for name in units:
        if name not in doubles:
            gaps.append(f"unit: {name} is not a parameter of type double")

    open_pointers = [p for p in pointers if not (is_handle(p.type, header) and p.type.count("*") == 1)]
    if open_pointers and "null" not in fields:
        gaps.append("null: missing; which of " + ", ".join(p.name for p in open_pointers) + " may be NULL?")
    for name in split(fields.get("null", "")):
        if name.split(" ")[0].lstrip("*") not in [p.name for p in pointers] + ["none", "result"]:
            gaps.append(f"null: {name} is not a pointer of this function")

    lasting = [p for p in parameters if p.type.count("*") == 2 or p.type in header.callbacks or
               (callback and pointee(p.type) == "char")]
    if (lasting or "*" in function.result) and "owns" not in fields:
        gaps.append("owns: missing; how long do pointers live that are kept or given here?")

    status = fields.get("status")
    if status is None:
        gaps.append("status: missing")
    elif status == "-":
        if function.result == "int32_t" and (handles or callback):
            gaps.append(f"status: '-', but the {'callback' if callback else 'function'} returns one")
    else:
        only = status.startswith("only ")
        words = set(split(status[5:] if only else status)) - {"usual"}
        # A callback that runs in this call was given to it, or earlier to a function of the same object.
        same = [f for f in header.functions.values() if parameters and f.parameters[:1] and
                f.parameters[0].type == parameters[0].type]
        if callback or any(p.type in header.callbacks for f in [function, *same] for p in f.parameters):
            words -= {"returned"}
        for word in sorted(words - STATUSES):
            gaps.append(f"status: '{word}' is not known; known are {', '.join(sorted(STATUSES))}")
        if callback and function.result != "int32_t":
            gaps.append(f"status: the callback returns {function.result}, not a status")
        elif function.result != "int32_t" and "NULL" not in everything and "never NULL" not in everything:
            gaps.append(f"status: the function returns {function.result}, not a status")
        complete = words if only else words | USUAL
        own = words - USUAL
        if fuzzed is not None and not callback and function.name in fuzzed and fuzzed[function.name] != own:
            gaps.append(f"status: {', '.join(sorted(own)) or 'usual'} here, "
                        f"{', '.join(sorted(fuzzed[function.name])) or 'usual'} in the fuzz target")
        if passed is not None and not callback and function.name in passed and passed[function.name] != own:
            gaps.append(f"status: {', '.join(sorted(own)) or 'usual'} here, "
                        f"{', '.join(sorted(passed[function.name])) or 'usual'} in the sources' table")
        if implemented is not None:
            for word in sorted(implemented.get(function.name, set()) - complete):
                gaps.append(f"status: its lines in src/capi give {word}, which is not listed")
    if implemented is not None and not callback and function.name not in implemented:
        gaps.append("no definition in src/capi")

    if not handles and "thread" not in fields:
        gaps.append("thread: missing; " + ("on which one does it run?" if callback else "the function takes no object"))
    computed = [p.name for p in parameters if p.type == "double*"]
    if not callback and (computed or "not_converged" in (status or "")) and "source" not in fields:
        gaps.append("source: missing; numbers are computed (none: stored or counted ones)")
    since = fields.get("since")
    if since is None:
        gaps.append("since: missing")
    elif not SINCE.fullmatch(since):
        gaps.append(f"since: '{since}' is not a version such as 0.1")
    elif listed is not None and listed.get(function.name, since) != since:
        gaps.append(f"since: {since}, but {listed[function.name]} in the list of symbols")
    return gaps


def struct_gaps(struct, header):
    """header: with the structs and functions that may use this one."""
    gaps = []
    if not struct.comment:
        return ["no comment directly above"]
    if len(re.findall(r"[A-Za-z]{2,}", struct.comment)) < 3:
        gaps.append("what: the comment does not say what the struct is")
    if fields_of(struct.comment)[0] is not None:
        gaps.append("a struct has no line in brackets")
    said = struct.comment
    for user in [*header.structs.values(), *header.functions.values(), *header.callbacks.values()]:
        things = user.members if isinstance(user, headers.Struct) else [user]
        if user is not struct and struct.name in (pointee(t) for thing in things for t in headers.types_of(thing)):
            said += "\n" + user.comment
    for member in struct.members:
        if member.name not in EXPLAINED and not named(member.name, said):
            gaps.append(f"what: member {member.name} is not named")
    return gaps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("header")
    parser.add_argument("symbols", nargs="?")
    parser.add_argument("--promised", help="delam.h, where HEADER is the experimental one")
    parser.add_argument("--base", help="delam.h, where HEADER is that of a library on top of libdelam")
    parser.add_argument("--sources", help="src/capi: the statuses that its lines give are compared with those listed")
    parser.add_argument("--fuzzed", help="verify/fuzz/api_calls.hpp: so are those that its table lets pass")
    options = parser.parse_args()
    try:
        known = options.promised or options.base
        promised = headers.read(known) if known else None
        header = headers.read(options.header, promised, promised=options.base is not None)
    except headers.HeaderError as error:
        print(error)
        sys.exit(1)
    own_callbacks = dict(header.callbacks)
    if promised:
        header.handles += promised.handles
        header.callbacks.update(promised.callbacks)
    listed = gate.read_list(options.symbols) if options.symbols else None
    implemented = own_statuses(options.sources) if options.sources else None
    fuzzed = fuzzed_statuses(options.fuzzed) if options.fuzzed else None
    passed = passed_statuses(options.sources) if options.sources else None
    gaps = 0
    for name in unused_passed(options.sources) if options.sources else ():
        print(f"{options.sources}/listed.hpp: {name}: the function does not take its row")
        gaps += 1
    for function in [*header.functions.values(), *own_callbacks.values()]:
        for gap in check(function, header, listed, implemented, fuzzed, passed):
            print(f"{options.header}:{function.line}: {function.name}: {gap}")
            gaps += 1
    if fuzzed is not None and options.promised:
        for name in sorted(set(header.functions) - set(fuzzed)):
            print(f"{options.header}:{header.functions[name].line}: {name}: no row in the fuzz target")
            gaps += 1
    for struct in header.structs.values():
        for gap in struct_gaps(struct, header):
            print(f"{options.header}:{struct.line}: {struct.name}: {gap}")
            gaps += 1
    print(f"{len(header.functions)} functions, {len(own_callbacks)} callbacks, {len(header.structs)} structs, "
          f"{gaps} gaps")
    sys.exit(1 if gaps else 0)


if __name__ == "__main__":
    main()
