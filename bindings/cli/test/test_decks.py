# SPDX-License-Identifier: BSD-3-Clause
"""Input files of Abaqus with cohesive elements or surfaces: what they become, and what is refused."""
import csv
import math
import os
import re

import decks
from decks import Beam
from support import delam, expect, expect_error, finish, folder, read, write


def saved(text, name="deck.inp", place=None):
    return write(text, name, place)


def history(path):
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", path, "--out", out)
    expect(code == 0, f"{os.path.basename(path)} runs: exit {code} {error.strip()[:300]}")
    if code != 0:
        return None
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items() if k not in ("solution", "mixity_rule")}
                for row in csv.DictReader(file)]


def off(rows, reference, key):
    largest = max(abs(row[key]) for row in reference) or 1.0
    return max(abs(a[key] - b[key]) for a, b in zip(rows, reference, strict=True)) / largest


def same(what, path, reference, allowed=1e-8, keys=("reaction", "dissipated", "stored_bulk")):
    rows = history(path)
    if rows is None or reference is None:
        return
    found = {key: off(rows, reference, key) for key in keys}
    expect(max(found.values()) <= allowed, f"{what}: {found}")


def imported(text, code=0):
    """The scene of a deck, and what was said of it."""
    status, scene, said = delam("import", saved(text))
    expect(status == code, f"import: exit {status}" + (f" {said.strip()}" if status != code else ""))
    return scene, said


def check_dialects():
    for plane in (True, False):
        beam = Beam(nx=40, ny=0 if plane else 2, nz=2)
        reference = history(saved(decks.hand(plane), "scene.toml"))
        expect(reference is not None and reference[-1]["dissipated"] > 0, "the crack of the reference grows")
        name = "plane" if plane else "space"
        same(f"{name}, flat", saved(decks.abaqus(beam)), reference)
        same(f"{name}, parts", saved(decks.parts(beam)), reference)
        same(f"{name}, surfaces", saved(decks.surfaces(beam)), reference)
        same(f"{name}, surfaces, bonded set", saved(decks.surfaces(beam, initial=True)), reference)
        apart = Beam(nx=40, ny=beam.ny, nz=2, gap=1e-5)
        same(f"{name}, thick cohesive elements", saved(decks.abaqus(apart)), reference, 1e-7)


def check_tetrahedra():
    """COH3D6 between the sides of tetrahedra, against the same sides as surfaces that adhere."""
    beam = Beam(length=0.024, notch=0.012, nx=16, ny=2, nz=1, tets=True)
    reference = history(saved(decks.surfaces(beam)))
    expect(reference is not None and reference[-1]["dissipated"] > 0, "the crack between tetrahedra grows")
    same("COH3D6", saved(decks.abaqus(beam)), reference)
    thick = Beam(length=0.024, notch=0.012, nx=16, ny=2, nz=1, tets=True, gap=1e-5)
    same("thick COH3D6", saved(decks.abaqus(thick)), reference, 1e-7)


def check_two_commands():
    """A scene that is written is the one that runs from the deck."""
    place = folder()
    deck = saved(decks.abaqus(Beam(nx=20, ny=0)), place=place)
    scene = os.path.join(place, "sub", "scene.toml")
    os.mkdir(os.path.dirname(scene))
    code, said, _ = delam("import", deck, "--out", scene)
    expect(code == 0 and "changed   NLGEOM" in said and "taken     10 cohesive elements" in said, "what import says")
    same("the scene that import wrote, in another folder", scene, history(deck), 0.0)
    before = read(scene)
    expect('[units]\nlength = ""\nforce = ""\n' in before.decode(), "a deck has no units to label pictures with")
    expect_error(delam("import", deck, "--out", scene), 2, "is there already", "--replace")
    pipe = scene + ".pipe"
    os.mkfifo(pipe)
    expect_error(delam("import", deck, "--out", pipe, "--replace"), 2, "it is no regular file")
    expect(read(scene) == before, "the scene is as it was")
    expect(delam("import", deck, "--out", scene, "--replace")[0] == 0, "--replace")
    expect_error(delam("import", os.path.join(place, "none.inp")), 2, "none.inp")
    expect_error(delam("import", deck, "--out", os.path.join(place, "none", "scene.toml")), 3, "none/scene.toml")
    code, said, _ = delam("check", deck)
    expect(code == 0 and 'law "Resin"' in said and "changed   NLGEOM" in said, "check says what the deck became")


def numbers(scene, key):
    return [float(word) for word in re.findall(rf"^{key} = (\S+)", scene, re.M)]


def check_laws():
    beam = Beam(nx=4, ny=0, nz=1)

    def law(**of_resin):
        text = decks.abaqus(beam, **of_resin)
        scene, said = imported(text)
        expect(delam("check", saved(text))[0] == 0, f"{of_resin} can be run")
        return scene, said

    scene, said = law(initiation="MAXS")
    expect(numbers(scene, "onset_exponent") == [100.0] and "MAXS as a power law" in said, "MAXS")

    scene, _ = law(evolution="*Damage Evolution, type=ENERGY, mixed mode behavior=POWER LAW, power=1.5\n"
                             "280., 790., 790.\n")
    expect('criterion = "power"\ntoughness_exponent = 1.5' in scene, "power law")
    # Toughnesses over the share of shear in the energy: straight lines between two rows are BK with exponent 1, and the
    # rows of a curve of BK give back its exponent.
    table = "*Damage Evolution, type=ENERGY, mixed mode behavior=TABULAR, mode mix ratio=ENERGY\n"
    scene, said = law(evolution=table + "280., 0., 0.\n790., 1., 0.\n")
    expect('criterion = "benzeggagh-kenane"\ntoughness_exponent = 1.0' in scene and "table of toughnesses" not in said and
           numbers(scene, "normal_toughness") == [280.0] and numbers(scene, "tangential_toughness") == [790.0], "two rows")
    rows = "".join(f"{280 + 510 * (k / 10) ** 2.284!r}, {k / 10}, {where}\n" for k in range(11) for where in (0.0, 1.0))
    scene, said = law(evolution=table + rows)
    found = numbers(scene, "toughness_exponent")
    expect(math.isclose(found[0], 2.284, rel_tol=1e-9) and re.search(r"off by up to 0\.\d+ %", said), f"rows of BK: {found}, {said}")
    scene, _ = law(evolution=table + "280., 0.\n280., 1.\n")
    expect(numbers(scene, "toughness_exponent") == [1.0], "a table of one toughness")
    for rows, pattern in (("280., 0.\n700., 0.1\n300., 0.9\n790., 1.\n", r"off by \d+ % from the table"),
                          ("280., 0.\n790., 0.9\n", "mode mix ratios 0 and 1"), ("280., 0.\n790., 2.\n", r"in \[0, 1\]"),
                          ("280., 0., 0.\n790., 1., 0.\n800., 1., 1.\n", "both directions of sliding"),
                          ("280., 0.\n-1., 1.\n", "a toughness > 0")):
        expect_error(delam("import", saved(decks.abaqus(beam, evolution=table + rows))), 2, pattern)
    scene, said = law(evolution="*Damage Evolution, type=ENERGY, softening=EXPONENTIAL\n280.,\n")
    expect('kind = "exponential"' in scene and "exponential softening" in said, "exponential")
    expect(numbers(scene, "normal_toughness") == numbers(scene, "tangential_toughness") == [280.0], "one toughness")
    # Displacement beyond the onset at the end: the area under the triangle.
    scene, said = law(evolution="*Damage Evolution, type=DISPLACEMENT\n2e-5,\n")
    wanted = [s * (s / decks.STIFFNESS + 2e-5) / 2 for s in (decks.NORMAL, decks.SHEAR)]
    found = numbers(scene, "normal_toughness") + numbers(scene, "tangential_toughness")
    expect(all(math.isclose(a, b, rel_tol=1e-12) for a, b in zip(found, wanted)), f"displacement: {found}, {wanted}")
    expect("the deck gives displacements" in said, "displacements are said")
    # D of a straight line down is that of the bilinear law. Both modes have the same jump at the onset.
    onset, end = decks.NORMAL / 1e12, 2e-5
    rows = [((d / end) * (onset + end) / (onset + d), d) for d in (end * k / 16 for k in range(17))]
    table = "".join(f"{d!r}, {x!r}\n" for d, x in rows)
    tabular = decks.abaqus(beam, evolution=f"*Damage Evolution, type=DISPLACEMENT, softening=TABULAR\n{table}")
    k = decks.STIFFNESS
    tabular = tabular.replace(f"{k}, {k}, {k}", f"1e12, {decks.SHEAR / onset!r}, {decks.SHEAR / onset!r}")
    scene, said = imported(tabular)
    expect(delam("check", saved(tabular))[0] == 0, "a tabulated law can be run")
    curve = [tuple(map(float, pair)) for pair in re.findall(r"^    \[(\S+), (\S+)\],", scene, re.M)]
    expect(len(curve) == 17 and max(abs(s - (1 - x)) for x, s in curve) < 1e-12, f"tabulated curve {curve}")
    expect("D in Abaqus" in said, "that Abaqus differs between the points is said")
    area = sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in zip(curve, curve[1:])) * end
    expect_error(delam("import", saved(tabular.replace("1e12, ", "1e14, ", 1))), 2,
                 "traction rises beyond the onset")
    toughness = decks.NORMAL * (onset / 2 + area)
    expect(math.isclose(numbers(scene, "normal_toughness")[0], toughness, rel_tol=1e-9), "its area")


def check_thickness():
    """Stiffnesses per strain: the same law from a tenth of the thickness and of the modulus."""
    beam = Beam(nx=40, ny=0)
    text = decks.abaqus(beam)
    scaled = text.replace("response=TRACTION SEPARATION\n", "response=TRACTION SEPARATION, thickness=SPECIFIED\n0.1,\n")
    scaled = scaled.replace(f"{decks.STIFFNESS}, {decks.STIFFNESS}, {decks.STIFFNESS}", "1e13, 1e13, 1e13")
    same("a specified thickness", saved(scaled), history(saved(text)))
    gap = 1e-5
    geometry = decks.abaqus(Beam(nx=40, ny=0, gap=gap)).replace(
        "response=TRACTION SEPARATION", "response=TRACTION SEPARATION, thickness=GEOMETRY")
    k = decks.STIFFNESS * gap
    geometry = geometry.replace(f"{decks.STIFFNESS}, {decks.STIFFNESS}, {decks.STIFFNESS}", f"{k}, {k}, {k}")
    same("the thickness of the geometry", saved(geometry), history(saved(text)), 1e-6)
    strain = text.replace("criterion=QUADS", "criterion=QUADE").replace(
        f"{decks.NORMAL}, {decks.SHEAR}, {decks.SHEAR}",
        f"{decks.NORMAL / decks.STIFFNESS}, {decks.SHEAR / decks.STIFFNESS}, {decks.SHEAR / decks.STIFFNESS}")
    same("strengths as strains", saved(strain), history(saved(text)))


def check_steps():
    beam = Beam(nx=20, ny=0)
    text = decks.abaqus(beam)
    amplitude = "*Amplitude, name=Saw\n0., 0., 0.4, 1., 0.7, 0.2, 1., 1.\n"
    driven = text.replace("*Step", amplitude + "*Step", 1).replace("*Boundary\nTop", "*Boundary, amplitude=saw\nTop")
    scene, _ = imported(driven)
    expect("times = [0.0, 0.4, 0.7, 1.0]\nvalues = [0.0, 0.001, 0.0002, 0.001]" in scene, "amplitude")
    # A second step of half the length and another increment, back to the start, with a force on top.
    second = ("*Step\n*Static, direct\n0.1, 0.5\n*Boundary\nTop, 2, 2, 0.\nBottom, 2, 2, 0.\n*Cload\nTop, 1, 3.5\n*End Step\n")
    scene, _ = imported(text + second)
    expect("times = [0.0, 1.0, 1.5]\nvalues = [0.0, 0.001, 0.0]" in scene, "two steps")
    expect("times = [0.0, 1.0, 1.5]\nvalues = [0.0, 0.0, 1.0]" in scene and "force = [3.5, 0.0]" in scene, "a force")
    instants = [float(word) for word in re.search(r"instants = \[(.*)\]", scene).group(1).split(",")]
    expect(len(instants) == 26 and instants[-1] == 1.5 and math.isclose(instants[21], 1.1),
           f"instants {instants[19:23]}")
    expect(delam("check", saved(text + second))[0] == 0, "two steps can be run")
    # A jump at the beginning of a step takes its first increment.
    scene, said = imported(text.replace("*Step, name=Open,", "*Step, name=Open, amplitude=STEP,"))
    expect("times = [0.0, 0.05, 1.0]\nvalues = [0.0, 0.001, 0.001]" in scene and "jumps at the beginning" in said,
           "a jump")
    smooth = driven.replace("*Amplitude, name=Saw\n0., 0., 0.4, 1., 0.7, 0.2, 1., 1.\n",
                            "*Amplitude, name=Saw, definition=SMOOTH STEP\n0., 0., 1., 1.\n")
    scene, _ = imported(smooth)
    values = [float(word) for word in re.search(r"^values = \[(.*)\]", scene, re.M).group(1).split(",")]
    # The point in the middle, where the curve is straight, is left out.
    expect(len(values) == 16 and math.isclose(values[4], 0.001 * 0.103515625), "smooth step")
    # The factor grows, whichever way the first set moves.
    turned = text.replace("Top, 2, 2, 0.001\nBottom, 2, 2, -0.001", "Bottom, 2, 2, -0.001\nTop, 2, 2, 0.001")
    assert turned != text
    scene, said = imported(turned)
    expect("values = [0.0, 0.001]" in scene and scene.index("coefficient = -1.0") < scene.index('set = "Top"'),
           "a pattern that grows")
    expect("moves 2 places in proportion: its reaction is the sum" in said, "what the reaction is")
    nodes = beam.set_at(0, (1,), (2,))
    scene, _ = imported(text.replace("*Boundary\nTop, 2, 2", f"*Boundary\n{nodes[0]}, 2, 2"))
    expect('point = [0.0, 0.003]\nbody = "Arms-2"' in scene, "a node by its number")
    last = beam.nx * beam.nz * 2
    pressed = text.replace("*Solid Section", "*Surface, name=Roof\nRoof-cells, S3\n"
                           f"*Elset, elset=Roof-cells, generate\n{last - beam.nx + 1}, {last}\n*Solid Section", 1)
    pressed = pressed.replace("*Output,", "*Dsload\nRoof, P, 2e5\n*Output,", 1)
    scene, _ = imported(pressed)
    expect('set = "Roof"' in scene and "pressure = 200000.0" in scene, "a pressure")
    expect(delam("check", saved(pressed))[0] == 0, "a pressure can be run")


def check_repeated_lines():
    """Of several lines of a step for the same place the last counts, and each kind of load has its own OP=NEW."""
    text = decks.abaqus(Beam(nx=6, ny=0, nz=1))
    scene, _ = imported(text.replace("Top, 2, 2, 0.001", "Top, 2, 2, 0.5\nTop, 2, 2, 0.001"))
    expect("values = [0.0, 0.001]" in scene and "0.5" not in scene.split("[[patterns]]")[1].split("[time]")[0],
           "the last line counts")
    blank = text.replace("*Boundary\nTop", "  *Boundary\nTop").replace("** a comment", "   ** a comment")
    expect("coefficient = -1.0" in imported(blank)[0], "keywords behind blanks")
    roof = ("*Surface, name=Roof\n12, S3\n")
    pressed = text.replace("*Solid Section", roof + "*Solid Section", 1)
    pressed = pressed.replace("*Output,", "*Dsload\nRoof, P, 10.\n*Output,", 1)
    second = "*Step\n*Static\n0.1, 1.\n*Cload, op=NEW\nTop, 1, 3.\n*End Step\n"
    scene, _ = imported(pressed + second)
    expect("times = [0.0, 1.0, 2.0]\nvalues = [0.0, 1.0, 1.0]" in scene, "a pressure stays where OP=NEW is of *CLOAD")
    third = second.replace("*Cload, op=NEW\nTop, 1, 3.", "*Dsload, op=NEW\n")
    scene, _ = imported(pressed + third)
    expect("times = [0.0, 1.0, 2.0]\nvalues = [0.0, 1.0, 0.0]" in scene, "and falls where it is of *DSLOAD")
    # In a later step too, where the load begins with it.
    again = second.replace("Top, 1, 3.", "Top, 1, 7.\nTop, 1, 3.")
    expect("times = [0.0, 1.0, 2.0]\nvalues = [0.0, 0.0, 1.0]" in imported(text + again)[0], "a force of a later step")
    turned = pressed.replace("Roof, P, 10.", "Roof, TRVEC, 10., 1., 0.")
    turned += second.replace("*Cload, op=NEW\nTop, 1, 3.", "*Dsload\nRoof, TRVEC, 10., 0., 1.")
    expect_error(delam("import", saved(turned)), 2, "another direction")
    top = Beam(nx=6, ny=0, nz=1).set_at(0, (1,), (1,))[0]
    twice = text.replace("*Output,", f"*Cload\nTop, 1, 10.\n{top}, 1, 4.\n*Output,", 1)
    expect_error(delam("import", saved(twice)), 2, "another line")
    # A scene in the plane is per unit of thickness.
    thick = text.replace("material=Ply\n,\n", "material=Ply\n0.02,\n").replace(
        "response=TRACTION SEPARATION\n", "response=TRACTION SEPARATION\n, 0.02\n")
    scene, said = imported(thick.replace("*Output,", "*Cload\nTop, 1, 10.\n*Output,", 1))
    expect("force = [500.0, 0.0]" in scene and "0.02 thick" in said, "a force in a plane of some thickness")
    scene, _ = imported(text.replace("DCB with", "Tr\xe4ger with"))
    expect("Tr\xe4ger" in scene, "a heading that is not ASCII")
    path = saved("", "latin.inp")
    with open(path, "wb") as file:
        file.write(text.replace("DCB with", "Tr\xe4ger with").encode("latin-1"))
    expect(delam("check", path)[0] == 0, "a heading in Latin-1")


def check_parts_of_their_own():
    """Orientations of the same name in two parts; an instance that is rotated."""
    cell = ("*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n"
            "5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n"
            "*Element, type=C3D8, elset=All\n1, 1, 2, 3, 4, 5, 6, 7, 8\n")
    part = ("*Part, name={0}\n" + cell + "*Orientation, name=Ori-1\n{1}\n3, 0.\n"
            "*Solid Section, elset=All, material=Ply, orientation=Ori-1\n,\n*End Part\n")
    text = (part.format("A", "1., 0., 0., 0., 1., 0.") + part.format("B", "0., 1., 0., -1., 0., 0.") +
            "*Assembly, name=X\n*Instance, name=A-1, part=A\n*End Instance\n"
            "*Instance, name=B-1, part=B\n0., 0., 5.\n*End Instance\n*End Assembly\n" + decks.PLY +
            "*Step\n*Static\n1., 1.\n*End Step\n")
    scene, _ = imported(text)
    expect(re.findall(r"axes = .*", scene) == ["axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]",
                                               "axes = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]"],
           "each part has its own orientation")
    # A part turns with its orientation.
    scene, _ = imported(text.replace("0., 0., 5.\n", "0., 0., 5.\n0., 0., 0., 0., 0., 1., 90.\n"))
    expect(re.findall(r"axes = .*", scene)[1] == "axes = [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]", "a rotated instance")


def check_axes():
    beam = Beam(nx=4, ny=2, nz=1)
    text = decks.abaqus(beam).replace("type=C3D8I", "type=SC8R")
    shell = text.replace("*Solid Section, elset=Arms, material=Ply\n,\n",
                         "*Orientation, name=Ori\n0., 1., 0., -1., 0., 0.\n3, 0.\n"
                         "*Shell Section, elset=Arms, composite, orientation=Ori\n0.0015, 3, Ply, 30.\n")
    scene, said = imported(shell)
    axes = [float(word) for word in re.findall(r"-?[\d.]+(?:e-?\d+)?", re.search(r"axes = (.*)", scene).group(1))]
    # Axis 1 is y, turned by 30 degrees towards -x about z.
    wanted = [-0.5, math.sqrt(0.75), 0, -math.sqrt(0.75), -0.5, 0]
    expect(all(math.isclose(a, b, abs_tol=1e-12) for a, b in zip(axes, wanted, strict=True)), f"axes {axes}")
    expect("SC8R: a solid cell here" in said, "continuum shells are said")
    expect(delam("check", saved(shell))[0] == 0, "continuum shells can be run")
    lamina = shell.replace(decks.PLY, "*Material, name=Ply\n*Elastic, type=LAMINA\n"
                           f"{decks.E1}, {decks.E2}, 0.3, 5e9, 5e9, 3.6e9\n")
    scene, said = imported(lamina)
    expect(numbers(scene, "E3") == [decks.E2] and "LAMINA says nothing" in said, "lamina")
    expect(math.isclose(numbers(scene, "nu23")[0], decks.E2 / 7.2e9 - 1), "nu23 of a lamina")


def check_bonded():
    """Bodies that share nodes are bonded: the same beam with its arms in two sections each."""
    beam = Beam(nx=40, ny=0)
    text = decks.abaqus(beam)
    row = beam.nx
    first = f"*Elset, elset=Outer\n{decks.lines([*range(1, row + 1), *range(3 * row + 1, 4 * row + 1)])}"
    inner = f"*Elset, elset=Inner, generate\n{row + 1}, {3 * row}\n"
    split = text.replace("*Solid Section, elset=Arms, material=Ply\n,\n", first + inner +
                         "*Solid Section, elset=Outer, material=Ply\n*Solid Section, elset=Inner, material=Ply\n")
    scene, _ = imported(split)
    expect(scene.count("bonded = true") == 2, "two bonded interfaces")
    same("bonded sections", saved(split), history(saved(text)), 1e-7)


def check_reference_nodes():
    """Nodes of no body that bodies are tied to, against the same motion prescribed node by node."""
    for plane in (True, False):
        beam = Beam(nx=20, ny=0 if plane else 2, nz=2)
        text = decks.abaqus(beam)
        reference = history(saved(text))
        across = 2 if plane else 3
        middle = "" if plane else f"{beam.width / 2}, "
        dummies = f"*Node\n9001, 0., {middle}0.01\n9002, 0., {middle}-0.01\n"
        pulled = text.replace("Top, ", "9001, ").replace("Bottom, ", "9002, ")
        equations = (dummies + f"*Equation\n2\nTop, {across}, 1., 9001, {across}, -1.\n"
                     f"2\nBottom, {across}, 1.,\n9002, {across}, -1.\n")
        by_equations = pulled.replace("*Boundary\nClamp", equations + "*Boundary\nClamp")
        same(f"{plane=}: equations with dummy nodes", saved(by_equations), reference)
        coupled = dummies + "*Nset, nset=RP-1\n9001\n"
        for name, node in (("Top", "RP-1"), ("Bottom", "9002")):
            coupled += (f"*Surface, name=S-{name}, type=NODE\n{name}\n"
                        f"*Coupling, constraint name={name}, ref node={node}, surface=S-{name}\n"
                        f"*Kinematic\n{across}, {across}\n")
        # No rotation can move this line of nodes in the plane; in space the line may tilt, which symmetry prevents.
        by_coupling = pulled.replace("*Boundary\nClamp", coupled + "*Boundary\nClamp")
        scene, said = imported(by_coupling)
        expect('name = "RP-1"' in scene and 'name = "node-9002"' in scene and "2 rigid couplings" in said, "couplings")
        expect(("-rotation" in scene) != plane, f"{plane=}: rotations only where they move nodes")
        same(f"{plane=}: couplings", saved(by_coupling), reference)
        clamped = text.replace("Clamp, ENCASTRE", "9001, ENCASTRE").replace(
            "*Boundary\n9001", dummies + "*Rigid body, nset=Clamp, ref node=9001, rot node=9002\n*Boundary\n"
            "9002, 1, 3\n9001")
        same(f"{plane=}: a rigid clamp", saved(clamped), reference)


def check_rotations():
    """The end of the upper arm in a grip that is moved and turned about a point beside it."""
    for plane in (True, False):
        beam = Beam(nx=20, ny=0 if plane else 2, nz=2)
        nodes = dict(beam.nodes())
        ends = beam.set_at(0, (1,), range(beam.nz + 1))
        centre = (-0.005, 0.004) if plane else (-0.005, 0.001, 0.004)
        moved = (1e-4, 1e-3) if plane else (1e-4, -2e-5, 3e-3)
        turned = (0.0, 0.0, 0.05) if plane else (0.01, 0.05, -0.02)
        text = decks.abaqus(beam)
        before = text[:text.index("*Boundary\nTop")]
        after = "*End Step\n"
        lines = []
        for node in ends:
            r = [a - b for a, b in zip(nodes[node], centre)] + [0.0] * (3 - len(centre))
            w = turned
            swung = (w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0])
            lines += [f"{node}, {a + 1}, {a + 1}, {moved[a] + swung[a]!r}\n" for a in range(len(centre))]
        reference = history(saved(before + "*Boundary\n" + "".join(lines) + after))
        expect(reference is not None and reference[-1]["dissipated"] > 0, "the crack grows")
        grip = ("*Node\n9001, " + ", ".join(map(str, centre)) + "\n9002, 0., 0.\n"
                "*Nset, nset=Grip\n9001\n*Nset, nset=Ends\n" + decks.lines(ends))
        kinds = {"coupling": "*Surface, name=End, type=NODE\nEnds\n"
                             "*Coupling, constraint name=C, ref node=Grip, surface=End\n*Kinematic\n"}
        first = 6 if plane else 4
        values = {"coupling": [f"9001, {4 + a}, {4 + a}, {w}\n" for a, w in enumerate(turned) if 4 + a >= first]}
        kinds["rigid body"] = "*Rigid body, nset=Ends, ref node=9001, rot node=9002\n"
        values["rigid body"] = [f"9002, {1 + a}, {1 + a}, {w}\n" for a, w in enumerate(turned) if 4 + a >= first]
        energies = ("dissipated", "stored_bulk", "stored_interface", "work")
        for kind, card in kinds.items():
            driven = "".join([f"9001, {a + 1}, {a + 1}, {u}\n" for a, u in enumerate(moved)] + values[kind])
            deck = before.replace("*Boundary\nClamp", grip + card + "*Boundary\nClamp") + "*Boundary\n" + driven + after
            same(f"{plane=}: {kind}", saved(deck), reference, 1e-6, energies)
        # A moment bends the arm.
        card = before.replace("*Boundary\nClamp", grip + kinds["coupling"] + "*Boundary\nClamp")
        scene, _ = imported(card + f"*Cload\nGrip, {6 if plane else 5}, 0.25\n" + after)
        expect('control = "Grip-rotation"\npattern = "force"\nforce = ' +
               ("[0.25, 0.0]" if plane else "[0.0, 0.25, 0.0]") in scene, "a moment")
        expect_error(delam("import", saved(card + f"*Cload\nEnds, {6 if plane else 5}, 0.25\n" + after)), 2, "a moment on")
        # A second node of no body, with which nothing moves: supports of both keep those of the first, loads are refused.
        both = card.replace("*Nset, nset=Grip\n9001\n", "*Nset, nset=Grip\n9001\n*Nset, nset=Both\n9001, 9003\n"
                            "*Node\n9003, 0.1, 0.1\n")
        scene, _ = imported(both.replace("Clamp, ENCASTRE\n", "Clamp, ENCASTRE\nBoth, ENCASTRE\n") + after)
        expect(scene.count('control = "Grip-rotation"\nfix = [' + ('"x"]' if plane else '"x", "y", "z"]')) == 1 and
               "9003" not in scene, "a set of reference nodes is held")
        for line in ("Both, 6, 6, 0.02", "9003, 1, 1, 0.1"):
            expect_error(delam("import", saved(both + f"*Boundary\n{line}\n" + after)), 2, "nothing moves with it")
        twice = card + "*Cload\nGrip, 2, 5.\n9001, 2, 5.\n" + after
        expect_error(delam("import", saved(twice)), 2, "another line by another name")
        other = grip + kinds["rigid body"] + kinds["rigid body"].replace("node=9001", "node=9003").replace(
            "nset=Ends", "nset=Clamp") + "*Node\n9003, 0.1, 0.1\n"
        expect_error(delam("import", saved(before.replace("*Boundary\nClamp", other + "*Boundary\nClamp") + after)), 2,
                     "another card uses this node too")
        for term in ("9001, 7, 1.", "9001, 1, abc", "9001, , 1.", "9001, 1, 1e400"):
            expect_error(delam("import", saved(card.replace("*Kinematic\n", f"*Kinematic\n*Equation\n1\n{term}\n") +
                                               after)), 2, r"deck\.inp:\d+: \*EQUATION")
        pairs = "*Nset, nset=Two, unsorted\n" + ", ".join(map(str, ends[1::-1])) + "\n*Equation\n2\nTwo, 1, 1., Grip, 1, -1.\n"
        expect_error(delam("import", saved(card.replace("*Kinematic\n", "*Kinematic\n" + pairs) + after)), 2, "UNSORTED")
        one = card.replace("*Kinematic\n", "*Kinematic\n2, 2\n")
        expect_error(delam("import", saved(one + "*Cload\nGrip, 1, 0.25\n" + after)), 2, "with which nothing moves")
        expect_error(delam("import", saved(card + "*Cload\nGrip, 1, 0.25, 3.\n" + after)), 2, "3 values are expected")
        upright = one.replace("Clamp, ENCASTRE\n", "Clamp, ENCASTRE\nGrip, 4, 6\n") + "*Cload\nGrip, 2, 0.25\n" + after
        expect(delam("check", saved(upright))[0] == 0, "and one with which nodes move")
        for old, new, pattern in (("*Kinematic\n", "*Distributing, coupling=STRUCTURAL\n", "COUPLING=STRUCTURAL is not imported"),
                                  ("ref node=Grip", "ref node=1", "belongs to no body is expected"),
                                  ("surface=End", "surface=Ent", "no surface or node set of this name"),
                                  ("*Kinematic\n", "*Kinematic\n4, 6\n", "nodes of solids do not rotate"),
                                  ("*Kinematic\n", "*Kinematic\n*Equation\n2\nGrip, 1, 1.\n", "1 terms: 2 are expected"),
                                  ("*Kinematic\n", "*Kinematic\n*Equation\n1\nEnds, 4, 1.\n", "a node of a body has 1 to"),
                                  ("*Kinematic\n", "*Kinematic\n*Equation\n2\nEnds, 1, 1., Clamp, 1, 1.\n",
                                   "nodes, and another set"),
                                  ("*Nset, nset=Ends\n", "*Nset, nset=Ends\n9001\n", "belong to no body")):
            expect_error(delam("import", saved(card.replace(old, new) + after)), 2, pattern)


REFUSED = [
    ("280.0, 790.0, 790.0\n", "280.0, 790.0, 790.0, 20.\n300.0, 800.0, 800.0, 60.\n", "values at one temperature"),
    ("type=ENERGY", "type=DISPLACEMENT", "MIXED MODE BEHAVIOR=BK needs TYPE=ENERGY"),
    ("*Damage Evolution", "*Damage Initiation, criterion=QUADS\n1., 1., 1.\n*Damage Evolution", "given twice"),
    ("*Solid Section, elset=Arms, material=Ply\n,\n", "*Solid Section, elset=Arms, material=Ply\n0.02,\n",
     "a thickness of 1 and one of 0.02"),
    ("1e-9, 0.05\n", "0., 1e-300\n", "increments of 1e-300"),
    ("1e-9, 0.05\n", "1e-9, 0.05\n1., 2.\n", "one line is expected"),
    ("Top, 2, 2,", "Top, 4294967299, 4294967299,", "degree of freedom 4294967299"),
    ("type=ENERGY, mixed mode behavior=BK, power=2.3\n280.0", "type=DISPLACEMENT, softening=TABULAR\n0.0\n280.0",
     "rows of D"),
    ("*Boundary\nClamp, ENCASTRE", "*Boundary\nClamps, ENCASTRE", r"node set \"Clamps\" is not there"),
    ("*Boundary\nClamp, ENCASTRE", "*Boundary\nClamp, 1, 3, 0.1", r"within a \*STEP"),
    ("*Boundary\nClamp, ENCASTRE", "*Boundary\nClamp, 7", r"1 to 6"),
    ("material=Resin", "material=Rosin", r"material \"Rosin\" is not there.*Resin"),
    ("type=TRACTION", "type=COUPLED TRACTION", r"COUPLED TRACTION is not imported"),
    ("response=TRACTION SEPARATION", "response=CONTINUUM", r"RESPONSE=CONTINUUM"),
    ("criterion=QUADS", "criterion=LEPP", r"CRITERION=LEPP"),
    ("*Damage Initiation, criterion=QUADS\n", "** \n", r"6 numbers: 3 constants"),
    ("mixed mode behavior=BK, power=2.3", "mixed mode behavior=BK", r"POWER= is missing"),
    ("mixed mode behavior=BK, power=2.3", "mixed mode behavior=BK, power=0", r"must be > 0"),
    ("type=ENERGY", "type=HYSTERESIS ENERGY", r"HYSTERESIS ENERGY"),
    ("280.0, 790.0, 790.0", "-280.0, 790.0, 790.0", r"toughness -280.*> 0"),
    ("12000000.0, 20000000.0, 20000000.0", "0., 20000000.0, 20000000.0", r"QUADS 0.*> 0"),
    ("*Static\n", "*Frequency\n", r"FREQUENCY.*would change the result"),
    ("nlgeom=NO,", "perturbation,", r"PERTURBATION"),
    ("*Material, name=Ply\n", "*Plastic\n1e6, 0.\n*Material, name=Ply\n", r"PLASTIC.*would change the result"),
    ("type=ENGINEERING CONSTANTS", "type=ANISOTROPIC", r"ANISOTROPIC is not imported"),
    ("*Cohesive Section, elset=Cohesive,", "*Cohesive Section, elset=Arms,", r"is no cohesive element"),
    ("*Step,", "*Tie, name=T\nA, B\n*Step,", r"\*TIE: surface .A. is not there"),
    ("*End Step\n", "", r"\*STEP is not ended"),
    ("Top, 2, 2, 0.001", "Top, 2, 2, abc", r"\"abc\".*number"),
]


def check_names():
    """The name of a deck stays in its comment, whatever ends a line in it."""
    text = decks.abaqus(Beam(nx=6, ny=0, nz=1))
    plain = delam("import", saved(text))[1].splitlines()
    status, scene, _ = delam("import", saved(text, name="x\nschema = 9\n#.inp"))
    expect(status == 0 and "# From" in scene and r"x\x0aschema = 9\x0a#.inp by delam import." in scene, "in the comment")
    expect("\nschema = 9" not in scene and len(scene.splitlines()) == len(plain), "and in no line of its own")


def check_refusals():
    text = decks.abaqus(Beam(nx=6, ny=0, nz=1))
    for old, new, pattern in REFUSED:
        assert old in text, old
        expect_error(delam("import", saved(text.replace(old, new, 1))), 2, r"deck\.inp(:\d+)?: ", pattern)
    expect_error(delam("import", saved(decks.mesh(Beam(nx=2, ny=0, nz=1)))), 2, "no \\*STEP")
    # Another strength in the second direction of sliding, which only space has.
    space = decks.abaqus(Beam(nx=4, ny=1, nz=1))
    scene, _ = imported(space.replace("12000000.0, 20000000.0, 20000000.0", "12e6, 20e6, 25e6"))
    found = re.search(r"^second_tangential_strength = (\S+)", scene, re.M)
    expect(found and float(found.group(1)) == 25e6 and "shear_axis" in scene, "two strengths in shear")
    glue = decks.surfaces(Beam(nx=4, ny=0, nz=1))
    k = decks.STIFFNESS
    # Contact beside cohesive elements, for what has come off, is what every interface has.
    beam = Beam(nx=4, ny=0, nz=1)
    both = decks.abaqus(beam).replace("*Solid Section", glue[glue.index("*Elset, elset=E-below"):glue.index(
        "*Elset, elset=Lower")] + glue[glue.index("*Surface, name"):glue.index(decks.PLY)] + "*Solid Section", 1)
    both = both.replace("*Step", "*Surface interaction, Name=Hard\n*Contact pair, Interaction=Hard\n"
                        "Above, Below\n*Step", 1)
    scene, _ = imported(both)
    expect(scene.count("[[interfaces]]") == 1 and 'law = "Resin"' in scene, "contact beside cohesive elements")
    soft = glue.replace(f"*Cohesive behavior\n{k}, {k}, {k}\n", f"*Cohesive behavior\n{k}\n")
    expect_error(delam("import", saved(soft)), 2, "Knn, Kss, Ktt are expected")
    expect_error(delam("import", saved(glue.replace("Above, Below\n", "Above, Beneath\n"))), 2, "Beneath")


DOUBLED = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 1 "plate"
1 2 "bottom"
1 3 "top"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 1 0
6 1 1 0
7 1 2 0
8 0 2 0
$EndNodes
$Elements
4
1 3 2 1 1 1 2 3 4
2 3 2 1 2 5 6 7 8
3 1 2 2 1 1 2
4 1 2 3 2 8 7
$EndElements
"""
OF_DOUBLED = """
schema = 1
[mesh]
file = "doubled.msh"
pieces = true
[[materials]]
name = "m"
young = 1e9
poisson = 0.0
[[bodies]]
name = "plate-*"
material = "m"
[[laws]]
name = "law"
normal_stiffness = 1e9
tangential_stiffness = 1e9
normal_strength = 1e5
tangential_strength = 1e5
normal_toughness = 20.0
tangential_toughness = 20.0
[[interfaces]]
a = "plate-1"
b = "plate-2"
law = "law"
[[patterns]]
name = "p"
times = [0, 1]
values = [0, 1e-3]
[[supports]]
set = "bottom"
fix = ["x", "y"]
[[supports]]
set = "top"
fix = ["x"]
[[loads]]
set = "top"
component = ["y"]
pattern = "p"
[time]
end = 1.0
steps = 10
"""


def check_doubled_nodes():
    """A mesh of Gmsh whose nodes are doubled along a line within one physical surface, as by its plug-in Crack."""
    place = folder()
    saved(DOUBLED, "doubled.msh", place)
    scene = saved(OF_DOUBLED, "scene.toml", place)
    rows = history(scene)
    # Two bars of height 1 and the interface in series, until the strength is reached; then all of the energy is lost.
    first = rows[1]["reaction"]
    expect(math.isclose(first, 1e-4 / (2 / 1e9 + 1 / 1e9), rel_tol=1e-9), f"bars and interface in series: {first}")
    expect(math.isclose(rows[-1]["dissipated"], 20.0, rel_tol=1e-9), f"the bar breaks: {rows[-1]['dissipated']}")
    code, out, _ = delam("check", scene)
    expect(code == 0 and 'body "plate" consists of 2 pieces: "plate-1" to "plate-2"' in out, "check says so")
    expect_error(delam("check", saved(OF_DOUBLED.replace("pieces = true\n", ""), "whole.toml", place)), 2, "plate-")
    expect_error(delam("check", saved(OF_DOUBLED.replace('law = "law"', 'law = "law"\nnotch = [{ lower = [0, 0], '
                                                         'upper = [1, 1], outside = true }]'), "box.toml", place)), 2,
                 "outside", "is for set")


check_dialects()
check_tetrahedra()
check_doubled_nodes()
check_two_commands()
check_laws()
check_thickness()
check_steps()
check_axes()
check_repeated_lines()
check_parts_of_their_own()
check_bonded()
check_reference_nodes()
check_rotations()
check_names()
check_refusals()
finish()
