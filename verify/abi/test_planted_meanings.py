#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""test_planted_meanings.py SOURCE_FOLDER LIBRARY [quick]: the table of meanings is only seen at work at a break.

Each break of meaning/planted.c gives one argument, result or default another meaning, in front of the real library,
whose words about itself stay as they are. The row that BREAKS names must see it; by default the whole table runs, and
each line says which rows saw the break, with `quick` only the row named. Then breaks of the table's completeness: a new
function with an array, a new option, a default in the header that changes, a row that does not pass what it claims.
"""
import ctypes
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE]
import header as headers  # noqa: E402
import meanings  # noqa: E402
import table  # noqa: E402
from host import Missing  # noqa: E402

HASH = "hash of the defaults"
# Break -> row that must see it.
BREAKS = {
    "layers from the top": "layers",
    "tet10 as Gmsh": "connectivity of tet10",
    "hex20 with upright edges first": "connectivity of hex20",
    "quad8 from the left edge": "connectivity of quad8",
    "faces inwards": "topology of the cell types",
    "interface tolerance 0 is 1e-3": "tolerance 0 of an interface",
    "interface tolerance 0 is 2e-6": "tolerance 0 of an interface",
    "tolerance 0 of all interfaces is 1e-3": "tolerance 0 of all interfaces",
    "periodic tolerance 0 is 1e-3": "tolerance 0 of a periodic cell",
    "gap 0 is 1e-3": "gap 0 of a projected interface",
    "normals from b to a": "an interface that is found",
    "normals into the obstacle": "obstacle",
    "normals of obstacles by component": "obstacle",
    "pairs from b to a": "rows of frames",
    "bodies of an interface": "an interface that is found",
    "rows of frames": "both tangents",
    "columns of frames": "rows of frames",
    "normals last": "an interface that is found",
    "tangents everywhere": "both tangents",
    "jump and traction with the normal last": "rows of frames",
    "patches against their direction": "patch",
    "weights of patches as shares": "patch",
    "law onset_exponent_1 3": "default criterion and exponents",
    "law toughness_exponent_2 1.9": "default criterion and exponents",
    "law gradient 0.01": "gradient of a law by default",
    "law criterion": "default criterion and exponents",
    "power criterion with exponent 1": "default exponents of the power criterion",
    "exponent 1 of Benzeggagh and Kenane": "default exponents of Benzeggagh and Kenane",
    "mixity as share of mode I": "default criterion and exponents",
    "jumps with the normal last": "response of a law",
    "jumps by component": "response of a law",
    "softening table by traction": "softening table",
    "plane stress by default": "nine constants in the plane",
    "incompatible by default": "formulation by default",
    "body -1 is body 0": "materials of all bodies",
    "axes 2 and 1": "material axes",
    "axes by component": "material axes",
    "eigenstrain not doubled": "eigenstrain",
    "eigenstrain zx before yz": "eigenstrain",
    "kernel by row": "host stiffness",
    "rows of the matrix by node": "host stiffness",
    "kernel_count -1 is none": "host stiffness",
    "adhesion as damage": "initial adhesion",
    "adhesion of a box as damage": "adhesion in a box",
    "coefficients by pattern": "prescribed displacements",
    "directions of any length": "prescribed displacements",
    "means without weights": "prescribed displacements",
    "equations by component": "prescribed displacements",
    "right sides by pattern": "prescribed displacements",
    "reaction on the machine": "prescribed displacements",
    "control nodes": "periodic cell",
    "forces by component": "host stiffness",
    "columns of a body by component": "stiffness of a body",
    "half the energy of eigenstrains": "eigenstrain",
    "factors backwards": "histories",
    "histories backwards": "histories",
    "length of the zone and spacing": "process zone",
    "strengths exchanged": "proposal for a law",
    "adhesion of the last pair first": "adhesion of a displacement step",
    "adhesion NULL is 1": "adhesion of a displacement step",
    "rotation in degrees": "connectivity of hex8",
    "rotation_max in degrees": "connectivity of hex8",
    "rotation as curl": "connectivity of hex8",
    "stress zx before yz": "nine constants",
    "stress yz before xy": "nine constants",
    "stress xy before zz": "nine constants in the plane",
    "strain not doubled": "nine constants",
    "average strain zx before yz": "nine constants",
    "average stress yz before xy": "nine constants",
    "pressure positive": "rows of frames",
    "traction as force": "rows of frames",
    "field mixity as share of mode I": "mixity_rule",
    "contact as opening": "initial adhesion",
    "displacement by component": "connectivity of hex8",
    "rates of modes II and III": "crack fronts in space",
    "rates by mode": "crack fronts in the plane",
    "fronts into the crack": "crack fronts in the plane",
    "zones in pairs": "crack fronts in the plane",
    "fronts that are open": "crack fronts in space",
    "tangent with damage": "tangents",
    "patterns of the tangent backwards": "tangents",
    "sign of the step tangent": "tangents",
    "condensed loads by unknown": "condensed operator",
    "offsets by pattern": "condensed operator",
    "half the condensed stiffness": "condensed operator",
    "the record backwards": "record",
    "what a jump releases and dissipates": "jump_tolerance",
    "step -1 is the first": "looking back",
    "energies of bodies and interfaces": "values of a bar",
    "damage without its slope": "values of a bar",
    "front as zone": "values of a bar",
    "reaction of the body": "values of a bar",
    "levels of the log upside down": "callbacks of a context",
    "progress that stops nothing": "callbacks of a context",
    "commit without a step": "commit and rollback without a step",
    "a step into the past out of order": "time of a step",
    "contact that stays without adhesion": "adhesion after contact and bonds",
    "a box that only lowers": "adhesion in a box again",
    "step tangent by columns": "rows of the step tangent",
    "lists of a state in another order": "states of earlier versions",
    "old formats refused": "states of earlier versions",
    "a cancel that is forgotten": "a cancel before a call",
}
# Another default of each option, and the row that must see it.
OPTIONS = {
    "solution": "energetic", "backtracking": "on", "backtracking_limit": 50, "backtracking_depth": 500,
    "search_limit": 50000, "search_tolerance": 0.05, "step_control": "adaptive", "step_tolerance": 0.02,
    "mixity_step_tolerance": 0.01, "smallest_step": 1e-3, "jump_tolerance": 1e-2, "jump_size": 0.25,
    "damage_tolerance": 1e-4, "minimisation_limit": 4000, "backtracking_tolerance": 1e-2, "minimisation": "alternate",
    "reduction": "feti", "contact": "always", "mixity": "always", "mixity_rule": "frozen", "path_step": 0.2,
    "contact_limit": 100, "subdomains": 4, "gluing": "redundant", "preconditioner": "dirichlet",
    "scaling": "multiplicity", "linear_tolerance": 1e-12, "linear_limit": 1000, "threads": 2, "memory_limit": 1e-7,
}
ROW_OF = {"backtracking": "solution", "smallest_step": "step_control", "search_limit": HASH, "linear_limit": HASH}


def all_breaks():
    """(break, row)"""
    yield from BREAKS.items()
    for i in range(9):
        for j in range(i):
            yield f"constants {j} {i}", "nine constants"
    for key, other in OPTIONS.items():
        yield f"option {key} {other}", ROW_OF.get(key, key)


class Test:
    def __init__(self, source, library, work, quick):
        self.quick, self.work, self.failures, self.checks = quick, work, [], 0
        self.header_path = os.path.join(source, "include", "delam", "delam.h")
        self.header = headers.read(self.header_path)
        shim = os.path.join(work, "libplanted.so")
        subprocess.run(["gcc", "-std=gnu99", "-fPIC", "-shared", "-I" + os.path.join(source, "include"),
                        os.path.join(HERE, "meaning", "planted.c"), "-o", shim, "-Wl,--no-as-needed", library,
                        "-Wl,-rpath," + os.path.dirname(os.path.abspath(library)), "-ldl", "-lm"], check=True)
        self.baseline = table.read_baseline(meanings.BASELINE)
        self.shim = shim
        self.table = self.fresh()
        self.name = ctypes.c_char_p.in_dll(self.table.host.library, "planted_break")

    def fresh(self, path=None, past=False):
        return meanings.Table(path or self.shim, self.header, self.baseline, past)

    def failed(self, rows):
        """Lines of the rows that fail."""
        self.table.failures, self.table.numbers = [], {}
        self.table.rows(rows)
        return self.table.failures

    def expect(self, what, lines, message=None):
        """message: a regular expression that one of the lines must hold; None: there must be no line."""
        self.checks += 1
        if message is None and lines:
            self.failures.append(f"{what}: must pass: {lines[0]}")
        elif message is not None and not any(re.search(message, line) for line in lines):
            self.failures.append(f"{what}: nothing says '{message}': {lines[:3]}")

    # ---- meanings ----
    def meanings(self):
        rows = table.ROWS
        self.expect("no break", self.failed(rows))
        for what, named in all_breaks():
            self.name.value = what.encode()
            lines = self.failed([row for row in rows if row.name == named or not self.quick])
            self.name.value = None
            seen = sorted({row.name for row in rows for line in lines if line.startswith(row.name + ": ")})
            if not self.quick:
                print(f"{what}: seen by {', '.join(seen) or 'nothing'}")
            self.expect(what, lines, "^" + re.escape(named) + ": ")
        self.expect("no break any more", self.failed(rows))

    # ---- completeness ----
    def gaps(self, edit=None, rows=None):
        header = self.header
        if edit is not None:
            with open(self.header_path, encoding="utf-8") as file:
                text = file.read()
            changed = edit(text)
            if changed == text:
                self.failures.append("an edit of the header changes nothing")
            path = os.path.join(self.work, "delam.h")
            with open(path, "w", encoding="utf-8") as file:
                file.write(changed)
            header = headers.read(path)
        host = meanings.Host(header, self.table.host.library)
        return list(meanings.gaps(header, host, table.ROWS if rows is None else rows))

    def completeness(self):
        self.expect("the table is complete", self.gaps())
        declared = ("/* Twists a mesh by angles: [count].\n"
                    " * [unit angles rad finite; null none; status argument; since 0.2] */\n"
                    "DELAM_API int32_t delam_mesh_twist(delam_mesh *mesh, int64_t count, const double *angles);\n")
        self.expect("a new function", self.gaps(lambda text: text.replace("/* Destroys a mesh;", declared +
                                                                          "/* Destroys a mesh;", 1)),
                    "^delam_mesh_twist: angles: no row of the table")
        self.expect("another default in words",
                    self.gaps(lambda text: text.replace("0 selects 1e-6", "0 selects 1e-3")),
                    "^delam_mesh_add_interface: .*0 selects 1e-3.* no row of the table")
        self.expect("a default in words that is gone",
                    self.gaps(lambda text: text.replace("0 selects 1e-6", "the least is 1e-6")),
                    "^'mesh_add_interface: 0 selects 1e-6': in the table, not in the header")
        called = ("/* Told of heat.\n * [null user; status -; thread call's; since 0.2] */\n"
                  "typedef void (*delam_heat_callback)(int32_t cell, void *user);\n")
        self.expect("a new callback", self.gaps(lambda text: text.replace("/* Creates a context", called +
                                                                          "/* Creates a context", 1)),
                    "^delam_heat_callback: no row of the table tells what it is given")
        self.expect("a new field", self.gaps(lambda text: text.replace(
            " *   reaction      [constraints][1]", " *   heat          [nodes][1]            F: heat\n"
            " *   reaction      [constraints][1]")), "^field heat: no row of the table")
        self.name.value = b"a new option"
        self.expect("a new option", self.gaps(), "^option patience: no row of the table observes its default")
        self.name.value = None
        without = [row for row in table.ROWS if row.name != "nine constants"]
        self.expect("a row that is gone", self.gaps(rows=without),
                    "^delam_problem_set_orthotropic: constants: no row of the table")
        idle = table.Row("idle", lambda host, see: None, ["problem_set_orthotropic constants"], [], [])
        self.expect("a row that claims what it does not use", self.failed([idle]),
                    "^idle: claims delam_problem_set_orthotropic constants, but does not use it")

    # ---- past releases ----
    def past(self):
        """A library without a function and without an option: left out if it is older than they are."""
        rows = [row for row in table.ROWS if row.name in ("nine constants", "gluing")]
        for version, message in ("0.0", None), ("0.1", "^nine constants: .*set_orthotropic: the library does not have"):
            old = self.fresh(past=True)
            own = old.host._function
            old.host._function = lambda name, own=own: refuse(name) if name.endswith("orthotropic") else own(name)
            old.version = lambda version=version: tuple(int(n) for n in version.split("."))
            options = old.options()
            old.options = lambda options=options: options - {"gluing"}
            old.rows(rows)
            self.expect(f"a past release {version} without a function", old.failures, message)
            self.expect(f"a past release {version} without an option", old.left_out, "^gluing: no option gluing")
        other = dict(self.baseline)
        unit, numbers = other[("nine constants", "stress")]
        other[("nine constants", "stress")] = (unit, numbers[:4] + numbers[5:3:-1])
        moved = meanings.Table(self.shim, self.header, other)
        moved.rows(rows)
        self.expect("another number in the baseline", moved.failures,
                    r"^nine constants: stress\[4\] is .*in the baseline")


def refuse(name):
    raise Missing(name)


def main():
    with tempfile.TemporaryDirectory() as work:
        test = Test(sys.argv[1], sys.argv[2], work, sys.argv[3:] == ["quick"])
        test.meanings()
        test.completeness()
        test.past()
    for failure in test.failures:
        print(failure)
    print(f"{test.checks} planted checks of meanings, {len(test.failures)} failures")
    sys.exit(1 if test.failures else 0)


if __name__ == "__main__":
    main()
