# SPDX-License-Identifier: BSD-3-Clause
"""A finite element program without delamination gets one: bodies by GetFEM, their interface by libdelam.

    python3 host_getfem.py [--out FOLDER] [enf] [dcb-3d] [graded]

GetFEM (Debian's python3-getfem) meshes and assembles two elastic arms. Their stiffness goes to libdelam as compressed
rows, libdelam marches through the delamination, and the displacements come back into GetFEM's own vectors, from which
it computes energy, reactions and stresses and writes FOLDER/NAME.vtu (default out/host-getfem). Scenes:

enf     end-notched flexure in plane strain, bilinear quadrilaterals. libdelam knows the arms by nodes and pairs alone.
dcb-3d  a double cantilever beam of trilinear bricks. libdelam gets the cells as well: it pairs the faces by itself and
        can say stresses. Its nodes are numbered as the mesh's points, GetFEM's rows are not: `dofs` is between them.
graded  arms with a modulus that grows from the interface outwards, of cubic triangles: libdelam has neither. Moments
        bend them apart, so that fracture mechanics has an exact answer.

The first two are computed by libdelam's own elements too, and the differences are printed. SI units.
"""
import argparse
import math
import pathlib
import time

import getfem
import numpy as np

import delam

getfem.util("trace level", 0)
SIDES, END = (1, 2), 3  # numbers of regions of GetFEM's meshes: the two sides of the interface, the loaded end


class Arms:
    """What is GetFEM's: two arms, one above the other, as a model with the displacement "u".

    A mesh of GetFEM's has each point once, fields on it need not: partitioned by arm they have every node of the
    interface twice, once for each arm. Rows run node by node, component by component; the order of the nodes is
    GetFEM's own."""

    def __init__(self, mesh, height, element, integration, young, poisson):
        """height: of the interface; element, integration: GetFEM's names; young: an expression of place X."""
        self.mesh, self.height, self.poisson, self.dimension = mesh, height, poisson, mesh.dim()
        points, starts = mesh.pid_from_cvid()
        self.points = points.reshape(len(starts) - 1, -1)  # of each cell
        middles = mesh.pts()[-1][self.points].mean(axis=1)
        self.arm = np.where(middles < height, 0, 1)  # of each cell
        self.space, self.scalars = (self._field(element, components) for components in (self.dimension, 1))
        self.integration = getfem.MeshIm(mesh, getfem.Integ(integration))
        self.nodes = self.scalars.basic_dof_nodes().T
        rows, starts = self.scalars.basic_dof_from_cvid()
        self.cell_nodes = rows.reshape(len(starts) - 1, -1)
        self.bodies = np.empty(len(self.nodes), int)  # arm of each node
        self.bodies[self.cell_nodes] = self.arm[:, None]

        # Hooke's law; plane strain is the same with what is in the plane.
        lame = poisson / (1.0 - 2.0 * poisson)
        strains = f"{lame!r}*Trace(Grad_u)*Id({self.dimension}) + Sym(Grad_u)"
        self.stress = f"(({young})*{1.0 / (1.0 + poisson)!r}*({strains}))"
        self.model = getfem.Model("real")
        self.model.add_fem_variable("u", self.space)
        self.model.add_linear_term(self.integration, f"{self.stress}:Grad_Test_u")

    def _field(self, element, components):
        field = getfem.MeshFem(self.mesh, components)
        field.set_fem(getfem.Fem(element))
        field.set_dof_partition(self.arm)
        return field

    def assemble(self):
        """The stiffness. GetFEM compresses columns; of a symmetric matrix these are the rows."""
        self.model.assembly("build_matrix")
        self.stiffness = self.model.tangent_matrix()
        starts, rows = self.stiffness.csc_ind()
        return delam.Sparse(self.stiffness.size(), starts, rows, self.stiffness.csc_val())

    def integral(self, expression, region=-1):
        return getfem.asm("generic", self.integration, 0, expression, region, self.model)

    def shares(self, weight, region):
        """Integral of weight times shape function of each node over a region of the boundary."""
        return getfem.asm("generic", self.integration, 1, f"({weight})*Test_w", region, "w", 1, self.scalars,
                          np.zeros(self.scalars.nbdof()))

    def region_at(self, number, axis, place, arm=None):
        """A region of the faces at a coordinate; those of an arm are found also where it touches the other."""
        faces = self.mesh.outer_faces() if arm is None else self.mesh.outer_faces(self.mesh.cvid()[self.arm == arm])
        there = np.flatnonzero(np.abs(self.mesh.pts()[axis] - place) < 1e-9)
        at = {tuple(face) for face in self.mesh.faces_from_pid(there).T}
        self.mesh.set_region(number, np.array([face for face in faces.T if tuple(face) in at]).T)

    def put(self, displacement):
        """The state of the model, [nodes][dimension]."""
        self.model.set_variable("u", displacement.ravel())

    def energy(self):
        return self.integral(f"0.5*{self.stress}:Grad_u")

    def forces(self):
        """[nodes][dimension]: what acts on the arms from outside, supports, loads and the interface alike."""
        return self.stiffness.mult(self.model.variable("u")).reshape(-1, self.dimension)

    def cell_stresses(self):
        """At the middles of the cells, [cells][dimension][dimension]."""
        constant = getfem.MeshFem(self.mesh)
        constant.set_classical_discontinuous_fem(0)
        components = self.model.interpolation(self.stress, constant).reshape(-1, self.dimension, self.dimension)
        return components[constant.basic_dof_from_cvid()[0]]

    def write(self, path, refine=1):
        """Displacement and the equivalent stress after von Mises, for ParaView: cell by cell, in pieces of 1/refine,
        since a field written as such has the two sides of the crack as one."""
        field = getfem.MeshFem(self.mesh)
        field.set_classical_discontinuous_fem(1)
        mises = f"sqrt(1.5)*Norm(Deviator({self.stress}))"
        if self.dimension == 2:
            # In plane strain the stress along z is poisson times the trace of those in the plane.
            along_z = f"({self.poisson!r}*Trace({self.stress}))"
            mises = f"sqrt(1.5*(Norm_sqr({self.stress}) + sqr{along_z}) - 0.5*sqr(Trace({self.stress}) + {along_z}))"
        path.parent.mkdir(parents=True, exist_ok=True)
        pieces = getfem.Slice(("none",), self.mesh, refine)
        pieces.export_to_vtu(str(path), self.space, self.model.variable("u"), "displacement", field,
                             self.model.interpolation(mises, field), "von Mises stress")


def join_by_pairs(arms):
    """A mesh of libdelam's that knows the arms by their nodes, in GetFEM's order, and the interface by pairs, along x.
    The weight of a pair is the integral of its shape function: the share of a uniform traction that it bears."""
    mesh = delam.Mesh(arms.nodes)
    sides = []
    for arm in (0, 1):
        mesh.add_host_body(arm, arms.bodies == arm)
        arms.region_at(SIDES[arm], -1, arms.height, arm)
        nodes = arms.scalars.basic_dof_on_region(SIDES[arm])
        sides.append(nodes[np.argsort(arms.nodes[nodes, 0])])
    below, above = sides
    weights = arms.shares("1", SIDES[0])
    # Neighbours make the faces, on which crack tips are looked for.
    faces = np.column_stack((np.arange(below.size - 1), np.arange(1, below.size)))
    return mesh, mesh.add_pairs(0, 1, below, above, "y", weights[below], faces)


class Hosted:
    """A march over bodies of the host's.

    nodes: libdelam's node of each of GetFEM's; glue: the interface."""

    def __init__(self, arms, problem, glue, nodes):
        self.arms, self.problem, self.glue, self.nodes = arms, problem, glue, nodes

    def march(self, times):
        self.solver, self.steps = march(self.problem, times)

    def put(self, fields):
        """The displacements of a step into GetFEM's model."""
        self.arms.put(fields["displacement"][self.nodes])

    def unbalanced(self, fields):
        """Nodal forces by GetFEM's stiffness less those of libdelam's interface and supports: zero in equilibrium."""
        self.put(fields)
        rest = np.zeros((self.problem.mesh.node_count, self.arms.dimension))
        rest[self.nodes] = self.arms.forces()
        largest = np.abs(rest).max()
        # Where the interface opens its traction is positive: it pulls b back and a after it.
        pull = np.einsum("p,pi,pij->pj", self.glue.weights, fields["traction"], self.glue.frames)
        np.add.at(rest, self.glue.nodes_b, pull)
        np.add.at(rest, self.glue.nodes_a, -pull)
        supports, _ = self.problem.constraints()
        each = np.repeat(fields["reaction"], np.diff(supports.row_starts))
        np.add.at(rest.reshape(-1), supports.columns, -supports.values * each)
        return np.abs(rest).max() / largest


def march(problem, times):
    """The solver, and values and fields of every step."""
    solver = delam.Solver(problem)
    fields = ("displacement", "adhesion", "jump", "traction", "reaction")
    return solver, [(values, {name: solver.field(name) for name in fields}) for values in solver.march(times)]


class Differences(dict):
    """Largest difference of each quantity over the steps, as a fraction of its largest value."""

    def __init__(self):
        super().__init__()
        self._found = {}

    def add(self, name, one, other):
        difference, size = self._found.get(name, (0.0, 0.0))
        difference = max(difference, float(np.abs(np.subtract(one, other)).max()))
        size = max(size, float(np.abs(other).max()))
        self._found[name] = difference, size
        self[name] = difference / size if size > 0.0 else difference

    def note(self, name, fraction):
        self[name] = max(self.get(name, 0.0), fraction)


def compare(hosted, own, nodes, reaction):
    """The marches over GetFEM's bodies and over the library's own; nodes: of the latter, for each of GetFEM's."""
    found = Differences()
    for (values, fields), (own_values, own_fields) in zip(hosted.steps, own, strict=True):
        for name in (reaction, "stored_bulk", "stored_interface", "dissipated", "work", "lower", "upper",
                     "debonded_length", "crack_length", "energy_release_rate"):
            found.add(name, values[name], own_values[name])
        found.add("displacement", fields["displacement"][hosted.nodes], own_fields["displacement"][nodes])
        for name in ("adhesion", "jump", "traction"):
            found.add(name, fields[name], own_fields[name])
    return found


def check_by_host(found, hosted, reaction, loaded, direction):
    """What GetFEM makes of libdelam's displacements: the energy by quadrature, the reaction by its matrix, equilibrium.
    loaded: GetFEM's nodes that the load moves along the direction."""
    for values, fields in hosted.steps:
        hosted.put(fields)
        found.add("energy by the host", hosted.arms.energy(), values["stored_bulk"])
        force = np.sum(hosted.arms.forces()[loaded] * direction)
        found.add("reaction by the host", force, values[reaction])
        found.note("unbalanced forces", hosted.unbalanced(fields))


def same_places(one, one_bodies, other, other_bodies):
    """Node of the other at the place of each of the one, in the same body."""
    def order(places, bodies):
        return np.lexsort((*np.round(places.T, 9), bodies))

    out = np.empty(len(one), int)
    out[order(one, one_bodies)] = order(other, other_bodies)
    return out


class Clock(dict):
    """Seconds by what they were spent for."""

    def __call__(self, name, function, *arguments):
        start = time.perf_counter()
        value = function(*arguments)
        self[name] = self.get(name, 0.0) + time.perf_counter() - start
        return value


# ---- end-notched flexure -------------------------------------------------------------------------------------------

def enf(folder, clock):
    """The specimen of examples/enf: two arms of 120 mm x 3 mm, a notch of 30 mm, mid-span pressed down by 6 mm."""
    length, height, cell, notch = 0.12, 3e-3, 1e-3, 30e-3
    across, upwards = round(length / cell), round(height / cell)
    young, poisson = 75e9, 0.3
    times = np.linspace(0.0, 1.0, 21)[1:]

    def scene(mesh, glue):
        """What both have in common, all of it libdelam's."""
        problem = delam.Problem(mesh, plane="plane-strain")
        problem.set_law(glue, delam.Law(
            "piecewise-linear", normal_stiffness=125e9, tangential_stiffness=125e9, normal_onset=100.0,
            tangential_onset=100.0, normal_toughness=250.0, tangential_toughness=250.0))
        problem.set_adhesion(glue, glue.places[:, 0] < notch - 1e-3 * cell, 0.0)
        press = problem.add_pattern("press", [0.0, 1.0], [0.0, 6e-3])
        problem.prescribe(mesh.find_node((0.0, 0.0)), "y")
        problem.prescribe(mesh.find_node((length, 0.0)), "x")
        problem.prescribe(mesh.find_node((length, 0.0)), "y")
        problem.prescribe(mesh.find_node((0.5 * length, 2.0 * height)), "-y", press)
        problem.options["damage_tolerance"] = 1e-10  # the two are compared to rounding
        return problem

    # The host's bodies.
    def bodies():
        mesh = getfem.Mesh("cartesian", np.linspace(0.0, length, across + 1),
                           np.linspace(0.0, 2.0 * height, 2 * upwards + 1))
        return Arms(mesh, height, "FEM_QK(2,1)", "IM_GAUSS_PARALLELEPIPED(2,3)", repr(young), poisson)

    arms = clock("host, mesh", bodies)
    stiffness = clock("host, stiffness", arms.assemble)
    mesh, glue = clock("handing over", join_by_pairs, arms)
    problem = scene(mesh, glue)
    clock("handing over", problem.set_stiffness, np.arange(len(arms.nodes)), stiffness)
    hosted = Hosted(arms, problem, glue, np.arange(len(arms.nodes)))
    clock("library, the host's bodies", hosted.march, times)

    # The library's own.
    own_mesh = delam.Mesh.layers(length, across, [height, height], [upwards, upwards], "quad4")
    own_problem = scene(own_mesh, own_mesh.add_interface(0, 1))
    own_problem.set_elastic(young, poisson)
    own_problem.set_formulation("standard")  # the cells of GetFEM are
    _, own = clock("library, its own bodies", march, own_problem, times)

    nodes = same_places(arms.nodes, arms.bodies, own_mesh.nodes, own_mesh.node_bodies)
    found = compare(hosted, own, nodes, "reaction:press")
    top = np.flatnonzero(np.abs(arms.nodes - (0.5 * length, 2.0 * height)).max(axis=1) < 1e-9)
    clock("host, post-processing", check_by_host, found, hosted, "reaction:press", top, np.array([0.0, -1.0]))
    clock("host, post-processing", arms.write, folder / "enf.vtu")
    return hosted, found


# ---- double cantilever beam in space -------------------------------------------------------------------------------

def dcb_3d(folder, clock):
    """Half of the width, y = 0 being the plane of symmetry; the ends of the arms are pulled apart by 1.4 mm each."""
    length, width, height, notch = 45e-3, 12.5e-3, 1.5e-3, 20e-3
    along, wide, upwards = 45, 6, 2
    young, poisson = 60e9, 0.3
    times = np.linspace(0.0, 1.0, 13)[1:]

    def host_mesh():
        mesh = getfem.Mesh("cartesian", np.linspace(0.0, length, along + 1), np.linspace(0.0, width, wide + 1),
                           np.linspace(0.0, 2.0 * height, 2 * upwards + 1))
        return Arms(mesh, height, "FEM_QK(3,1)", "IM_GAUSS_PARALLELEPIPED(3,3)", repr(young), poisson)

    arms = clock("host, mesh", host_mesh)
    stiffness = clock("host, stiffness", arms.assemble)

    # Points and cells go over as GetFEM has them; nodes of a brick run x first there, libdelam goes round the faces.
    # libdelam doubles the points of the interface by itself and appends the copies.
    around = [0, 1, 3, 2, 4, 5, 7, 6]

    def cells():
        mesh = delam.Mesh(arms.mesh.pts().T)
        mesh.add_conforming_cells("hex8", arms.points[:, around], arms.arm)
        return mesh, mesh.add_interface(0, 1)

    mesh, glue = clock("handing over", cells)
    nodes = np.empty(len(arms.nodes), int)
    nodes[arms.cell_nodes[:, around]] = mesh.cells.of("hex8")

    def scene():
        problem = delam.Problem(mesh)
        # Of the host's bodies the material serves the stresses that libdelam is asked for.
        problem.set_elastic(young, poisson)
        problem.set_formulation("standard")  # the cells of GetFEM are
        problem.set_law(glue, delam.Law(
            "piecewise-linear", normal_stiffness=3e12, tangential_stiffness=3e12, normal_onset=20.0,
            tangential_onset=20.0, normal_toughness=250.0, tangential_toughness=250.0))
        problem.set_adhesion(glue, glue.places[:, 0] < notch - 1e-9, 0.0)
        opening = problem.add_pattern("open", [0.0, 1.0], [0.0, 1.4e-3])
        for axis in "xyz":
            problem.prescribe(mesh.find_nodes((length, 0.0, 0.0), (length, width, 2.0 * height)), axis)
        # What the clamp holds already is left out: a support that is there twice is refused.
        problem.prescribe(mesh.find_nodes((0.0, 0.0, 0.0), (length - 1e-6, 0.0, 2.0 * height)), "y")
        problem.prescribe(mesh.find_nodes((0.0, 0.0, 0.0), (0.0, width, 0.0)), "-z", opening)
        problem.prescribe(mesh.find_nodes((0.0, 0.0, 2.0 * height), (0.0, width, 2.0 * height)), "z", opening)
        return problem

    problem = scene()
    # Row of each displacement of libdelam's nodes, in their order.
    rows = np.empty((len(nodes), 3), int)
    rows[nodes] = np.arange(3 * len(nodes)).reshape(-1, 3)
    clock("handing over", problem.set_stiffness, np.arange(len(nodes)), stiffness, rows)
    hosted = Hosted(arms, problem, glue, nodes)
    clock("library, the host's bodies", hosted.march, times)

    own_solver, own = clock("library, its own bodies", march, scene(), times)
    found = compare(hosted, own, nodes, "reaction:open")
    pulled = np.flatnonzero((arms.nodes[:, 0] < 1e-9) & (np.abs(arms.nodes[:, 2] - height) > height - 1e-9))
    outwards = np.where(arms.nodes[pulled, 2] > height, 1.0, -1.0)[:, None] * (0.0, 0.0, 1.0)
    clock("host, post-processing", check_by_host, found, hosted, "reaction:open", pulled, outwards)
    # Both programs have the cells in one order: their stresses side by side, at the middles.
    stresses = arms.cell_stresses()
    components = stresses[:, [0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
    found.add("stresses by the host", components, own_solver.field("stress"))
    clock("host, post-processing", arms.write, folder / "dcb-3d.vtu")
    return hosted, found


# ---- what libdelam has no elements for ------------------------------------------------------------------------------

class Graded:
    """Arms whose modulus grows linearly from the interface outwards, bent apart by moments on their ends.

    The ends bear the tractions that go with pure bending of such an arm, E'(d) (d - d0) times a curvature, d being the
    distance from the interface, E' = E/(1 - nu^2), d0 the modulus-weighted middle. Such bending is exact wherever the
    arms are apart. Closed around the crack at the ends, Rice's integral is then the energy of an arm's bending, twice:
    the crack grows at one curvature, sqrt(toughness/EI), whatever its length and the shape of the softening."""

    length, height, notch = 80e-3, 1.5e-3, 20e-3
    inner, outer, poisson = 70e9, 210e9, 0.3  # modulus at the interface and at the outside
    toughness = 300.0

    def __init__(self):
        # Integrals of E', E' d and E' d^2 over the height, of E = inner + (outer - inner) d/height.
        h, rise = self.height, self.outer - self.inner
        area, first, second = (h**(n + 1) * (self.inner / (n + 1) + rise / (n + 2)) / (1.0 - self.poisson**2)
                               for n in range(3))
        self.middle = first / area
        self.bending = second - first**2 / area
        self.curvature = math.sqrt(self.toughness / self.bending)

    def march(self, cell, clock, element="FEM_PK(2,3)", steps=20):
        """With triangles of that length, two over the height of an arm."""
        distance = f"abs(X(2) - {self.height!r})"
        young = f"({self.inner!r} + {(self.outer - self.inner) / self.height!r}*{distance})"

        def host_mesh():
            mesh = getfem.Mesh("regular simplices", np.linspace(0.0, self.length, round(self.length / cell) + 1),
                               np.linspace(0.0, 2.0 * self.height, 5))
            return Arms(mesh, self.height, element, "IM_TRIANGLE(6)", young, self.poisson)

        arms = clock("host, mesh", host_mesh)
        stiffness = clock("host, stiffness", arms.assemble)
        mesh, glue = clock("handing over", join_by_pairs, arms)
        # Pairs lie at the nodes of the cubic edges, thirds of a cell apart, with weights of 1, 3, 3, 1 eighths.
        problem = delam.Problem(mesh, plane="plane-strain")
        problem.set_law(glue, delam.Law(
            "piecewise-linear", normal_stiffness=1e13, tangential_stiffness=1e13, normal_onset=45.0,
            tangential_onset=45.0, normal_toughness=self.toughness, tangential_toughness=self.toughness))
        problem.set_adhesion(glue, glue.places[:, 0] < self.notch - 1e-9, 0.0)
        clock("handing over", problem.set_stiffness, np.arange(len(arms.nodes)), stiffness)
        for place, axis in (((self.length, 0.0), "x"), ((self.length, 0.0), "y"),
                            ((self.length, 2.0 * self.height), "x")):
            problem.prescribe(mesh.find_node(place), axis)
        # The loading device drives the average of the displacements that its tractions work on; GetFEM integrates it
        # with the shape functions, and its reaction is the curvature at once.
        arms.region_at(END, 0, 0.0)
        traction = f"{young}*({distance} - {self.middle!r})*{1.0 / (1.0 - self.poisson**2)!r}"
        shares = arms.shares(traction, END)
        ends = arms.scalars.basic_dof_on_region(END)
        # While the crack grows by a, the arms turn by curvature * a each.
        reach = 2.0 * self.bending * self.curvature * 2.0 * self.notch
        turn = problem.add_pattern("turn", [0.0, 1.0], [0.0, reach])
        problem.add_equation(ends, np.column_stack((shares[ends], np.zeros(len(ends)))), turn)

        hosted = Hosted(arms, problem, glue, np.arange(len(arms.nodes)))
        clock("library, the host's bodies", hosted.march, np.linspace(0.0, 1.0, steps + 1)[1:])
        return hosted


def graded(folder, clock, cells=(1e-3, 0.5e-3)):
    """By refinement: cell, march, curvatures over the exact one, crack growth of the steps over the exact one."""
    beam = Graded()
    rows = []
    for cell in cells:
        hosted = beam.march(cell, clock)
        curvatures = np.array([values["reaction:turn"] for values, _ in hosted.steps]) / beam.curvature
        energies = np.array([values["dissipated"] for values, _ in hosted.steps])
        # The ends turn by as much in each step as a growth of 2 notches / steps makes them.
        growth = np.diff(energies) / beam.toughness / (2.0 * beam.notch / len(energies))
        rows.append((cell, hosted, curvatures, growth))
    hosted.put(hosted.steps[-1][1])
    clock("host, post-processing", hosted.arms.write, folder / "graded.vtu", 3)
    return rows


def sizes(hosted):
    displacements, jumps = hosted.problem.dofs
    return (f"{displacements} displacements, {jumps} of jumps, {hosted.arms.stiffness.nnz()} entries, "
            f"{len(hosted.steps)} steps")


def main():
    scenes = {"enf": enf, "dcb-3d": dcb_3d, "graded": graded}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"of {', '.join(scenes)} (all)")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/host-getfem"), metavar="FOLDER")
    arguments = parser.parse_args()
    for name in arguments.scenes or scenes:
        if name not in scenes:
            parser.error(f"scene {name!r} is not known; known are {', '.join(scenes)}")
        clock = Clock()
        if name == "graded":
            print("graded: curvature while the crack grows over sqrt(toughness/EI), growth over the exact one")
            for cell, hosted, curvatures, growth in graded(arguments.out, clock):
                print(f"  cells of {1e3 * cell:g} mm, {sizes(hosted)}: {curvatures[-1]:.4f}, {growth[-1]:.4f}; "
                      f"unbalanced forces {hosted.unbalanced(hosted.steps[-1][1]):.1e}")
        else:
            hosted, found = scenes[name](arguments.out, clock)
            values = hosted.steps[-1][0]
            print(f"{name}: {sizes(hosted)}; dissipated {values['dissipated']:.6g}, "
                  f"debonded {values['debonded_length']:.6g}")
            print("  largest differences: " + ", ".join(f"{what} {size:.1e}" for what, size in found.items()))
        print("  seconds: " + ", ".join(f"{what} {seconds:.3f}" for what, seconds in clock.items()))


if __name__ == "__main__":
    main()
