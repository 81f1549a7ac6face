# SPDX-License-Identifier: BSD-3-Clause
"""Units of lengths, forces, times and stresses: their sizes, and how people write them. Standard library alone."""
import math
import re

# In m, N, s, Pa. Symbols are read as they stand; where one is unknown, without regard to capitals.
SIZES = {
    "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "micron": 1e-6, "nm": 1e-9,
               "in": 0.0254, "inch": 0.0254, "in.": 0.0254, "ft": 0.3048, "mil": 2.54e-5},
    "force": {"N": 1.0, "kN": 1e3, "MN": 1e6, "mN": 1e-3, "daN": 10.0, "lbf": 4.4482216152605, "lb": 4.4482216152605,
              "kip": 4448.2216152605, "klbf": 4448.2216152605, "kgf": 9.80665, "kp": 9.80665, "gf": 9.80665e-3},
    "time": {"s": 1.0, "sec": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "psi": 6894.757293168, "ksi": 6894757.293168,
               "msi": 6894757293.168},
}
# By the capitals alone these would be others.
DISTINCT = {"mN", "MN", "mPa", "mn"}


def kind_of(symbol):
    """The kind of a unit and its size in SI; (None, 1.0): it is none of the table."""
    text = symbol.strip()
    for kind, sizes in SIZES.items():
        if text in sizes:
            return kind, sizes[text]
    for kind, sizes in SIZES.items():
        for known, size in sizes.items():
            if known.lower() == text.lower() and not {known, text} & DISTINCT:
                return kind, size
    if "/" in text:  # a force per width, or a compliance
        above, below = (kind_of(part) for part in text.split("/", 1))
        if (above[0], below[0]) in (("force", "length"), ("length", "force")):
            return f"{above[0]}/{below[0]}", above[1] / below[1]
    return None, 1.0


# Each key of a scene has a quantity, which the end of its name tells.
OF_KEYS = (("toughness", "{force}/{length}"), ("stiffness", "{force}/{length}^3"), ("strength", "{force}/{length}^2"),
           ("young", "{force}/{length}^2"), (r"\b[EG][123]+", "{force}/{length}^2"), ("thickness", "{length}"),
           (r"geometry\.(length|width|h)", "{length}"))


def unit_of_key(path, units):
    """" N/mm": the unit of the number at a path of a scene, after a blank. units: of length and force; "" where the scene
    names none, or the key is not of the table."""
    length, force = units
    form = next((form for ending, form in OF_KEYS if re.search(f"(?:{ending})$", path)), None)
    return " " + form.format(length=length, force=force) if form and length and force else ""


ENDING = re.compile(r"\s*(?:\[([^\[\]]*)\]|\(([^()]*)\)|(?:\bin|/|,)\s*([^\s,/]+)|_([A-Za-zµμ]+))\s*$")


def title_and_unit(title):
    """"Load (kN)", "Kraft [N]", "Weg in mm", "Extension, mm", "load_kN": the title without its unit, and the unit or
    "". What is no unit of the table stays within the title, unless it stands in square brackets."""
    match = ENDING.search(title)
    if match is None:
        return title.strip(), ""
    unit = next(group for group in match.groups() if group is not None).strip()
    if kind_of(unit)[0] is None:
        return (title[:match.start()].strip(), "") if match.group(1) is not None else (title.strip(), "")
    rest = title[:match.start()].strip()
    return (rest, unit) if rest else (title.strip(), unit)


def quantity(text, kind):
    """A number with or without a unit of this kind, "25mm", "25 mm", "1.5e-3 m": the number and the unit or "". None:
    it is no such quantity."""
    match = re.fullmatch(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S*)\s*", text)
    if match is None or not math.isfinite(float(match.group(1))):
        return None
    unit = match.group(2)
    if unit and kind_of(unit)[0] != kind:
        return None
    return float(match.group(1)), unit
