#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""keys.py LIBRARY HEADER [--baseline FILE] [--write] [--new-defaults]: do the keys of LIBRARY and the tables of HEADER
still hold those of the baseline? Prints what does not, by key; exit code 1 then. --write: what a new baseline would be.

A line of the baseline is one of
    option NAME; TYPE; unit UNIT; initial TEXT; range TEXT       as delam_option_info gives them
    law KIND NAME; TYPE; unit UNIT; initial TEXT; range TEXT     as delam_law_parameter_info does; kinds of the header
    cell NAME; number CONSTANT; shape [NODES][DIMENSION]         as delam_cell_type_info does
    value NAME; unit UNIT; recorded yes; alias OTHER     delam_solver_value_name; units by the table at
                                                 delam_solver_value; alias by delam_solver_value_info, if any; of
                                                 those that delam_solver_record refuses: no
    field NAME; shape [ROWS][COLUMNS]; unit UNIT     the table at delam_solver_field_shape
    text FUNCTION; range TEXT | TEXT             those in quotation marks in the comment of a function of CHOOSING

None may go, change its type, unit or shape, or be recorded no more. Ranges may widen and texts to choose from may come. Another default is
named, and passes once the baseline has it (update.sh). New keys are free; those that the baseline does not have yet are
listed.

The tables of the header are held to the library by two small analyses, in the plane and in space, each once more with
other units of length, force and time: values and fields are there, have their shape, and scale as their unit says
(but for zeros). Each text is taken.
"""
import argparse
import ctypes
import math
import os
import re
import sys
from ctypes import byref, c_char_p, c_double, c_int32, c_int64, c_void_p

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import header as headers  # noqa: E402
import promise  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
HEAD = ("# SPDX-License-Identifier: BSD-3-Clause\n"
        "# Options, parameters of laws, cell types, values and fields as they were promised (../keys.py). Written by update.sh.\n")
UNIT = r"F/L2|F/L3|F/L|F L|F|L or L2|L|rad|t|-"
# Nothing but rounding, or an effort that depends on it: their digits are no measure of a unit.
ROUNDING = {"mixity_error", "damage_change", "linear_residual", "newton_solves", "kkt_gap", "kkt_pressure",
            "kkt_complementarity", "kkt_equilibrium"}
CHOOSING = ("delam_problem_set_plane", "delam_problem_set_formulation")
SMALL, LARGE = (1.0, 1.0, 1.0), (4.0, 32.0, 2.0)  # units of length, force, time


def library_of(path, header, past=False):
    """past: functions of today's header may be missing."""
    library = ctypes.CDLL(path)
    scalars = {"int32_t": c_int32, "int64_t": c_int64, "double": c_double}
    for function in header.functions.values():
        try:
            symbol = getattr(library, function.name)
        except AttributeError as error:
            if past:
                continue
            raise SystemExit(error) from None
        symbol.argtypes = [scalars.get(p.type, c_void_p) for p in function.parameters]
        symbol.restype = c_char_p if "*" in function.result else scalars.get(function.result)
    return library


# ---- what the library says of its keys ----
def described(info, count, *first):
    """name -> facts, of a function that describes keys by index."""
    found = {}
    for index in range(count):
        texts = [c_char_p() for _ in range(5)]
        if info(*first, index, *[byref(text) for text in texts], None) != 0:
            raise SystemExit(f"{info.__name__}: index {index} of {count} is refused")
        name, kind, unit, initial, allowed = [text.value.decode() for text in texts]
        found[name] = {"type": kind, "unit": unit, "initial": initial, "range": allowed}
    return found


def cells_of(library):
    """(name, constant, nodes, dimension) of each cell type."""
    for index in range(library.delam_cell_type_count()):
        name, number, dimension, nodes = c_char_p(), c_int32(), c_int32(), c_int32()
        if library.delam_cell_type_info(index, byref(name), byref(number), byref(dimension), byref(nodes), *[None] * 4):
            raise SystemExit(f"delam_cell_type_info: index {index} is refused")
        yield name.value.decode(), number.value, nodes.value, dimension.value


def misnamed_cells(library, header):
    """Cell types whose number is not the constant of their name in the header."""
    for name, number, _, _ in cells_of(library):
        constant = header.constants.get(f"DELAM_{name.upper()}")
        if constant is None or int(constant) != number:
            yield f"cell {name}: number {number}, by the header {constant}"


def keys_of(library, header):
    """line's head -> facts."""
    found = {}
    for name, facts in described(library.delam_option_info, library.delam_option_count()).items():
        found[f"option {name}"] = facts
    for kind in kinds_of(header):
        count = library.delam_law_parameter_count(kind.encode())
        for name, facts in described(library.delam_law_parameter_info, count, kind.encode()).items():
            found[f"law {kind} {name}"] = facts
    for name, number, nodes, dimension in cells_of(library):
        found[f"cell {name}"] = {"type": f"number {number}", "shape": f"[{nodes}][{dimension}]"}
    recorded, aliases = recorded_of(library, header)
    for name, unit in values_of(header).items():
        if name in aliases.values():  # in the line of its key
            continue
        found[f"value {name}"] = {"unit": unit, "recorded": recorded.get(name, "no")}
        if aliases.get(name):
            found[f"value {name}"]["alias"] = aliases[name]
    for name, (shape, unit) in fields_of(header).items():
        found[f"field {name}"] = {"shape": shape, "unit": unit}
    for name in CHOOSING:
        found[f"text {name}"] = {"range": " | ".join(texts_of(header, name))}
    return found


# ---- the tables of the header ----
def kinds_of(header):
    table = header.functions["delam_law_create"].comment.partition("kind:\n")[2].partition("\nNumbers")[0]
    return re.findall(r"^ {2}([a-z-]+) {2}", table, re.M)


def values_of(header):
    """key -> unit. Names behind a colon stand for any: crack_length:I, load:NAME."""
    found, behind = {}, ""
    for line in header.functions["delam_solver_value"].comment.split("\n"):
        if line.startswith("Values of "):
            behind = "I" if line.startswith("Values of the fronts") else ""
        match = re.match(rf" {{2}}([a-z_]+(?::NAME)?) {{2,}}({UNIT}) {{2,}}", line)
        if match:
            name = match.group(1)
            found[name] = match.group(2).replace("-", "1")
            if behind:
                found[f"{name}:{behind}"] = found[name]
    return found


def fields_of(header):
    """key -> (shape, unit)."""
    found = {}
    for line in header.functions["delam_solver_field_shape"].comment.split("\n"):
        match = re.match(rf" {{2}}([a-z]+(?:, [a-z]+)*) +(\[[^\]]*\]\[[^\]]*\]) +({UNIT})(?=[ ,;:])", line)
        if match:
            for name in match.group(1).split(", "):
                found[name] = (match.group(2), match.group(3).replace("-", "1"))
    return found


def texts_of(header, name):
    return list(dict.fromkeys(re.findall(r'"([a-z-]+)"', header.functions[name].comment)))


# ---- two beams that are peeled apart ----
def recorded_of(library, header):
    """key -> yes, or no if an analysis in the plane or in space refuses it; key -> its alias."""
    refused = int(header.constants["DELAM_ERROR_ARGUMENT"])
    found, aliases = {}, {}
    for dimension in (2, 3):
        analysis = Analysis(library, header, dimension, SMALL)
        for name, info in analysis.infos().items():
            aliases[general(name)] = info["alias"]
        for name in analysis.values():
            status = library.delam_solver_record(analysis.solver, name.encode())
            if status not in (0, refused):
                raise SystemExit(f"delam_solver_record of '{name}': status {status}")
            key = general(name)
            found[key] = "yes" if status == 0 and found.get(key) != "no" else "no"
        analysis.end()
    return found, aliases


def general(name):
    """The key of a value of the analysis, as the table of the header has it."""
    return re.sub(r":\d+$", ":I", re.sub(r":open$", ":NAME", name))


class Analysis:
    def __init__(self, library, header, dimension, units):
        length, force, time = units
        self.library, self.made = library, []
        constants = header.constants
        cell = int(constants["DELAM_QUAD4" if dimension == 2 else "DELAM_HEX8"])
        across = dimension - 2
        self.context = None
        self.context = self.make("context")
        mesh = self.make("mesh", "_create_layers", self.context, dimension, self.real([8 * length] + [length] * across),
                         self.whole([8] + [1] * across), 2, self.real([length] * 2), self.whole([1, 1]), cell)
        self.call("mesh_add_interface", mesh, 0, 1, 0.0, self.whole([0]))
        law = self.make("law", "_create", self.context, b"piecewise-linear")
        for direction in ("normal", "tangential"):
            for name, value in (("stiffness", 1e4 * force / length**3), ("onset", 0.1 * force / length),
                                ("toughness", 1.0 * force / length)):
                self.call("law_set", law, f"{direction}_{name}".encode(), value)
        problem = self.problem = self.make("problem", "_create", self.context, mesh)
        self.call("problem_set_elastic", problem, -1, 1e5 * force / length**2, 0.3)
        self.call("problem_set_law", problem, 0, law)
        self.call("problem_set_number", problem, b"damage_tolerance", 1e-10)
        self.call("problem_set_text", problem, b"kinematics", b"linear")  # large rotations know no buckling_ratio
        self.call("problem_add_pattern", problem, b"open", 2, self.real([0, time]), self.real([0, 1]), self.whole([0]))
        nodes = self.whole([0] * 5)
        self.call("mesh_size", mesh, self.short([0]), self.at(nodes, 0), self.at(nodes, 1), self.at(nodes, 2),
                  self.at(nodes, 3))
        pairs = self.whole([0])
        self.call("mesh_interface_size", mesh, 0, None, None, pairs, None, None)
        self.counts = {"nodes": nodes[0], "cells": nodes[1], "pairs": pairs[0]}
        places = (c_double * (nodes[0] * dimension))()
        self.call("mesh_nodes", mesh, len(places), places)
        point = [tuple(places[i * dimension:(i + 1) * dimension]) for i in range(nodes[0])]
        rows = 0

        def hold(chosen, axis, coefficient=None):
            nonlocal rows
            chosen = [i for i in range(nodes[0]) if chosen(point[i])]
            direction = [float(i == axis) for i in range(dimension)]
            patterns = 0 if coefficient is None else 1
            self.call("problem_prescribe_nodes", problem, len(chosen), self.whole(chosen), self.real(direction),
                      patterns, self.whole([0]), self.real([coefficient or 0.0] * len(chosen)), 0)
            rows += len(chosen)

        height = dimension - 1
        for axis in range(dimension):
            hold(lambda p: p[0] == 8 * length, axis)
        hold(lambda p: p[0] == 0 and p[height] == 0, height)
        hold(lambda p: p[0] == 0 and p[height] == 2 * length, height, 0.3 * length)
        self.counts["constraints"] = rows
        self.solver = self.make("solver", "_create", problem, 0.0)
        for part in (0.25, 0.5, 0.75, 0.95, 1.0):  # where every step damages abruptly, the energy balance closes
            self.call("solver_advance", self.solver, part * time)
            self.call("solver_commit", self.solver)

    @staticmethod
    def real(numbers):
        return (c_double * len(numbers))(*numbers)

    @staticmethod
    def whole(numbers):
        return (c_int64 * len(numbers))(*numbers)

    @staticmethod
    def short(numbers):
        return (c_int32 * len(numbers))(*numbers)

    @staticmethod
    def at(array, index):
        return ctypes.addressof(array) + index * ctypes.sizeof(array._type_)

    def call(self, name, *arguments):
        status = getattr(self.library, "delam_" + name)(*arguments)
        if status != 0:
            message = self.library.delam_context_message(self.context) if self.context else b""
            raise SystemExit(f"delam_{name}: status {status}: {message.decode()}")

    def make(self, kind, how="_create", *arguments):
        out = c_void_p()
        self.call(kind + how, *arguments, byref(out))
        self.made.append((kind, out))
        return out.value

    def values(self):
        count = self.whole([0])
        self.call("solver_value_count", self.solver, count)
        found = {}
        for index in range(count[0]):
            name = self.library.delam_solver_value_name(self.solver, index)
            value = self.real([0])
            self.call("solver_value", self.solver, name, value)
            found[name.decode()] = value[0]
        return found

    def infos(self):
        """name -> what delam_solver_value_info says."""
        found = {}
        for index, name in enumerate(self.values()):
            texts, recorded = [c_char_p() for _ in range(5)], c_int32()
            self.call("solver_value_info", self.solver, index, *[byref(text) for text in texts], byref(recorded))
            alias, unit, cost, scope, meaning = [text.value.decode() for text in texts]
            found[name] = {"alias": alias, "unit": unit, "cost": cost, "scope": scope, "meaning": meaning,
                           "recorded": "yes" if recorded.value else "no"}
        return found

    def of_alias(self, alias):
        value = self.real([0])
        self.call("solver_value", self.solver, alias.encode(), value)
        return value[0]

    def field(self, name):
        """Shape, and the largest magnitude; None for the latter where there is no such field."""
        shape = self.whole([0, 0])
        if self.library.delam_solver_field_shape(self.solver, name.encode(), -1, shape, self.at(shape, 1)) != 0:
            return None, None
        numbers = (c_double * (shape[0] * shape[1]))()
        self.call("solver_field", self.solver, name.encode(), -1, len(numbers), numbers)
        return tuple(shape), max(abs(number) for number in numbers)

    def end(self):
        for kind, out in reversed(self.made):
            getattr(self.library, f"delam_{kind}_destroy")(byref(out))


def growth(unit, dimension):
    """By what a number of this unit grows from SMALL to LARGE."""
    length, force, time = LARGE
    if unit == "L or L2":
        return length ** (dimension - 1)
    grown = {"F/L2": force / length**2, "F/L": force / length, "F L": force * length, "F": force, "L": length,
             "t": time}.get(unit, 1.0)
    # In the plane forces and energies are per thickness.
    return grown / length if dimension == 2 and unit in ("F", "F L") else grown


def measured(library, header):
    """Lists where the library differs from the tables of the header."""
    wrong, seen = [], set()
    values, fields = values_of(header), fields_of(header)

    def compare(what, unit, small, large, dimension):
        expected = small * growth(unit, dimension)
        if not math.isfinite(small):
            wrong.append(f"{what}: is {small} in {dimension}D")
        elif small != 0 and not math.isclose(large, expected, rel_tol=1e-3):
            wrong.append(f"{what}: is {small:g}, and {large:g} in units of length {LARGE[0]:g}, force {LARGE[1]:g}, "
                         f"time {LARGE[2]:g} times as small: not the unit '{unit}' of the header")
        elif small != 0:
            seen.add(what)

    kinds, name = [], c_char_p()
    for index in range(library.delam_law_kind_count()):
        library.delam_law_kind_info(index, byref(name), None, None)
        kinds.append(name.value.decode())
    if kinds != kinds_of(header):
        wrong.append(f"kinds of laws: {', '.join(kinds)} by delam_law_kind_info, {', '.join(kinds_of(header))} in the "
                     f"table of the header")
    for dimension in (2, 3):
        one, other = (Analysis(library, header, dimension, units) for units in (SMALL, LARGE))
        before, after = one.values(), other.values()
        for name, info in one.infos().items():
            if values.get(general(name), info["unit"]).replace("-", "1") != info["unit"].replace("-", "1"):
                wrong.append(f"value {general(name)}: unit {info['unit']} in the library, {values[general(name)]} in the "
                             f"table of the header")
            status = library.delam_solver_record(one.solver, name.encode())
            if (status == 0) != (info["recorded"] == "yes"):
                wrong.append(f"value {general(name)}: recorded {info['recorded']} says delam_solver_value_info")
            if info["alias"] and one.of_alias(info["alias"]) != before[name]:
                wrong.append(f"value {general(name)}: its alias {info['alias']} has another value")
        keys = {general(name): name for name in before}
        others = {info["alias"]: general(name) for name, info in one.infos().items()}
        for name in values:
            if name in others and values[name] != values.get(others[name]):
                wrong.append(f"value {name}: in the header, another unit than {others[name]}, whose alias it is")
            if name not in keys and name not in others:
                wrong.append(f"value {name}: in the header, delam_solver_value_name does not give it")
        for name, own in keys.items():
            if name not in values:
                wrong.append(f"value {name}: delam_solver_value_name gives it, the table of the header has no such key")
            elif name not in ROUNDING:
                compare(f"value {name}", values[name], before[own], after[own], dimension)
        for name, (shape, unit) in fields.items():
            rows, columns = re.fullmatch(r"\[(.*)\]\[(.*)\]", shape).groups()
            columns = re.fullmatch(r"(\w+)(?: or (\w+))?", columns).groups()
            column = (columns[dimension - 2] or columns[0]).replace("dimension", str(dimension))
            found, small = one.field(name)
            if found != (one.counts[rows], int(column)):
                wrong.append(f"field {name}: shape {found}, by the header {shape} = ({one.counts[rows]}, {column})")
            else:
                compare(f"field {name}", unit, small, other.field(name)[1], dimension)
        for name in CHOOSING:
            body = (-1,) if "formulation" in name else ()
            for text in texts_of(header, name) if dimension == 2 or body else ():
                if getattr(library, name)(one.problem, *body, text.encode()) != 0:
                    wrong.append(f"text {name}: '{text}' of the header is refused in {dimension}D: "
                                 + library.delam_context_message(one.context).decode())
        one.end()
        other.end()
    return list(dict.fromkeys(wrong)), seen


# ---- against the baseline ----
def line_of(head, facts):
    parts = [head] + ([facts["type"]] if "type" in facts else [])
    return "; ".join(parts + [f"{key} {facts[key]}".strip() for key in ("shape", "unit", "recorded", "alias", "initial",
                                                                   "range") if key in facts])


def read_keys(path):
    found = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                head, *parts = line.strip().split("; ")
                facts = {}
                for part in parts:
                    key, _, value = part.partition(" ")
                    if key in ("shape", "unit", "recorded", "alias", "initial", "range"):
                        facts[key] = value
                    else:
                        facts["type"] = part
                found[head] = facts
    return found


def wider(old, new):
    """Does the range or list of texts `new` allow all of `old`?"""
    if re.search(r" \| |^[\w-]+(, [\w-]+)+$", old):
        return set(re.split(r" \| |, ", old)) <= set(re.split(r" \| |, ", new))
    return promise.within(old, new)


def compare(baseline, today, new_defaults):
    wrong = []
    for head, old in baseline.items():
        new = today.get(head)
        if new is None:
            wrong.append(f"{head}: in the baseline, gone from the library or its header")
            continue
        for key in ("type", "shape", "unit"):
            if old.get(key) != new.get(key):
                wrong.append(f"{head}: {key} {new.get(key)}, in the baseline {old.get(key)}")
        if old.get("recorded") == "yes" and new.get("recorded") != "yes":
            wrong.append(f"{head}: is not recorded any more")
        if "alias" in old and old["alias"] != new.get("alias"):
            wrong.append(f"{head}: alias {new.get('alias')}, in the baseline {old['alias']}")
        if "range" in old and not wider(old["range"], new["range"]):
            wrong.append(f"{head}: range '{new['range']}' does not allow all of '{old['range']}' of the baseline")
        if old.get("initial") != new.get("initial"):
            line = f"{head}: default '{new.get('initial')}', in the baseline '{old.get('initial')}'"
            if new_defaults and new.get("initial"):
                print(f"{line}: to be named in the version's notes")
            elif not new.get("initial"):
                wrong.append(f"{line}: it must be given now")
            else:
                wrong.append(f"{line}: run verify/abi/update.sh, and name it in the version's notes")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("library")
    parser.add_argument("header")
    parser.add_argument("--baseline", default=os.path.join(HERE, "baseline", "keys.txt"))
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--new-defaults", action="store_true", help="name other defaults and let them pass")
    options = parser.parse_args()
    try:
        header = headers.read(options.header)
    except headers.HeaderError as error:
        print(error)
        sys.exit(1)
    library = library_of(options.library, header)
    today = keys_of(library, header)
    if options.write:
        sys.stdout.write(HEAD + "".join(line_of(head, facts) + "\n" for head, facts in sorted(today.items())))
        return
    baseline = read_keys(options.baseline)
    wrong = compare(baseline, today, options.new_defaults) + list(misnamed_cells(library, header))
    unlike, seen = measured(library, header)
    for line in wrong + unlike:
        print(line)
    if not wrong + unlike:
        added = sorted(set(today) - set(baseline))
        print(f"{len(baseline)} keys as in the baseline; the units of {len(seen)} values and fields measured"
              + (f"; new: {', '.join(added)}" if added else ""))
    sys.exit(1 if wrong + unlike else 0)


if __name__ == "__main__":
    main()
