# SPDX-License-Identifier: BSD-3-Clause
"""The same colour for the same thing in every picture: Okabe and Ito's colours, which colour-blind eyes tell apart, each with a
marker of its own, so that a print without colours can be read too."""

BLUE, VERMILLION, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
ORANGE, SKY, YELLOW, BLACK, GREY = "#E69F00", "#56B4E9", "#F0E442", "#000000", "#6E6E6E"

# role: colour, marker, line
ROLES = {
    "condensed": (BLUE, "o", "-"),
    "feti": (VERMILLION, "s", "-"),
    "direct": (BLACK, "x", "-"),
    "reference": (BLACK, "", "--"),
    "baseline": (ORANGE, "D", "-"),
    "accelerated": (SKY, "^", "-"),
    "local": (PURPLE, "v", "-"),
    "backtracking": (ORANGE, "d", "-"),
    "energetic": (GREEN, "P", "-"),
    "limit": (GREY, "", ":"),
    "lower": (SKY, "", "-"),
    "upper": (VERMILLION, "", "-"),
    # Quantities of one realisation, meshes, languages: told apart in this order.
    "first": (BLUE, "o", "-"),
    "second": (VERMILLION, "s", "-"),
    "third": (GREEN, "^", "-"),
    "fourth": (PURPLE, "v", "-"),
    "fifth": (ORANGE, "D", "-"),
    "sixth": (SKY, "P", "-"),
}
ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")


def style(role: str) -> tuple[str, str, str]:
    if role not in ROLES:
        raise KeyError(f"role {role!r} is not in palette.py ({', '.join(ROLES)})")
    return ROLES[role]
