# SPDX-License-Identifier: BSD-3-Clause
"""The same colour for the same thing in every picture: Okabe and Ito's colours for solvers, concepts and bounds, Paul Tol's muted ones for what
is only told apart in its picture. Colour-blind eyes tell both apart; each has a marker of its own, so that a print without colours can be read."""

BLUE, VERMILLION, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
ORANGE, SKY, BLACK, GREY, BROWN = "#E69F00", "#56B4E9", "#000000", "#6E6E6E", "#7A4B1E"
INDIGO, ROSE, TEAL, OLIVE, WINE, FOREST = "#332288", "#CC6677", "#44AA99", "#999933", "#882255", "#117733"

# role: colour, marker, line
ROLES = {
    "condensed": (BLUE, "o", "-"),
    "iterated": (GREEN, "^", "-"),
    "feti": (VERMILLION, "s", "-"),
    "direct": (BLACK, "x", "-"),
    "reference": (BLACK, "", "--"),
    "baseline": (BROWN, "D", "-"),
    "accelerated": (SKY, "^", "-"),
    "local": (PURPLE, "v", "-"),
    "backtracking": (ORANGE, "d", "-"),
    "energetic": (GREEN, "P", "-"),
    "limit": (GREY, "", ":"),
    "lower": (SKY, "", "-"),
    "upper": (VERMILLION, "", "-"),
    # Quantities of one realisation, elements, languages: told apart in this order.
    "first": (INDIGO, "o", "-"),
    "second": (ROSE, "s", "-"),
    "third": (TEAL, "^", "-"),
    "fourth": (OLIVE, "v", "-"),
    "fifth": (WINE, "D", "-"),
    "sixth": (FOREST, "P", "-"),
}


def style(role: str) -> tuple[str, str, str]:
    if role not in ROLES:
        raise KeyError(f"role {role!r} is not in palette.py ({', '.join(ROLES)})")
    return ROLES[role]
