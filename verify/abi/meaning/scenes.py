# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that several rows build."""
import forms
from host import Out

TYPES = {"tri3": 1, "quad4": 2, "tet4": 3, "hex8": 4, "tri6": 5, "quad8": 6, "quad9": 7, "tet10": 8, "hex20": 9,
         "hex27": 10, "wedge6": 11, "pyramid5": 12, "wedge15": 13}
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
CORNERS = {"tri": [(0, 0), (1, 0), (0, 1)], "quad": SQUARE, "tet": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
           "hex": [(*c, 0) for c in SQUARE] + [(*c, 1) for c in SQUARE],
           "wedge": [(0, 0, 1), (1, 0, 1), (0, 1, 1), (0, 0, 0), (1, 0, 0), (0, 1, 0)],
           "pyramid": [(*c, 0) for c in SQUARE] + [(0.5, 0.5, 1)]}
MIDDLES = {"tri": [(0, 1), (1, 2), (2, 0)], "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
           "tet": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
           "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
           "hex": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]}

# Centres of cells and faces, by the ends of one diagonal.
CENTRES = {"quad9": [(0, 2)], "hex27": [(0, 7), (1, 6), (0, 5), (3, 6), (0, 2), (4, 6), (0, 6)]}


def shape_of(name):
    return name.rstrip("0123456789")


def middles_of(name):
    return [] if name in ("tri3", "quad4", "tet4", "hex8", "wedge6", "pyramid5") else MIDDLES[shape_of(name)]


def places_of(name):
    """The coordinates of the nodes of a cell type, in the unit square or its like; the order is that of the header."""
    corners = CORNERS[shape_of(name)]
    places = [tuple(map(float, c)) for c in corners]
    for a, b in middles_of(name) + CENTRES.get(name, []):
        places.append(tuple((x + y) / 2 for x, y in zip(corners[a], corners[b])))
    return places


def axis(dimension, k):
    return [float(i == k) for i in range(dimension)]


def ramp(host, problem, name="load", times=(0.0, 1.0), values=(0.0, 1.0)):
    """A pattern; the factor is the time."""
    return host("problem_add_pattern", problem, name, len(times), times, values, Out())


def hold(host, problem, nodes, directions):
    for direction in directions:
        host("problem_prescribe_nodes", problem, len(nodes), nodes, direction, 0, None, None, 0)


def drive(host, problem, nodes, direction, pattern, coefficients):
    host("problem_prescribe_nodes", problem, len(nodes), nodes, direction, 1, [pattern], coefficients, 0)


def fill(host, problem, nodes, field, pattern):
    """Prescribes every displacement: node -> [dimension]."""
    values = [field(node) for node in nodes]
    for k in range(len(values[0])):
        drive(host, problem, nodes, axis(len(values[0]), k), pattern, [value[k] for value in values])


def field(host, solver, key, part=-1):
    """[rows][columns]"""
    rows, columns = host("solver_field_shape", solver, key, part, Out(), Out())
    numbers = host("solver_field", solver, key, part, rows * columns, Out(rows * columns))
    return [numbers[r * columns:(r + 1) * columns] for r in range(rows)]


def value(host, solver, key):
    return host("solver_value", solver, key, Out())


def bilinear(host, stiffness, onset, toughness, kind="piecewise-linear"):
    """stiffness, onset, toughness: (normal, tangential)."""
    law = host("law_create", host.context, kind, Out())
    for name, pair in (("stiffness", stiffness), ("onset", onset), ("toughness", toughness)):
        if name == "onset" and kind == "griffith":
            continue
        for direction, number in zip(("normal", "tangential"), pair):
            host("law_set", law, f"{direction}_{name}", number)
    return law


def strong(host, normal, tangential):
    """A law that stays elastic."""
    return bilinear(host, (normal, tangential), (1e9, 1e9), (2e9, 2e9))


class Bar:
    """Two layers of one quad4 each on top of each other, without lateral contraction, pulled apart at the top: per unit
    of width the bodies are a spring of `bulk`, in series with the law. The top moves by the factor of `pull`, the
    bottom down by `base` times that of a further pattern, unless base is 0. Both pairs of the interface open alike.
    Steps are taken whole, for the sake of closed forms, unless the options name a step control (None: the default)."""

    def __init__(self, host, law, bulk=1.0, width=1.0, options=(), times=(0.0, 1.0), values=(0.0, 1.0), time=0.0,
                 base=0.0):
        self.host, self.bulk, self.width = host, bulk, width
        mesh = host("mesh_create_layers", host.context, 2, [width], [1], 2, [0.5, 0.5], [1, 1], TYPES["quad4"], Out())
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        self.mesh = mesh
        problem = self.problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, bulk, 0.0)
        host("problem_set_law", problem, 0, law)
        pull = ramp(host, problem, "pull", times, values)
        hold(host, problem, list(range(8)), [[1.0, 0.0]])
        drive(host, problem, [6, 7], [0.0, 1.0], pull, [1.0, 1.0])
        if base == 0.0:
            hold(host, problem, [0, 1], [[0.0, 1.0]])
        else:
            drive(host, problem, [0, 1], [0.0, -1.0], ramp(host, problem, "base", times, values), [base, base])
        for left in (2, 4):  # both faces stay level
            host("problem_add_equation", problem, 2, [left, left + 1], [0.0, 1.0, 0.0, -1.0], 0, None, None, 0)
        for key, setting in {"step_control": "fixed", **dict(options)}.items():
            if setting is not None:
                give(host, problem, key, setting)
        self.solver = host("solver_create", problem, time, Out())

    def step(self, time, commit=True):
        """The status of the step."""
        status = self.host.status("solver_advance", self.solver, time)
        if commit and status in (0, 1):
            self.host("solver_commit", self.solver)
        return status

    def value(self, key):
        return value(self.host, self.solver, key)


def give(host, problem, key, setting):
    if isinstance(setting, str):
        host("problem_set_text", problem, key, setting)
    else:
        host("problem_set_number", problem, key, setting)


def unit_cells(columns, rows=1, width=1.0, height=1.0):
    """Nodes and connectivity of rectangles in the plane."""
    nodes = [(width * i, height * j) for j in range(rows + 1) for i in range(columns + 1)]
    cells = [[j * (columns + 1) + i, j * (columns + 1) + i + 1, (j + 1) * (columns + 1) + i + 1,
              (j + 1) * (columns + 1) + i] for j in range(rows) for i in range(columns)]
    return nodes, cells


def plane_stiffness(young, poisson):
    """Plane strain, [3][3] in xx, yy, xy."""
    full = forms.isotropic(young, poisson)
    return [[full[i][j] for j in (0, 1, 3)] for i in (0, 1, 3)]
