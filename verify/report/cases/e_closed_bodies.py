# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (e): closed forms, by the Python package: a circular inclusion, bodies and elements of a host."""
import cmath
import importlib.util
import math
import sys

import numpy as np

import orders
from case import (LEDGER_VALUES, Case, Failed, Skip, axis, check, column, figure, largest, ledger_of, order, plot,
                  reference, result, series)
from e_closed import FLOOR, law_of, box

RADIUS, OUTER = 5e-6, 15e-6
FIBRE, MATRIX = (74e9, 0.2), (3.5e9, 0.35)
KN, KT = 2e15, 5e14


class Inclusion:
    """Muskhelishvili's potentials of a fibre in an infinite matrix, real by symmetry: matrix phi = G z + A/z, psi = H z + B/z + C/z^3; fibre phi = a z + c z^3,
    psi = b z; conditions at the fibre's surface at 0, 90 and 45 degrees determine A B C a b c."""

    def __init__(self, remote, normal, tangential, free=False):
        known = np.zeros(8)
        known[6:] = 0.25 * (remote[0] + remote[1]), 0.5 * (remote[1] - remote[0])
        right = -self._conditions(known, normal, tangential, free)
        system = np.column_stack([self._conditions(np.eye(8)[j], normal, tangential, free) for j in range(6)])
        scale = np.abs(system).max(axis=1)
        self.c = known
        self.c[:6] = np.linalg.solve(system / scale[:, None], right / scale)

    @staticmethod
    def _potentials(inside, z, c):
        A, B, C, a, b, k, G, H = c
        if inside:
            return a * z + k * z ** 3, a + 3 * k * z ** 2, 6 * k * z, b * z, b
        return G * z + A / z, G - A / z ** 2, 2 * A / z ** 3, H * z + B / z + C / z ** 3, H - B / z ** 2 - 3 * C / z ** 4

    def _u(self, inside, z, c):
        young, nu = FIBRE if inside else MATRIX
        phi, phi1, _, psi, _ = self._potentials(inside, z, c)
        return ((3 - 4 * nu) * phi - z * np.conj(phi1) - np.conj(psi)) * RADIUS / (young / (1 + nu))

    def _s(self, inside, z, c):
        _, phi1, phi2, _, psi1 = self._potentials(inside, z, c)
        total, rest = 4 * np.real(phi1), 2 * (np.conj(z) * phi2 + psi1)
        return 0.5 * (total - rest.real), 0.5 * (total + rest.real), 0.5 * rest.imag

    def _conditions(self, c, normal, tangential, free):
        out = []
        for angle, part in ((0.0, 0), (0.5 * math.pi, 0), (0.25 * math.pi, 1)):
            z = cmath.exp(1j * angle)

            def polar(value):
                turned = value * np.conj(z)
                return (turned.real, turned.imag)[part]

            def traction(inside):
                s = self._s(inside, z, c)
                n, m = math.cos(angle), math.sin(angle)
                return polar(complex(s[0] * n + s[2] * m, s[2] * n + s[1] * m))

            outer, inner = traction(False), traction(True)
            jump = polar(self._u(False, z, c)) - polar(self._u(True, z, c))
            out += [outer, inner] if free else [outer - inner, (jump - (normal, tangential)[part] * inner) * MATRIX[0] / RADIUS]
        return np.array(out)

    def displacement(self, inside, x, y):
        u = self._u(inside, (x + 1j * y) / RADIUS, self.c)
        return np.column_stack((np.real(u), np.imag(u)))

    def stress(self, inside, x, y):
        return np.column_stack(np.broadcast_arrays(*self._s(inside, (x + 1j * y) / RADIUS, self.c)))


def fibre_mesh(n):
    """A disc (a square inside four patches that become round) and a ring around it, n 4-node cells on a quarter of the circle."""
    nodes, index, cells, bodies = [], {}, [], []

    def node(body, place):
        key = (body, round(place[0] / RADIUS * 1e7), round(place[1] / RADIUS * 1e7))
        if key not in index:
            index[key] = len(nodes)
            nodes.append(place)
        return index[key]

    def patch(across, along, body, of):
        for i in range(across):
            for j in range(along):
                cells.append([node(body, of((i + s) / across, (j + t) / along)) for s, t in ((0, 0), (1, 0), (1, 1), (0, 1))])
                bodies.append(body)

    core = 0.5 * RADIUS
    patch(n, n, 0, lambda s, t: (core * (2 * s - 1), core * (2 * t - 1)))
    for quarter in range(4):
        c, d = round(math.cos(0.5 * math.pi * quarter)), round(math.sin(0.5 * math.pi * quarter))

        def ray(r, t, rounded, c=c, d=d):
            angle = 0.25 * math.pi * (2 * t - 1)
            x, y = (1 - rounded) * core + rounded * r * math.cos(angle), (1 - rounded) * core * (2 * t - 1) + rounded * r * math.sin(angle)
            return c * x - d * y, d * x + c * y

        patch(max(1, n // 2), n, 0, lambda s, t, ray=ray: ray(RADIUS, t, s))
        patch(n, n, 1, lambda s, t, ray=ray: ray(RADIUS * (OUTER / RADIUS) ** s, t, 1.0))
    return np.array(nodes), np.array(cells), np.array(bodies, np.int32)


SETTINGS = (("glued, uniaxial tension", "bonded", (50e6, 0.0)), ("springs, tension", "springs", (50e6, 25e6)), ("loose, tension", "loose", (50e6, 40e6)), ("loose, pressed", "loose", (-50e6, -40e6)),
            ("springs, pressed", "springs", (-50e6, -40e6)))


def fibre(context):
    delam = context.python()
    rows, found, checks, by_u, by_s = [], [], [], [], []
    levels = (4, 8, 16) if context.quick else (4, 8, 16, 32)
    for (name, bond, remote), role in zip(SETTINGS, ("first", "second", "third", "fourth", "fifth")):
        pressed = remote[0] < 0
        # Closed contact is rigid along the normal; what does not adhere slides.
        exact = Inclusion(remote, 1 / KN if bond == "springs" and not pressed else 0.0, 1 / KT if bond == "springs" else 0.0 if bond == "bonded" else 1e6 * OUTER / MATRIX[0], bond == "loose" and not pressed)
        sizes, errors_u, errors_s = [], [], []
        for n in levels:
            nodes, cells, bodies = fibre_mesh(n)
            mesh = delam.Mesh(nodes)
            mesh.add_cells("quad4", cells, bodies)
            interface = mesh.add_interface(0, 1)
            problem = delam.Problem(mesh, plane="plane-strain")
            problem.options["kinematics"] = "linear"
            problem.set_formulation("standard")
            problem.set_elastic(*FIBRE, body=0)
            problem.set_elastic(*MATRIX, body=1)
            if bond == "bonded":
                problem.set_bonded(interface)
            else:
                problem.set_law(interface, law_of(delam, (KN, KT), (1e3, 1e3), (2e3, 2e3)))
                if bond == "loose":
                    problem.set_adhesion(interface, np.arange(interface.pair_count), 0.0)
            rim = np.flatnonzero(np.hypot(*nodes.T) > OUTER * (1 - 1e-9))
            load = problem.add_pattern("load", [0.0, 1.0], [0.0, 1.0])
            moved = exact.displacement(False, *nodes[rim].T)
            for axis_, values in (("x", moved[:, 0]), ("y", moved[:, 1])):
                problem.prescribe(rim, axis_, drive={load: values})
            with delam.Solver(problem, not_converged="raise") as solver:
                solver.advance(1.0)
                u, s = solver.field("displacement"), solver.field("stress")
            off = size = wrong = pull = 0.0
            middles = nodes[cells].mean(axis=1)
            for inside in (True, False):
                of = bodies == (0 if inside else 1)
                if bond != "loose" or not inside:  # a loose fibre may lie anywhere within its gap
                    at = cells[of].ravel()
                    e = exact.displacement(inside, *nodes[at].T)
                    off, size = off + ((u[at] - e) ** 2).sum(), size + (e ** 2).sum()
                e = exact.stress(inside, *middles[of].T)
                wrong, pull = wrong + ((s[of][:, [0, 1, 3]] - e) ** 2).sum(), pull + (e ** 2).sum()
            sizes.append(1.0 / n)
            errors_u.append(float(math.sqrt(off / size)))
            errors_s.append(float(math.sqrt(wrong / pull)))
            rows.append([name, n, problem.dofs[0], errors_u[-1], errors_s[-1]])
        found += [order(f"displacement, {name}", "h", orders.fit(sizes, errors_u), 2.0, 0.1, sizes, errors_u, "at least"), order(f"stress, {name}", "h", orders.fit(sizes, errors_s), 2.0, 0.15, sizes, errors_s, "at least")]
        angle = 0.5 * math.pi / n
        checks += [check(f"{name}: displacement", errors_u[-1], 0.25 * angle ** 2, "second order: (angle/2)^2 with the angle of a cell; a chord lies angle^2/8 inside the circle"),
                   check(f"{name}: stress at the middles of cells", errors_s[-1], angle ** 2, "angle^2: where cells have second order for stresses")]
        by_u.append(series(name, role, sizes, errors_u))
        by_s.append(series(name, role, sizes, errors_s))
    return result(reference("closed form", "Muskhelishvili's potentials of a circular inclusion, perfect, on linear springs (Hashin, J. Mech. Phys. Solids 39, 1991), free, or sliding", "a system of six equations in double precision: 1e-12"),
                  tables=[{"title": "Errors against the exact field, by cells a quarter of the circle", "note": "", "columns": [column("interface and load", key=True), column("cells", key=True), column("displacements", "DOFs"), column("error of displacement", "relative", past=1e-5),
                           column("error of stress", "relative", past=1e-5)], "rows": rows}], orders=found, checks=checks,
                  plots=[plot("Displacement", axis("cell size over a quarter of the circle", "", "log"), axis("error, root of squares", "relative", "log"), by_u, [{"kind": "slope", "order": 2, "label": "order 2"}]),
                         plot("Stress at the middles of cells", axis("cell size over a quarter of the circle", "", "log"), axis("error, root of squares", "relative", "log"), by_s, [{"kind": "slope", "order": 2, "label": "order 2"}])],
                  figures=[figure("inclusion_displacement", max(c["value"] for c in checks if "displacement" in c["what"]), "relative", "Circular inclusion, five interfaces and loads: error of the displacement, finest mesh", past=1e-5)])


# ---- a sub-laminate as one element of a host

MACHINE, TRAVEL, NAMES = np.array([3e7, 5e8, 2e7]), np.array([1.5e-3, -4e-5, -1.2e-3]), ("up", "side", "low")


def arms(delam, with_machine):
    """Two arms glued behind a notch. The element has its tips prescribed by three patterns; with the machine its springs are pairs of the tips with nodes that travel."""
    layers = delam.Mesh.layers(0.04, 40, [1e-3, 1e-3], [1, 1], "quad4")
    nodes, cells = layers.nodes, layers.cells
    mesh = delam.Mesh(np.vstack((nodes, [[0.0, 4e-3], [0.0, -2e-3]])))
    mesh.add_cells("quad4", cells.of("quad4"), cells.bodies)
    glue = mesh.add_interface(0, 1)
    upper, lower, above, below = mesh.find_node((0.0, 2e-3), 1), mesh.find_node((0.0, 0.0), 0), len(nodes), len(nodes) + 1
    if with_machine:
        top, bottom = mesh.add_obstacle([upper], (0.0, -1.0), above, [1.0]), mesh.add_obstacle([lower], (0.0, 1.0), below, [1.0])
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_formulation("standard")
    problem.set_elastic(70e9, 0.3)
    problem.set_law(glue, law_of(delam, (1e12, 1e12), (20.0, 40.0), (600.0, 1500.0)))
    problem.set_adhesion(glue, glue.places[:, 0] < 0.0075, 0.0)
    problem.options["damage_tolerance"] = 1e-12
    problem.options["mixity_rule"] = "frozen"  # what a step dissipates is then a function of its ends
    for axis_ in ("x", "y"):
        problem.prescribe(box(mesh, (0.04, 0), (0.04, 2e-3)), axis_)
    patterns = [problem.add_pattern(name, [0.0, 1.0], [0.0, TRAVEL[p] if with_machine else 0.0]) for p, name in enumerate(NAMES)]
    problem.prescribe([above if with_machine else upper], "y", drive=patterns[0])
    problem.prescribe([above if with_machine else upper], "x", drive=patterns[1])
    problem.prescribe([below if with_machine else lower], "y", drive=patterns[2])
    if with_machine:
        problem.set_law(top, law_of(delam, (MACHINE[0], MACHINE[1]), (1e30, 1e30), (2e30, 2e30)))
        problem.set_law(bottom, law_of(delam, (MACHINE[2], 1e-4), (1e30, 1e30), (2e30, 2e30)))  # sideways as good as free
        problem.prescribe([below], "x")
    return problem


def user_element(context):
    delam = context.python()
    steps, rows, histories, iterations = 40, [], [], []
    u = np.zeros(3)
    with delam.Solver(arms(delam, False), not_converged="raise") as element, delam.Solver(arms(delam, True), not_converged="raise") as whole:
        quadratic, worst_force, worst_spent, forces = 0, 0.0, 0.0, []
        recorded = delam.History(element, LEDGER_VALUES), delam.History(whole, LEDGER_VALUES)
        for k in range(1, steps + 1):
            time, residuals = k / steps, []
            while True:
                if len(residuals) >= 8:
                    raise Failed(f"step {k}: Newton's method of the host does not converge: {residuals}")
                for p in range(3):
                    element.set_history(p, [time], [u[p]])
                element.advance(time)
                reaction = np.array([element.values[f"reaction:{name}"] for name in NAMES])
                residual = reaction + MACHINE * (u - TRAVEL * time)
                residuals.append(float(np.abs(residual).max() / np.abs(MACHINE * TRAVEL * time).max()))
                if residuals[-1] <= 1e-10:
                    break
                tangent = element.step_tangent()
                element.rollback()
                u = u - np.linalg.solve(tangent + np.diag(MACHINE), residual)
            element.commit()
            whole.advance(time)
            whole.commit()
            for history in recorded:
                history.record()
            if len(residuals) >= 3 and residuals[-2] < 1e-3 and residuals[-1] <= 100 * residuals[-2] ** 2 + 1e-11:
                quadratic += 1
            same = np.array([whole.values[f"reaction:{name}"] for name in NAMES])
            worst_force = max(worst_force, float((np.abs(reaction - same) / (0.05 * np.abs(MACHINE * TRAVEL) + np.abs(same))).max()))
            worst_spent = max(worst_spent, abs(element.values["dissipated"] - whole.values["dissipated"]) / (0.1 + whole.values["dissipated"]))
            iterations.append(len(residuals))
            forces.append((time, -float(reaction[0]), -float(same[0])))
            histories.append(residuals)
            if k % 5 == 0:
                rows.append([time, len(residuals), residuals[-1], -float(reaction[0]), -float(same[0]), float(element.values["dissipated"]), float(whole.values["dissipated"])])
        spent = float(element.values["dissipated"])
    longest = max(histories, key=len)
    return result(reference("other code", "the same structure with the machine's springs as part of the library's scene; and Newton's method of the host, which converges quadratically only with the consistent tangent",
                            "delta = 1e-12 on both sides; residual of the host 1e-10"),
                  tables=[{"title": "Every fifth step", "note": "", "columns": [column("time", key=True), column("Newton iterations", "", past="count"), column("residual", "relative", past="free"), column("force, element", "N/m", past=1e-5), column("force, whole", "N/m", past=1e-5),
                           column("dissipated, element", "J/m", past=1e-5), column("dissipated, whole", "J/m", past=1e-5)], "rows": rows}],
                  checks=[check("force of the element off the whole structure", worst_force, 1e-9, "the residual of the host's Newton method, 1e-10, through softening"), check("dissipated energy, off", worst_spent, 1e-9, "as of the force"),
                          check("steps with quadratic convergence", quadratic, 15, "the last residual is at most 100 times the square of the one before; steps without damage are linear and need two", ">="),
                          check("Newton iterations of a step", max(iterations), 7, "more would not be Newton's method"), check("energy dissipated", spent, 0.1, "J/m: the arms part, it is no elastic element", ">=")],
                  ledger=ledger_of({"element in the host": recorded[0], "whole structure, springs of the machine included": recorded[1]}, "J/m"),
                  plots=[plot("Force of the machine", axis("time"), axis("force", "N/m"), [series("whole structure", "reference", [f[0] for f in forces], [f[2] for f in forces], marker=False), series("element in the host", "condensed", [f[0] for f in forces], [f[1] for f in forces], line="none")]),
                         plot("Newton's method of the host, longest step", axis("iteration"), axis("residual", "relative", "log"), [series("residual", "condensed", list(range(1, len(longest) + 1)), [max(v, FLOOR) for v in longest])])],
                  figures=[figure("user_element_force", worst_force, "relative", "Sub-laminate as one element of a host: force against the whole structure in one scene, largest difference", past="rounding")])


# ---- GetFEM as the host

def getfem(context):
    if importlib.util.find_spec("getfem") is None:
        raise Skip("GetFEM is not there (Debian's python3-getfem)")
    context.python()
    sys.path.insert(0, str(context.root / "examples" / "host-getfem"))
    import host_getfem

    folder = context.out / "analyses" / "getfem"
    folder.mkdir(parents=True, exist_ok=True)
    context.commands.append("python3 examples/host-getfem/host_getfem.py " + ("enf" if context.quick else ""))
    rows, checks, plots, tables = [], [], [], []
    scenes = (host_getfem.enf,) if context.quick else (host_getfem.enf, host_getfem.dcb_3d)
    for scene in scenes:
        hosted, found = scene(folder, host_getfem.Clock())
        for name, difference in found.items():
            rows.append([scene.__name__, name, float(difference)])
        checks.append(check(f"{scene.__name__}: largest difference", largest(float(v) for v in found.values()), 1e-8, "two assemblies of one body differ in rounding alone; slender arms and softening amplify it"))
        reaction = "reaction:press" if scene is host_getfem.enf else "reaction:open"
        load = reaction.replace("reaction", "load")
        x = [1e3 * float(v[load]) for v, _ in hosted.steps]
        plots.append(plot(f"{scene.__name__}: force with GetFEM's bodies", axis("load", "mm"), axis("force", "N/m" if scene is host_getfem.enf else "N"), [series("bodies by GetFEM", "condensed", x, [float(v[reaction]) for v, _ in hosted.steps])]))
    tables.append({"title": "Largest relative difference to the library's own bodies, and to what GetFEM computes from the displacements", "note": "", "columns": [column("scene", key=True), column("quantity", key=True), column("difference", "relative", past="rounding")], "rows": rows})
    if not context.quick:
        graded = []
        for cell, hosted, curvatures, growth in host_getfem.graded(folder, host_getfem.Clock()):
            plateau = curvatures[-5:]
            graded.append([cell * 1e3, float(plateau.min()), float(plateau.max()), float(growth[-5:].min()), float(growth[-5:].max())])
            limit = 8e-3 if cell > 0.75e-3 else 2e-3
            checks.append(check(f"graded arms, cells of {cell * 1e3:g} mm: curvature of growth, off", float(np.abs(plateau - 1).max()), limit, "sqrt(toughness/EI) is exact; the softening zone against the cell leaves this"))
        tables.append({"title": "Arms of graded modulus, cubic triangles: curvature and growth over the exact ones", "note": "", "columns": [column("cells", "mm", key=True), column("curvature, least", past=1e-4), column("curvature, largest", past=1e-4), column("growth, least", past=1e-3),
                       column("growth, largest", past=1e-3)], "rows": graded})
    return result(reference("other code", "GetFEM (Debian's python3-getfem) meshes, assembles and integrates; energy, reaction and stresses by it from the library's displacements; graded arms: Rice's integral, sqrt(toughness/EI)", "rounding of two assemblies, 1e-10; exact for graded arms"),
                  tables=tables, checks=checks, plots=plots, figures=[figure("getfem_difference", max(r[2] for r in rows), "relative", "Bodies assembled by GetFEM against the library's own: largest difference", past="rounding")])


def cases():
    return [
        Case(id="e-inclusion", chapter="e", title="A circular fibre: the exact field", requirement="Glued, on springs, loose under tension and pressed without friction: displacements and stresses converge to the exact field.", run=fibre, quick=True, expected=3, seconds=600,
             geometry="fibre of 5 micrometres in a matrix out to 15, quadrilaterals of 4 nodes, 4 to 32 (quick: 16) on a quarter of the circle", materials="fibre 74 GPa, 0.2; matrix 3.5 GPa, 0.35; kn = 2e15, kt = 5e14 N/m3", supports="the rim moves as in the exact field", units="relative errors"),
        Case(id="e-user-element", chapter="e", title="A sub-laminate as one element of a host", requirement="The host's Newton method converges quadratically with the step's tangent, to what the library finds with the whole structure in its own scene.", run=user_element, quick=True, expected=4, seconds=300,
             geometry="two arms 40 mm x 1 mm, notch of 7.5 mm", materials="E = 70 GPa, nu = 0.3; k = 1e12 N/m3; Go 20/40, Gc 600/1500 J/m2 by mode", supports="root clamped; tips on three springs of a machine that travels", units="N/m, J/m"),
        Case(id="e-getfem", chapter="e", title="GetFEM as the host", requirement="Bodies that GetFEM has assembled give what the library's own give, and graded arms of cubic triangles give the exact curvature.", run=getfem, quick=False, expected=15, seconds=1200,
             geometry="ENF 120 mm x 2 x 3 mm; double cantilever in space 45 x 12.5 x 2 x 1.5 mm; graded arms 80 mm x 1.5 mm", materials="E = 75, 60 and 70 to 210 GPa, nu = 0.3", supports="as in examples/host-getfem", units="SI; relative differences"),
    ]
