# SPDX-License-Identifier: BSD-3-Clause
"""changes.json lists what may differ from kept data, each with the sentence of CHANGELOG.md that names it. An entry:

    {"made": "8aed94c5", "data": "scenes/mixed", "column": "reaction", "sentence": "..."}

`data` and `column` are those that a failing test prints. An entry that nothing needs is a failure as well, unless it
says `"tie": true`: with some kernels of OpenBLAS the column differs, with others it does not, because today's rule
decides by rounding there.
"""
import json
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
MEMBERS = ["made", "data", "column", "sentence"]


def entries():
    return json.loads((HERE / "changes.json").read_text(encoding="utf-8"))


def changelog():
    return (HERE.parents[1] / "CHANGELOG.md").read_text(encoding="utf-8")


def plain(text):
    """Lines may be broken anywhere."""
    return " ".join(text.split())


def named(sentence, log):
    return len(sentence.split()) >= 4 and plain(sentence) in plain(log)


def of(made, data, listed):
    """The columns of one table that may differ."""
    return {entry["column"]: entry["sentence"] for entry in listed if (entry["made"], entry["data"]) == (made, data)}


def judge(made, data, found, listed, log):
    """What is wrong, a line each. found: the differences of this table from the kept one."""
    allowed, place = of(made, data, listed), f"{made} {data}"
    wrong = []
    for column, text in found:
        if column not in allowed:
            wrong.append(f"{place}, {column}: {text}; no entry of changes.json names it")
        elif not named(allowed[column], log):
            wrong.append(f'{place}, {column}: CHANGELOG.md does not say "{allowed[column]}"')
    ties = {entry["column"] for entry in listed if (entry["made"], entry["data"]) == (made, data) and entry.get("tie")}
    unneeded = allowed.keys() - {column for column, _ in found} - ties
    wrong += [f"{place}, {column}: does not differ; remove its entry from changes.json" for column in sorted(unneeded)]
    return wrong
