# SPDX-License-Identifier: BSD-3-Clause
"""Several specimens of one test: each is evaluated as if alone, and one table has all of them with mean, standard deviation
and coefficient of variation. A specimen that cannot be evaluated, or is left out, is named."""
import contextlib
import csv
import io
import json
import os
import re
import shlex

from _pictures.input_file import MOST_RESULT, Unreadable, quoted, read_json
from command import DONE, NOT_CONVERGED, Trouble, complain, loading, outcome, overheard, say
from evaluation import TITLES, Evaluation
from own_files import owned, write_file
from series.members import members_of
from series.statistics import ASKED, LEAST, columns_of, disagreements, outlier_in, statistics_of, values_of

NAMES = ["series.json", "series.csv", "r-curves.csv", "series.png"]
# A row has these of its specimen: title, key of the sheet in SI or name of a number of its points, and the unit's size.
NUMBERS = (("width (mm)", "width", 1e-3), ("arm (mm)", "arm", 1e-3), ("notch (mm)", "notch", 1e-3), ("span (mm)", "span", 1e-3),
           ("lever (mm)", "lever", 1e-3), ("compliance (mm/N)", "compliance", 1e-3), ("bending modulus (GPa)", "modulus", 1e9))
STATISTICS = (("mean", "mean", 1.0), ("standard deviation", "deviation", 1.0), ("CV (%)", "variation", 100.0), ("count", "count", 1))


def refuse_one(given):
    """Refuses options that are of one specimen."""
    for option, value in (("--marks", given.marks), ("--calibration", given.calibration)):
        if value:
            raise Trouble(f"{option} is of one specimen: of a series, a column {quoted(option[2:])} of --sheets FILE names the files of each")
    if given.beside:
        raise Trouble("--beside is of one specimen: evaluate it alone")


def evaluate_members(members):
    """Evaluates each; what goes wrong stays with its specimen. Returns the warnings of each kind with those who have it."""
    kinds = {}
    for member in members:
        if not member.trouble:
            try:
                with overheard() as member.warnings:
                    member.found = Evaluation(member.given)
            except Exception as error:  # pylint: disable=broad-exception-caught
                member.trouble = str(outcome(error)[0])
        if member.trouble:
            complain(f"{member.name} is not evaluated: {member.trouble}")
            continue
        for text in member.warnings:
            kind = re.sub(r"[-+]?[0-9][0-9.e+-]*", "#", text.replace(member.path, "FILE"))
            kinds.setdefault(kind, (text.removeprefix("warning: "), []))[1].append(member.name)
    return kinds


def leave_out(members, names):
    """Marks the specimens that are left out."""
    for name in names:
        chosen = [member for member in members if name == member.name] or [member for member in members if name in member.names()]
        if len(chosen) != 1:
            raise Trouble(f"--leave-out {name[:60]}: the name of one specimen is expected: {', '.join(member.name for member in members)}")
        chosen[0].counted = False


def remarks(members, counted, columns, given):
    """What is to be said of the series as a whole."""
    yield from disagreements(counted)
    if len(counted) < LEAST:
        yield (f"{len(counted)} specimen{'s' * (len(counted) != 1)} count{'s' * (len(counted) == 1)}: {ASKED[given.test]} ask{'' if ' and ' in ASKED[given.test] else 's'} for at least "
               f"{LEAST}" + ("; one has no standard deviation" if len(counted) == 1 else ""))
    short = [f"{method}: {', '.join(member.name for member in counted if member not in having)}" for method in dict(columns)
             for having in [values_of(counted, method, "max")[0]] if len(having) < len(counted)]
    if short:
        yield f"not all specimens have all methods, which their means leave out: {'; '.join(short)}"
    odd = {}
    for method, point in columns:
        having, values = values_of(counted, method, point)
        place = outlier_in(values)
        if place is not None:
            odd.setdefault(having[place].name, []).append(f"{method}, {point}: {values[place]:.4g} J/m2")
    for name, where in odd.items():
        yield (f"{name} is an outlier by Grubbs' test at 95 % ({where[0]}{f', and {len(where) - 1} more' if len(where) > 1 else ''}): it counts; "
               f"--leave-out {shlex.quote(name)} leaves it out")


def table_lines(members, method, points, found):
    """A row for each specimen, and their statistics, of one method."""
    rows = [["specimen", *points]]
    for member in members:
        if member.found:
            rates = member.found.values().get(method, {})
            rows.append([member.name + ("" if member.counted else " (left out)"), *(f"{rates[p]:.4g}" if p in rates else "-" for p in points)])
        else:
            rows.append([f"{member.name} (not evaluated)", *("-" for _ in points)])
    for title, key, factor in STATISTICS:
        values = [getattr(found[method, p], key) for p in points]
        rows.append([title, *("-" if value is None else f"{factor * value:.4g}" if key != "variation" else f"{factor * value:.3g}" for value in values)])
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    for row in rows:
        yield "  ".join([row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:]))]).rstrip()


def lines(members, columns, found, level):
    """What the command says of the series: a table of the first method, means of all others."""
    methods = list(dict(columns))
    counts = [len(values_of([m for m in members if m.found], method, "max")[0]) for method in methods]
    methods.insert(0, methods.pop(counts.index(max(counts))))
    for k, method in enumerate(methods):
        points = [point for name, point in columns if name == method]
        if k == 0:
            yield f"{method}, J/m2:"
            yield from table_lines(members, method, points, found)
        else:
            yield f"{method}: means " + ", ".join(
                f"{point} {found[method, point].mean:.4g}" + (f" (CV {100 * found[method, point].variation:.3g} %)" if found[method, point].variation is not None else "")
                for point in points if found[method, point].count) + " J/m2"
        told = [f"{point} {found[method, point].low:.4g} to {found[method, point].high:.4g}" for point in points if found[method, point].low is not None]
        if told and k == 0:
            yield f"{100 * level:g} % interval of the mean (Student, count - 1 degrees of freedom): {', '.join(told)} J/m2"


def csv_text(rows):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def table_of(members, counted, columns, found, level):
    """Rows of series.csv."""
    numbers = [(title, key, size) for title, key, size in NUMBERS if any(key in number_of(member) for member in counted)]
    rows = [["specimen", "file", *(title for title, _, _ in numbers), *(f"{method}: {point} (J/m2)" for method, point in columns), "counted", "message"]]
    for member in members:
        own = number_of(member) if member.found else {}
        rates = member.found.values() if member.found else {}
        rows.append([member.name, member.path, *(f"{own[key] / size:.9g}" if key in own else "" for _, key, size in numbers),
                     *(f"{rates[m][p]:.9g}" if p in rates.get(m, {}) else "" for m, p in columns),
                     "yes" if member.found and member.counted else "no", member.trouble])
    of_numbers = [statistics_of([number_of(m)[key] / size for m in counted if key in number_of(m)], level) for _, key, size in numbers]
    for title, key, factor in STATISTICS:
        values = [getattr(one, key) for one in (*of_numbers, *(found[column] for column in columns))]
        rows.append([title, "", *("" if value is None else f"{factor * value:.9g}" for value in values), "", ""])
    return rows


def number_of(member):
    return member.found.sheet | {"compliance": member.found.points.compliance, "modulus": member.found.points.modulus}


def earlier(given, members, of_one):
    """True if a series is there; another one, or the evaluation of one specimen, is refused without --replace."""
    if os.path.lexists(os.path.join(given.out, of_one[0])) and not given.replace:
        raise Trouble(f"{given.out} holds the evaluation of one specimen: --replace, or another --out")
    place = os.path.join(given.out, NAMES[0])
    if not os.path.lexists(place):
        return False
    before = {}
    with contextlib.suppress(Unreadable):
        before = read_json(place, MOST_RESULT)
    files = {os.path.realpath(str(one.get("file"))) for one in before.get("specimens", [])}
    if before and not given.replace and (before.get("test") != given.test or files != {os.path.realpath(member.path) for member in members}):
        raise Trouble(f"{given.out} holds the evaluation of another series, {before.get('test')} of {len(files)} files: --replace, or another --out")
    return True


def evaluate_series(given, of_one):
    """of_one: the files of the evaluation of one specimen, which those of a series replace."""
    refuse_one(given)
    members = members_of(given)
    leave_out(members, given.leave_out)
    replaced = earlier(given, members, of_one)
    kinds = evaluate_members(members)
    counted = [member for member in members if member.found and member.counted]
    if not counted:
        raise Trouble("no specimen is evaluated and counts: there is no mean")
    with loading():
        from series.pictures import draw
    columns = columns_of([member for member in members if member.found])
    found = {column: statistics_of(values_of(counted, *column)[1], given.confidence) for column in columns}
    with overheard(keep=False) as warnings:
        for text, names in kinds.values():
            complain(f"warning of {len(names)} of {len(members)} specimens ({', '.join(names[:8])}{', ..' * (len(names) > 8)}): {text}")
        for text in remarks(members, counted, columns, given):
            complain(f"warning: {text}")
    for line in lines(members, columns, found, given.confidence):
        say(line)
    failed, left = ([m.name for m in members if not m.found], [m.name for m in members if m.found and not m.counted])
    with owned(given.out, NAMES, of_one):
        write_file(os.path.join(given.out, "series.json"), json.dumps(about_of(given, members, columns, found, warnings), indent=1, allow_nan=False))
        write_file(os.path.join(given.out, "series.csv"), csv_text(table_of(members, counted, columns, found, given.confidence)))
        rows = [["specimen", "method", "displacement (mm)", "crack (mm)", "toughness (J/m2)"]]
        for member in (one for one in members if one.found):
            for answer in member.found.answers:
                rows += [[member.name, answer.name, f"{1e3 * w:.9g}", f"{1e3 * a:.9g}", f"{g:.9g}"]
                         for w, a, g in zip(answer.where, answer.crack, answer.rate)]
        write_file(os.path.join(given.out, "r-curves.csv"), csv_text(rows))
        draw(given.out, TITLES[given.test], members, columns, found)
    say(f"{len(counted)} of {len(members)} specimens count" + (f"; left out (--leave-out): {', '.join(left)}" if left else "")
        + (f"; not evaluated: {', '.join(failed)}" if failed else ""))
    say(f"wrote {given.out}: {', '.join(NAMES)}" + (", in the place of an earlier evaluation" if replaced else ""))
    return NOT_CONVERGED if failed else DONE


def about_of(given, members, columns, found, warnings):
    """series.json: SI, as evaluate.json, which each of `specimens` is."""
    specimens = [{"name": m.name, "counted": bool(m.found and m.counted)} | (m.found.about() | {"warnings": m.warnings} if m.found else
                 {"file": m.path, "specimen": m.given.specimen, "message": m.trouble}) for m in members]
    table = {}
    for method, point in columns:
        table.setdefault(method, {})[point] = vars(found[method, point])
    return {"test": given.test, "confidence": given.confidence, "units": {"toughness": "J/m2", "variation": ""}, "statistics": table,
            "specimens": specimens, "warnings": warnings}
