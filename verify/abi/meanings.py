#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""meanings.py HEADER LIBRARY [--past LIBRARY ...] [--exchange] [--rows WORDS] [--baseline FILE] [--write]
[--new-defaults]: do arguments, options and defaults still mean what they meant?

The table of meaning/rows_*.py has a row for each array of the header, each option and each default in the words of the
header. A row computes a small scene and compares its result with a closed form or with an evaluation of its own; the
numbers that it sees are also compared with those of the baseline, which stand for past releases. --past: shared
libraries of past releases, which the same table is run on; what a release did not have yet (symbols.txt says since
when) is left out and listed. --new-defaults: rows of options may differ from the baseline.

The table is complete, or the gate fails with the name of what is missing:
    array      every parameter that points to numbers is told apart by a row, and so is every field; what callbacks are
               given is seen by a row
    cell type  has a row "connectivity of NAME"
    option     every key of delam_option_info has a row that observes its default
    default    words of the header such as "0 selects 1e-6" (SPECIAL) have a row, or describe a result (RESULTS)
A row that claims an array must really pass it; --exchange proves more: it exchanges any two neighbours of every array
on its way, and the row must see it.

Exit code 1, and a line for each difference.
"""
import argparse
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "meaning")]
import contract_lint as lint  # noqa: E402
import gate  # noqa: E402
import header as headers  # noqa: E402
import keys  # noqa: E402
import table  # noqa: E402
from host import Host, Missing, Refused, Twist  # noqa: E402

table.load()

BASELINE = os.path.join(HERE, "baseline", "meanings.txt")
SPECIAL = re.compile(r"(?<![\w.])(?<!index from )(?:0|-1|NULL)(?:\)?: | selects| gives| means| takes| if | with count"
                     r"|, counts)|\bdefault\b(?! value)(?<!its default)")
# What such words say of results.
RESULTS = {
    "blas_threads: 0 if BLAS", "problem_process_zone: length 0: ",
    "solver_value: 0 if no pair", "solver_value: 0 if none was compared",
    "solver_value: 0: none of them has less", "solver_value: 0 if they are direct",
    "solver_value: largest jump (0: none)", "solver_value: of a pair (0: none)",
    "solver_value: 0 if there is no front", "solver_recorded_size: 0 if nothing",
    "solver_average: 0 if no body", "solver_plan_item: (0 if left out)",
    "solver_jump: (-1: none)",
}
# Arrays whose order has no meaning.
UNORDERED = {("delam_mesh_add_host_body", "nodes")}


def run(host, row):
    """Runs a row with a library and returns what it sees."""
    see = table.See(row.name)
    host.used = {}
    host.open()
    try:
        row.run(host, see)
    except Refused as refused:
        see.failures.append(f"{row.name}: {refused}")
    except (ArithmeticError, LookupError, TypeError, ValueError, StopIteration) as error:
        see.failures.append(f"{row.name}: {type(error).__name__}: {error}")
    finally:
        host.close()
    return see


def places_of(row):
    """"function parameter key" -> as Host.used has it. The names of callbacks alone are left out."""
    return {place_of(tell) for tell in row.tells if " " in tell}


def place_of(tell):
    function, parameter, *key = tell.split(" ")
    return "delam_" + function, parameter, key[0] if key else None


# ---- completeness ----
def phrases(header):
    """(function, text, start, end of what SPECIAL finds)"""
    for function in header.functions.values():
        prose = " ".join(lint.fields_of(function.comment)[1].split())
        for match in SPECIAL.finditer(prose):
            yield function.name, prose, match.start(), match.end()


def gaps(header, host, rows):
    """Lists what the table lacks, and what it has that does not exist."""
    told = {place for row in rows for place in places_of(row)}
    arrays = {("delam_" + name[6:], parameter, None) for name, kinds in host.shapes.items()
              for parameter, kind, _ in kinds if kind in ("in", "out")}
    for function, parameter, _ in sorted(arrays - {(f, p, None) for f, p, _ in told}):
        yield f"{function}: {parameter}: no row of the table tells what its entries mean"
    alone = {tell for row in rows for tell in row.tells if " " not in tell}
    for name in sorted(set(header.callbacks) - alone):
        yield f"{name}: no row of the table tells what it is given"
    for name in sorted(alone - set(header.callbacks)):
        yield f"{name}: in the table, not in the header"
    for key in keys.fields_of(header):
        if ("delam_solver_field", "values", key) not in told:
            yield f"field {key}: no row of the table tells what its columns mean"
    for function, parameter, _ in sorted(told, key=str):
        if (function, parameter, None) not in arrays:
            yield f"{function}: {parameter}: in the table, not in the header"
    names = {row.name for row in rows}
    for name, *_ in keys.cells_of(host.library):
        if f"connectivity of {name}" not in names:
            yield f"cell type {name}: no row of the table tells the order of its nodes"
    observed = {key for row in rows for key in row.options}
    options = set(keys.described(host.library.delam_option_info, host.library.delam_option_count()))
    for key in sorted(options - observed):
        yield f"option {key}: no row of the table observes its default"
    for key in sorted(observed - options):
        yield f"option {key}: in the table, not in the library"
    yield from gaps_of_words(header, rows)


def gaps_of_words(header, rows):
    claims = {claim for row in rows for claim in row.says} | RESULTS
    said = set()
    for name, prose, start, end in phrases(header):
        own = [claim for claim in claims if claim.partition(": ")[0] == name[len("delam_"):]]
        hits = [claim for claim in own for found in re.finditer(re.escape(claim.partition(": ")[2]), prose)
                if found.start() < end and start < found.end()]
        said.update(hits)
        if not hits:
            yield f"{name}: '...{prose[max(0, start - 20):end + 30]}...': no row of the table observes it"
    for claim in sorted(claims - said):
        yield f"'{claim}': in the table, not in the header"


# ---- libraries ----
class Table:
    """The rows, run on one library."""

    def __init__(self, path, header, baseline, past=False, new_defaults=False):
        self.header, self.baseline, self.past, self.new_defaults = header, baseline, past, new_defaults
        self.host = Host(header, keys.library_of(path, header, past))
        self.numbers, self.failures, self.left_out, self.count = {}, [], [], 0

    def version(self):
        return tuple(int(n) for n in self.host("version").split(".")[:2])

    def later(self, function, listed):
        return tuple(int(n) for n in listed[function].split(".")) > self.version()

    def options(self):
        return set(keys.described(self.host.library.delam_option_info, self.host.library.delam_option_count()))

    def rows(self, rows):
        listed = gate.read_list(os.path.join(HERE, "symbols.txt"))
        known = self.options()
        seen = set()
        for row in rows:
            if self.past and not set(row.options) <= known:
                self.left_out.append(f"{row.name}: no option {', '.join(sorted(set(row.options) - known))}")
                continue
            try:
                see = run(self.host, row)
            except Missing as missing:
                if self.past and self.later(str(missing), listed):
                    self.left_out.append(f"{row.name}: no function {missing}")
                else:
                    self.failures.append(f"{row.name}: {missing}: the library does not have it")
                continue
            if not (row.options and self.new_defaults):
                seen.add(row.name)
            self.count += 1
            self.numbers.update(see.numbers)
            self.failures += see.failures
            if not see.failures:
                for place in sorted(places_of(row) - set(self.host.used), key=str):
                    self.failures.append(f"{row.name}: claims {' '.join(p for p in place if p)}, but does not use it")
        if self.baseline is not None:
            self.failures += table.against(self.baseline, self.numbers, seen)


def exchanges(host, row):
    """Neighbours of arrays that the row claims and that it does not see exchanged."""
    run(host, row)
    lengths = {place: host.used.get(place, 0) for place in sorted(places_of(row), key=str)}
    baseline = table.read_baseline(BASELINE)
    for (function, parameter, key), length in lengths.items():
        for index in range(max(length - 1, 1)):
            host.twist = Twist(function, parameter, key, index, (function, parameter) not in UNORDERED)
            try:
                see = run(host, row)
            finally:
                twist, host.twist = host.twist, None
            if twist.done:
                seen = see.failures or list(table.against(baseline, see.numbers, {row.name}))
                yield None if seen else f"{row.name}: entries {index} and {index + 1} of {function}'s {parameter}"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("header")
    parser.add_argument("library")
    parser.add_argument("--past", nargs="+", default=[], help="shared libraries of past releases")
    parser.add_argument("--of-the-past", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--exchange", action="store_true", help="exchange neighbours of arrays; each must be seen")
    parser.add_argument("--rows", help="only rows whose name contains these words")
    parser.add_argument("--baseline", default=BASELINE)
    parser.add_argument("--new-defaults", action="store_true", help="rows of options may differ from the baseline")
    parser.add_argument("--write", action="store_true", help="write what a new baseline would be")
    return parser.parse_args()


def main():
    options = arguments()
    try:
        header = headers.read(options.header)
    except headers.HeaderError as error:
        sys.exit(str(error))
    kept = table.read_baseline(options.baseline) if os.path.exists(options.baseline) and not options.write else None
    own = Table(options.library, header, kept, options.of_the_past, options.new_defaults)
    rows = [row for row in table.ROWS if (options.rows or "") in row.name]
    if options.exchange:
        found = [missed for row in rows for missed in exchanges(own.host, row)]
        missed = [text for text in found if text]
        for text in missed:
            print(f"{text}: exchanged, and not seen")
        print(f"{len(found)} exchanges of neighbours, {len(missed)} not seen")
        sys.exit(1 if missed or not found else 0)
    if not options.of_the_past and not options.rows:
        own.failures += gaps(header, own.host, table.ROWS)
    own.rows(rows)
    if options.write:
        sys.stdout.write(table.HEAD + "".join(table.line_of(place, unit, numbers) + "\n"
                                              for place, (unit, numbers) in own.numbers.items()))
        sys.exit("\n".join(own.failures) if own.failures else 0)
    for line in own.failures:
        print(line)
    for line in own.left_out:
        print(f"left out, {line}")
    new = len(set(own.numbers) - set(kept or {}))
    print(f"{os.path.basename(options.library)}: {own.count} rows, {len(own.numbers)} numbers or arrays of them "
          f"({new} not in the baseline yet), {len(own.failures)} failures")
    # Another process for each: a loader may take two libraries of one name for the same.
    past = [subprocess.run([sys.executable, os.path.abspath(__file__), options.header, path, "--of-the-past",
                            "--baseline", options.baseline], check=False).returncode
            for path in options.past]
    sys.exit(1 if own.failures or any(past) else 0)


if __name__ == "__main__":
    main()
