# SPDX-License-Identifier: BSD-3-Clause
"""delam.petsc on two ranks: what is raised where, and that libdelam alone needs neither MPI nor libdelam-petsc.

The file is also what the ranks run, with the name of a part of `Parts`."""
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import support

HEADER = support.ROOT / "include" / "delam" / "petsc.h"
FORTRAN = support.ROOT / "bindings" / "fortran" / "src" / "delam_petsc.f90"


def libraries():
    """Where libdelam-petsc would lie in the build."""
    folder = pathlib.Path(os.environ.get("DELAM_LIBRARY", ""))
    return list((folder if folder.is_dir() else folder.parent).glob("libdelam-petsc.so.*"))


class Alone(unittest.TestCase):
    def test_nothing_is_loaded_before_it_is_asked_for(self):
        code = ("import sys, delam, delam.petsc\n"
                "assert 'mpi4py' not in sys.modules\n"
                "assert 'libmpi' not in open('/proc/self/maps').read()\n"
                "try:\n    delam.petsc._library_of_ranks()\n"
                "except ImportError as error:\n    print(error)\n")
        environment = dict(os.environ, PYTHONPATH=str(support.SOURCES),
                           DELAM_PETSC_LIBRARY="/nowhere/libdelam-petsc.so.1")
        done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("DELAM_PETSC_LIBRARY", done.stdout)
        self.assertIn("/nowhere", done.stdout)

    def test_the_functions_are_those_of_the_header(self):
        import delam.petsc
        text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(encoding="utf-8"), flags=re.S)
        names = re.findall(r"DELAM_API[^;]*?\b(delam_petsc_\w+)\(", text)
        self.assertGreater(len(names), 8)
        self.assertEqual({*delam.petsc._FUNCTIONS, "delam_petsc_create", "delam_petsc_create_fortran"}, set(names))
        for name, (_, arguments) in delam.petsc._FUNCTIONS.items():
            parameters = re.search(name + r"\((.*?)\);", text, flags=re.S)[1]
            parameters = parameters.replace("(*work)(void *user)", "work")
            self.assertEqual(parameters.count(",") + 1, len(arguments), name)
        # A communicator of C is nothing for Fortran.
        bound = re.findall(r'bind\(c, name="(\w+)"\)', FORTRAN.read_text(encoding="utf-8"))
        self.assertEqual(set(bound), set(names) - {"delam_petsc_create"})


class Parts:
    """Each runs on all ranks."""

    @staticmethod
    def raised(kind, function, *words):
        try:
            function()
        except kind as error:
            if type(error) is not kind or not all(word in str(error) for word in words):
                raise AssertionError(f"{type(error).__name__}: {error}") from error
            return error
        raise AssertionError(f"no {kind.__name__}")

    @classmethod
    def errors(cls, comm):
        import numpy as np

        import delam
        import delam.petsc
        first = comm.rank == 0
        with delam.petsc.Ranks(comm) as ranks:
            assert (ranks.rank, ranks.size) == (comm.rank, comm.size)
            assert ranks.run(lambda: 7) == (7 if first else None)

            # What the function raises.
            def fails():
                raise KeyError("spoon")
            error = cls.raised(delam.petsc.WorkError, lambda: ranks.run(fails), "KeyError", "spoon")
            assert isinstance(error.__cause__, KeyError) == first
            cls.raised(delam.ArgumentError, lambda: ranks.run(lambda: delam.Law("gum")), "gum")

            def warns():
                raise delam.NotConverged("nearly")
            cls.raised(delam.NotConverged, lambda: ranks.run(warns), "nearly")

            def interrupted():
                raise KeyboardInterrupt
            cls.raised(KeyboardInterrupt if first else delam.petsc.WorkError, lambda: ranks.run(interrupted))

            # Inside, the ranks are at work.
            for inner in (lambda: ranks.run(lambda: 1), lambda: ranks.value("solves"), ranks.close,
                          lambda: ranks.attach(None)):
                cls.raised(delam.StateError, lambda inner=inner: ranks.run(inner), "running")
            cls.raised(delam.petsc.WorkError, lambda: ranks.run(fails), "KeyError", "spoon")
            assert ranks.run(lambda: "again") == ("again" if first else None)

            # What one rank alone does wrong.
            nodes = np.arange(2.0) if ranks.rank == 1 else np.arange(2)
            part = delam.Sparse((4, 4), np.arange(5), np.arange(4), np.ones(4))
            cls.raised(delam.ArgumentError, lambda: ranks.set_part(nodes, part, dimension=2), "rank 1", "integers")
            nodes = [3, 3] if ranks.rank == 1 else [0, 1]
            cls.raised(delam.ArgumentError, lambda: ranks.set_part(nodes, part, dimension=2), "3")
            cls.raised(delam.ArgumentError, lambda: ranks.attach("problem"), "Problem")
            cls.raised(delam.ArgumentError, lambda: ranks.value("spoon"))
            assert ranks.value("solves") == 0.0
        assert ranks.closed
        cls.raised(delam.HandleError, lambda: ranks.run(lambda: 1), "closed")
        try:
            delam.petsc.Ranks(3)
            raise AssertionError("a number for a communicator")
        except delam.ArgumentError:
            pass

    @classmethod
    def fields(cls, comm, ranks, made):
        """What each rank has of a recovered state is what rank 0 can gather."""
        import numpy as np

        import delam
        seen = {}

        def look(names):
            nodes, owned = ranks.part_nodes()
            for name in names:
                rows = (nodes[owned], ranks.part_field(name)[owned]) if name in ("displacement", "force") else (
                    ranks.part_cells(), ranks.part_field(name))
                parts = comm.gather(rows)
                if comm.rank == 0:
                    numbers, values = (np.concatenate(part) for part in zip(*parts))
                    assert (np.sort(numbers) == np.arange(len(numbers))).all(), name
                    seen[name] = values[np.argsort(numbers)]

        def task(data):
            if data == "fail" and comm.rank == 1:
                raise KeyError("spoon")
            if data == "fail together":
                raise KeyError(f"spoon of rank {comm.rank}")
            if data == "refuse" and comm.rank == 1:
                raise delam.ArgumentError("too hot")
            if isinstance(data, list):
                look(data)

        cls.raised(delam.StateError, ranks.part_nodes, "recovered")
        cls.raised(delam.ArgumentError, lambda: ranks.set_task(3 if comm.rank == 1 else task), "rank 1")
        cls.raised(delam.StateError, ranks.everywhere, "rank 0")
        ranks.set_task(task)

        def work():
            cls.raised(delam.petsc.WorkError, lambda: ranks.everywhere("fail"), "KeyError", "spoon")
            error = cls.raised(delam.petsc.WorkError, lambda: ranks.everywhere("fail together"), "spoon of rank 0")
            assert isinstance(error.__cause__, KeyError)
            cls.raised(delam.ArgumentError, lambda: ranks.everywhere("refuse"), "too hot")
            cls.raised(delam.ArgumentError, lambda: ranks.part_field("spoon"), "spoon")
            solver = made[0]
            ranks.recover(solver)
            names = ["displacement", "stress", "rotation", "force"]
            ranks.everywhere(names)
            for name in names[:3]:
                own = solver.field(name).reshape(len(seen[name]), -1)
                assert np.abs(seen[name] - own).max() <= 1e-12 * np.abs(own).max(), name
            # A solver that the ranks do not solve for.
            other = delam.Solver(support.double_cantilever(4))
            cls.raised(delam.StateError, lambda: ranks.recover(other), "engine")
            # In equilibrium the nodal forces of the bodies are those of supports and interfaces, which add up to 0.
            assert np.abs(seen["force"].sum(axis=0)).max() <= 1e-7 * np.abs(seen["force"]).max()
        ranks.run(work)

        # What leaves the work after a task is the same on all ranks; whoever has the original has it as the cause.
        for data, having in (("fail", (1,)), ("fail together", (0, 1))):
            error = cls.raised(delam.petsc.WorkError, lambda data=data: ranks.run(lambda: ranks.everywhere(data)),
                               "KeyError", "spoon")
            assert isinstance(error.__cause__, KeyError) == (comm.rank in having), data
        cls.raised(delam.ArgumentError, lambda: ranks.run(lambda: ranks.everywhere("refuse")), "too hot")

        # The cause belongs to the task that failed last, not to one that rank 0 has dealt with.
        def goes_on():
            cls.raised(delam.petsc.WorkError, lambda: ranks.everywhere("fail"))
            raise ValueError("fork")
        error = cls.raised(delam.petsc.WorkError, lambda: ranks.run(goes_on), "ValueError", "fork")
        assert isinstance(error.__cause__, ValueError) == (comm.rank == 0)

    @classmethod
    def march(cls, comm):
        """The cells of rank 0's mesh on all ranks, against the library alone; then solvers without their ranks."""
        import delam
        import delam.petsc
        first = comm.rank == 0
        problem, own = None, None
        times = [0.25, 0.5, 0.75, 1.0]
        if first:
            problem = support.double_cantilever(20)
            problem.options["kinematics"] = "linear"  # as the ranks have them
            own = delam.Solver(problem).history(times)["reaction:opening"]
        with delam.petsc.Ranks(comm) as ranks:
            ranks.take_scene(problem.mesh if first else None, problem)
            ranks.attach(problem)

            def march():
                solver = delam.Solver(problem)
                return solver, solver.history(times)["reaction:opening"]
            made = ranks.run(march)
            cls.fields(comm, ranks, made)
            assert ranks.value("solves") > 0.0
            if first:
                worst = abs(made[1] - own).max() / abs(own).max()
                assert worst < 1e-7, worst
                cls.raised(delam.StateError, lambda: made[0].advance(1.25))
            # Of parts that are others now: the reason is libdelam's.
            ranks.take_scene(problem.mesh if first else None, problem)
            cls.raised(delam.StateError, lambda: ranks.run(lambda: ranks.recover(made[0])), "cannot be recovered",
                       "parts have changed")
        if first:
            cls.raised(delam.StateError, lambda: made[0].advance(1.25))


@unittest.skipIf(shutil.which("mpirun") is None, "mpirun is not there")
@unittest.skipIf(importlib.util.find_spec("mpi4py") is None, "mpi4py is not there")
@unittest.skipUnless(libraries(), "libdelam-petsc is not built")
class OnTwoRanks(unittest.TestCase):
    def on_ranks(self, part):
        told = subprocess.run(["mpirun", "--version"], capture_output=True, text=True, check=False).stdout
        options = ["--allow-run-as-root", "--oversubscribe"] if "Open MPI" in told or "OpenRTE" in told else []
        done = subprocess.run(["mpirun", *options, "-n", "2", sys.executable, "-m", "mpi4py", __file__, part],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(done.stdout.count(f"{part}: done"), 2, done.stdout + done.stderr)

    def test_errors_reach_all_ranks(self):
        self.on_ranks("errors")

    def test_cells_of_rank_0(self):
        self.on_ranks("march")


if __name__ == "__main__":
    if sys.argv[1:] in (["errors"], ["march"]):
        from mpi4py import MPI
        getattr(Parts, sys.argv[1])(MPI.COMM_WORLD)
        print(f"{sys.argv[1]}: done", flush=True)
    else:
        support.main()
