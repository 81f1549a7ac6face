# SPDX-License-Identifier: BSD-3-Clause
"""Tables over the mode mix in decks, which follow from a curve of Benzeggagh and Kenane: the scene must have its numbers
again. And what the law of an interface has one value for."""
import csv
import math
import os
import re

from support import delam, expect, expect_error, finish, folder, write

NORMAL, SHEAR, ETA = 0.02, 0.05, 1.6  # toughnesses and exponent
K_N, K_S, S_N, S_S = 1000.0, 400.0, 1.5, 2.0  # stiffnesses and strengths
HEAD = "*DAMAGE EVOLUTION, TYPE=ENERGY, MIXED MODE BEHAVIOR=TABULAR, MODE MIX RATIO=TRACTION\n"


def deck(evolution, stiffness=f"{K_N}, {K_S}, {K_S}", strengths=f"{S_N}, {S_S}, {S_S}", initiation="QUADS", solid=False):
    text = "*HEADING\ntwo blocks\n*NODE\n"
    corners = [(x, y) for y in (0.0, 1.0) for x in (0.0, 1.0)]
    for first, z in ((1, 0.0), (5, 1.0), (11, 1.0), (15, 2.0)):
        for i, (x, y) in enumerate(corners):
            if solid:
                text += f"{first + i}, {x}, {y}, {z}\n"
            elif y == 0.0:
                text += f"{first + i}, {x}, {z}\n"
    kinds = ("C3D8", "COH3D8", "1, 2, 4, 3, 5, 6, 8, 7", "11, 12, 14, 13, 15, 16, 18, 17", "5, 6, 8, 7, 11, 12, 14, 13")
    if not solid:
        kinds = ("CPE4", "COH2D4", "1, 2, 6, 5", "11, 12, 16, 15", "5, 6, 12, 11")
    cell, cohesive, low, up, between = kinds
    text += f"*ELEMENT, TYPE={cell}, ELSET=LOW\n1, {low}\n*ELEMENT, TYPE={cell}, ELSET=UP\n2, {up}\n"
    text += f"*ELEMENT, TYPE={cohesive}, ELSET=COH\n3, {between}\n"
    text += "*SOLID SECTION, ELSET=LOW, MATERIAL=M\n*SOLID SECTION, ELSET=UP, MATERIAL=M\n"
    text += "*COHESIVE SECTION, ELSET=COH, MATERIAL=C, RESPONSE=TRACTION SEPARATION\n1.\n"
    text += f"*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*MATERIAL, NAME=C\n*ELASTIC, TYPE=TRACTION\n{stiffness}\n"
    text += f"*DAMAGE INITIATION, CRITERION={initiation}\n{strengths}\n{evolution}"
    return text + "*STEP\n*STATIC\n0.5, 1., 1e-5, 0.5\n*BOUNDARY\n1, 1, 3\n2, 2, 3\n*END STEP\n"


def law(text):
    code, scene, said = delam("import", write(text, "deck.inp"))
    expect(code == 0, f"import: exit {code} {said.strip()[:300]}")
    keys = ("normal_toughness", "tangential_toughness", "toughness_exponent")
    return [float(re.search(rf"^{key} = (\S+)", scene, re.M).group(1)) if code == 0 else 0.0 for key in keys], said


def expect_curve(what, text, allowed=0.01):
    (normal, shear, exponent), said = law(text)
    expect(math.isclose(normal, NORMAL, rel_tol=1e-12) and math.isclose(shear, SHEAR, rel_tol=1e-12),
           f"{what}: toughnesses {normal}, {shear}")
    expect(math.isclose(exponent, ETA, rel_tol=allowed), f"{what}: exponent {exponent}")
    off = re.search(r"off by up to (\S+) %", said)
    expect(off and float(off.group(1)) < 0.3, f"{what}: said {said}")


def toughness(share):
    return NORMAL + (SHEAR - NORMAL) * share ** ETA


def share_at(ratio):
    """The shear's share of the energy where the traction is at `ratio` right angles from the normal."""
    t_n, t_s = math.cos(ratio * math.pi / 2), math.sin(ratio * math.pi / 2)
    energy_n, energy_s = t_n * t_n / K_N, t_s * t_s / K_S
    return energy_s / (energy_n + energy_s)


def failure_at(share, largest):
    """The jump beyond the onset at which a traction that falls linearly has the toughness of this share: along a way of
    this share, the traction at the onset is that of the criterion."""
    u_n, u_s = math.sqrt((1 - share) / K_N), math.sqrt(share / K_S)  # the way
    ratios = (K_N * u_n / S_N, K_S * u_s / S_S)
    scale = 1 / (max(ratios) if largest else math.hypot(*ratios))
    onset = scale * math.hypot(u_n, u_s)
    work = 0.5 * scale * scale * (K_N * u_n * u_n + K_S * u_s * u_s)  # to the onset
    return (toughness(share) / work - 1) * onset


# The corner of MAXS has a row of its own: between two rows the table is straight.
steps = sorted([k / 40 for k in range(41)] + [math.atan(S_S / S_N) * 2 / math.pi])
expect_curve("energies over tractions", deck(HEAD + "".join(f"{toughness(share_at(x))!r}, {x}\n" for x in steps)))
expect_curve("energies over energies", deck(HEAD.replace("TRACTION", "ENERGY") +
                                            "".join(f"{toughness(x)!r}, {x}\n" for x in steps)))
displacements = HEAD.replace("TYPE=ENERGY", "TYPE=DISPLACEMENT")
for initiation in ("QUADS", "MAXS"):
    rows = "".join(f"{failure_at(share_at(x), initiation == 'MAXS')!r}, {x}\n" for x in steps)
    expect_curve(f"displacements, {initiation}", deck(displacements + rows, initiation=initiation))

for evolution, pattern in (
        ("*DAMAGE EVOLUTION, TYPE=ENERGY, MIXED MODE BEHAVIOR=BK, POWER=1.5, MODE MIX RATIO=TRACTION\n1., 2., 2.\n",
         r"write MODE MIX RATIO=ENERGY"),
        ("*DAMAGE EVOLUTION, TYPE=DISPLACEMENT, MIXED MODE BEHAVIOR=BK, POWER=1.5\n1., 2., 2.\n", "BK needs TYPE=ENERGY"),
        (displacements.replace("TABULAR,", "TABULAR, SOFTENING=EXPONENTIAL,") + "1., 0.\n1., 1.\n", "SOFTENING=LINEAR"),
        (HEAD.replace("TRACTION", "ACCUMULATED ENERGY") + "1., 0.\n1., 1.\n", "ACCUMULATED ENERGY is not imported"),
        (displacements + "0., 0.\n1., 1.\n", "a displacement > 0")):
    expect_error(delam("import", write(deck(evolution), "deck.inp")), 2, r"deck\.inp:\d+: \*DAMAGE EVOLUTION: ", pattern)

ONE = "*DAMAGE EVOLUTION, TYPE=ENERGY\n1.,\n"
# What is wrong in one law is said together.
answer = delam("import", write(deck(ONE.replace("1.,", "-1.,"), stiffness="-1000., 400., 400.", strengths="1.5, 0., 2."), "deck.inp"))
expect_error(answer, 2, "stiffness -1000: must be > 0", "QUADS 0: must be > 0", "toughness -1: must be > 0")
SHEARS = "1000., 400., 225."  # with strengths 2 and 1.5, damage begins at the same energy in both
POWER = "*DAMAGE EVOLUTION, TYPE=ENERGY, MIXED MODE BEHAVIOR=POWER LAW, POWER=1.\n1., 2., 3.\n"


def numbers_of(scene):
    """The numbers of the only law of a scene."""
    return {key: float(value) for key, value in re.findall(r"^(\w+) = ([-+.\de]+)$", scene.split("[[laws]]")[1], re.M)}


def expect_numbers(what, text, wanted, missing=()):
    code, scene, said = delam("import", write(text, "deck.inp"))
    expect(code == 0, f"{what}: {said}")
    found = numbers_of(scene)
    for key, value in wanted.items():
        expect(math.isclose(found.get(key, 0.0), value, rel_tol=1e-12), f"{what}: {key} is {value} in\n{scene}")
    for key in missing:
        expect(key not in found, f"{what}: no {key} in\n{scene}")
    expect(("shear_axis" in scene) == any("second" in key for key in wanted), f"{what}: the axis of the first shear")


def expect_energies(text, stored, dissipated):
    """Runs the scene of a deck; the energies belong to its interface in the end."""
    where, out = os.path.join(folder(), "scene.toml"), os.path.join(folder(), "out")
    for words in (("import", write(text, "deck.inp"), "--out", where), ("run", where, "--out", out)):
        code, _, said = delam(*words)
        expect(code == 0, f"{words[0]}: {said}")
    with open(os.path.join(out, "history.csv"), encoding="utf-8", newline="") as file:
        last = list(csv.DictReader(file))[-1]
    for column, value in (("stored_interface", stored), ("dissipated", dissipated)):
        expect(math.isclose(float(last[column]), value, rel_tol=1e-9), f"{column} {last[column]} instead of {value}")


SECOND = ("second_tangential_stiffness", "second_tangential_onset", "second_tangential_strength",
          "second_tangential_toughness")
expect_numbers("other stiffnesses", deck(ONE, stiffness=SHEARS, solid=True),
               {SECOND[0]: 225.0, "tangential_strength": 2.0, SECOND[2]: 2.0}, SECOND[3:])
expect_numbers("other strengths", deck(ONE, strengths="1.5, 2., 3.", solid=True),
               {"tangential_strength": 2.0, SECOND[2]: 3.0}, (SECOND[0], SECOND[3]))
expect_numbers("a strain of the third mode", deck(ONE, strengths="0.0015, 0.005, 0.02", initiation="QUADE", solid=True),
               {"tangential_strength": 2.0, SECOND[2]: 8.0}, (SECOND[0], SECOND[3]))
expect_numbers("other toughnesses", deck(POWER, solid=True), {"tangential_toughness": 2.0, SECOND[3]: 3.0}, SECOND[:3])
expect_numbers("the toughness of the first shear", deck(POWER.replace("POWER LAW", "BK"), solid=True),
               {"tangential_toughness": 2.0}, SECOND)
expect_numbers("displacements", deck("*DAMAGE EVOLUTION, TYPE=DISPLACEMENT\n1.,\n", strengths="1.5, 2., 3.", solid=True),
               {"tangential_toughness": 2.0 * (2.0 / K_S + 1) / 2, SECOND[3]: 3.0 * (3.0 / K_S + 1) / 2}, SECOND[:2])
for what, text, words in (("POWER=1", POWER, None), ("POWER=2", POWER.replace("POWER=1.", "POWER=2."), "toughness with exponent 1"),
                          ("equal numbers", POWER.replace("POWER=1.", "POWER=2.").replace("3.", "2."), None)):
    said = delam("import", write(deck(text, solid=True), "deck.inp"))[2]
    expect(("between the two directions of sliding" in said) == bool(words) and (words or "") in said, f"{what}: {said}")
for what, text in (("strengths", deck(ONE, strengths="1.5, 2., 3.")), ("toughnesses", deck(POWER)),
                   ("stiffnesses", deck(ONE, stiffness=SHEARS))):
    expect_numbers(f"in the plane there is one direction: {what}", text, {"tangential_strength": 2.0}, SECOND)
table = HEAD.replace("TRACTION", "ENERGY") + "1., 0.\n1., 1.\n"
expect_error(delam("import", write(deck(table, strengths="1.5, 2., 3.", solid=True), "deck.inp")), 2, r"deck\.inp:\d+: ",
             "without a table of modes")

# Stiffnesses of both shears become keys of the law, whose first shear is along x as in the deck.
TWICE = deck(ONE, stiffness=SHEARS, strengths="1.5, 2., 1.5", solid=True)
code, scene, said = delam("import", write(TWICE, "deck.inp"))
expect(code == 0, f"two stiffnesses in shear: {said}")
for key, value in (("tangential_stiffness", 400.0), ("second_tangential_stiffness", 225.0), ("tangential_onset", 0.005)):
    found = re.search(rf"^{key} = (\S+)", scene, re.M)
    expect(found and math.isclose(float(found.group(1)), value, rel_tol=1e-12), f"{key} in\n{scene}")
expect("shear_axis = [1.0, 0.0, 0.0]" in scene, f"the axis of the first shear in\n{scene}")
# The upper block slides between both shears, beyond the onset; with an orientation whose axis 1 is y, the first is along y.
ENERGY, ONSET, TOUGHNESS = 0.02, 0.005, 1.0  # Y = (Kss u_s^2 + Ktt u_t^2)/2
slip = math.sqrt(2 * ENERGY / (400 * 0.36 + 225 * 0.64))
zeta = (TOUGHNESS * math.sqrt(ONSET / ENERGY) - ONSET) / (TOUGHNESS - ONSET)
spent = TOUGHNESS * ONSET * (1 - zeta) / (ONSET + (TOUGHNESS - ONSET) * zeta)
TURNED = "*ORIENTATION, NAME=TURNED\n0., 1., 0., -1., 0., 0.\n"
for turned, along, across in ((False, 0.6, 0.8), (True, 0.8, 0.6)):
    moved = "".join(f"{node}, 1, 3\n" for node in range(1, 9)) + "".join(
        f"{node}, 1, 1, {along * slip!r}\n{node}, 2, 2, {across * slip!r}\n{node}, 3, 3\n" for node in range(11, 19))
    sliding = TWICE.replace("*BOUNDARY\n1, 1, 3\n2, 2, 3\n", "*BOUNDARY\n" + moved)
    if turned:
        sliding = sliding.replace("*COHESIVE SECTION", TURNED + "*COHESIVE SECTION, ORIENTATION=TURNED")
    expect_energies(sliding, zeta * ENERGY, spent)
# The same block, with another strength and toughness of the second shear: (Y_1/G_1 + Y_2/G_2)^-1 of both.
text = deck(POWER, stiffness=SHEARS, strengths="1.5, 2., 3.", solid=True)
moved = "".join(f"{node}, 1, 3\n" for node in range(1, 9)) + "".join(
    f"{node}, 1, 1, {0.6 * slip!r}\n{node}, 2, 2, {0.8 * slip!r}\n{node}, 3, 3\n" for node in range(11, 19))
share = 225 * 0.64 / (400 * 0.36 + 225 * 0.64)
onset, total = 1 / ((1 - share) / 0.005 + share / (3.0 ** 2 / 450)), 1 / ((1 - share) / 2.0 + share / 3.0)
zeta = (total * math.sqrt(onset / ENERGY) - onset) / (total - onset)
spent = total * onset * (1 - zeta) / (onset + (total - onset) * zeta)
expect_energies(text.replace("*BOUNDARY\n1, 1, 3\n2, 2, 3\n", "*BOUNDARY\n" + moved), zeta * ENERGY, spent)
for card, pattern in (("", "\"TURNED\" is not there"), ("*ORIENTATION, NAME=TURNED, SYSTEM=CYLINDRICAL\n0., 0., 0., 0., 0., 1.\n",
                                                       "differs from element to element")):
    text = TWICE.replace("*COHESIVE SECTION", card + "*COHESIVE SECTION, ORIENTATION=TURNED")
    expect_error(delam("import", write(text, "deck.inp")), 2, r"deck\.inp:\d+: \*COHESIVE SECTION", pattern)
finish()
