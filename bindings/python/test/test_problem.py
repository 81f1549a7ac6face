# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: options as a mapping, loads by pattern, what the library assembled, errors."""
import logging
import math
import unittest

import support
import numpy as np

import delam


class Options(unittest.TestCase):
    def setUp(self):
        self.problem = support.double_cantilever()

    def test_bounds_of_options_are_what_the_library_takes(self):
        options = self.problem.options
        self.assertIsNone(options.bounds("solution"))
        for key, item in delam.options().items():
            if item.type == "text":
                continue
            with self.subTest(key):
                bounds = options.bounds(key)
                self.assertIn(float(item.initial), bounds)
                outside = bounds.lower if bounds.lower_open else bounds.lower - 1
                self.assertNotIn(outside, bounds)
                with self.assertRaises(delam.ArgumentError):
                    options[key] = outside
                self.assertEqual(options[key], type(options[key])(float(item.initial)))

    def test_mapping(self):
        options = self.problem.options
        self.assertEqual(set(options), set(delam.options()))
        self.assertEqual(options["solution"], "local")
        options["solution"] = "energetic"
        options["minimisation_limit"] = 100
        options["damage_tolerance"] = 1e-6
        self.assertEqual(dict(self.problem.options)["solution"], "energetic")
        self.assertEqual((options["minimisation_limit"], options["damage_tolerance"]), (100, 1e-6))
        self.assertIsInstance(options["minimisation_limit"], int)
        del options["solution"]
        self.assertEqual(options["solution"], "local")
        self.assertEqual(delam.Solver(self.problem).option("minimisation_limit"), "100")
        self.assertIn("minimisation_limit = 100  (1 <= value", options.describe())
        self.assertEqual(options.info("solution").type, "text")

    def test_alias(self):
        options = self.problem.options
        options["multipliers"] = "redundant"
        self.assertEqual((options["gluing"], options["multipliers"]), ("redundant", "redundant"))
        self.assertNotIn("multipliers", dict(options))
        self.assertEqual(delam.Solver(self.problem).option("multipliers"), "redundant")
        del options["multipliers"]
        self.assertEqual(options["gluing"], "orthonormal")
        self.assertIn("multipliers", options.info("multipliers").meaning)

    def test_mistakes(self):
        options = self.problem.options
        for change, kind, words in (
                (("solutions", "local"), KeyError, "did you mean 'solution'"),
                (("solution", "best"), delam.ArgumentError, "best"),
                (("solution", 1), delam.ArgumentError, "solution = 1 is a int, expected a str"),
                (("minimisation_limit", 1.5), delam.ArgumentError, "minimisation_limit"),
                (("damage_tolerance", 2.0), delam.ArgumentError, "damage_tolerance"),
                (("damage_tolerance", "small"), delam.ArgumentError, "is no number")):
            before = dict(options)
            with self.assertRaisesRegex(kind, words):
                options.__setitem__(*change)
            self.assertEqual(dict(options), before)


def grid(columns, rows, extra=()):
    """Quadrilaterals over the unit square, and nodes without cells behind the others."""
    x, y = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    nodes = np.vstack([np.column_stack([x.ravel(), y.ravel()]), np.reshape(extra, (-1, 2))])
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    mesh = delam.Mesh(nodes)
    mesh.add_cells("quad4", corner[:, None] + np.array([0, 1, columns + 2, columns + 1]))
    return mesh


class Stages(unittest.TestCase):
    def test_constraints_begin_and_end(self):
        """A square of stiffness 1 under a force of 0.2: taken where it is, moved to zero, and let go."""
        problem = delam.Problem(grid(1, 1, []), plane="plane-strain")
        problem.set_elastic(1.0, 0.0)
        problem.prescribe([0, 1, 2, 3], "x")
        problem.prescribe([0, 1], "y")
        problem.add_forces(problem.add_pattern("force", [0, 1], [0, 1]), [2, 3], [0, 0.1])
        problem.prescribe([2, 3], "y")
        first = problem.constraints()[0].shape[0] - 2
        problem.begin_constraints(first, 2, 1.0, problem.add_pattern("found", [1, 2], [1, 0]))
        problem.end_constraints(first, 2, 2.0, problem.add_pattern("left", [2, 3], [1, 0]))
        self.assertEqual(problem.pattern("left"), 2)
        with self.assertRaisesRegex(delam.ArgumentError, "first = 9"):
            problem.begin_constraints(9, 1, 1.0, "found")
        solver = delam.Solver(problem)
        for time, place in ((1.0, 0.2), (1.5, 0.1), (2.0, 0.0), (2.5, 0.1), (3.0, 0.2)):
            solver.advance(time)
            solver.commit()
            self.assertAlmostEqual(solver.field("displacement")[2, 1], place, 12)
        self.assertAlmostEqual(solver.values["defect"], 0.0, 12)


class Materials(unittest.TestCase):
    YOUNG, POISSON = 3.0, 0.25

    def stiffness(self, material):
        """Homogenised stiffness (xx, yy) of a periodic square, by the tangent of its control nodes' patterns."""
        mesh = grid(3, 2, [[2, 0], [0, 2]])
        first, second = 12, 13
        problem = delam.Problem(mesh, plane="plane-stress")
        material(problem)
        problem.add_periodic(np.eye(2), [first, second])
        problem.prescribe(0, "x")
        problem.prescribe(0, "y")
        problem.prescribe(first, "x", problem.add_pattern("xx", [0, 1], [0, 1]))
        problem.prescribe(second, "y", problem.add_pattern("yy", [0, 1], [0, 1]))
        problem.prescribe(first, "y")
        problem.prescribe(second, "x")
        return delam.Solver(problem).tangent()

    def test_periodic_square_has_the_elasticity_of_its_material(self):
        modulus = self.YOUNG / (1 - self.POISSON ** 2)
        found = self.stiffness(lambda problem: problem.set_elastic(self.YOUNG, self.POISSON))
        np.testing.assert_allclose(found, modulus * np.array([[1, self.POISSON], [self.POISSON, 1]]), rtol=1e-9)

    def test_orthotropic_and_its_orientation(self):
        shear = self.YOUNG / 2 / (1 + self.POISSON)
        constants = [self.YOUNG] * 3 + [self.POISSON] * 3 + [shear] * 3
        same = self.stiffness(lambda problem: problem.set_orthotropic(constants))
        isotropic = self.stiffness(lambda problem: problem.set_elastic(self.YOUNG, self.POISSON))
        np.testing.assert_allclose(same, isotropic, rtol=1e-9)

        def along_y(problem, **cells):
            problem.set_orthotropic([10.0, 1.0, 1.0, 0.3, 0.3, 0.3, 1.0, 1.0, 1.0])
            problem.set_orientation([[0, 1, 0], [-1, 0, 0]], **cells)

        straight = self.stiffness(lambda problem: problem.set_orthotropic([10.0, 1.0, 1.0, 0.3, 0.3, 0.3, 1.0, 1.0,
                                                                           1.0]))
        turned = self.stiffness(along_y)
        np.testing.assert_allclose(turned, straight[::-1, ::-1], rtol=1e-9)
        np.testing.assert_allclose(self.stiffness(lambda problem: along_y(problem, cells=range(6))), turned, rtol=1e-9)
        with self.assertRaisesRegex(delam.ArgumentError, r"constants has shape \(3,\), expected \(9,\)"):
            self.stiffness(lambda problem: problem.set_orthotropic([1, 2, 3]))

    def test_plane(self):
        problem = delam.Problem(grid(1, 1))
        problem.set_plane("plane-stress")
        with self.assertRaisesRegex(delam.ArgumentError, "known are plane-strain, plane-stress"):
            problem.set_plane("flat")


class Interfaces(unittest.TestCase):
    def reaction(self, how, sign):
        mesh = delam.Mesh.layers(1.0, 2, [1.0, 1.0], [1, 1])
        interface = mesh.add_interface(0, 1)
        problem = delam.Problem(mesh)
        problem.set_elastic(1e3, 0.3)
        how(problem, interface)
        low, high = mesh.find_nodes((0, 0), (1, 0)), mesh.find_nodes((0, 2), (1, 2))
        for axis in "xy":
            problem.prescribe(low, axis)
        problem.prescribe(high, "x")
        problem.prescribe(high, "y", problem.add_pattern("pull", [0, 1], [0, sign * 1e-3]))
        solver = delam.Solver(problem)
        solver.advance(1.0)
        return solver.values["reaction:pull"]

    def test_bonded_contact_and_law(self):
        bonded, contact = delam.Problem.set_bonded, delam.Problem.set_contact
        self.assertAlmostEqual(self.reaction(bonded, 1), -self.reaction(bonded, -1), delta=1e-9)
        self.assertAlmostEqual(self.reaction(contact, 1), 0.0, delta=1e-12)
        self.assertAlmostEqual(self.reaction(contact, -1), self.reaction(bonded, -1), delta=1e-3)

    def test_process_zone(self):
        length, spacing = support.double_cantilever().process_zone(0)
        self.assertAlmostEqual(spacing, 0.1 / 51, delta=1e-4)
        self.assertGreater(length, 0.0)

    def test_propose(self):
        problem = support.double_cantilever()
        spacing = problem.process_zone(0)[1]
        found = problem.propose(problem.mesh.interfaces[0], 2.5)
        self.assertAlmostEqual(found.stiffness, 50 * 135e9 / 1.5e-3, delta=1e-9 * found.stiffness)
        self.assertAlmostEqual(found.share, 1 / (1 + 135e9 / 1.5e-3 / 1e12), delta=1e-12)
        self.assertGreater(found.tangential_strength, math.sqrt(2 * 1e12 * 50))  # that of the law is low enough
        problem.set_law(0, support.bilinear(normal_strength=found.normal_strength))
        self.assertAlmostEqual(problem.process_zone(0)[0], 2.5 * spacing, delta=1e-12 * spacing)
        self.assertGreater(problem.propose(0, 2.0).normal_strength, found.normal_strength)
        with self.assertRaisesRegex(delam.ArgumentError, "pairs = 0"):
            problem.propose(0, 0)

    def test_plan(self):
        problem = support.double_cantilever()
        plan = problem.plan()
        solver = delam.Solver(problem)
        self.assertEqual(plan.plan, solver.plan)
        self.assertEqual(plan.memory, next(item.cost for item in solver.plan_items if item.subject == "memory"))
        self.assertGreater(plan.setup, 0.0)
        self.assertEqual(problem.option("solution"), solver.option("solution"))
        self.assertEqual(problem.value_keys, list(solver.values))
        with self.assertRaises(delam.ArgumentError):
            problem.option("solutoin")


class Scene(unittest.TestCase):
    def test_adhesion_by_mask_and_by_index(self):
        hashes = set()
        for select in (lambda mask: mask, np.flatnonzero, lambda mask: np.flatnonzero(mask).tolist()):
            problem = support.double_cantilever()
            interface = problem.mesh.interfaces[0]
            problem.set_adhesion(interface, select(interface.places[:, 0] < 0.04), 0.25)
            hashes.add(problem.hash)
        self.assertEqual(len(hashes), 1)
        self.assertRegex(hashes.pop(), "^[0-9a-f]{16}$")
        with self.assertRaisesRegex(delam.ArgumentError, r"pairs is a mask of shape \(3,\), expected \(51,\)"):
            problem.set_adhesion(0, [True, False, True])

    def test_adhesion_in_a_box(self):
        hashes = set()
        for notch in (lambda p, i: p.set_adhesion(i, i.places[:, 0] < 0.04 - 1e-6, 0.25),
                      lambda p, i: self.assertEqual(p.set_adhesion_box(i, (0, 0), (0.04, 3e-3), 0.25), 20)):
            problem = support.double_cantilever()
            notch(problem, problem.mesh.interfaces[0])
            hashes.add(problem.hash)
        self.assertEqual(len(hashes), 1)
        self.assertEqual(problem.set_adhesion_box(0, (0, 1), (1, 2)), 0)
        with self.assertRaisesRegex(delam.ArgumentError, "lower"):
            problem.set_adhesion_box(0, (0, 0, 0), (1, 1, 1))
        with self.assertRaisesRegex(delam.ArgumentError, r"lower\[1\] = 2 > upper\[1\] = 1"):
            problem.set_adhesion_box(0, (0, 2), (1, 1))

    def test_patterns(self):
        problem = support.double_cantilever()
        heat = problem.add_pattern("heat", [0, 1], [0, -100])
        problem.add_eigenstrain("heat", [1e-5, 1e-5, 1e-5, 0, 0, 0])
        self.assertEqual(problem.patterns, ["opening", "heat"])
        np.testing.assert_allclose(problem.factors(0.5), [3e-3, -50])
        self.assertEqual(problem.forces(heat).shape, (problem.mesh.node_count, 2))
        self.assertGreater(problem.eigenstrain_energy()[1, 1], 0.0)
        with self.assertRaisesRegex(delam.ArgumentError, "'cold' is not known; known are opening, heat"):
            problem.prescribe(0, "x", "cold")
        with self.assertRaisesRegex(delam.ArgumentError, "must be finite"):
            problem.prescribe_mean([0], [1.0], "x", {"opening": np.inf})

    def test_gaps(self):
        mesh = delam.Mesh([[0, 0], [1, 0], [1, 1], [0, 1], [0, 1.125], [1, 1.125], [1, 2], [0, 2]])
        mesh.add_cells("quad4", [[0, 1, 2, 3], [4, 5, 6, 7]], [0, 1])
        faces = mesh.add_mortar_interface(0, 1, gap=0.25)
        problem = delam.Problem(mesh)
        problem.set_elastic(1.0, 0.0)
        problem.set_formulation("standard")  # with them, rounding leaves the gap open when it is just closed
        problem.set_contact(faces)
        problem.add_pattern("apart", [0, 1], [1, 1])
        push = problem.add_pattern("push", [0, 1], [0, -0.25])
        for nodes, drive in (([0, 1], None), ([6, 7], push)):
            problem.prescribe(nodes, "x")
            problem.prescribe(nodes, "y", drive)
        problem.set_gaps(faces, "apart", [0.125, 0.25], adjust=0.125)
        small = problem.hash
        problem.set_gaps(faces, "apart", [0.0, 0.25])
        self.assertEqual(problem.hash, small)
        problem.set_gaps(faces, "apart", 0.125)
        known = problem.hash
        problem.set_gaps(faces, "apart")
        self.assertEqual(problem.hash, known)
        self.assertNotEqual(small, known)
        for gaps, shape in (([0.1], r"\(1,\)"), ([], r"\(0,\)")):
            with self.assertRaisesRegex(delam.ArgumentError, rf"gaps has shape {shape}, expected \(2,\)"):
                problem.set_gaps(0, "apart", gaps)
        with self.assertRaisesRegex(delam.ArgumentError, "adjust = -1"):
            problem.set_gaps(0, "apart", adjust=-1.0)
        with self.assertRaisesRegex(delam.ProblemError, "pattern 'push' drives prescribed displacements"):
            problem.set_gaps(0, push)
        with self.assertRaisesRegex(delam.ArgumentError, "interface_index = 1"):
            problem.set_gaps(1, "apart", 0.1)
        self.assertEqual(problem.hash, known)
        solver = delam.Solver(problem)
        history = solver.history([0.25, 0.5, 1.0])
        # The lower half of the push closes the gap; the rest is the strain of two bodies of height 1 and 0.875.
        np.testing.assert_allclose(solver.field("jump"), 0.0, atol=1e-12)
        np.testing.assert_allclose(history["contact_pairs"], [0, 0, 0, 2])
        np.testing.assert_allclose(solver.values["stored_bulk"], 0.5 * 0.125**2 / 1.875)
        self.assertEqual([p["drives"] for p in history._about["patterns"]], ["gap", "displacement"])

    def test_a_number_is_no_drive(self):
        problem = support.double_cantilever()
        before = problem.hash
        for drive in (0, 0.5, np.int64(0), True, [0], ("opening", 0.5), {0: 1.0}, {0: 0.0, 1.0: 6e-3}):
            for use in (lambda: problem.prescribe(0, "x", drive),
                        lambda: problem.prescribe_mean([0], [1.0], "x", drive),
                        lambda: problem.add_equation([0], [[1.0, 0.0]], drive)):
                with self.subTest(drive=drive), self.assertRaisesRegex(
                        delam.ArgumentError, r"^drive = .*expected the pattern that add_pattern returned, its name, "
                                             r"\{pattern: coefficient\}, or None: held at zero"):
                    use()
        self.assertEqual(problem.hash, before)
        hashes = set()
        for drive in (delam.problem.Pattern("opening", 0, problem), "opening", {"opening": 1.0}, {"opening": [1.0]}):
            again = support.double_cantilever()
            opening = delam.problem.Pattern("opening", 0, again)
            again.prescribe(0, "x", opening if isinstance(drive, delam.Pattern) else drive)
            hashes.add(again.hash)
        self.assertEqual(len(hashes), 1)
        with self.assertRaisesRegex(delam.ArgumentError, "'openning' is not known .did you mean 'opening'"):
            problem.prescribe(0, "x", "openning")

    def test_nothing_is_selected(self):
        problem = support.double_cantilever()
        mesh, dead, before = problem.mesh, problem.add_pattern("dead", [0, 1], [0, 1]), problem.hash
        for nodes in (mesh.find_nodes((0, 7), (0.1, 8), body=1), np.zeros(mesh.node_count, bool), []):
            for use in (lambda: problem.prescribe(nodes, "x"), lambda: problem.prescribe_mean(nodes, [], "x"),
                        lambda: problem.add_forces(dead, nodes, (0.0, 1.0))):
                with self.assertRaisesRegex(
                        ValueError, r"nodes is empty, expected at least one node; find_nodes last found none of body 1 "
                                    r"from \(0, 7\) to \(0.1, 8\); the nodes lie from \(0, 0\) to \(0.1, 0.003\)"):
                    use()
        for pairs in ([], np.zeros(51, bool)):
            with self.assertRaisesRegex(ValueError, r"pairs is empty, expected at least one of the 51 pairs of "
                                                    r"interface 0; they lie from \(0, 0.0015\) to \(0.1, 0.0015\)"):
                problem.set_adhesion(0, pairs)
        self.assertEqual(problem.hash, before)

    def test_an_interface_that_nothing_holds(self):
        def warnings_of(change):
            problem = support.double_cantilever(divisions=400)
            problem.prescribe(problem.mesh.find_nodes((0.1, 0), (0.1, 3e-3)), "y")
            change(problem)
            with self.assertLogs("delam", logging.WARNING) as caught:
                logging.getLogger("delam").warning("one at least")
                delam.Solver(problem)
            return [line for line in caught.output if "has any adhesion" in line]

        every = np.arange(401)
        (found,) = warnings_of(lambda problem: problem.set_adhesion(0, every, 0.0))
        self.assertIn("interface 0 has a law, but none of its 401 pairs has any adhesion", found)
        self.assertEqual(len(warnings_of(lambda problem: problem.set_adhesion_box(0, (-1, -1), (1, 1)))), 1)
        self.assertEqual(warnings_of(lambda problem: None), [])
        self.assertEqual(warnings_of(lambda problem: problem.set_adhesion(0, every[:-1], 0.0)), [])

        def free(problem):
            problem.set_adhesion(0, every, 0.0)
            problem.set_contact(0)

        self.assertEqual(warnings_of(free), [])

    def test_things_of_another_scene(self):
        one, other = support.double_cantilever(), support.double_cantilever()
        cold = other.add_pattern("cold", [0, 1], [0, 1])
        one.add_eigenstrain(one.add_pattern("heat", [0, 1], [0, 1]), np.zeros(6))
        before = one.hash
        for use in (lambda: one.prescribe(0, "x", cold), lambda: one.prescribe(0, "x", {cold: 1.0}),
                    lambda: one.add_eigenstrain(cold, np.zeros(6)), lambda: one.forces(cold),
                    lambda: delam.Solver(one).set_history(cold, 1.0, 0.0)):
            with self.assertRaisesRegex(delam.ArgumentError, "pattern 'cold' given is one of another problem"):
                use()
        interface = other.mesh.interfaces[0]
        for use in (lambda: one.set_law(interface, support.bilinear()), lambda: one.set_bonded(interface),
                    lambda: one.set_adhesion(interface, [0]), lambda: one.process_zone(interface),
                    lambda: delam.Solver(one).field("jump", interface), lambda: delam.Solver(one).fronts(interface)):
            with self.assertRaisesRegex(delam.ArgumentError, "interface 0 given is one of another mesh"):
                use()
        self.assertEqual(one.hash, before)

    def test_numbers_that_are_none(self):
        problem = support.double_cantilever()
        masked = np.ma.array([0.5, 0.5], mask=[False, True])
        with self.assertRaisesRegex(delam.ArgumentError, r"adhesion\[1\] is masked"):
            problem.set_adhesion(0, [0, 1], masked)
        with self.assertRaisesRegex(delam.ArgumentError, r"pairs\[50\] is masked"):
            problem.set_adhesion(0, np.ma.array([False] * 51, mask=[False] * 50 + [True]))
        problem.set_adhesion(0, [0, 1], np.ma.array([0.5, 0.5]))
        with self.assertRaisesRegex(delam.ArgumentError, "threads does not fit into a float"):
            problem.options["threads"] = 10**400
        with self.assertRaisesRegex(delam.ArgumentError, "young = '1e9' is no number"):
            problem.set_elastic("1e9", 0.3)
        with self.assertRaisesRegex(delam.ArgumentError, "place"):
            problem.mesh.find_node(None)

    def test_a_solver_goes_on_when_its_problem_is_closed(self):
        problem = support.double_cantilever()
        solver = delam.Solver(problem)
        opening = delam.problem.Pattern("opening", 0, problem)
        problem.close()
        for pattern in ("opening", 0, opening):
            solver.set_history(pattern, [0.5], [1e-4])
        solver.advance(0.5)
        solver.commit()
        self.assertAlmostEqual(solver.values["load:opening"], 1e-4)
        with self.assertRaisesRegex(delam.ArgumentError, "'cold' is not known; known are opening"):
            solver.set_history("cold", [0.6], [1e-4])
        with self.assertRaises(delam.ArgumentError):
            solver.load(memoryview(solver.save())[::-1])

    def test_assembled(self):
        problem = support.double_cantilever()
        stiffness = problem.body_matrix(0).toarray()
        self.assertEqual(len(stiffness), problem.dofs[0] // 2)
        np.testing.assert_allclose(stiffness, stiffness.T, atol=1e-9 * abs(stiffness).max())
        along_x = np.tile([1.0, 0.0], len(stiffness) // 2)
        self.assertLess(abs(stiffness @ along_x).max(), 1e-9 * abs(stiffness).max())
        rows, coefficients = problem.constraints()
        self.assertEqual((rows.shape[0], coefficients.shape), (6, (6, 1)))
        np.testing.assert_allclose(coefficients[:2, 0], 0.5)

    def test_equations_and_drives_are_the_same(self):
        reactions = []
        for way in ("prescribe", "equation", "mean"):
            problem = support.double_cantilever()
            side = problem.mesh.find_node((0.1, 0.0))
            if way == "prescribe":
                problem.prescribe(side, "y", {"opening": 0.5})
            elif way == "equation":
                problem.add_equation([side], [[0.0, 1.0]], {"opening": 0.5})
            else:
                problem.prescribe_mean([side], [3.0], (0.0, 2.0), {"opening": 0.5})
            solver = delam.Solver(problem)
            solver.advance(0.1)
            reactions.append(solver.values["reaction:opening"])
        np.testing.assert_allclose(reactions, reactions[0], rtol=1e-10)

    def test_incomplete_scenes_are_named(self):
        mesh = delam.Mesh.layers(1.0, 2, [1.0], [1])
        problem = delam.Problem(mesh)
        with self.assertRaisesRegex(delam.ProblemError, "material|elastic"):
            problem.check()
        with self.assertRaises(delam.ProblemError):
            delam.Solver(problem)
        problem.set_elastic(1.0, 0.3)
        problem.prescribe([0, 3], "x")
        with self.assertRaisesRegex(delam.ProblemError, "held|support|rigid|motion"):
            delam.Solver(problem)
        problem.prescribe([0], "y")
        self.assertEqual(delam.Solver(problem).field("displacement").shape, (6, 2))

    def test_dead_forces_and_limit(self):
        problem = support.double_cantilever()
        problem.add_pattern("dead", [0, 1], [0, 1])
        problem.add_forces("dead", problem.mesh.find_node((0.05, 3e-3)), (0.0, 10.0))
        solver = delam.Solver(problem)
        solver.advance(0.1)
        self.assertLess(solver.values["load_potential"], 0.0)
        self.assertAlmostEqual(solver.tangent()[0, 1], solver.tangent()[1, 0])


if __name__ == "__main__":
    support.main()
