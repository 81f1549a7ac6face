# SPDX-License-Identifier: BSD-3-Clause
"""Elements of decks and meshes that are wrong are named as their file names them: by number and line; and all that a deck
asks for and does not get is said in one run."""
import json
import os

import decks
from block_deck import COHESIVE, deck
from deck_runs import refused
from support import delam, expect, expect_error, finish, folder, write

GOOD = "102, 103, 104, 109, 108\n"


# A wedge beside a brick whose upper face goes round the wrong way.
MIXED = """*Node
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
9, 2., 0., 0.
10, 2., 0., 1.
*Element, type=C3D6, elset=E
7, 2, 9, 3, 6, 10, 7
*Element, type=C3D8, elset=E
5, 1, 2, 3, 4, 5, 6, 8, 7
*Solid section, elset=E, material=M
*Material, name=M
*Elastic
1., 0.
*Step
*Static
*Boundary
1, 1, 3
*End step
"""


def line_of(text, start):
    """The number of the line that begins so."""
    return 1 + [line.startswith(start) for line in text.splitlines()].index(True)


def check_elements_of_decks():
    bare = deck(cohesive=False)
    for new, pattern in (
            ("102, 103, 109, 104, 108\n", r"element 102 \(body \"Up\"\): smallest Jacobian .*inverted"),
            ("102, 103, 104, 104, 108\n", r"element 102 \(body|element 102 has an edge of no length"),
            ("102, 103, 104, 109, 999\n", "element 102 has node 999, which is not there")):
        text = bare.replace(GOOD, new)
        assert text != bare
        where = rf"deck\.inp:{line_of(text, new.strip())}: \*ELEMENT: "
        for command in (("check",), ("run", "--out", os.path.join(folder(), "out"))):
            expect_error(delam(command[0], write(text, "deck.inp"), *command[1:]), 2, where + pattern)
    code, said, _ = delam("check", "--json", write(bare.replace(GOOD, "102, 103, 109, 104, 108\n"), "deck.inp"))
    error = json.loads(said)["errors"]
    expect(code == 2 and len(error) == 1 and error[0]["key"] == "*ELEMENT" and error[0]["line"] > 0, f"{error}")
    # Two elements in one place, in the same part and in an instance.
    twice = bare.replace(GOOD, GOOD + "180, 103, 104, 109, 108\n")
    first, second = line_of(twice, GOOD.strip()), line_of(twice, "180, ")
    expect_error(delam("check", write(twice, "deck.inp")), 2, rf"deck\.inp:{first}: \*ELEMENT: ",
                 rf"elements 102 and 180 of .*deck\.inp:{second} lie on the same side .* they overlap")
    # Elements of an instance, and of several types.
    text = decks.parts(decks.Beam(nx=4, ny=0, nz=1))
    lines = text.splitlines()
    at = lines.index("*Element, type=CPE4I, elset=Arms") + 2
    number, a, b, c, d = lines[at].split(", ")
    lines[at] = ", ".join((number, a, b, d, c))
    expect_error(delam("check", write("\n".join(lines) + "\n", "deck.inp")), 2,
                 rf"deck\.inp:{at + 1}: \*ELEMENT: element Beam-1\.{number} \(body \"Beam-1\.Arms-1\"\)")
    expect_error(delam("check", write(MIXED, "deck.inp")), 2, r"deck\.inp:15: \*ELEMENT: element 5 \(body")
    # The element beside a cohesive one, not the cohesive one, is wrong.
    text = deck().replace(GOOD, "102, 103, 109, 104, 108\n")
    refused(text, rf"deck\.inp:{line_of(text, '102, 103')}: \*ELEMENT: element 102 has the nodes of a face of element 202")
    refused(deck().replace("202, 7, 8, 104, 103", "202, 7, 104, 8, 103"), "element 202 of .* no side of a cell")
    assert "202, 7, 8, 104, 103" in COHESIVE


def check_elements_of_meshes():
    """The same mesh in a scene, from a deck's mesh and from a file of Gmsh."""
    bare = deck(cohesive=False)
    bad = bare.replace(GOOD, "102, 103, 109, 104, 108\n")
    _, scene, _ = delam("import", write(bare, "mesh.inp"))
    place = folder()
    for mesh, text, where in (("mesh.inp", bad, rf"element 102 of .*mesh\.inp:{line_of(bad, '102, 103')} \(body"),
                              ("mesh.msh", gmsh(bad), r"element 102 of .*mesh\.msh \(body \"Up\"\): smallest Jacobian")):
        write(text, mesh, place)
        lines = [f'file = "{mesh}"' if line.startswith("file = ") else line for line in scene.splitlines()]
        path = write("\n".join(lines[1:]) + "\n", "scene.toml", place)
        expect_error(delam("check", path), 2, r"scene\.toml:\d+: mesh: " + where)


def gmsh(text):
    """A deck's mesh as a file of Gmsh, version 2.2, with its numbers."""
    nodes, cells, block = [], [], ""
    for line in text.splitlines():
        if line.startswith("*"):
            block = line
        elif block == "*Node":
            nodes.append(line.split(","))
        elif block.startswith("*Element"):
            cells.append((1 if "Low" in block else 2, line.split(",")))
    out = '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n2 1 "Low"\n2 2 "Up"\n1 3 "Bottom"\n1 4 "Top"\n$EndPhysicalNames\n'
    out += f"$Nodes\n{len(nodes)}\n" + "".join(f"{n} {x} {y} 0\n" for n, x, y in nodes) + "$EndNodes\n"
    edges = [f"{900 + i} 1 2 {tag} {tag} {first + i} {first + i + 1}\n" for tag, first in ((3, 1), (4, 107)) for i in range(4)]
    edges = [f"{900 + k} " + edge.split(" ", 1)[1] for k, edge in enumerate(edges)]
    out += f"$Elements\n{len(cells) + len(edges)}\n" + "".join(edges)
    out += "".join(f"{nodes[0]} 3 2 {tag} {tag} {' '.join(n.strip() for n in nodes[1:])}\n" for tag, nodes in cells)
    return out + "$EndElements\n"


def check_all_refusals():
    """Five things that stay out are said in one run, each with its line; what nothing uses is not among them."""
    extra = ("*Plastic\n300., 0.\n*Creep, law=TIME\n1., 1., 1.\n*Material, name=Unused\n*Elastic\n1., 0.\n*Hyperelastic\n1.,\n"
             "*Element, type=S4R, elset=Skin\n901, 1, 2, 7, 6\n*Element, type=S4R, elset=Other\n902, 2, 3, 8, 7\n")
    text = deck(extra=extra, static="*Visco, cetol=1e-3\n0.1, 1.\n*Static, perturbation\n",
                after="*Model change, remove\nUp\n*Boundry\n1, 1\n")
    wanted = [("*Plastic", "plasticity would change"), ("*Creep", "viscous strain stays out"), ("*Element, type=S4R", "1 more of these"),
              ("*Visco", "viscous materials stay out"), ("*Static", "PERTURBATION is not read"),
              ("*Model change", "end it with the step before"), ("*Boundry", "did you mean 'BOUNDARY'")]
    for command in ("import", "check"):
        code, _, error = delam(command, write(text, "deck.inp"))
        lines = error.strip().splitlines()
        expect(code == 2 and len(lines) == len(wanted), f"{command}: {error}")
        for said, (card, words) in zip(lines, wanted):
            expect(said.startswith("delam: ") and f"deck.inp:{line_of(text, card)}: *{card.split(',')[0][1:].upper()}: " in said
                   and words in said, f"{card}: {said}")
    code, said, _ = delam("check", "--json", write(text, "deck.inp"))
    errors = json.loads(said)["errors"]
    expect(code == 2 and [error["line"] for error in errors] == [line_of(text, card) for card, _ in wanted], f"{errors}")
    many = deck(after="".join(f"*Strange{k}\n" for k in range(50)))
    _, _, error = delam("import", write(many, "deck.inp"))
    expect(len(error.strip().splitlines()) == 41 and "10 other things are not imported" in error, error[-300:])
    refused(deck(extra="*Surface, name=Tool, type=SEGMENTS\nSTART, 0., 0.\n*Rigid body, ref node=1, analytical surface=Tool\n"),
            r"\*RIGID BODY: analytical rigid surfaces stay out")
    refused(deck(extra="*Surface, name=Tool, type=CYLINDER\nSTART, 0., 0.\n*Surface interaction, name=I\n"
                       "*Contact pair, interaction=I\nUpper, Tool\n*Surface, name=Upper\nUp, S3\n"),
            r"\*SURFACE: analytical rigid surfaces stay out")


def check_values():
    """Values that stay out are said together: of cards that do not follow from each other, of the mesh, of materials and loads."""
    text = deck(extra="*Equation\n2\n6, 2, 1.\n", held="Bottom, 2\n1, 1\nTop, 9\n", after="*Cload\n109, 2, ten\n*Dload\nUp, GRAV, 9.8\n")
    text = text.replace("\n5, 4.0, 0.0\n", "\n5, four, 0.0\n")
    code, _, error = delam("import", write(text, "deck.inp"))
    lines = error.strip().splitlines()
    wanted = ("*NODE: ", "*EQUATION: ", "*BOUNDARY: ", "*CLOAD: ", "*DLOAD: ")
    expect(code == 2 and len(lines) == len(wanted) and all(card in line for card, line in zip(wanted, lines)), f"of cards: {error}")
    numbers = [int(line.split("deck.inp:")[1].split(":")[0]) for line in lines]
    expect(numbers == sorted(numbers), f"in the order of the lines: {numbers}")
    # Two materials and two places of loads are judged where a card uses them.
    text = deck(elastic="*Elastic, type=LAMINA\n1000., 500., 0.3, 400., 400., 100.\n", loads="Tip, 2, 2, 0.03\nTips, 2, 2, 0.01\n",
                extra="*Material, name=N\n*Elastic, type=ORTHOTROPIC\n1., 2., 1., 0., 0., 1., 1., 1.\n1.\n")
    text = text.replace("*Solid section, elset=Up, material=M", "*Solid section, elset=Up, material=N")
    code, _, error = delam("import", write(text, "deck.inp"))
    said = ("make nu23 = ", "are not positive definite", '"Tip"', '"Tips"')
    expect(code == 2 and len(error.strip().splitlines()) == len(said) and all(words in error for words in said), f"where used: {error}")
    # Forces on what is not there, of several kinds.
    text = deck(after="*Cload\nNone, 1, 1.\n*Dsload\nNo surface, P, 1.\nNo skin, P, 1.\n")
    code, _, error = delam("import", write(text, "deck.inp"))
    said = ('"None"', '"No surface"', '"No skin"')
    expect(code == 2 and len(error.strip().splitlines()) == 3 and all(words in error for words in said), f"forces: {error}")
    # Two faults of one material that a body has, and those of a card on which others hang alone.
    text = deck(elastic="*Elastic\n1000.\n*Expansion\n1., 2., 3., 4.\n")
    refused(text, r"\*ELASTIC: 1 numbers: 2 constants", r"\*EXPANSION: 4 numbers")
    code, _, error = delam("import", write(deck(static="*Static\n-1., 1.\n"), "deck.inp"))
    expect(code == 2 and len(error.strip().splitlines()) == 1 and "*STATIC: " in error, f"a step alone: {error}")


check_elements_of_decks()
check_elements_of_meshes()
check_values()
check_all_refusals()
finish()
