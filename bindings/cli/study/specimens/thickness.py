# SPDX-License-Identifier: BSD-3-Clause
"""The thickness of a specimen, both arms together: what standards ask for, and the mistake to take it for that of an arm,
because h of ASTM D5528 is the whole and h of ASTM D7905, D6671 and ISO 15024 the half."""

# Least and largest, mm.
ASKED = {"dcb": ("ASTM D5528, ISO 15024", 3.0, 5.0), "enf": ("ASTM D7905", 3.4, 4.7), "mmb": ("ASTM D6671", 3.0, 5.0)}


def taken_for_arm(kind, arm, given):
    """Why the thickness of the arm, in mm, is likely that of the specimen; nothing where it is not, or where it was given
    as the whole."""
    if kind not in ASKED or given.get("thickness"):
        return ""
    standard, low, high = ASKED[kind]
    if low <= 2 * arm <= high or not low <= arm <= high:
        return ""
    return (f"--arm {given['arm']} is one arm, which makes a specimen of {2 * arm:g} mm; {standard} asks for {low:g} to {high:g} mm, both "
            f"arms together: give --thickness {arm:g}mm if that is the whole specimen, --thickness {2 * arm:g}mm if it is not")
