# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of a sheet that are possible and that no usual specimen has: a prefix too many or too few."""

from specimens.usual import ARM, E1, LENGTH, TOUGHNESS, WIDTH

LAMINATES, FIBRES = ("dcb", "adcb", "enf", "4enf", "mmb", "slb", "laminate"), ("fibre",)
BEAMS = LAMINATES[:-1]
# Names, kinds, the unit for people and how many of it are one in mm, N and MPa, what is possible, what is usual. A number
# beyond the first is told, and the prefix that brings it into the second is proposed. Possible are a tenth of what is usual and
# less, to ten times of it, so that an odd material is not told and a factor of 1000 always is.
ROWS = (
    (("GIc", "GIIc"), LAMINATES, "J/m2", 1e3, TOUGHNESS, (40, 6e3)),
    (("GIc", "GIIc"), FIBRES, "J/m2", 1e3, (0.05, 2e3), (0.5, 300)),
    (("E1",), LAMINATES, "GPa", 1e-3, (2, 1000), E1),
    (("E2", "G12"), LAMINATES, "GPa", 1e-3, (0.2, 120), (1, 90)),
    (("fibre-young",), FIBRES, "GPa", 1e-3, (1, 2000), (10, 900)),
    (("young",), LAMINATES + FIBRES, "GPa", 1e-3, (0.05, 1000), (0.5, 400)),
    (("normal-strength", "shear-strength"), LAMINATES + FIBRES, "MPa", 1.0, (0.5, 800), (3, 200)),
    (("arm", "lower-arm"), BEAMS, "mm", 1.0, (0.1, 50), ARM),
    (("width",), BEAMS, "mm", 1.0, (1, 300), WIDTH),
    (("notch", "half-span", "lever", "inner-span"), BEAMS, "mm", 1.0, (2, 1000), LENGTH),
    (("ply",), ("laminate",), "mm", 1.0, (0.005, 10), (0.02, 3)),
    (("radius",), FIBRES, "um", 1e3, (0.2, 500), (1, 100)),
    (("strain",), ("laminate", "fibre"), "%", 1e2, (0.01, 50), (0.1, 20)),
)
FACTORS = (1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9)


def warnings(kind, sheet, texts):
    """A sentence for each number that is beyond what is possible, with the one that may be meant."""
    out = []
    for names, kinds, unit, of_unit, (least, most), (low, high) in ROWS:
        for name in names:
            if kind not in kinds or name not in sheet or least <= sheet[name] * of_unit <= most:
                continue
            value = sheet[name] * of_unit
            meant = [f"{value * factor:.6g} {unit}" for factor in FACTORS if low <= value * factor <= high]
            asked = f": {meant[0].replace(' ', '')} may be meant" if meant else ""
            out.append(f"--{name} {texts.get(name) or ''} is {value:.4g} {unit}, and specimens have {low:g} to {high:g} {unit}{asked}")
    return out
