# SPDX-License-Identifier: BSD-3-Clause
"""The toughness of a fit beside that of a standard: only what both mean alike is compared."""
import os

from _pictures.input_file import MOST_RESULT, read_json
from command import Trouble, complain, say
from measured.units import kind_of

MODES = {"normal_toughness": "mode I", "tangential_toughness": "mode II"}
TOTAL = {"dcb": "mode I", "enf": "mode II"}  # of which mode the toughness of a test is


def beside(folder, measured):
    """measured: the file of this test. Toughnesses of a fit in J/m2, and exponents of its criterion: key, value, ends of the interval, with errors in what
    is held where the fit has looked at them; those of which it knows the units."""
    try:
        about = read_json(os.path.join(folder, "fit.json"), MOST_RESULT)
    except OSError as error:
        raise Trouble(f"--beside {folder}: {os.path.join(folder, 'fit.json')}: {error.strerror}; the folder of delam fit is "
                      "expected") from error
    sizes = [kind_of(unit) for unit in about.get("units", ["", ""])]
    if [kind for kind, _ in sizes] != ["length", "force"]:
        complain(f"warning: {folder}: its scene names no units of length and force: it cannot stand beside")
        return []
    if about.get("describes") is False:
        complain(f"warning: --beside {folder}: its model does not describe its curve: its toughness and interval mean nothing")
    names = [os.path.basename(path) for path in about.get("data", [])]
    if names and os.path.basename(measured) not in names:
        complain(f"warning: --beside {folder}: it is the fit of {', '.join(names[:3])}, and this is {os.path.basename(measured)}: "
                 "do both belong to one specimen?")
    factor, rows = sizes[1][1] / sizes[0][1], []
    for row in about["parameters"]:
        name = row["key"].rpartition(".")[2]
        size = factor if name in MODES else 1.0
        if name in MODES and row.get("told", True) or name == "toughness_exponent":
            rows.append((row["key"], row["value"] * size,
                         *(end * size if end is not None else float("nan")
                           for end in row.get("interval_with_held", row["interval"]))))
    return rows


def compared(test, fitted, answers):
    """Says the toughnesses of the fit, and returns those that can be drawn over those of the test: of its mode, or of a
    mixed test the sum at its share of mode II (Benzeggagh and Kenane), if the fit has both and the exponent."""
    by_name = {key.rpartition(".")[2]: row for key, *row in fitted}
    bands = []
    for key, value, low, high in fitted:
        mode = MODES.get(key.rpartition(".")[2])
        if mode is None:
            continue
        say(f"delam fit: {key} {value:.4g} J/m2, interval {low:.4g} to {high:.4g}, of {mode}")
        if TOTAL.get(test) == mode:
            bands.append((key, value, low, high))
        elif test in TOTAL:
            complain(f"warning: --beside: {key} is of {mode}, and this test of {TOTAL[test]}: it is not drawn")
    if test == "mmb" and fitted:
        share = answers[0].numbers["mode II share"]
        if {*MODES, "toughness_exponent"} <= by_name.keys():
            one, two, eta = (by_name[name][0] for name in (*MODES, "toughness_exponent"))
            total = one + (two - one) * share ** eta
            say(f"delam fit: {total:.4g} J/m2 at this share of mode II, {share:.3g} (Benzeggagh and Kenane)")
            bands.append((f"at a share of {share:.2f}", total, float("nan"), float("nan")))
        else:
            complain(f"warning: --beside: the toughness of this test is of both modes, with a share of mode II of {share:.3g}; one "
                     "test cannot give both, so that those of single modes are not drawn")
    return bands
