#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""promise.py HEADER [--base DELAM.H] [--baseline FILE] [--write]: do the lines in brackets of HEADER still hold what those of the
baseline promised? Prints what does not, by function; exit code 1 then. --write: prints what a new baseline would be.
--base: HEADER is that of a library on top of libdelam.

A line of the baseline is the name of a function or callback and its line in brackets, without `source` and
`deprecated`, which may change. Compared are

    unit     equal for each parameter; the range of an input may widen, that of an output may narrow
    null     names may come; `result`, which the library gives, may only go
    status   may go; `usual` counts as handle, memory and internal
    owns, thread, since   equal

What a callback is given counts as an output, and what it gives as an input. New functions are free: symbols.txt must
list them, and update.sh takes their lines along.
"""
import argparse
import math
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import contract_lint as lint  # noqa: E402
import gate  # noqa: E402
import header as headers  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
KEPT = [field for field in lint.FIELDS if field not in ("source", "deprecated")]
HEAD = ("# SPDX-License-Identifier: BSD-3-Clause\n"
        "# The lines in brackets of {} as they were promised (../promise.py). Written by update.sh.\n")


def interval(text):
    """(low, low is in, high, high is in) of a range in numbers; None where it is in words."""
    if text in ("", "finite"):
        return (-math.inf, False, math.inf, False)
    number = r"-?\d[\d.]*(?:e-?\d+)?(?:\^\d+)?"

    def value(word):
        base, _, power = word.partition("^")
        return float(base) ** (float(power) if power else 1.0)

    match = re.fullmatch(rf"in ([\[(])({number}), ({number})([\])])", text)
    if match:
        return value(match.group(2)), match.group(1) == "[", value(match.group(3)), match.group(4) == "]"
    low, low_in, high, high_in = -math.inf, False, math.inf, False
    turned = {"<": ">", "<=": ">="}
    middle = re.fullmatch(rf"({number}) (<=?) value(?: (<=?) ({number}))?|value (<=?) ({number})", text)
    if middle:
        bounds = [(turned.get(middle.group(2)), middle.group(1)), (middle.group(3), middle.group(4)),
                  (middle.group(5), middle.group(6))]
    else:
        words = [word for word in re.split(r" and ", text) if word != "finite"]
        bounds = [re.fullmatch(rf"([<>]=?) ({number})", word) for word in words]
        if None in bounds:
            return None
        bounds = [match.groups() for match in bounds]
    for relation, bound in bounds:
        if relation and relation[0] == ">":
            low, low_in = value(bound), relation == ">="
        elif relation:
            high, high_in = value(bound), relation == "<="
    return low, low_in, high, high_in


def within(inner, outer):
    """Is all that the range `inner` allows in the range `outer`?"""
    if inner == outer or outer in ("", "finite"):
        return True
    one, other = interval(inner), interval(outer)
    if one is None or other is None:
        return False
    low = one[0] > other[0] or (one[0] == other[0] and (other[1] or not one[1]))
    high = one[2] < other[2] or (one[2] == other[2] and (other[3] or not one[3]))
    return low and high


def read_lines(path):
    """name -> fields of the baseline."""
    found = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                name, _, rest = line.strip().partition(" ")
                fields = {}
                for part in rest[1:-1].split("; "):
                    key, _, value = part.partition(" ")
                    fields[key] = value
                found[name] = fields
    return found


def units_of(fields):
    """parameter -> (unit, range)."""
    found = {}
    for entry in lint.split(fields.get("unit", "")):
        match = lint.UNIT.fullmatch(entry)
        if match:
            found[match.group(1)] = (match.group(2), match.group(3) or "")
    return found


def statuses(text):
    if text == "-":
        return set()
    only = text.startswith("only ")
    words = set(lint.split(text[5:] if only else text)) - {"usual"}
    return words if only else words | lint.USUAL


def entries(text):
    """The entries of null: each entry, and for one without a condition the name alone."""
    return [] if text in ("", "none") else lint.split(text)


def compare(function, old, new):
    wrong = []
    for key in ("owns", "thread", "since"):
        if old.get(key) != new.get(key):
            wrong.append(f"{key}: '{new.get(key, 'nothing')}', in the baseline '{old.get(key, 'nothing')}'")

    before, today = units_of(old), units_of(new)
    types = {p.name: p.type for p in function.parameters}
    for name, (unit, allowed) in before.items():
        if name not in today:
            wrong.append(f"unit: none for {name}, in the baseline {unit}")
            continue
        now, range_now = today[name]
        if now != unit:
            wrong.append(f"unit: {name} in {now}, in the baseline {unit}")
        goes_in = types.get(name) != "double*"
        if goes_in != function.callback:
            if not within(allowed, range_now):
                wrong.append(f"unit: the range of {name} is '{range_now}', narrower than "
                             f"'{allowed or 'finite'}' of the baseline")
        elif not within(range_now, allowed):
            wrong.append(f"unit: {name} that is given has the range '{range_now or 'finite'}', wider than "
                         f"'{allowed}' of the baseline")

    was, now = entries(old.get("null", "")), entries(new.get("null", ""))
    for name in was:
        gives = function.callback or name.split(" ")[0] == "result"
        if not gives and name not in now and name.split(" ")[0] not in now:
            wrong.append(f"null: {name} may be NULL in the baseline, and no longer")
    for name in now:
        gives = function.callback or name.split(" ")[0] == "result"
        if gives and name not in was and name.split(" ")[0] not in was:
            wrong.append(f"null: the host may be given {name} as NULL, in the baseline it is not")

    for word in sorted(statuses(new.get("status", "-")) - statuses(old.get("status", "-"))):
        wrong.append(f"status: {word} is listed, in the baseline it is not")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("header")
    parser.add_argument("--base", help="delam.h, where HEADER is that of a library on top of libdelam")
    parser.add_argument("--baseline", help="default: baseline/contract.txt, with --base contract_NAME.txt")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    name = os.path.basename(options.header)
    file = f"contract_{name[:-2]}.txt" if options.base else "contract.txt"
    options.baseline = options.baseline or os.path.join(HERE, "baseline", file)
    try:
        header = gate.read_header(options.header, options.base)
    except headers.HeaderError as error:
        print(error)
        sys.exit(1)
    functions = {**header.functions, **header.callbacks}
    today = {name: lint.fields_of(function.comment)[0] or {} for name, function in functions.items()}
    if options.write:
        sys.stdout.write(HEAD.format(name))
        for name in sorted(today):
            print(name, "[" + "; ".join(f"{key} {today[name][key]}" for key in KEPT if key in today[name]) + "]")
        return
    baseline = read_lines(options.baseline)
    failures = 0
    for name, old in baseline.items():
        if name not in functions:
            found = ["in the baseline, gone from the header"]
        else:
            found = compare(functions[name], old, today[name])
        for line in found:
            print(f"{name}: {line}")
        failures += len(found)
    if not failures:
        added = sorted(set(functions) - set(baseline))
        print(f"{len(baseline)} lines in brackets hold what the baseline promised"
              + (f"; new: {', '.join(added)}" if added else ""))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
