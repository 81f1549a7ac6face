#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Toughnesses by the standards: `delam evaluate dcb | enf | mmb FILE.. --width 25mm --arm 1.5mm --notch 50mm .. --out DIR`.

Reads the raw files of a test machine as `delam fit` does. Of one specimen, writes DIR/evaluate.json, DIR/r-curve.csv and
DIR/evaluate.png; the lines say the toughness of each method at each point with its interval, beside that of a fit
(--beside). Of several, writes DIR/series.json, DIR/series.csv, DIR/r-curves.csv and DIR/series.png (series/).
"""
import contextlib
import json
import os

import command

if __name__ == "__main__":
    command.begin("delam: evaluate")

from packages import require  # noqa: E402

require("numpy", "scipy", "matplotlib")

from _pictures.input_file import MOST_RESULT, Unreadable, read_json  # noqa: E402
from command import loading, overheard, say  # noqa: E402
from analyses import DONE, Trouble, given_words, hold, run_study  # noqa: E402
from evaluation import TITLES, Evaluation  # noqa: E402
from own_files import owned, write_file  # noqa: E402
from series.evaluate import NAMES as OF_SERIES  # noqa: E402
from series.evaluate import evaluate_series  # noqa: E402
from series.members import is_series  # noqa: E402
from specimens.beside import beside, compared  # noqa: E402

NAMES = ["evaluate.json", "r-curve.csv", "evaluate.png"]


def earlier(given, path):
    """True if an evaluation is there; that of another test, or of a series, is refused without --replace."""
    if os.path.lexists(os.path.join(given.out, OF_SERIES[0])):
        if not given.replace:
            raise Trouble(f"{given.out} holds the evaluation of a series: --replace, or another --out")
        return True
    place = os.path.join(given.out, NAMES[0])
    if not os.path.lexists(place):
        return False
    before = {}
    with contextlib.suppress(Unreadable):
        before = read_json(place, MOST_RESULT)
    same = (before.get("test") == given.test and os.path.realpath(str(before.get("file"))) == os.path.realpath(path)
            and before.get("specimen", given.specimen) == given.specimen)
    if before and not same and not given.replace:
        raise Trouble(f"{given.out} holds the evaluation of another test, {before.get('test')} of {before.get('file')}: --replace, or another --out")
    return True


def evaluate_one(given):
    """One specimen, into its folder."""
    with overheard(keep=False) as warnings:
        fitted = beside(given.beside, given.data[0]) if given.beside else []
        found = Evaluation(given)
        with loading():
            from specimens.pictures import draw
        for line in found.lines():
            say(line)
        bands = compared(given.test, fitted, found.answers)
    replaced = earlier(given, found.curve.path)
    with owned(given.out, NAMES, OF_SERIES):
        about = found.about() | {"fit": [{"key": row[0], "value": row[1], "interval": [end if end == end else None for end in row[2:]]}
                                         for row in fitted], "warnings": warnings}
        write_file(os.path.join(given.out, "evaluate.json"), json.dumps(about, indent=1, allow_nan=False))
        rows = ["method,displacement (mm),crack (mm),toughness (J/m2)"]
        for answer in found.answers:
            rows += [f"{answer.name},{1e3 * w:.9g},{1e3 * a:.9g},{g:.9g}" for w, a, g in zip(answer.where, answer.crack, answer.rate)]
        write_file(os.path.join(given.out, "r-curve.csv"), "\n".join(rows) + "\n")
        draw(given.out, TITLES[given.test], found.curve, found.answers, found.points, bands, found.intervals, given.confidence)
    say(f"wrote {given.out}: {', '.join(NAMES)}" + (", in the place of an earlier evaluation" if replaced else ""))
    return DONE


def main():
    given = given_words()
    return evaluate_series(given, NAMES) if is_series(given) else evaluate_one(given)


if __name__ == "__main__":
    run_study(main)
