# SPDX-License-Identifier: BSD-3-Clause
"""What the standards ask of a specimen, as rows: kind, standard, what it says, and whether the sheet has it (mm, N)."""
import beams


def between(value, low, high):
    return value is None or 0.999 * low <= value <= 1.001 * high


def thick_enough(of):
    """The least thickness of both arms, so that displacements stay small (ASTM D5528)."""
    return 8.28 * (of.gic * of.notch ** 2 / of.e1) ** (1 / 3)


# A text may name numbers of the sheet: {notch:g}.
ROWS = (
    ("dcb", "ASTM D5528", "a width of 20 to 25 mm; it is {width:g} mm", lambda of: between(of.width, 20, 25)),
    ("dcb", "ASTM D5528, ISO 15024", "a thickness of 3 to 5 mm, both arms together; it is {thickness:g} mm",
     lambda of: between(of.thickness, 3, 5)),
    ("dcb", "ASTM D5528", "a thickness of at least {thick_enough:.2g} mm for this toughness and notch; it is "
     "{thickness:g} mm", lambda of: of.thickness >= thick_enough(of)),
    ("dcb", "ASTM D5528, ISO 15024", "a notch of about 50 mm from the load; it is {notch:g} mm",
     lambda of: between(of.notch, 45, 55)),
    ("enf", "ASTM D7905", "a width of 19 to 26 mm; it is {width:g} mm", lambda of: between(of.width, 19, 26)),
    ("enf", "ASTM D7905", "a thickness of 3.4 to 4.7 mm, both arms together; it is {thickness:g} mm",
     lambda of: between(of.thickness, 3.4, 4.7)),
    ("enf", "ASTM D7905", "a half span of 50 mm; it is {half_span:g} mm", lambda of: between(of.half_span, 50, 50)),
    ("enf", "ASTM D7905", "a notch of 30 mm from the support; it is {notch:g} mm", lambda of: between(of.notch, 29, 31)),
    ("enf", "beam theory", "a notch of 0.7 of the half span or more, from which the crack grows stably; from {share:.2f} it jumps",
     lambda of: of.notch >= 0.7 * of.half_span),
    ("mmb", "ASTM D6671", "a width of 20 to 25 mm; it is {width:g} mm", lambda of: between(of.width, 20, 25)),
    ("mmb", "ASTM D6671", "a thickness of 3 to 5 mm, both arms together; it is {thickness:g} mm",
     lambda of: between(of.thickness, 3, 5)),
    ("mmb", "ASTM D6671", "a half span of 50 mm; it is {half_span:g} mm", lambda of: between(of.half_span, 50, 50)),
    ("mmb", "ASTM D6671", "a notch of about half of the half span, 25 mm; it is {notch:g} mm",
     lambda of: between(of.notch, 0.4 * of.half_span, 0.6 * of.half_span)),
    ("mmb", "ASTM D6671", "a share of mode II from 0.15 to 0.95; it is {mixity:.2f}",
     lambda of: between(beams.growth(of, of.notch)[2], 0.15, 0.95)),
    ("4enf", "Martin and Davidson 1999", "a notch that ends between the noses, from {outside:g} to {inside:g} mm; it is "
     "{notch:g} mm", lambda of: of.outside + 2 * of.arm < of.notch < of.inside - 2 * of.arm),
    ("slb", "Davidson and Sundararaman 1996", "a crack shorter than the half span of {half_span:g} mm; it grows from "
     "{notch:g} to {end:g} mm", lambda of: of.notch + of.growth < of.half_span),
)


def warnings(of):
    facts = {**vars(of), "thickness": of.thickness, "thick_enough": thick_enough(of), "end": of.notch + of.growth,
             "share": of.notch / of.half_span if of.half_span else 0,
             "mixity": beams.growth(of, of.notch)[2], "outside": of.outside, "inside": of.inside}
    return [f"{standard} asks for {text.format(**facts)}" for kind, standard, text, good in ROWS
            if kind == of.kind and not good(of)]
