# SPDX-License-Identifier: BSD-3-Clause
"""The sheet of an evaluated specimen in SI, and whether the numbers that follow from it can be those of a specimen."""
import math
import re

from command import Trouble, complain
from measured.units import kind_of, quantity
from specimens import usual
from specimens.thickness import taken_for_arm

# key: its kind, and an example.
SHEET = {"width": ("length", "25mm"), "arm": ("length", "1.5mm"), "thickness": ("length", "3mm"), "notch": ("length", "50mm"), "span": ("length", "100mm"),
         "half-span": ("length", "50mm"), "lever": ("length", "41.3mm"), "block-pin": ("length", "5mm"),
         "block-length": ("length", "10mm"), "E1": ("stress", "140GPa"), "E2": ("stress", "10GPa"), "G13": ("stress", "5GPa"),
         "G12": ("stress", "5GPa"), "compliance": ("length/force", "2e-5mm/N")}
NEEDED = {"dcb": ("width", "arm", "notch"), "enf": ("width", "arm", "notch", "span"),
          "mmb": ("width", "arm", "notch", "span", "lever", "E1", "E2", "G13")}
# Two names of one number, and the factor.
SAME = (("span", "half-span", 2.0), ("G13", "G12", 1.0), ("arm", "thickness", 0.5))
# The modulus that the initial compliance has over E1. Bending tests of laminates give 0.8 to 1.1 of the modulus of tension, a
# compliance of 5 % that is not taken off and a notch of 50 mm that is 1 mm off move it by 5 % each: beyond the first pair a
# number of the sheet or a unit is likely wrong. The opening of one arm for that of both makes 2, 15 mm of width for 25 mm 1.7.
# Beyond the second pair something is certainly wrong: units differ by factors of ten.
LIKELY, CERTAIN = (0.75, 1.25), (0.1, 10.0)
UNROTATED = 0.6  # the lower one without --E2 and --G13: the rotation of the arms at the tip counts as bending then, up to a fourth
HALVED = (0.5, 2.0)  # beyond, a half that was taken for a whole, or the reverse, is refused
MODULI = 1e9, 1e12  # Pa, without E1: from a plastic to twice the stiffest carbon fibres in resin


def sheet_of(given):
    """The specimen in SI."""
    sheet = {}
    for key, (kind, example) in SHEET.items():
        text = given.sheet.get(key, "")
        if not text:
            continue
        read = quantity(re.sub(r"^(\s*\d+),(\d)", r"\1.\2", text), kind)
        if read is None or not read[1] or not read[0] > 0:
            raise Trouble(f"--{key} {text[:60]}: a number > 0 with its unit is expected, such as {example}")
        sheet[key] = read[0] * kind_of(read[1])[1]
    for key, other, factor in SAME:
        if other in sheet:
            value = factor * sheet.pop(other)
            if abs(sheet.get(key, value) / value - 1) > 1e-6:
                raise Trouble(f"--{key} {given.sheet[key]} and --{other} {given.sheet[other]} contradict each other: give one of them")
            sheet[key] = value
    mistaken = taken_for_arm(given.test, 1e3 * sheet.get("arm", 0.0), given.sheet)
    if mistaken:
        raise Trouble(mistaken)
    others = {key: other for key, other, _ in SAME}
    missing = [f"--{key}" + (f" (or --{others[key]})" if key in others else "") + f", such as {SHEET[key][1]}"
               for key in NEEDED[given.test] if key not in sheet]
    if missing:
        raise Trouble(f"{given.test} needs {'; '.join(missing)}")
    if "span" in sheet and not sheet["notch"] < 0.5 * sheet["span"]:
        raise Trouble(f"--notch {given.sheet['notch']}: less than the half span of {500 * sheet['span']:g} mm is expected")
    if "lever" in sheet and not sheet["lever"] > sheet["span"] / 6:
        raise Trouble(f"--lever {given.sheet['lever']}: more than a third of the half span, {1e3 * sheet['span'] / 6:.4g} mm, is expected: below, "
                      "the lever presses the arms together, and there is no mode I")
    if "block-pin" in sheet and given.test != "dcb":
        raise Trouble("--block-pin is of dcb alone")
    return sheet


# Mistakes that change the modulus, the factor that makes up for each, and what was likely given.
MISTAKES = (("arm", 0.5, "--arm is that of the whole specimen (--thickness)"), ("span", 2.0, "--span is half of the span (--half-span)"),
            ("span", 0.5, "--half-span is the whole span (--span)"))
MADE_UP = (0.7, 1.3)  # modulus over --E1 without the mistake: bending tests give 0.8 to 1.1, and a compliance has an error
# Units that people take for each other, the likelier first; prefixes and decimal places that they miss.
TAKEN_FOR = (("N", "kN", "lbf"), ("mm", "um", "cm", "m", "in"))
PLACES, PREFIXES = (0.1, 10.0), (1e-3, 1e3)
SHOWN = 3  # mistakes that a message names, the nearest first: more are no help


def _of_the_file(modulus_at, compliance, sheet, names):
    """With other units of load and displacement, and with columns that were exchanged: the modulus, and what is wrong."""
    for kind, word, name, units, power in zip(("force", "length"), ("load", "displacement"), names[::-1], TAKEN_FOR, (-1, 1)):
        for unit in units:
            factor = kind_of(unit)[1] / kind_of(name)[1]
            if kind_of(name)[0] == kind and abs(factor - 1) > 1e-9:
                yield modulus_at(factor ** power * compliance, sheet), f"the {word} of the file is in {unit} and not in {name} (--units)"
    per = kind_of(names[0])[1] / kind_of(names[1])[1]
    yield modulus_at(per * per / compliance, sheet), "displacement and load are exchanged (--columns X Y)"


def mistakes(modulus_at, compliance, sheet, names):
    """What was likely taken for something else, because the modulus would be --E1 without that mistake, the nearest first: a
    whole for a half, a unit, a decimal place, a prefix. names: units of displacement and load."""
    def with_number(key, factor):
        return modulus_at(compliance, {**sheet, key: factor * sheet[key]})

    found = [(with_number(key, factor), what) for key, factor, what in MISTAKES if key in sheet]
    found += _of_the_file(modulus_at, compliance, sheet, names)
    for key, (low, high) in (("arm", usual.ARM), ("width", usual.WIDTH), ("notch", usual.LENGTH), ("span", usual.LENGTH)):
        found += [(with_number(key, factor), f"--{key} is {1e3 * factor * sheet[key]:.4g}mm") for factor in PLACES
                  if key in sheet and low < 1e3 * factor * sheet[key] < high]
    found += [(modulus_at(compliance, sheet) / factor, f"--E1 is {factor * sheet['E1'] / 1e9:.4g}GPa") for factor in PREFIXES
              if usual.E1[0] < factor * sheet["E1"] / 1e9 < usual.E1[1]]
    near = [(round(abs(math.log(modulus / sheet["E1"])), 3), k, what) for k, (modulus, what) in enumerate(found)
            if MADE_UP[0] < modulus / sheet["E1"] < MADE_UP[1]]
    return [what for _, _, what in sorted(near)][:SHOWN]


def agreeing(modulus_of, sheet, key):
    """The number of the sheet with which the modulus would be --E1, between a third and three times of it; None: there is none."""
    low, high = sheet[key] / 3, 3 * sheet[key]

    def off(value):
        return modulus_of({**sheet, key: value}) - sheet["E1"]

    if not off(low) * off(high) < 0:
        return None
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if off(low) * off(middle) > 0 else (low, middle)
    return middle


def reasons(modulus_of, sheet, ratio, test):
    """What can make the modulus differ from --E1, in words: numbers of the sheet with which it would not."""
    found = [(name, factor, agreeing(modulus_of, sheet, key))
             for key, name, factor in (("width", "width", 1e3), ("arm", "thickness", 2e3), ("notch", "notch", 1e3))]
    said = "it would agree with a " + ", a ".join(f"{name} of {factor * value:.3g} mm" for name, factor, value in found if value)
    if test == "dcb" and MADE_UP[0] < ratio / 2 < MADE_UP[1]:
        said += ", or if the displacement is the opening of one arm and not of both"
    if ratio < 1:
        said += ", or if machine and fixture give way (--compliance)"
    return said + "; or E1, or a unit of the file (--units), is another one"


def require_modulus(modulus_at, compliance, sheet, curve, test):
    """Refuses a bending modulus, a function of the compliance and the sheet, that no specimen has, and warns of an unlikely
    one; returns it."""
    modulus = modulus_at(compliance, sheet)
    said = (f"{curve.path}: the initial compliance of {1e3 * compliance:.4g} mm/N ({curve.read_as}) gives a bending modulus of "
            f"{modulus / 1e9:.4g} GPa")
    advice = "units of the file (--units), another test, or a wrong --notch, --arm, --width or --span are likely"
    if "E1" not in sheet:
        if not MODULI[0] < modulus < MODULI[1]:
            raise Trouble(f"{said}: {MODULI[0] / 1e9:g} to {MODULI[1] / 1e9:g} GPa are expected: {advice}")
        return modulus
    ratio = modulus / sheet["E1"]
    said += f", --E1 is {sheet['E1'] / 1e9:g} GPa"
    what = mistakes(modulus_at, compliance, sheet, curve.names) if not HALVED[0] < ratio < HALVED[1] else []
    if what:
        raise Trouble(f"{said}, and would agree if {', or if '.join(what)}")
    if not CERTAIN[0] < ratio < CERTAIN[1]:
        raise Trouble(f"{said}: {advice}")
    if not (LIKELY[0] if {"E2", "G13"} <= sheet.keys() else UNROTATED) < ratio < LIKELY[1]:
        complain(f"warning: {said}: {reasons(lambda one: modulus_at(compliance, one), sheet, ratio, test)}")
    return modulus


def require_growing(lengths, compliances, path, advice, each=False):
    """Refuses compliances that do not grow with the crack, of which no calibration is one: as a whole, for marks that an
    operator reads, or from each length to the next, for files of one length each."""
    order = sorted(range(len(lengths)), key=lambda k: lengths[k])
    first, last = order[0], order[-1]
    if not lengths[last] > lengths[first]:
        raise Trouble(f"{path}: all crack lengths are {1e3 * lengths[first]:g} mm: a calibration needs different ones")
    middle = sum(lengths) / len(lengths)
    falls = [(a, b) for a, b in zip(order, order[1:]) if not compliances[b] > compliances[a]] if each else []
    if falls or not sum((a - middle) * c for a, c in zip(lengths, compliances)) > 0:
        first, last = falls[0] if falls else (first, last)
        raise Trouble(f"{path}: the compliance does not grow with the crack: {1e3 * compliances[first]:.4g} mm/N at "
                      f"{1e3 * lengths[first]:g} mm, {1e3 * compliances[last]:.4g} mm/N at {1e3 * lengths[last]:g} mm: {advice}")
