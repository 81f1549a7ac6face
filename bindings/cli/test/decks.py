# SPDX-License-Identifier: BSD-3-Clause
"""Input files in the dialects of Abaqus, CalculiX and PrePoMax: a beam of two arms, in the plane or in space. And the same
beam as a scene."""
import json

E1, E2, NU12, NU23, G12 = 126e9, 10e9, 0.3, 0.4, 5e9
STIFFNESS, NORMAL, SHEAR, G_I, G_II, ETA = 1e14, 12e6, 20e6, 280.0, 790.0, 2.3


# The ways along the edges of a brick from its first corner to the opposite one, and whether the tetrahedron of such a way
# has to be turned inside out to have a positive volume.
PATHS = (((0, 1, 2), False), ((1, 2, 0), False), ((2, 0, 1), False), ((0, 2, 1), True), ((1, 0, 2), True),
         ((2, 1, 0), True))


def corners_along(path):
    axes, turned = path
    at = [0, 0, 0]
    corners = [tuple(at)]
    for axis in axes:
        at[axis] = 1
        corners.append(tuple(at))
    return [corners[n] for n in (0, 2, 1, 3)] if turned else corners


class Beam:
    """Two arms of `length`, each `thick`, notched over `notch`; cells nx by ny by nz in an arm. The nodes of the middle
    are doubled, `gap` apart. tets: each brick is cut into six tetrahedra around its diagonal."""

    def __init__(self, length=0.06, width=0.006, thick=0.0015, notch=0.03, nx=60, ny=2, nz=2, gap=0.0, tets=False):
        self.length, self.width, self.thick, self.notch = length, width, thick, notch
        self.nx, self.ny, self.nz, self.gap = nx, ny, nz, gap
        self.plane, self.tets = ny == 0, tets

    def node(self, arm, i, j, k):
        rows = self.ny + 1
        return 1 + i + (self.nx + 1) * (j + rows * (k + (self.nz + 1) * arm))

    def at(self, arm, i, j, k):
        x, z = i * self.length / self.nx, k * self.thick / self.nz + arm * (self.thick + self.gap)
        return (x, z) if self.plane else (x, j * self.width / self.ny, z)

    def nodes(self):
        for arm in (0, 1):
            for k in range(self.nz + 1):
                for j in range(self.ny + 1):
                    for i in range(self.nx + 1):
                        yield self.node(arm, i, j, k), self.at(arm, i, j, k)

    def cells(self, arm):
        for k in range(self.nz):
            for j in range(max(1, self.ny)):
                for i in range(self.nx):
                    if self.plane:
                        yield [self.node(arm, i + a, 0, k + c) for a, c in ((0, 0), (1, 0), (1, 1), (0, 1))]
                    elif self.tets:
                        for path in PATHS:
                            yield [self.node(arm, i + a, j + b, k + c) for a, b, c in corners_along(path)]
                    else:
                        yield [self.node(arm, i + a, j + b, k + c) for c in (0, 1)
                               for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]

    def cohesive(self):
        """Nodes of the cohesive elements, which begin at the end of the notch."""
        for j in range(max(1, self.ny)):
            for i in range(self.nx):
                if i * self.length / self.nx < self.notch - 1e-9:
                    continue
                if self.plane:
                    yield [self.node(0, i, 0, self.nz), self.node(0, i + 1, 0, self.nz),
                           self.node(1, i + 1, 0, 0), self.node(1, i, 0, 0)]
                elif self.tets:  # on both sides of the diagonal along which the tetrahedra cut the face
                    for corners in (((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1))):
                        yield [self.node(arm, i + a, j + b, self.nz if arm == 0 else 0) for arm in (0, 1)
                               for a, b in corners]
                else:
                    yield [self.node(arm, i + a, j + b, self.nz if arm == 0 else 0) for arm in (0, 1)
                           for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]

    def set_at(self, i, arms, levels):
        return [self.node(arm, i, j, k) for arm in arms for k in levels for j in range(self.ny + 1)]


def lines(numbers, each=8):
    numbers = list(numbers)
    return "\n".join(", ".join(str(n) for n in numbers[k:k + each]) for k in range(0, len(numbers), each)) + "\n"


def mesh(beam, name_of_cells="Arms"):
    cell, cohesive = (("CPE4I", "COH2D4") if beam.plane else ("C3D4", "COH3D6") if beam.tets else ("C3D8I", "COH3D8"))
    text = "*Node\n" + "".join(f"{n}, {', '.join(repr(x) for x in at)}\n" for n, at in beam.nodes())
    number = 0
    text += f"*Element, type={cell}, elset={name_of_cells}\n"
    for arm in (0, 1):
        for nodes in beam.cells(arm):
            number += 1
            text += f"{number}, {', '.join(map(str, nodes))}\n"
    text += f"*Element, type={cohesive}, elset=Cohesive\n"
    for nodes in beam.cohesive():
        number += 1
        text += f"{number}, {', '.join(map(str, nodes))}\n"
    text += "*Nset, nset=Clamp\n" + lines(beam.set_at(beam.nx, (0, 1), range(beam.nz + 1)))
    text += "*Nset, nset=Top\n" + lines(beam.set_at(0, (1,), (beam.nz,)))
    text += "*Nset, nset=Bottom\n" + lines(beam.set_at(0, (0,), (0,)))
    return text


PLY = f"""*Material, name=Ply
*Elastic, type=ENGINEERING CONSTANTS
{E1}, {E2}, {E2}, {NU12}, {NU12}, {NU23}, {G12}, {G12},
{E2 / (2 * (1 + NU23))}
"""


def resin(initiation="QUADS", evolution=None, thickness=""):
    evolution = evolution or (f"*Damage Evolution, type=ENERGY, mixed mode behavior=BK, power={ETA}\n"
                              f"{G_I}, {G_II}, {G_II}\n")
    return (f"*Material, name=Resin\n*Elastic, type=TRACTION\n{STIFFNESS}, {STIFFNESS}, {STIFFNESS}\n"
            f"*Damage Initiation, criterion={initiation}\n{NORMAL}, {SHEAR}, {SHEAR}\n{evolution}")


def opened(displacement, steps, plane, boundary="*Boundary\n"):
    """Both arms are moved apart; in the plane the second axis is that across."""
    across = 2 if plane else 3
    return (f"*Step, name=Open, nlgeom=NO, inc=1000\n*Static\n{1 / steps}, 1., 1e-9, {1 / steps}\n"
            f"{boundary}Top, {across}, {across}, {displacement}\nBottom, {across}, {across}, {-displacement}\n"
            "*Output, field, variable=PRESELECT\n*Restart, write, frequency=0\n*End Step\n")


def abaqus(beam, displacement=0.001, steps=20, **of_resin):
    """As Abaqus writes a flat file."""
    return ("*Heading\n DCB with cohesive elements\n** a comment\n" + mesh(beam) +
            "*Solid Section, elset=Arms, material=Ply\n,\n"
            "*Cohesive Section, elset=Cohesive, material=Resin, response=TRACTION SEPARATION\n" +
            PLY + resin(**of_resin) + "*Boundary\nClamp, ENCASTRE\n" + opened(displacement, steps, beam.plane))


def parts(beam, displacement=0.001, steps=20):
    """As Abaqus/CAE writes a model: a part, an instance of it and sets of the assembly."""
    text = mesh(beam)
    sets = text.index("*Nset")
    named = text[sets:].replace("\n*Nset", "\n*Nset").replace("nset=Clamp", "nset=Clamp, instance=Beam-1").replace(
        "nset=Top", "nset=Top, instance=Beam-1").replace("nset=Bottom", "nset=Bottom, instance=Beam-1")
    return ("*Heading\n** Job name: dcb Model name: Model-1\n*Part, name=Beam\n" + text[:sets] +
            "*Solid Section, elset=Arms, material=Ply\n,\n"
            "*Cohesive Section, elset=Cohesive, material=Resin, response=TRACTION SEPARATION\n*End Part\n"
            "*Assembly, name=Assembly\n*Instance, name=Beam-1, part=Beam\n*End Instance\n" + named +
            "*End Assembly\n" + PLY + resin() + "*Boundary\nClamp, ENCASTRE\n" +
            opened(displacement, steps, beam.plane))


def surface_of_tets(beam, arm):
    """The lines of *SURFACE: element and side, along the cohesive elements."""
    sides = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
    first = 1 + arm * 6 * beam.nx * beam.ny * beam.nz
    held = {frozenset(nodes[3 * arm:3 * arm + 3]) for nodes in beam.cohesive()}
    for number, nodes in enumerate(beam.cells(arm), first):
        for side, corners in enumerate(sides, 1):
            if frozenset(nodes[c] for c in corners) in held:
                yield f"{number}, S{side}\n"


def surfaces(beam, displacement=0.001, steps=20, initial=False):
    """Two bodies and a pair of surfaces that adhere, in the style of PrePoMax (OP=New in each step)."""
    text = mesh(beam)
    head, rest = text.split("*Element, type=COH", 1)
    sets = rest[rest.index("*Nset"):]
    side_below, side_above = ("S3", "S1") if beam.plane else ("S2", "S1")
    each = beam.nx * max(1, beam.ny) * (6 if beam.tets else 1)
    last = each * beam.nz
    below = range(last - each + 1, last + 1)   # the upper row of the lower arm
    above = range(last + 1, last + each + 1)
    bonded = [beam.node(1, i, j, 0) for i in range(beam.nx + 1) for j in range(beam.ny + 1)
              if i * beam.length / beam.nx > beam.notch - 1e-9]
    if not initial:
        held = [n for n in range(each) if (n % beam.nx) * beam.length / beam.nx > beam.notch - 1e-9]
        below, above = ([side[n] for n in held if n < len(side)] for side in (below, above))
    if beam.tets:
        sides = [f"*Surface, name={name}, type=ELEMENT\n" + "".join(surface_of_tets(beam, arm))
                 for arm, name in enumerate(("Below", "Above"))]
    else:
        sides = ["*Elset, elset=E-below\n" + lines(below) + "*Elset, elset=E-above\n" + lines(above),
                 f"*Surface, name=Below, type=ELEMENT\nE-below, {side_below}\n"
                 f"*Surface, name=Above, type=ELEMENT\nE-above, {side_above}\n"]
    text = (head + sets + sides[0] +
            f"*Elset, elset=Lower, generate\n1, {last}, 1\n*Elset, elset=Upper, generate\n{last + 1}, {2 * last}, 1\n" +
            sides[1] + PLY +
            "*Solid section, Elset=Lower, Material=Ply\n*Solid section, Elset=Upper, Material=Ply\n"
            "*Surface interaction, Name=Glue\n*Cohesive behavior" +
            (", eligibility=SPECIFIED CONTACTS" if initial else "") + f"\n{STIFFNESS}, {STIFFNESS}, {STIFFNESS}\n" +
            resin()[resin().index("*Damage Initiation"):] + "*Surface behavior, Pressure-overclosure=Hard\n"
            "*Contact pair, Interaction=Glue, Type=Surface to surface\nAbove, Below\n")
    if initial:
        text += ("*Nset, nset=Bonded\n" + lines(bonded) + "*Initial conditions, type=CONTACT\nAbove, Below, Bonded\n")
    return text + opened(displacement, steps, beam.plane, "*Boundary, op=New\nClamp, 1, 3, 0\n")


HAND = f"""
schema = 1
[geometry]
dimension = DIMENSION
length = 0.06
SIZE
[[materials]]
name = "Ply"
E1 = {E1}
E2 = {E2}
nu12 = {NU12}
nu23 = {NU23}
G12 = {G12}
formulation = "incompatible"
[[layers]]
name = "lower"
thickness = 0.0015
divisions = 2
material = "Ply"
[[layers]]
name = "upper"
thickness = 0.0015
divisions = 2
material = "Ply"
[[laws]]
name = "Resin"
normal_stiffness = {STIFFNESS}
tangential_stiffness = {STIFFNESS}
normal_onset = {NORMAL ** 2 / 2 / STIFFNESS}
tangential_onset = {SHEAR ** 2 / 2 / STIFFNESS}
normal_toughness = {G_I}
tangential_toughness = {G_II}
criterion = "benzeggagh-kenane"
toughness_exponent = {ETA}
onset_criterion = "power"
onset_exponent = 1.0
[[interfaces]]
lower = "lower"
upper = "upper"
law = "Resin"
notch = [{{ from = 0.0, to = 0.03 }}]
[[patterns]]
name = "open"
times = [0, 1]
values = [0, 0.001]
[time]
end = 1.0
steps = 20
"""


def hand(plane):
    """The beam of abaqus(), written as a scene."""
    size = "divisions = 40" if plane else "width = 0.006\ndivisions = [40, 2]"
    text = HAND.replace("DIMENSION", "2" if plane else "3").replace("SIZE", size)
    width = [] if plane else [0.006]
    origin = [0.0] * len(width)
    axes = ["x", "y"] if plane else ["x", "y", "z"]
    text += (f"[[supports]]\nbox = {{ lower = {[0.06, *origin, 0.0]}, upper = {[0.06, *width, 0.003]} }}\n"
             f"fix = {json.dumps(axes)}\n")
    for height, sign in ((0.003, 1.0), (0.0, -1.0)):
        text += (f"[[loads]]\nbox = {{ lower = {[0.0, *origin, height]}, upper = {[0.0, *width, height]} }}\n"
                 f"direction = {[0.0, *origin, sign]}\npattern = \"open\"\n")
    return text
