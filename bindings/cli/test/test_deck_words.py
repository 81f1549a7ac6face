# SPDX-License-Identifier: BSD-3-Clause
"""Words of decks: keywords, parameters and values may be abbreviated; a word that is not known is refused with the line
and what is near; what nothing uses is left out."""
import deck_runs
import decks
from deck_runs import refused
from support import delam, expect, finish, write

PLAIN = decks.abaqus(decks.Beam(nx=4, ny=0, nz=1))
PAIR = decks.surfaces(decks.Beam(nx=4, ny=0, nz=1), initial=True)


def imported(text):
    """The scene without its first line, which names the deck, and what is said."""
    scene, said = deck_runs.imported(text)
    return scene.split("\n", 1)[-1], said


def changed(text, *pairs):
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def bare(scene):
    return "\n".join(line for line in scene.splitlines() if not line.startswith(("#", "file = ")))


wanted = bare(imported(PLAIN)[0])
for pairs in ((("*Cohesive Section", "*COHESIVE SECT"),), (("*Solid Section", "*SOLIDSECTION"), ("*End Step", "*ENDSTEP")),
              (("*Elastic", "*ELAS"), ("*Static", "*Stat"), ("*Boundary", "*Bound"), ("*Material", "* mat")),
              (("material=Ply", "mat=Ply"), ("criterion=QUADS", "crit=QUADS"), ("mixed mode behavior=BK", "mixed mode=BK")),
              (("type=ENERGY", "type=ener"), ("type=ENGINEERING CONSTANTS", "type=ENG"),
               ("response=TRACTION SEPARATION", "response=TRACTION  SEP"))):
    expect(bare(imported(changed(PLAIN, *pairs))[0]) == wanted, f"{pairs}: another scene")
for old, new, pattern in (
        ("*Boundary", "*Boundry", r"unknown keyword \(did you mean 'BOUNDARY'"),
        ("*Elastic, type=ENG", "*Elastc, type=ENG", r"unknown keyword \(did you mean 'ELASTIC'"),
        ("*Boundary", "*End", "END"), ("mixed mode behavior", "mo", r"the parameter MO is not read"),
        ("*Static\n", "*Static, drect\n", r"DRECT is not read \(did you mean 'DIRECT'"),
        ("*Static\n", "*Static,\n", "is not read"), ("criterion=QUADS", "criterion=MAX", "MAXS, QUADS, MAXE, QUADE, MAXU or QUADU is"),
        ("*Static\n", "*Output\n", r"\*STEP: the step has no procedure"),
        ("\n1, ", "\n0, ", r"node 0: its number must be > 0"), ("type=CPE4I, elset=Arms\n1,", "type=CPE4I, elset=Arms\n-1,",
                                                             "element -1: its number must be > 0"),
        ("*Solid Section", "*Shell Section", r"element 1 is a CPE4I: shell sections of SC8R are imported"),
        ("*Cohesive Section", "*Solid Section, elset=ARMS, material=Ply\n*Cohesive Section",
         r"the elements \"ARMS\" have the section of .*deck.inp:\d+"),
        ("*Damage Initiation", "*Elastic, type=TRACTION\n1., 1., 1.\n*Damage Initiation", "is given twice for one material")):
    refused(changed(PLAIN, (old, new)), r"deck\.inp:\d+: \*", pattern)
_, said = imported(changed(PLAIN, ("*Cohesive Section", "*Section Controls, name=EC, max degradation=0.9\n*Cohesive Section")))
expect("MAX DEGRADATION=0.9: damage goes to 1" in said, f"{said}")

scene, said = imported(changed(PLAIN, ("*Cohesive Section", "*Transverse shear stiffness\n1., 1., 0.\n*Cohesive Section")))
expect(bare(scene) == wanted and "solid cells shear by the moduli of their material" in said, f"{said}")

# Pairs at the edge of cohesive elements have half a cell beyond it, which is told where it is much.
for cells, much in ((4, True), (60, False)):
    code, said, error = delam("check", write(decks.abaqus(decks.Beam(nx=cells, ny=0, nz=1)), "deck.inp"))
    expect(code == 0 and ('the faces of "Cohesive" cover 0.03, the pairs that adhere 0.0375' in error) == much and
           ("the pairs that adhere" in error) == much, f"{cells} cells: {error.strip()}")

# Interactions.
imported(PAIR)
for old, new, pattern in (
        ("Pressure-overclosure=Hard", "no separation", r"\*SURFACE BEHAVIOR: NO SEPARATION would hold"),
        ("*Surface behavior", "*Friction, rough\n*Surface behavior", r"\*FRICTION: ROUGH would let no faces slide"),
        ("type=CONTACT\n", "type=CONTACT, normal\n", r"\*INITIAL CONDITIONS: NORMAL is not imported"),
        ("Name=Glue", "Name=Glue, user", r"\*SURFACE INTERACTION: the parameter USER is not read"),
        ("Type=Surface to surface", "Interference=1.", r"\*CONTACT PAIR: the parameter INTERFERENCE is not read")):
    refused(changed(PAIR, (old, new)), r"deck\.inp:\d+: ", pattern)

# What nothing uses is left out, and refused where it is used.
for card, name in (("*Material, name=Steel\n*Elastic\n2e5, 0.3\n*Plastic\n300., 0.\n", 'material "Steel"'),
                   ("*Material, name=Rubber\n*Hyperelastic, neo hooke\n1., 0.\n", 'material "Rubber"'),
                   ("*Material, name=Skin\n*Elastic\n1., 2., 3.,\n*Damage Initiation, criterion=HASHIN\n1.\n",
                    'material "Skin"'),
                   ("*Amplitude, name=Wave, definition=PERIODIC\n1, 1., 0., 0.\n", 'amplitude "Wave"'),
                   ("*Surface Interaction, name=Rough\n*Friction, rough\n", 'surface interaction "Rough"'),
                   ("*Surface Interaction, name=Own, user\n*Friction\n0.1\n", 'surface interaction "Own"'),
                   ("*Orientation, name=Local, system=Z RECTANGULAR\n1., 0.\n", 'orientation "LOCAL"'),
                   ("*Surface, name=Tool, type=CYLINDER\nSTART, 0., 0.\n", 'surface "Tool"')):
    scene, said = imported(changed(PLAIN, ("*Material, name=Ply", card + "*Material, name=Ply")))
    expect(bare(scene) == wanted and f"left out  {name}, which nothing uses (" in said and "deck.inp:" in said, f"{said}")
refused(changed(PLAIN, ("*Elastic, type=TRACTION", "*Plastic\n300., 0.\n*Elastic, type=TRACTION")), "plasticity would change")
refused(changed(PLAIN, ("*Step", "*Amplitude, name=Wave, definition=PERIODIC\n1, 1., 0., 0.\n*Step"),
                ("*Boundary\nTop", "*Boundary, amplitude=Wave\nTop")), r"deck\.inp:\d+: \*AMPLITUDE: DEFINITION=PERIODIC is not")
refused(changed(PAIR, ("E-below, S", "E-below, SPOS"), ), r"deck\.inp:\d+: \*SURFACE: \"SPOS\d\": a side, S1")
_, said = imported(changed(PLAIN, ("*Output", "*Integrated output section, name=I\n*Incrementation output\n*Energy file\n*Filter,"
                                   " name=F\n*Output"), ("*Elastic", "*Depvar\n1,\n*User output variables\n1,\n*Elastic")))
expect(all(f"left out  *{word}" in said for word in ("DEPVAR", "ENERGY FILE", "FILTER", "INCREMENTATION OUTPUT")), f"{said}")
# A lap joint with a thick adhesive: its nodes are paired, also where both sheets go on beyond it.
lap = "*Node\n" + "".join(f"{1 + i + 5 * j}, {0.5 * i + (j > 1)}, {j - 0.9 * (j > 1)}\n" for j in range(4) for i in range(5))
for name, first in (("Low", 0), ("Up", 10)):
    lap += f"*Element, type=CPE4I, elset={name}\n" + "".join(
        f"{first + i}, {first + i}, {first + i + 1}, {first + i + 6}, {first + i + 5}\n" for i in range(1, 5))
lap += "*Element, type=COH2D4, elset=Cohesive\n21, 8, 9, 12, 11\n22, 9, 10, 13, 12\n*Nset, nset=Clamp\n1, 6\n*Nset, nset=Top\n15, 20\n"
lap += "".join(f"*Solid Section, elset={name}, material=Ply\n" for name in ("Low", "Up"))
lap += "*Cohesive Section, elset=Cohesive, material=Resin, response=TRACTION SEPARATION\n" + decks.PLY + decks.resin()
lap += "*Step\n*Static\n*Boundary\nClamp, 1, 2\nTop, 1, 1, 0.01\nTop, 2\n*End Step\n"
scene, said = imported(lap)
expect("the nodes of its two sides are paired" in said and "tolerance = 0.2002" in scene and "projected" not in scene, f"{said}")
code, said, error = delam("check", write(lap, "deck.inp"))
expect(code == 0 and '"Low-Up", 3 pairs' in said, f"a lap joint: {error.strip()}")
finish()
