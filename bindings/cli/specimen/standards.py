# SPDX-License-Identifier: BSD-3-Clause
"""What the standards ask of a specimen, as rows: kind, standard, what it says, and whether the sheet has it (mm, N)."""
import math

import beams
from specimens.thickness import ASKED


def between(value, low, high):
    return value is None or 0.999 * low <= value <= 1.001 * high


def thick_enough(of):
    """The least thickness of both arms, so that displacements stay small (ASTM D5528)."""
    return 8.28 * (of.gic * of.notch ** 2 / of.e1) ** (1 / 3)


def mmb_notches(of):
    return 0.4 * of.half_span, 0.6 * of.half_span


def between_noses(of):
    return of.outside + 2 * of.arm, of.inside - 2 * of.arm


def thicknesses(of):
    """Of both arms, least and largest: a tough laminate has to be thicker than usual ones."""
    _, low, high = ASKED["dcb"]
    least = thick_enough(of)
    return (max(low, least), high) if least < high else (least, math.inf)


# A specimen breaks no row that another row of its kind asks for (`standards` in ../test/test_specimen.py). A text may name numbers of the sheet: {notch:g}.
ROWS = (
    ("dcb", "ASTM D5528", "a width of 20 to 25 mm; it is {width:g} mm", lambda of: between(of.width, 20, 25)),
    ("dcb", "ASTM D5528, ISO 15024", "a thickness of {thinnest:.2g}{thickest}, both arms together, for this toughness and notch; "
     "it is {thickness:g} mm{meant}", lambda of: between(of.thickness, *thicknesses(of))),
    ("dcb", "ASTM D5528, ISO 15024", "a notch of about 50 mm from the load; it is {notch:g} mm",
     lambda of: between(of.notch, 45, 55)),
    ("enf", "ASTM D7905", "a width of 19 to 26 mm; it is {width:g} mm", lambda of: between(of.width, 19, 26)),
    *((kind, ASKED[kind][0], f"a thickness of {ASKED[kind][1]:g} to {ASKED[kind][2]:g} mm, both arms together; it is {{thickness:g}} mm{{meant}}",
       lambda of: between(of.thickness, *ASKED[of.kind][1:])) for kind in ("enf", "mmb")),
    ("enf", "ASTM D7905", "a half span of 50 mm; it is {half_span:g} mm", lambda of: between(of.half_span, 50, 50)),
    ("enf", "ASTM D7905", "a notch of 30 mm from the support; it is {notch:g} mm{stable}", lambda of: between(of.notch, 29, 31)),
    ("mmb", "ASTM D6671", "a width of 20 to 25 mm; it is {width:g} mm", lambda of: between(of.width, 20, 25)),
    ("mmb", "ASTM D6671", "a half span of 50 mm; it is {half_span:g} mm", lambda of: between(of.half_span, 50, 50)),
    ("mmb", "ASTM D6671", "a notch of about half of the half span, {mmb_least:g} to {mmb_most:g} mm; it is {notch:g} mm",
     lambda of: between(of.notch, *mmb_notches(of))),
    ("mmb", "ASTM D6671", "a share of mode II from 0.15 to 0.95; it is {mixity:.2f}",
     lambda of: between(beams.growth(of, of.notch)[2], 0.15, 0.95)),
    ("4enf", "Martin and Davidson 1999", "a notch that ends between the noses and a thickness away from them, from {outside:g} "
     "to {inside:g} mm; it is {notch:g} mm", lambda of: between(of.notch, *between_noses(of))),
    ("slb", "Davidson and Sundararaman 1996", "a crack shorter than the half span of {half_span:g} mm; it grows from "
     "{notch:g} to {end:g} mm", lambda of: of.notch + of.growth < of.half_span),
)


# Beam theory without corrections: at a held displacement the energy release rate of an ENF specimen falls with the crack from
# this part of the half span on, L / 3^(1/3) (L. A. Carlsson, J. W. Gillespie, R. B. Pipes, J. Compos. Mater. 20, 1986).
STABLE = 3 ** (-1 / 3)


def warnings(of):
    low, high = thicknesses(of) if of.kind == "dcb" else ASKED[of.kind][1:] if of.kind in ASKED else (0, 0)
    slip = next((of.arm * factor for factor in (0.1, 10) if between(of.thickness * factor, low, high)), None)
    mmb = mmb_notches(of) if of.kind == "mmb" else (0, 0)
    noses = between_noses(of) if of.kind == "4enf" else (0, 0)
    stable = of.kind == "enf" and of.notch >= STABLE * of.half_span
    facts = {**vars(of), "thinnest": low, "thickest": " mm at least" if math.isinf(high) else f" to {high:g} mm",
             "end": of.notch + of.growth, "meant": f": --arm {slip:g}mm may be meant" if slip else "", "mmb_least": mmb[0], "mmb_most": mmb[1],
             "stable": ", from which the crack grows stably, as that of the standard does not" if stable else "",
             "mixity": beams.growth(of, of.notch)[2], "outside": noses[0], "inside": noses[1]}
    return [f"{standard} asks for {text.format(**facts)}" for kind, standard, text, good in ROWS
            if kind == of.kind and not good(of)]


def remarks(of):
    """What the test does as it is, which is no reason to change it."""
    if of.kind == "enf" and of.notch < STABLE * of.half_span:
        return (f"the crack jumps at the peak, because the notch is shorter than {STABLE:.2f} of the half span, "
                f"{STABLE * of.half_span:.3g} mm; from there on it would grow stably"
                + (". The specimen of ASTM D7905 does so too" if between(of.notch, 29, 31) else ""))
    return ""
