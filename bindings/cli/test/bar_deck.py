# SPDX-License-Identifier: BSD-3-Clause
"""A bar of two blocks that is pulled apart, as decks write it. It is 2 long and 2 high; its force per length is known in
closed form (`stress`)."""
from deck_runs import close, history

HEIGHT, LENGTH, THICKNESS, YOUNG, ACROSS = 2.0, 2.0, 2.0, 70000.0, 9000.0
STIFFNESS, STRENGTH, TOUGHNESS, PULL = 1e6, 30.0, 0.25, 0.01

CFRP = f"*MATERIAL, NAME=CFRP\n*DENSITY\n1.6e-9,\n*ELASTIC\n{YOUNG}, 0.3\n"
GLUE = f"""*MATERIAL, NAME=GLUE
*ELASTIC, TYPE=TRACTION
{STIFFNESS}, {STIFFNESS}, {STIFFNESS}
*DAMAGE INITIATION, CRITERION=QUADS
{STRENGTH}, 60., 60.
*DAMAGE EVOLUTION, TYPE=ENERGY, MIXED MODE BEHAVIOR=BK, POWER=1.75
{TOUGHNESS}, 0.8, 0.8
*DAMAGE STABILIZATION
1e-5
"""
HELD = "BOTTOM, YSYMM\nLEFT, XSYMM\n"
STEP = f"*STEP\n*STATIC\n0.1, 1.\n*BOUNDARY\n{HELD}TOP, 2, 2, {PULL}\n*END STEP\n"
SURFACES = "*SURFACE, NAME=BELOW, TYPE=ELEMENT\nA2, S3\n*SURFACE, NAME=ABOVE, TYPE=ELEMENT\nB1, S1\n"


def stress(pulled, young=YOUNG, opened=0.0):
    """The stress of the bar, and the jump: opened is the largest jump before, which damaged the glue."""
    compliance, first, last = HEIGHT / young, STRENGTH / STIFFNESS, 2.0 * TOUGHNESS / STRENGTH
    softening = STRENGTH / (last - first)
    secant = STIFFNESS if opened <= first else softening * (last - opened) / opened
    found = pulled / (compliance + 1.0 / secant)
    jump = pulled - found * compliance
    if jump > max(first, opened):
        found = softening * (last - pulled) / (1.0 - softening * compliance)
        jump = pulled - found * compliance
    return found, jump


def dissipated(jump):
    """Per area: what was put in, less what is given back along the secant."""
    first, last = STRENGTH / STIFFNESS, 2.0 * TOUGHNESS / STRENGTH
    now = STRENGTH * (last - jump) / (last - first)
    return 0.5 * STRENGTH * first + 0.5 * (STRENGTH + now) * (jump - first) - 0.5 * now * jump


def row(first, y, number):
    """Nodes first to first + 2 at the height y."""
    return "".join(f"{first + i}, {i:.1f}, {y:.1f}\n" for i in range(number))


def bar(cell="CPS4", glue=True, section=None, cohesive="RESPONSE=TRACTION SEPARATION\n,2.\n", material=CFRP, law=GLUE,
        before="", after=STEP, mesh=None):
    """Nodes 1 to 9 and 101 to 109, cells 1 to 4 and 11 to 14 (rows A1, A2, B1, B2), cohesive elements 21 and 22."""
    text = "*HEADING\na bar\n** of two blocks\n" + before
    if mesh is None:
        mesh = "*NODE, NSET=ALL\n" + "".join(row(start + 3 * j, 0.5 * j + start // 100, 3)
                                            for start in (1, 101) for j in range(3))
        for name, start, number in (("A1", 1, 1), ("A2", 4, 3), ("B1", 101, 11), ("B2", 104, 13)):
            mesh += f"*ELEMENT, TYPE={cell}, ELSET={name}\n" + "".join(
                f"{number + i}, {start + i}, {start + i + 1}, {start + i + 4}, {start + i + 3}\n" for i in range(2))
        mesh += "*ELSET, ELSET=A\nA1, A2\n*ELSET, ELSET=B\nB1, B2\n"
    text += mesh
    if glue:
        text += "*ELEMENT, TYPE=COH2D4, ELSET=G\n21, 7, 8, 102, 101\n22, 8, 9, 103, 102\n"
        text += f"*COHESIVE SECTION, ELSET=G, MATERIAL=GLUE, {cohesive}"
    text += section or "".join(f"*SOLID SECTION, ELSET={name}, MATERIAL=CFRP\n{THICKNESS},\n" for name in "AB")
    text += material + law
    text += "*NSET, NSET=BOTTOM\n1, 2, 3\n*NSET, NSET=TOP, GENERATE\n107, 109, 1\n*NSET, NSET=LEFT\n1, 4, 7, 101, 104, 107\n"
    return text + after


def pulled(what, text, young=YOUNG, **others):
    rows, _, _ = history(text, **others)
    if rows:
        close(what, rows[-1]["reaction"], LENGTH * stress(PULL, young)[0])
