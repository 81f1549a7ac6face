# SPDX-License-Identifier: BSD-3-Clause
"""Whether crack lengths, the numbers of methods and their toughnesses agree with each other and with the compliance."""
import numpy as np

from command import Trouble, complain
from specimens import methods
from specimens.usual import TOUGHNESS

# A crack that is longer than the notch by the first part makes the specimen softer by the second part of that at least: by 2.8
# times in a DCB, and by half in an MMB with a lever of the half span. Half and twice of both refuse the same marks in test_tables.py.
SURELY_GROWN, LEAST_SOFTER = 0.05, 0.2
SHORTER = 0.8  # of the notch: a first crack below is a growth, or counts from elsewhere; an operator reads to 1 mm of 30 to 50
# By this part of the notch the first crack may differ from the one that the compliance has: 2 to 3 mm, where an operator reads
# to half a millimetre and a front bends by 1 mm. The last one is not asked: bridging fibres stiffen a long crack.
FIRST_OFF = 0.06
# The offset of corrected beam theory over chi h: readings that err by half a millimetre move it by 1 mm of 3, and bridging doubles it.
OFFSET = (1 / 3, 3.0)
EXPONENT = (2.5, 3.1)  # n of the compliance calibration is 3 a / (a + offset): 2.6 for short cracks in thick arms, 3 at most
DISAGREE = 0.1  # between methods: on the same test they agree to some per cent

LARGE = 0.4  # opening over crack: the factor F of ISO 15024, 1 - 0.3 (opening / crack)^2, takes off 5 % there


def _modulus_matches(modulus_at, compliance, first, sheet):
    """The crack with which this compliance has the modulus that the first one has at the notch."""
    low, high = 0.2 * sheet["notch"], 5 * sheet["notch"]
    wanted = modulus_at(first, sheet)
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if modulus_at(compliance, {**sheet, "notch": middle}) < wanted else (low, middle)
    return middle


def require_lengths(curve, sheet, given):
    """Refuses marks that are no crack lengths from the line of load on, or not those of this notch."""
    marks, path = curve.marks, given.marks or curve.path
    if len(marks) and not marks[:, 2].max() > sheet["notch"]:
        raise Trouble(f"{path}: the cracks of the file, up to {1e3 * marks[:, 2].max():g} mm, are not longer than --notch "
                      f"{given.sheet['notch']}, from where they grow: lengths from the line of load are expected, no growths")
    if len(marks) and marks[0, 2] < SHORTER * sheet["notch"]:
        raise Trouble(f"{path}: the first crack is {1e3 * marks[0, 2]:.4g} mm long, --notch is {given.sheet['notch']}: lengths from the "
                      "line of load are expected, no growths: add the notch to them")


def require_marks(marks, curve, points, sheet, given, modulus_at):
    """Refuses marks where the compliance is still that of the notch, and tells where it is that of another crack. modulus_at:
    the bending modulus of a compliance and a sheet."""
    path = given.marks or curve.path
    if not len(marks):
        return
    longest = marks[np.argmax(marks[:, 2])]
    grown, softer = longest[2] / sheet["notch"] - 1, (longest[0] - points.zero) / longest[1] / points.compliance - 1
    if grown > SURELY_GROWN and not softer > LEAST_SOFTER * grown:
        raise Trouble(f"{path}: the crack of {1e3 * longest[2]:g} mm is marked at a displacement of {1e3 * longest[0]:.4g} "
                      f"mm, where the compliance is still that of the notch of {given.sheet['notch']}: is the time or the displacement of "
                      "the marks in another unit, or do they belong to another test?")
    d, p, a = marks[0]
    own = _modulus_matches(modulus_at, (d - points.zero) / p, points.compliance, sheet)
    if abs(a - own) > FIRST_OFF * sheet["notch"]:
        complain(f"warning: {path}: the first crack is {1e3 * a:.4g} mm long, and by the compliance there {1e3 * own:.4g} mm, from --notch "
                 f"{given.sheet['notch']} on: are both measured from the line of load, is --notch that of the crack before the test, "
                 "and were time or displacement of the marks read at the same moment?")


def said_of_marks(marks, notch):
    """How many marks count for means, in words; nothing if all of them do."""
    beyond = int(np.sum(marks[:, 2] > 1.0001 * notch)) if len(marks) else 0
    left = len(marks) - beyond
    return (f"marks: {beyond} of {len(marks)} count for the mean; the crack of the other{'s are' if left > 1 else ' is'} not longer than "
            f"the notch" if left else "")


def complain_of_offsets(numbers, sheet, modulus):
    """numbers: by method and name; what corrected beam theory and calibration find is compared with what the moduli give."""
    off = []
    offset = numbers.get("modified beam theory", {}).get("offset")
    rotation = sheet["arm"] * methods.chi(sheet.get("E1", modulus), sheet["E2"], sheet["G13"]) if {"E2", "G13"} <= sheet.keys() else None
    if offset == 0:
        off.append("the line of the cube roots of the compliances has an offset below zero, which is taken as zero")
    elif offset is not None and rotation and not OFFSET[0] < offset / rotation < OFFSET[1]:
        off.append(f"the offset of beam theory is {1e3 * offset:.3g} mm, where the moduli give {1e3 * rotation:.3g} mm (chi h)")
    n = numbers.get("compliance calibration", {}).get("n")
    if n is not None and not EXPONENT[0] < n < EXPONENT[1]:
        off.append(f"n of the compliance calibration is {n:.3g}, and {EXPONENT[0]:g} to {EXPONENT[1]:g} in a DCB")
    if off:
        complain(f"warning: {', and '.join(off)}: crack lengths that do not count from the line of load, or were not read at the "
                 "moment that stands beside them, are likely")


def complain_of_spread(table):
    """table: the toughness of each method at each point."""
    at_max = sorted((rates["max"], name) for name, rates in table.items())
    if len(at_max) > 1 and at_max[-1][0] > (1 + DISAGREE) * at_max[0][0]:
        (low, one), (high, other) = at_max[0], at_max[-1]
        complain(f"warning: the methods differ by {100 * (high / low - 1):.0f} % at the largest load: {low:.4g} J/m2 ({one}), {high:.4g} "
                 f"J/m2 ({other}): width, thickness, notch, crack lengths or --E1 do not fit together")


def complain_of_opening(path, opening, crack):
    """Says where a DCB opens so far that its arms are no beams of small rotations; openings from zero on, and cracks."""
    k = int(np.argmax(opening / crack))
    if opening[k] > LARGE * crack[k]:
        complain(f"warning: {path}: at an opening of {1e3 * opening[k]:.4g} mm the crack is {1e3 * crack[k]:.4g} mm long: beyond {LARGE:g} of the "
                 f"crack, arms rotate too far for beam theory, of which corrected beam theory alone takes off what is too much, "
                 f"{30 * (opening[k] / crack[k]) ** 2:.0f} %: is the displacement in another unit (--units), or is the specimen too thin?")


def complain_of_growth(curve, points):
    """Says that a curve ends before the crack grows: at its largest load, and on its initial line."""
    last = len(curve.displacement) - 1
    if not curve.broken and points.top == last and all(point.place in (-1, last) for point in points.points):
        complain(f"warning: {curve.path}: the curve ends at its largest load, still on its initial line: if the specimen did not break "
                 "there, its crack has not grown, and toughnesses are larger than these values")


def complain_of_toughness(table, curve):
    """Says which toughness no laminate has."""
    odd = [(rates["max"], name) for name, rates in table.items() if not TOUGHNESS[0] <= rates["max"] <= TOUGHNESS[1]]
    if odd:
        complain(f"warning: {curve.path}: {odd[0][0]:.4g} J/m2 at the largest load ({odd[0][1]}), and laminates have {TOUGHNESS[0]:g} to "
                 f"{TOUGHNESS[1]:g} J/m2: is the load in another unit ({curve.read_as}; --units), or of another column (--columns)?")
