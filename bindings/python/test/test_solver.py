# SPDX-License-Identifier: BSD-3-Clause
"""The march: steps that are kept or refused, what can be read, states as bytes, outcomes."""
import io
import logging
import unittest
import warnings

import support
import numpy as np

import delam
from delam.solver import FIELDS


class Steps(unittest.TestCase):
    def setUp(self):
        self.problem = support.double_cantilever()
        self.solver = delam.Solver(self.problem)

    def test_commit_and_rollback(self):
        solver = self.solver
        solver.advance(0.3)
        self.assertTrue(solver.pending)
        solver.commit()
        kept = solver.save()
        solver.advance(0.5)
        self.assertNotEqual(solver.time, 0.3)
        solver.rollback()
        self.assertFalse(solver.pending)
        self.assertEqual(solver.time, 0.3)
        self.assertEqual(solver.save(), kept)

    def test_order(self):
        with self.assertRaises(delam.StateError) as caught:
            self.solver.commit()
        self.assertIsInstance(caught.exception, RuntimeError)
        self.solver.advance(0.1)
        with self.assertRaises(delam.StateError):
            self.solver.advance(0.2)
        self.assertTrue(self.solver.pending)
        self.solver.commit()
        with self.assertRaises(delam.ArgumentError):
            self.solver.advance(0.1)
        with self.assertRaisesRegex(delam.ArgumentError, "time"):
            self.solver.advance(float("nan"))
        with self.assertRaisesRegex(delam.ArgumentError, "time = 'now' is no number"):
            self.solver.advance("now")

    def test_equilibrate(self):
        pairs = self.problem.mesh.interfaces[0].pair_count
        adhesion = np.zeros(pairs)
        adhesion[pairs // 2:] = 1.0
        self.solver.equilibrate(0.01, adhesion)
        np.testing.assert_array_equal(self.solver.field("adhesion"), adhesion)
        self.solver.rollback()
        self.solver.equilibrate(0.01)
        self.solver.commit()
        with self.assertRaisesRegex(delam.ArgumentError, r"adhesion has shape \(3,\), expected \(51,\)"):
            self.solver.equilibrate(0.02, [1, 1, 1])
        for value in (1.5, -0.1):
            adhesion[3] = value
            with self.assertRaisesRegex(delam.ArgumentError, f"adhesion of pair 3 is {value}, allowed: 0 to 1"):
                self.solver.equilibrate(0.02, adhesion)
        adhesion[3] = np.nan
        with self.assertRaisesRegex(delam.ArgumentError, r"adhesion\[3\] is nan, must be finite"):
            self.solver.equilibrate(0.02, adhesion)
        self.assertFalse(self.solver.pending)

    def test_march_is_a_generator(self):
        rows = []
        for row in self.solver.march(np.linspace(0.1, 1.0, 10), ["time", "reaction:opening"]):
            rows.append(row)
            if len(rows) == 3:
                break
        self.assertEqual([list(row) for row in rows], [["time", "reaction:opening"]] * 3)
        self.assertAlmostEqual(self.solver.time, 0.3)
        with self.assertRaises(KeyError):
            next(self.solver.march([0.4], ["reactions"]))
        with self.assertRaises(delam.ArgumentError):
            list(self.solver.march([0.4, 0.2]))
        self.assertFalse(self.solver.pending)
        self.assertAlmostEqual(self.solver.time, 0.4)

    def test_looking_back(self):
        self.problem.options["backtracking"] = "on"
        solver = delam.Solver(self.problem)
        history = solver.history([0.2, 0.4, 0.6])
        with solver.looking(1):
            self.assertEqual(solver.time, 0.2)
        self.assertEqual(solver.time, 0.6)
        solver.look(2)
        self.assertEqual(solver.values["reaction:opening"], history["reaction:opening"][2])
        solver.look(-1)
        with self.assertRaises(delam.ArgumentError):
            solver.look(7)

    def test_history(self):
        history = self.solver.history(np.linspace(0.1, 1.0, 10))
        self.assertEqual(len(history), 11)
        np.testing.assert_allclose(history["load:opening"], 6e-3 * history["time"])
        self.assertTrue((np.diff(history["dissipated"]) >= 0).all())
        np.testing.assert_allclose(history["work"],
                                   history["stored_bulk"] + history["stored_interface"] + history["dissipated"],
                                   rtol=0.05)
        self.assertEqual(history.row(3)["time"], history["time"][3])
        self.assertEqual(list(dict(history)), list(history.keys()))
        self.assertNotIn("rotation_max", history)
        with self.assertRaises(KeyError):
            history["rotation_max"]
        out = io.StringIO()
        history.write_csv(out)
        self.assertEqual(np.loadtxt(io.StringIO(out.getvalue()), delimiter=",", skiprows=1).shape,
                         (11, len(history.names)))

    def test_values_are_described(self):
        infos = self.solver.values.describe()
        self.assertEqual(list(infos), list(self.solver.values))
        self.assertEqual(infos["kkt_gap"].cost, "recovers")
        self.assertFalse(infos["kkt_gap"].recorded)
        self.assertEqual(infos["crack_length:0"].scope, "interface")
        self.assertEqual(infos["dissipated"], ("", "F L", "free", "whole", infos["dissipated"].meaning, True))
        self.solver.advance(0.5)
        self.assertEqual(infos["am_iterations"].alias, "staggered_iterations")
        self.assertGreater(self.solver.values["staggered_iterations"], 0)
        self.assertEqual(self.solver.values["staggered_iterations"], self.solver.values["am_iterations"])
        self.assertIn("dissipated_linear", self.solver.values)
        self.assertNotIn("", self.solver.values)
        self.solver.rollback()
        self.solver.record("dissipated_linear")
        np.testing.assert_array_equal(self.solver.recorded("dissipated_slides"),
                                      self.solver.recorded("dissipated_linear"))

    def test_replaced_steps_are_read_again(self):
        problem = support.brittle_flexure()
        problem.options["backtracking"] = "on"
        solver = delam.Solver(problem)
        names, seen, replaced = ["time", "reaction:press", "dissipated"], [], 0
        history = delam.History(solver, names)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", delam.NotConvergedWarning)
            for _ in solver.march(np.linspace(0.05, 0.5, 10), ()):
                step, first = int(solver.values["step"]), int(solver.values["revised_from"])
                replaced += step - first
                history.record()
                for earlier in range(first, step):
                    with solver.looking(earlier):
                        seen.append((earlier, [solver.values[name] for name in names]))
        latest = dict(seen)
        for step, values in latest.items():
            self.assertEqual(list(history.row(step).values()), values)
        self.assertEqual(len(history), 11)
        self.assertGreater(replaced, 0, "the scene returns no more: choose a more brittle one")


class Reading(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.problem = support.double_cantilever(100)  # three pairs in the process zone
        cls.solver = delam.Solver(cls.problem)
        cls.solver.history(np.linspace(0.1, 1.0, 10), ())

    def test_values(self):
        values = self.solver.values
        self.assertEqual(values["time"], 1.0)
        self.assertIn("reaction:opening", values)
        self.assertEqual(len(dict(values)), len(values))
        with self.assertRaisesRegex(KeyError, "did you mean 'dissipated'"):
            values["disipated"]
        self.assertNotIn("nothing", values)

    def test_fields_have_their_shapes(self):
        mesh, pairs = self.problem.mesh, self.problem.mesh.interfaces[0].pair_count
        for name, shape in (("displacement", (mesh.node_count, 2)), ("stress", (mesh.cell_count, 4)),
                            ("rotation", (mesh.cell_count,)), ("jump", (pairs, 2)), ("traction", (pairs, 2)),
                            ("adhesion", (pairs,)), ("mixity", (pairs,)), ("contact", (pairs,)), ("reaction", (6,)),
                            ("free_since", (2,)), ("free_motion", (2, 3))):
            field = self.solver.field(name)
            self.assertEqual((field.shape, field.dtype), (shape, np.float64), name)
            self.assertTrue(field.flags.owndata and field.flags.writeable)
        np.testing.assert_array_equal(self.solver.field("jump", 0), self.solver.field("jump"))
        interface = mesh.interfaces[0]
        moved = self.solver.field("displacement")
        for node in range(0, len(moved), 7):
            off = np.abs(self.solver.displacement(node) - moved[node]).max()
            self.assertLess(off, 1e-9 * np.abs(moved).max())
        for node in (-1, len(moved), 1.0, True, "1"):
            with self.assertRaisesRegex(delam.ArgumentError, "node is .*, allowed: 0 to"):
                self.solver.displacement(node)
        opening = moved[interface.nodes_b] - moved[interface.nodes_a]
        np.testing.assert_allclose(self.solver.field("jump", interface)[:, 0], opening[:, 1], atol=1e-9)
        for name, part, words in (
                ("zzz", None, "'zzz' is not known; known are displacement, stress"), ("jump", 3, "3"),
                ("damage", interface, r"'damage' is not known \(did you mean 'adhesion', which is 1 - damage\?\);"),
                ("tractoin", 0, r"did you mean 'traction'\?"), (None, None, "field None is not known"),
                ("displacement", 0, "'displacement' is one over all nodes and takes no interface, but 0 was given; "
                                    "those of an interface are jump, traction, adhesion, mixity, contact")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                self.solver.field(name, part)
        with self.assertRaises(delam.ArgumentError) as caught:
            self.solver._shape("stretch", -1)
        self.assertEqual(str(caught.exception).split("known: ")[1].split(", "), list(FIELDS))
        for name, over in FIELDS.items():
            if over == "pairs":
                self.assertEqual(len(self.solver.field(name, 0)), pairs)

    def test_fronts_average_tangent(self):
        fronts = self.solver.fronts()
        self.assertEqual((len(fronts.lengths), fronts.rates.shape, fronts.closed.tolist()), (1, (1, 3), [False]))
        self.assertAlmostEqual(fronts.rates.sum(), 280.0, delta=14.0)
        self.assertEqual(fronts.lines()[0].shape, (1, 2))
        self.assertAlmostEqual(self.solver.average().volume, 0.1 * 3e-3)
        self.assertAlmostEqual(self.solver.average(0).volume, 0.1 * 1.5e-3)
        tangent = self.solver.tangent()
        self.assertEqual(tangent.shape, (1, 1))
        self.assertAlmostEqual(tangent[0, 0], self.solver.values["reaction:opening"] / 6e-3, delta=0.05 * tangent[0, 0])

    def test_plan(self):
        self.assertIn("condensed operator", self.solver.plan)
        self.assertIn("left out", {item.decision for item in self.solver.plan_items})
        self.assertEqual(self.solver.option("solution"), "local")
        with self.assertRaises(KeyError):
            self.solver.option("nothing")
        self.assertEqual(self.solver.searched, "")

    def test_jumps(self):
        problem = support.double_cantilever()
        problem.set_law(0, support.bilinear(normal_onset=279.0, tangential_onset=279.0))
        problem.options["jump_tolerance"] = 1e-3
        solver = delam.Solver(problem)
        solver.history([0.5, 1.0], ())
        self.assertGreater(len(solver.jumps), 0)
        self.assertEqual(len(solver.jumps), solver.values["jumps"] if solver.values["step"] == 1 else len(solver.jumps))
        for jump in solver.jumps:
            self.assertLess(jump.before, jump.time)
            self.assertEqual(jump.interface, 0)
            self.assertGreater(jump.reaction_before[0], jump.reaction_after[0])


class Bytes(unittest.TestCase):
    def test_load_goes_on_bitwise(self):
        times = np.linspace(0.1, 1.0, 10)
        whole = delam.Solver(support.double_cantilever())
        history = whole.history(times)
        first = delam.Solver(support.double_cantilever())
        first.history(times[:4])
        state = first.save()
        for kind in (bytes, bytearray, memoryview):
            second = delam.Solver(support.double_cantilever())
            second.load(kind(state))
            rest = second.history(times[4:])
            for name in ("reaction:opening", "dissipated", "stored_bulk", "upper"):
                np.testing.assert_array_equal(rest[name], history[name][4:], name)
            self.assertEqual(second.save(), whole.save())

    def test_foreign_bytes_are_refused(self):
        solver = delam.Solver(support.double_cantilever())
        solver.advance(0.3)
        solver.commit()
        state = solver.save()
        other = delam.Solver(support.double_cantilever(divisions=100))
        for wrong in (b"", b"nothing", state[:-1], state[:50] + bytes([state[50] ^ 1]) + state[51:]):
            with self.assertRaises((delam.SnapshotError, delam.ArgumentError)):
                solver.load(wrong)
        with self.assertRaises(delam.SnapshotError):
            other.load(state)
        with self.assertRaisesRegex(delam.ArgumentError, "state"):
            solver.load(3.5)
        self.assertEqual(solver.save(), state)


class Outcomes(unittest.TestCase):
    def problem(self):
        problem = support.double_cantilever()
        problem.options["minimisation_limit"] = 1
        return problem

    def test_warn(self):
        solver = delam.Solver(self.problem())
        with self.assertWarns(delam.NotConvergedWarning) as caught:
            solver.advance(1.0)
        self.assertEqual(caught.filename, __file__)
        self.assertTrue(solver.pending)
        solver.rollback()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(delam.NotConvergedWarning):
                list(solver.march([1.0]))
        self.assertEqual((solver.pending, solver.time), (False, 0.0))

    def test_raise(self):
        solver = delam.Solver(self.problem(), not_converged="raise")
        with self.assertRaises(delam.NotConverged) as caught:
            solver.advance(1.0)
        self.assertEqual(caught.exception.name, "DELAM_NOT_CONVERGED")
        self.assertIsInstance(caught.exception, delam.Outcome)
        self.assertTrue(solver.pending)
        solver.commit()

    def test_ignore(self):
        solver = delam.Solver(self.problem(), not_converged="ignore")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            solver.advance(1.0)
        with self.assertRaisesRegex(delam.ArgumentError, "not_converged = 'maybe'"):
            delam.Solver(self.problem(), not_converged="maybe")

    def test_limit(self):
        mesh = delam.Mesh.layers(1.0, 2, [1.0, 1.0], [1, 1])
        mesh.add_interface(0, 1)
        problem = delam.Problem(mesh)
        problem.set_elastic(1e3, 0.3)
        problem.set_law(0, support.bilinear(normal_stiffness=1e5, tangential_stiffness=1e5, normal_onset=1e-3,
                                            tangential_onset=1e-3, normal_toughness=2e-3, tangential_toughness=2e-3))
        low = mesh.find_nodes((0, 0), (1, 0))
        problem.prescribe(low, "x")
        problem.prescribe(low, "y")
        pull = problem.add_pattern("pull", [0, 1], [0, 1e4])
        problem.add_forces(pull, mesh.find_nodes((0, 2), (1, 2)), (0.0, 1.0))
        solver = delam.Solver(problem)
        with self.assertRaises(delam.LimitReached) as caught:
            solver.advance(1.0)
        self.assertEqual(caught.exception.status, 3)
        self.assertFalse(solver.pending)
        self.assertEqual(solver.time, 0.0)
        solver.advance(1e-6)

    def test_notes_go_to_the_logger(self):
        problem = support.double_cantilever(divisions=20)
        solver = delam.Solver(problem)
        with self.assertLogs("delam", logging.WARNING) as caught:
            solver.history(np.linspace(0.1, 1.0, 10), ())
        self.assertTrue(any("pairs" in line for line in caught.output))


class SharedBodies(unittest.TestCase):
    """Solvers that share the condensed bodies of another one: the same digits, and no second condensation."""

    KEYS = ("reaction:opening", "work", "dissipated", "released", "front", "am_iterations")

    def walk(self, solver):
        history = solver.history(np.linspace(0.05, 1.0, 20), self.KEYS)
        return [history[key] for key in self.KEYS] + [solver.field(key) for key in ("displacement", "adhesion")]

    def test_the_same_digits(self):
        problem = support.double_cantilever()
        first = delam.Solver(problem)
        self.walk(first)
        for toughness in (280.0, 350.0, 200.0):
            problem.set_law(0, support.bilinear(normal_toughness=toughness, tangential_toughness=toughness))
            alone = delam.Solver(problem)
            shared = delam.Solver(problem, like=first)
            self.assertEqual((alone.values["bulk_factorisations"], shared.values["bulk_factorisations"]), (1, 0))
            self.assertTrue(first.shares_bodies(problem))
            first.close()
            for own, other in zip(self.walk(alone), self.walk(shared)):
                np.testing.assert_array_equal(own, other)
            self.assertEqual(alone.save(), shared.save())
            reason = {item.subject: item.reason for item in shared.plan_items}["condensed operator"]
            self.assertIn("a solver that has condensed the same bodies", reason)
            first = shared

    def test_at_the_same_time(self):
        problem = support.double_cantilever()
        first = delam.Solver(problem)
        second = delam.Solver(problem, like=first)
        for time in (0.2, 0.4, 0.6):
            for solver in (first, second):
                solver.advance(time)
                solver.commit()
        self.assertEqual(first.save(), second.save())

    def test_adhesion_and_options(self):
        problem = support.double_cantilever()
        first = delam.Solver(problem)
        interface = problem.mesh.interfaces[0]
        problem.set_adhesion(interface, interface.places[:, 0] < 0.05, 0.0)
        problem.options["solution"] = "energetic"
        alone, shared = delam.Solver(problem), delam.Solver(problem, like=first)
        self.assertEqual(shared.values["bulk_factorisations"], 0)
        for own, other in zip(self.walk(alone), self.walk(shared)):
            np.testing.assert_array_equal(own, other)

    def test_other_bodies(self):
        problem = support.double_cantilever()
        first = delam.Solver(problem)
        changes = (lambda: problem.set_elastic(70e9, 0.3), lambda: problem.set_formulation("standard"),
                   lambda: problem.add_forces(problem.add_pattern("more", [0, 1], [0, 1]),
                                              problem.mesh.find_node((0, 3e-3)), (1.0, 0.0)))
        for change in changes:
            change()
            self.assertFalse(first.shares_bodies(problem))
            alone, other = delam.Solver(problem), delam.Solver(problem, like=first)
            self.assertEqual(other.values["bulk_factorisations"], 1)
            alone.advance(0.3)
            other.advance(0.3)
            self.assertEqual(alone.values["work"], other.values["work"])

    def test_other_operators(self):
        problem = support.double_cantilever()
        first = delam.Solver(problem)
        for options in ({"reduction": "iterated"}, {"reduction": "feti"},
                        {"reduction": "auto", "kinematics": "corotational"}):
            problem.options.update(options)
            solver = delam.Solver(problem, like=first)
            solver.advance(0.2)
            self.assertNotIn("a solver that has", solver.plan)
            first = solver

    def test_refused(self):
        problem = support.double_cantilever()
        with self.assertRaisesRegex(delam.ArgumentError, "other: a solver of another context"):
            delam.Solver(problem, like=delam.Solver(support.double_cantilever()))
        with self.assertRaisesRegex(delam.ArgumentError, "like = 3, expected a Solver or None"):
            delam.Solver(problem, like=3)
        closed = delam.Solver(problem)
        closed.close()
        with self.assertRaises(delam.DelamError):
            delam.Solver(problem, like=closed)


if __name__ == "__main__":
    support.main()
