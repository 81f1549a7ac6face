# SPDX-License-Identifier: BSD-3-Clause
"""The features of the table, and the small scene to which each of them adds itself.

Two plies are bonded but for a notch. The lower one stands on rollers; above the notch the upper one is lifted and
pulled along. Where nothing else is said, the scene is a plane with the default options, but for those of `Scene`."""
import dataclasses
from collections.abc import Callable

import numpy as np

import delam

LENGTH, WIDTH, PLY = 0.04, 0.004, 1e-3  # m
# The first step damages nothing, the others damage and break pairs, without a jump.
TIMES = (0.06, 0.25, 0.5, 0.75, 1.0)
ENDS = {"lift": 1.2e-4, "pull": 2e-5, "heat": 1.0, "stretch": 1e-5, "press": 1.0}  # of the patterns, at time 1
LAW = {"normal_stiffness": 1e12, "tangential_stiffness": 1e12, "normal_onset": 30.0, "tangential_onset": 45.0,
       "normal_toughness": 200.0, "tangential_toughness": 260.0,
       "criterion": "power", "onset_exponent": 1.0, "toughness_exponent": 1.0}


class Scene:
    """What the features choose, and the problem that is made of it."""

    def __init__(self, features, toughness=1.0):
        self.features = frozenset(features)
        self.dimension, self.plane, self.law = 2, None, dict(LAW)
        # An engine takes steps whole and keeps rotations small, and so do those with which it is compared.
        self.options = {"damage_tolerance": 1e-11, "step_control": "fixed", "kinematics": "linear"}
        self.engine = self.periodic = self.nose = self.hosted = self.heated = self.pressed = False
        for feature in features:
            if feature.add is not None:
                feature.add(self)
        self.law["normal_toughness"] *= toughness
        self.mesh = self.make_mesh()
        self.patterns = []
        self.problem = self.make_problem()

    def make_mesh(self):
        space = self.dimension == 3
        plies = delam.Mesh.layers([LENGTH, WIDTH] if space else LENGTH, [32, 1] if space else 40, [PLY, PLY], [1, 1],
                                  "hex8" if space else "quad4")
        # Behind the plies' nodes, control nodes: of the periods and of the nose that lifts.
        mesh = delam.Mesh(np.vstack([plies.nodes, np.full((3, self.dimension), -PLY)]))
        self.controls = len(plies.nodes) + np.arange(3)
        cells = "hex8" if space else "quad4"
        mesh.add_cells(cells, plies.cells.of(cells), plies.cells.bodies)
        mesh.add_interface(0, 1)
        return mesh

    def find(self, body, height, **places):
        """Nodes of a body at a height, where x and y are as given or, with a period, not at its end."""
        nodes = self.mesh.nodes
        found = (np.abs(nodes[:, -1] - height) < 1e-9) & (self.mesh.node_bodies == body)
        for axis, end in enumerate((LENGTH, WIDTH)[: self.dimension - 1]):
            if "xy"[axis] in places:
                found &= np.abs(nodes[:, axis] - places["xy"[axis]]) < 1e-9
            elif self.periodic:
                found &= nodes[:, axis] < end - 1e-9
        return np.flatnonzero(found)

    def pattern(self, name):
        self.patterns.append(name)
        return self.problem.add_pattern(name, [0.0, 1.0], [0.0, ENDS[name]])

    def make_problem(self):
        self.problem = problem = delam.Problem(self.mesh, self.plane)
        problem.set_elastic(70e9, 0.3)
        problem.set_formulation("incompatible")
        problem.set_law(0, delam.Law("piecewise-linear", **self.law))
        problem.set_adhesion_box(0, [0.0155, *[0.0] * (self.dimension - 1)], [0.0205, *[WIDTH] * (self.dimension - 1)])
        if self.hosted and not self.engine:
            for body in (0, 1):
                problem.set_stiffness(np.flatnonzero(self.mesh.node_bodies == body), problem.body_matrix(body))
        up = "y" if self.dimension == 2 else "z"
        foot = self.find(0, 0.0)
        problem.prescribe(foot, up)
        problem.prescribe(foot[:1], "x")
        if self.dimension == 3:
            problem.prescribe(self.find(0, 0.0, y=0.0)[:1] if self.periodic else self.find(0, 0.0, y=0.0), "y")
        self.lift(self.find(1, 2 * PLY, x=0.01875 if self.dimension == 3 else 0.018), up)
        if self.periodic:
            self.repeat(up)
        if self.heated:
            problem.add_eigenstrain(self.pattern("heat"), [3e-4, 0, 0, 0, 0, 0], body=1)
        if self.pressed:
            nodes = self.find(1, 2 * PLY, x=0.03)
            problem.add_forces(self.pattern("press"), nodes,
                               np.eye(self.dimension)[-1] * (-2000.0 if self.dimension == 2 else -4.0))
        for key, value in self.options.items():
            problem.options[key] = value
        return problem

    def lift(self, nodes, up):
        """Lifts and pulls nodes, each by itself or all by a rigid nose."""
        if self.periodic:
            nodes = nodes[:1]
        held = nodes
        if self.nose:
            held = self.controls[2:]
            for node in nodes:
                for axis in range(self.dimension):
                    along = np.eye(self.dimension)[axis]
                    self.problem.add_equation([node, held[0]], [along, -along])
        self.problem.prescribe(held, up, self.pattern("lift"))
        self.problem.prescribe(held, "x", self.pattern("pull"))
        if self.dimension == 3:
            self.problem.prescribe(held, "y")

    def repeat(self, up):
        """Repeats the plies along x and, in space, along y; they are stretched along x and free to contract."""
        count = self.dimension - 1
        periods = np.diag((LENGTH, WIDTH, 0.0))[:count, : self.dimension]
        self.problem.add_periodic(periods, self.controls[:count])
        self.problem.prescribe(self.controls[:1], "x", self.pattern("stretch"))
        self.problem.prescribe(self.controls[:count], up)
        if self.dimension == 3:
            self.problem.prescribe(self.controls[:1], "y")
            self.problem.prescribe(self.controls[1:2], "x")

    def shared(self, traction):
        """Tractions of pairs, with a period the mean of each pair and its images: only the sum of their contact forces
        is determined."""
        if not self.periodic:
            return traction
        pairs = self.mesh.interfaces[0]
        share = np.rint(1e6 * pairs.places[:, :-1] / [LENGTH, WIDTH][: self.dimension - 1]) % 1e6  # of the periods
        _, image = np.unique(share, axis=0, return_inverse=True)
        sums = np.zeros((image.max() + 1, self.dimension))
        np.add.at(sums, image, pairs.weights[:, None] * traction)
        return (sums / np.bincount(image, pairs.weights)[:, None])[image]

    def run(self, function):
        """function(): where an engine solves the bodies, as the work of rank 0."""
        if not self.engine:
            return function()
        from mpi4py import MPI

        import delam.petsc
        with delam.petsc.Ranks(MPI.COMM_SELF) as ranks:
            if self.hosted:
                nodes = np.flatnonzero(self.mesh.node_bodies >= 0)
                ranks.set_part(nodes, self.stiffness(), self.mesh.nodes[nodes], self.dimension)
            else:
                ranks.take_scene(self.mesh, self.problem)
            ranks.attach(self.problem)
            return ranks.run(function)

    def stiffness(self):
        """Of both plies, over all their nodes."""
        from scipy import sparse
        matrices = [self.problem.body_matrix(body) for body in (0, 1)]
        blocks = [sparse.csr_matrix((m.values, m.columns, m.row_starts), m.shape) for m in matrices]
        order = np.concatenate([np.flatnonzero(self.mesh.node_bodies == body) for body in (0, 1)])
        rows = (self.dimension * order[:, None] + np.arange(self.dimension)).ravel()
        whole = sparse.block_diag(blocks, "csr")
        back = np.argsort(rows)
        return whole[back][:, back].tocsr()


@dataclasses.dataclass(frozen=True)
class Feature:
    name: str
    group: str  # a scene has one feature of a group; "" has no such limit
    words: tuple[str, ...]  # of which a message that names the feature has one
    add: Callable | None = None  # to the scene

    def named(self, message):
        return any(word.lower() in message.lower() for word in self.words)


def option(key, value, **more):
    return lambda scene: scene.options.update({key: value, **more})


def chosen(**attributes):
    return lambda scene: vars(scene).update(attributes)


SPACE = Feature("space", "dimension", ("3D",), chosen(dimension=3))
ENGINE = Feature("PETSc engine", "", ("engine",), chosen(engine=True))
# With path_step = 1 a step has one part: what damages in it does not come to rest before its end, as the derivatives of
# a step assume.
SENSITIVITY = Feature("sensitivities", "", ("sensitivities",), option("path_step", 1.0))
LOAD_TANGENT = Feature("load tangent", "", ("tangent",))
STEP_TANGENT = Feature("step tangent", "", ("step tangent",), option("path_step", 1.0))
SAVED = Feature("saved state", "", ("loaded",))
CONDENSED = Feature("condensed", "reduction", ("condensed",), option("reduction", "condensed"))
ITERATED = Feature("iterated", "reduction", ("iterated",), option("reduction", "iterated"))
FETI = Feature("FETI", "reduction", ("feti",), option("reduction", "feti", subdomains=6))
HOST = Feature("host stiffness", "", ("stiffness",), chosen(hosted=True))
NOSE = Feature("control node", "", ("control node",), chosen(nose=True))
# Pairs break at once: without a process zone analyses jump.
BRITTLE = Feature("brittle law", "", ("law", "onset"),
                  lambda scene: scene.law.update(normal_onset=180.0, tangential_onset=230.0))

TURNED = Feature("large rotations", "", ("corotational", "rotations"), option("kinematics", "corotational"))

LOCAL = Feature("local", "solution", ("local",), option("solution", "local"))
CONVERGED = Feature("converged", "mixity_rule", ("converged",), option("mixity_rule", "converged"))

FEATURES = (
    CONDENSED,
    ITERATED,
    FETI,
    ENGINE,
    LOCAL,
    Feature("energetic", "solution", ("energetic",), option("solution", "energetic")),
    Feature("frozen", "mixity_rule", ("frozen",), option("mixity_rule", "frozen")),
    CONVERGED,
    Feature("variational", "mixity_rule", ("variational",), option("mixity_rule", "variational")),
    HOST,
    Feature("periodic cell", "", ("periodic", "period"), chosen(periodic=True)),
    Feature("eigenstrain", "", ("eigenstrain",), chosen(heated=True)),
    Feature("gradient term", "", ("gradient",), lambda scene: scene.law.update(gradient=5e-4)),
    NOSE,
    Feature("dead force", "", ("force",), chosen(pressed=True)),
    BRITTLE,
    TURNED,
    Feature("adaptive steps", "", ("step_control",), option("step_control", "adaptive")),
    Feature("located jumps", "", ("jump_tolerance",), option("jump_tolerance", 1e-2)),
    SENSITIVITY,
    LOAD_TANGENT,
    STEP_TANGENT,
    SAVED,
)
DEFAULTS = frozenset({CONDENSED, LOCAL, CONVERGED})
QUERIES = frozenset({SENSITIVITY, LOAD_TANGENT, STEP_TANGENT, SAVED})
# What solves the same equations in another way: the answer agrees with that of the scene without it.
ALIKE = frozenset({*FEATURES[:4], HOST, NOSE})
