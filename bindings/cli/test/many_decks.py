# SPDX-License-Identifier: BSD-3-Clause
"""Input files of Abaqus with many objects of one kind: squares of one cell, in the plane, in a row or one upon another."""

STEP = "*STEP\n*STATIC\n0.1, 1.0\n*BOUNDARY\n{}, 1, 1, 0.001\n*END STEP\n"
ELASTIC = "*MATERIAL, NAME={}\n*ELASTIC\n1000.0, 0.3\n"
LAW = ("*COHESIVE BEHAVIOR\n1e6, 1e6, 1e6\n*DAMAGE INITIATION, CRITERION=MAXS\n10.0, 10.0, 10.0\n"
       "*DAMAGE EVOLUTION, TYPE=ENERGY\n0.1\n")
TRACTION = ("*MATERIAL, NAME={}\n*ELASTIC, TYPE=TRACTION\n1e6, 1e6, 1e6\n*DAMAGE INITIATION, CRITERION=MAXS\n"
            "10.0, 10.0, 10.0\n*DAMAGE EVOLUTION, TYPE=ENERGY\n0.1\n")


def square(k, x, y):
    """The nodes 4 k + 1 to 4 k + 4 and the element k + 1."""
    at = ((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1))
    nodes = "".join(f"{4 * k + i + 1}, {a}, {b}\n" for i, (a, b) in enumerate(at))
    return nodes, f"{k + 1}, {4 * k + 1}, {4 * k + 2}, {4 * k + 3}, {4 * k + 4}\n"


def squares(n, dx=2.0, dy=0.0, material="M", one=False, sections=True):
    """n bodies B0, B1, .. or one body of n pieces."""
    parts = [square(k, k * dx, k * dy) for k in range(n)]
    out = "*NODE\n" + "".join(nodes for nodes, _ in parts)
    if one:
        out += "*ELEMENT, TYPE=CPE4, ELSET=B0\n" + "".join(element for _, element in parts)
    else:
        out += "".join(f"*ELEMENT, TYPE=CPE4, ELSET=B{k}\n{element}" for k, (_, element) in enumerate(parts))
    out += "*NSET, NSET=HELD\n1\n"
    if sections:
        out += "".join(f"*SOLID SECTION, ELSET=B{k}, MATERIAL={material.format(k)}\n" for k in range(1 if one else n))
    return out


def finished(mesh, cards="", step=None):
    return mesh + (ELASTIC.format("M") if "*MATERIAL, NAME=M\n" not in cards else "") + cards + (step or STEP.format("HELD"))


def instances(n, dy=0.0, parts=1):
    nodes, element = square(0, 0.0, 0.0)
    out = "".join(f"*PART, NAME=P{p}\n*NODE\n{nodes}*ELEMENT, TYPE=CPE4, ELSET=E\n{element}*NSET, NSET=N\n1, 2\n"
                  "*SURFACE, NAME=S\nE, S1\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*END PART\n" for p in range(parts))
    out += "*ASSEMBLY, NAME=A\n"
    out += "".join(f"*INSTANCE, NAME=I{k}, PART=P{k % parts}\n{0.0 if dy else 2.0 * k}, {dy * k}, 0.0\n*END INSTANCE\n"
                   for k in range(n))
    return finished(out + "*NSET, NSET=HELD, INSTANCE=I0\n1\n*END ASSEMBLY\n")


def contact_pairs(n, cohesive, bonded=False, several=True):
    """A column of bodies, each pair with an interaction of its own, or all with one."""
    law = LAW if not bonded else LAW.replace("*COHESIVE BEHAVIOR", "*COHESIVE BEHAVIOR, ELIGIBILITY=SPECIFIED CONTACTS")
    cards = "".join(f"*SURFACE, NAME=TOP{k}\nB{k}, S3\n*SURFACE, NAME=LOW{k}\nB{k}, S1\n" for k in range(n))
    cards += "".join(f"*SURFACE INTERACTION, NAME=INT{k}\n{law if cohesive else ''}" for k in range(n if several else 1))
    cards += "".join(f"*CONTACT PAIR, INTERACTION=INT{k if several else 0}\nTOP{k}, LOW{k + 1}\n" for k in range(n - 1))
    if bonded:
        cards += "".join(f"*NSET, NSET=BOND{k}\n{4 * k + 3}, {4 * k + 4}\n" for k in range(n))
        cards += "".join(f"*INITIAL CONDITIONS, TYPE=CONTACT\nTOP{k}, LOW{k + 1}, BOND{k}\n" for k in range(n - 1))
    return finished(squares(n, 0.0, 1.0), cards)


def one_pair_of_all(n):
    """Two surfaces with a face of each body."""
    cards = "*SURFACE, NAME=TOP\n" + "".join(f"B{k}, S3\n" for k in range(n - 1))
    cards += "*SURFACE, NAME=LOW\n" + "".join(f"B{k}, S1\n" for k in range(1, n))
    cards += f"*SURFACE INTERACTION, NAME=INT\n{LAW}*CONTACT PAIR, INTERACTION=INT\nTOP, LOW\n"
    return finished(squares(n, 0.0, 1.0), cards)


def cohesive_sections(n, one=False):
    """A column of bodies with a cohesive section between each two, of a material of its own or all of one."""
    mesh = squares(n, 0.0, 1.0)
    mesh += "".join(f"*ELEMENT, TYPE=COH2D4, ELSET=C{k}\n{n + k + 1}, {4 * k + 4}, {4 * k + 3}, {4 * k + 6}, {4 * k + 5}\n"
                    for k in range(n - 1))
    mesh += "".join(f"*COHESIVE SECTION, ELSET=C{k}, MATERIAL=T{0 if one else k}, RESPONSE=TRACTION SEPARATION\n"
                    for k in range(n - 1))
    return finished(mesh, "".join(TRACTION.format(f"T{k}") for k in range(1 if one else n - 1)))


def references(n, cards):
    """n nodes of no body, R0, R1, .."""
    mesh = squares(n)
    mesh += "*NODE\n" + "".join(f"{4 * n + k + 1}, {2.0 * k}, 5.0\n" for k in range(n))
    mesh += "".join(f"*NSET, NSET=R{k}\n{4 * n + k + 1}\n*NSET, NSET=F{k}\n{4 * k + 3}, {4 * k + 4}\n" for k in range(n))
    return finished(mesh, "".join(cards(k) for k in range(n)))


def orientations(n):
    mesh = squares(n).replace("MATERIAL=M", "MATERIAL=M, ORIENTATION=O{}")
    for k in range(n):
        mesh = mesh.replace("O{}", f"O{k}", 1) if n < 3 else mesh
    pieces = mesh.split("O{}")
    mesh = pieces[0] + "".join(f"O{k}{piece}" for k, piece in enumerate(pieces[1:]))
    return finished(mesh, "".join(f"*ORIENTATION, NAME=O{k}\n1.0, 0.0, 0.0, 0.0, 1.0, 0.0\n" for k in range(n)))


def loads(n, step, cards=""):
    return finished(squares(n, one=True), cards, step)


def boundaries(n):
    return loads(n, "*STEP\n*STATIC\n0.1, 1.0\n*BOUNDARY\n" + "".join(f"{4 * k + 1}, 1, 2, {0.001 * (k % 7)}\n"
                                                                      for k in range(n)) + "*END STEP\n")


def amplitudes(n):
    cards = "".join(f"*AMPLITUDE, NAME=A{k}\n0.0, 0.0, 0.5, {k + 1}.0, 1.0, 1.0\n" for k in range(n))
    return loads(n, "*STEP\n*STATIC\n0.1, 1.0\n" + "".join(f"*BOUNDARY, AMPLITUDE=A{k}\n{4 * k + 1}, 1, 1, 0.001\n"
                                                           for k in range(n)) + "*END STEP\n", cards)


def forces(n):
    return loads(n, "*STEP\n*STATIC\n0.1, 1.0\n*BOUNDARY\nHELD, 1, 2\n*CLOAD\n" +
                 "".join(f"{4 * k + 3}, 2, {k + 1}.0\n" for k in range(n)) + "*END STEP\n")


def surfaces(n):
    cards = "".join(f"*SURFACE, NAME=S{k}\n{k + 1}, S3\n" for k in range(n))
    return loads(n, "*STEP\n*STATIC\n0.1, 1.0\n*BOUNDARY\nHELD, 1, 2\n*DSLOAD\n" +
                 "".join(f"S{k}, P, 1.0\n" for k in range(n)) + "*END STEP\n", cards)


def steps(n, again="*BOUNDARY\nHELD, 1, 1, {}\n"):
    return loads(2, "*BOUNDARY\nHELD, 2, 2\n" + "".join(
        f"*STEP\n*STATIC, DIRECT\n1.0, 1.0\n{again.format(0.001 * (k % 5))}*END STEP\n" for k in range(n)))


REFUSED = ("sections of one set",)  # each but the first, by its line
KINDS = {
    "instances": instances,
    "instances that touch": lambda n: instances(n, 1.0),
    "parts": lambda n: instances(n, parts=n),
    "bodies": lambda n: finished(squares(n)),
    "bodies that touch": lambda n: finished(squares(n, 0.0, 1.0)),
    "pieces of a body": lambda n: finished(squares(n, one=True)),
    "elements without sections": lambda n: finished(squares(n, sections=False) +
                                                    "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*ELSET, ELSET=ALL\n" +
                                                    "".join(f"B{k},\n" for k in range(n))),
    "sections of one set": lambda n: finished(squares(n, one=True) + "*SOLID SECTION, ELSET=B0, MATERIAL=M\n" * n),
    "materials": lambda n: finished(squares(n, material="M{}"), "".join(ELASTIC.format(f"M{k}") for k in range(n))),
    "orientations": orientations,
    "sets of nodes": lambda n: finished(squares(2) + "".join(f"*NSET, NSET=X{k}\n1, 2\n" for k in range(n))),
    "sets of elements": lambda n: finished(squares(2) + "".join(f"*ELSET, ELSET=X{k}\n1, 2\n" for k in range(n))),
    "lines of a set": lambda n: finished(squares(2) + "*NSET, NSET=X\n" + "1, 2\n" * n),
    "continued keyword lines": lambda n: finished(squares(2) + "*NSET,\n" + ",\n" * n + "NSET=X\n1\n"),
    "continued lines of nodes": lambda n: finished(squares(2) + "*NSET,\n" + "   ,   \n" * n + "NSET=X\n1\n"),
    "comments": lambda n: finished(squares(2) + "** a comment\n" * n),
    "contact pairs": lambda n: contact_pairs(n, False, several=False),
    "interactions": lambda n: contact_pairs(n, True),
    "pairs with bonded sets": lambda n: contact_pairs(n, True, bonded=True),
    "one pair of many bodies": one_pair_of_all,
    "cohesive sections": cohesive_sections,
    "cohesive sections of one material": lambda n: cohesive_sections(n, one=True),
    "couplings": lambda n: references(n, lambda k: f"*COUPLING, CONSTRAINT NAME=C{k}, REF NODE=R{k}, SURFACE=F{k}\n"
                                                   "*KINEMATIC\n1, 2\n"),
    "rigid bodies": lambda n: references(n, lambda k: f"*RIGID BODY, REF NODE=R{k}, NSET=F{k}\n"),
    "equations": lambda n: references(n, lambda k: f"*EQUATION\n2\nF{k}, 2, 1.0, R{k}, 2, -1.0\n"),
    "boundaries": boundaries,
    "amplitudes": amplitudes,
    "points of an amplitude": lambda n: loads(2, STEP.format("HELD").replace("*BOUNDARY", "*BOUNDARY, AMPLITUDE=A"),
                                              "*AMPLITUDE, NAME=A\n" + "".join(f"{k}.0, {k % 9}.0\n" for k in range(n))),
    "points in total time": lambda n: loads(
        2, "".join(f"*STEP\n*STATIC, DIRECT\n1.0, 1.0\n{'*BOUNDARY, AMPLITUDE=A' if k == 0 else '*BOUNDARY'}\n"
                   f"{'HELD, 1, 1, 1.0' if k == 0 else 'HELD, 2, 2'}\n*END STEP\n" for k in range(n)),
        "*BOUNDARY\nHELD, 2, 2\n*AMPLITUDE, NAME=A, TIME=TOTAL TIME\n" + "".join(f"{k}.0, {k % 9}.0\n" for k in range(n))),
    "forces": forces,
    "surfaces with loads": surfaces,
    "steps": steps,
    "lines of a step for one place": lambda n: steps(1, "*BOUNDARY\n" + "HELD, 1, 1, 0.5\n" * n),
    "steps that renew": lambda n: steps(n, "*BOUNDARY, OP=NEW\nHELD, 1, 2, {}\n"),
}
