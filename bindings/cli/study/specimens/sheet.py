# SPDX-License-Identifier: BSD-3-Clause
"""The sheet of an evaluated specimen in SI, and whether the numbers that follow from it can be those of a specimen."""
import re

from command import Trouble, complain
from measured.units import kind_of, quantity
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
# The modulus that the initial compliance has over E1: bending tests give 0.8 to 1.1 of that of tension, so that beyond the
# first pair something else is likely wrong, and beyond the second certain: units differ by factors of ten. Half of these
# distances would complain of soft fixtures, twice of them would miss the whole span taken for its half.
LIKELY, CERTAIN = (0.5, 2.0), (0.1, 10.0)
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
    if "block-pin" in sheet and given.test != "dcb":
        raise Trouble("--block-pin is of dcb alone")
    return sheet


# Mistakes that change the modulus, the factor that makes up for each, and what was likely given.
MISTAKES = (("arm", 0.5, "--arm is that of the whole specimen (--thickness)"), ("span", 2.0, "--span is half of the span (--half-span)"),
            ("span", 0.5, "--half-span is the whole span (--span)"))
MADE_UP = (0.7, 1.3)  # modulus over --E1 without the mistake: bending tests give 0.8 to 1.1, and a compliance has an error


def mistake(modulus_of, sheet):
    """What was likely taken for something else, because the modulus would be --E1 without that mistake; nothing if none."""
    for key, factor, what in MISTAKES:
        if key in sheet and MADE_UP[0] < modulus_of({**sheet, key: factor * sheet[key]}) / sheet["E1"] < MADE_UP[1]:
            return what
    return ""


def require_modulus(modulus_of, compliance, sheet, curve):
    """Refuses a bending modulus, a function of the sheet, that no specimen has, and warns of an unlikely one."""
    modulus = modulus_of(sheet)
    said = (f"{curve.path}: the initial compliance of {1e3 * compliance:.4g} mm/N ({curve.read_as}) gives a bending modulus of "
            f"{modulus / 1e9:.4g} GPa")
    advice = "units of the file (--units), another test, or a wrong --notch, --arm, --width or --span are likely"
    if "E1" in sheet:
        ratio, wanted = modulus / sheet["E1"], f", --E1 is {sheet['E1'] / 1e9:g} GPa"
    else:
        ratio, wanted = None, f": {MODULI[0] / 1e9:g} to {MODULI[1] / 1e9:g} GPa are expected"
    what = mistake(modulus_of, sheet) if ratio is not None and not LIKELY[0] < ratio < LIKELY[1] else ""
    if what:
        raise Trouble(f"{said}{wanted}, and would agree if {what}")
    if not (CERTAIN[0] < ratio < CERTAIN[1] if ratio is not None else MODULI[0] < modulus < MODULI[1]):
        raise Trouble(f"{said}{wanted}: {advice}")
    if ratio is not None and not LIKELY[0] < ratio < LIKELY[1]:
        complain(f"warning: {said}{wanted}: {advice}")


def require_growing(lengths, compliances, path, advice):
    """Refuses compliances that do not grow with the crack as a whole, of which no calibration is one."""
    order = sorted(range(len(lengths)), key=lambda k: lengths[k])
    first, last = order[0], order[-1]
    if not lengths[last] > lengths[first]:
        raise Trouble(f"{path}: all crack lengths are {1e3 * lengths[first]:g} mm: a calibration needs different ones")
    middle = sum(lengths) / len(lengths)
    if not sum((a - middle) * c for a, c in zip(lengths, compliances)) > 0:
        raise Trouble(f"{path}: the compliance does not grow with the crack: {1e3 * compliances[first]:.4g} mm/N at "
                      f"{1e3 * lengths[first]:g} mm, {1e3 * compliances[last]:.4g} mm/N at {1e3 * lengths[last]:g} mm: {advice}")
