# SPDX-License-Identifier: BSD-3-Clause
"""Breaks of meaning, on the way between a host and the library: one argument, result or default means something else.
What the library says about itself stays as it is (../test_planted_meanings.py).

A break is {function: change}, and change(host, real, given) calls real(parameter=another value, ...), which returns
the status and the outputs by name.
"""
import ctypes
import math

from host import Host, Out


class PlantedHost(Host):
    planted = {}

    def call(self, short, *arguments):
        if short not in self.planted:
            return super().call(short, *arguments)
        kinds = self.shapes["delam_" + short]
        given = dict(zip((name for name, *_ in kinds), arguments))
        outs = [name for name, kind, _ in kinds if kind.endswith("out")]

        def real(**others):
            status, results = super(PlantedHost, self).call(short, *(given | others).values())
            return status, dict(zip(outs, results))

        status, told = self.planted[short](self, real, given)
        return status, list(told.values())

    def number(self, name):
        return int(self.header.constants["DELAM_" + name])

    def dimension(self, given):
        """That of a mesh or of a solver's problem."""
        if "mesh" in given:
            return self.call("mesh_size", given["mesh"], Out(), None, None, None, None)[1][0]
        return self.call("solver_field_shape", given["solver"], "displacement", -1, Out(), Out())[1][1]


# ---- changes of a call ----
def given(short, **changes):
    """Arguments on their way in: parameter=change(value, all arguments)."""
    def change(_, real, before):
        return real(**{name: turn(before[name], before) for name, turn in changes.items() if before[name] is not None})
    return {short: change}


def told(short, **changes):
    """Outputs on their way back, given the arguments, too, and the dimension "d"."""
    def change(host, real, before):
        status, after = real()
        known = {**before, **after, "d": host.dimension(before) if {"mesh", "solver"} & set(before) else 0}
        for name, turn in changes.items():
            if status == 0 and after[name] is not None:
                after[name] = turn(after[name], known)
        return status, after
    return {short: change}


def exchanged(short, *pairs):
    """Pairs of parameters, of both arguments or both outputs."""
    def change(_, real, before):
        ways = [way for a, b in pairs for way in ((a, b), (b, a))]
        status, after = real(**{a: before[b] for a, b in ways if not isinstance(before[b], Out)})
        return status, after | {a: after[b] for a, b in ways if b in after}
    return {short: change}


def then(short, follows):
    """follows(host, arguments and outputs): what the library does besides."""
    def change(host, real, before):
        status, after = real()
        if status == 0:
            follows(host, before | after)
        return status, after
    return {short: change}


def answer(short, said, instead):
    """Another status."""
    def change(host, real, _):
        status, after = real()
        return host.number(instead) if status == host.number(said) else status, after
    return {short: change}


def field(name, turn):
    return told("solver_field", values=lambda v, g: turn(v, g) if g["key"] == name else v)


def law(key, value):
    setter = "law_set_text" if isinstance(value, str) else "law_set"
    return then("law_create", lambda host, g: host.status(setter, g["out"], key, value))


def law_text(word, key, value):
    return then("law_set_text", lambda host, g: g["value"] == word and host.status("law_set", g["law"], key, value))


def option(key, value):
    """The default of an option, its text kept."""
    setter = "problem_set_text" if isinstance(value, str) else "problem_set_number"
    return then("problem_create", lambda host, g: host.status(setter, g["out"], key, value))


def nodes_as(cell_type, order):
    """The nodes of a single cell."""
    def change(host, real, before):
        nodes = before["connectivity"]
        if before["cell_type"] == host.number(cell_type) and before["cell_count"] == 1:
            nodes = [nodes[i] for i in order]
        return real(connectivity=nodes)
    return {"mesh_add_cells": change}


# ---- changes of numbers: (value, all arguments) ----
def of(text):
    return lambda g: g[text]


def by(columns):
    """[rows][columns] as [columns][rows]. columns: a number, or one of all arguments."""
    def turn(v, g):
        n = columns(g) if callable(columns) else columns
        return [v[i] for j in range(n) for i in range(j, len(v), n)]
    return turn


def swap(i, j, width=None, only=None):
    """Two entries, of each row of so many; only: in this dimension. -1 is the last of a row."""
    def turn(v, g):
        n = width(g) if callable(width) else width or len(v)
        if only not in (None, g.get("d")):
            return v
        v = list(v)
        for at in range(0, len(v) - n + 1, n):
            a, b = at + i % n, at + j % n
            v[a], v[b] = v[b], v[a]
        return v
    return turn


def blocks(v, width, order):
    """Rows of so many numbers, in another order."""
    return [number for i in order for number in v[i * width:(i + 1) * width]]


def each(turn):
    """of single numbers or of all of an array"""
    return lambda v, g: [turn(n) for n in v] if isinstance(v, list | tuple) else turn(v)


def frames(order):
    """Rows of each frame."""
    def turn(v, g):
        d = g["d"]
        return [n for at in range(0, len(v), d * d) for n in blocks(v[at:at + d * d], d, order(d))]
    return turn


def axes(turn):
    return given("problem_set_orientation",
                 axes=lambda v, g: [n for at in range(0, len(v), 6) for n in turn(v[at:at + 6], g)])


def backwards(v, _):
    return list(v)[::-1]


def default(value, of_it=0.0):
    return lambda v, g: value if v == of_it else v


def root(g):
    return math.isqrt(g["capacity"])


NEGATED, SHARE, HALF, DOUBLE = each(lambda n: -n), each(lambda n: 1 - n), each(lambda n: n / 2), each(lambda n: 2 * n)
DEGREES = each(math.degrees)
PAIRWISE = ("jump", "traction")
TANGENTS = frames(lambda d: (0, 2, 1) if d == 3 else range(d))


def callback(short, *types, turn):
    def change(host, real, before):
        own = before["callback"]
        if own is not None:
            own = ctypes.CFUNCTYPE(*types, ctypes.c_void_p)(lambda *a: turn(before["callback"], *a))
            host.kept.append(own)
        return real(callback=own)
    return {short: change}


def key_as(keys):
    return given("solver_value", key=lambda v, g: keys.get(v, v))


def value_of(key, turn):
    return told("solver_value", value=lambda v, g: turn(v, g) if g["key"].startswith(key) else v)


def only_lower():
    lowest = {}

    def turn(v, g):
        lowest[g["problem"]] = min(v, lowest.get(g["problem"], v))
        return lowest[g["problem"]]
    return given("problem_set_adhesion_box", adhesion=turn) | then("problem_create", lambda host, g: lowest.clear())


def contact_stays():
    joined = set()

    def contact(_, real, before):
        joined.add(before["problem"])
        return real()

    def law_given(host, g):
        if g["problem"] in joined:
            host.status("problem_set_adhesion_box", g["problem"], g["interface_index"], [-9.0] * 3, [9.0] * 3, 0.0, Out())
    return ({"problem_set_contact": contact} | then("problem_set_law", law_given) |
            then("problem_create", lambda host, g: joined.clear()))


def adhesion_of_none(host, real, before):
    pairs = host.call("solver_field_shape", before["solver"], "adhesion", -1, Out(), Out())[1][0]
    return real(adhesion=[1.0] * pairs if before["adhesion"] is None else before["adhesion"])


def with_damage(host, _, before):
    status, (matrix,) = host.call("solver_step_tangent", *before.values())
    return status, {"matrix": matrix}


def reordered(v, _):
    """The words of the middle half backwards, as in a format that has its lists in another order."""
    data = bytearray(v)
    if len(data) >= 40:
        first, words = len(data) // 4, len(data) // 16
        middle = [data[first + 8 * i:first + 8 * i + 8] for i in range(words)]
        data[first:first + 8 * words] = b"".join(reversed(middle))
        total = 14695981039346656037
        for byte in data[:-8]:
            total = (total ^ byte) * 1099511628211 % 2**64
        data[-8:] = total.to_bytes(8, "little")
    return list(data)


def old_refused(host, real, before):
    old = before["size"] > 8 and before["bytes"][8] < 11
    return (host.number("ERROR_SNAPSHOT"), {}) if old else real()


# Break: the row that must see it, and what it changes.
BREAKS = {
    "layers from the top": ("layers", given("mesh_create_layers", thickness=backwards)),
    "tet10 as Gmsh": ("connectivity of tet10", nodes_as("TET10", [*range(8), 9, 8])),
    "hex20 with upright edges first": ("connectivity of hex20",
                                       nodes_as("HEX20", [*range(12), *range(16, 20), *range(12, 16)])),
    "quad8 from the left edge": ("connectivity of quad8", nodes_as("QUAD8", [0, 1, 2, 3, 7, 4, 5, 6])),
    "faces inwards": ("topology of the cell types", told(
        "cell_type_topology", face=lambda v, g: swap(1, 3)(v, g) if g["index"] == 3 else v)),
    "interface tolerance 0 is 1e-3": ("tolerance 0 of an interface", given("mesh_add_interface", tolerance=default(1e-3))),
    "interface tolerance 0 is 2e-6": ("tolerance 0 of an interface", given("mesh_add_interface", tolerance=default(2e-6))),
    "tolerance 0 of all interfaces is 1e-3": ("tolerance 0 of all interfaces",
                                              given("mesh_add_all_interfaces", tolerance=default(1e-3))),
    "tolerance 0 of seams is 1e-3": ("tolerance 0 of seams", given("mesh_add_seams", tolerance=default(1e-3))),
    "half the gap of self contact": ("self contact of a slot", given("mesh_add_self_contact", gap=HALF)),
    "periodic tolerance 0 is 1e-3": ("tolerance 0 of a periodic cell",
                                     given("problem_add_periodic", tolerance=default(1e-3))),
    "gap 0 is 1e-3": ("gap 0 of a projected interface", given("mesh_add_projected_interface", gap=default(1e-3))),
    "normals from b to a": ("an interface that is found", exchanged("mesh_add_interface", ("body_a", "body_b"))),
    "normals into the obstacle": ("obstacle", given("mesh_add_obstacle", normals=NEGATED)),
    "normals of obstacles by component": ("obstacle", given("mesh_add_obstacle", normals=by(2))),
    "pairs from b to a": ("rows of frames", exchanged("mesh_add_pairs", ("body_a", "body_b"), ("nodes_a", "nodes_b"))),
    "bodies of an interface": ("an interface that is found", exchanged("mesh_interface_size", ("body_a", "body_b"))),
    "rows of frames": ("both tangents", told("mesh_interface_pairs", frames=TANGENTS)),
    "columns of frames": ("rows of frames", told("mesh_interface_pairs", frames=lambda v, g: [
        n for at in range(0, len(v), g["d"]**2) for n in by(g["d"])(v[at:at + g["d"]**2], g)])),
    "normals last": ("an interface that is found",
                     told("mesh_interface_pairs", frames=frames(lambda d: [d - 1, *range(1, d - 1), 0]))),
    "tangents everywhere": ("both tangents", told("mesh_interface_pairs", frames=TANGENTS) | told(
        "solver_field", values=lambda v, g: swap(1, 2, 3, only=3)(v, g) if g["key"] in PAIRWISE else v)),
    "jump and traction with the normal last": ("rows of frames", told(
        "solver_field", values=lambda v, g: swap(0, -1, of("d"))(v, g) if g["key"] in PAIRWISE else v)),
    "patches against their direction": ("patch", given("mesh_find_patch",
                                                       direction=lambda v, g: [-v[0], -v[1], *v[2:]])),
    "weights of patches as shares": ("patch", told("mesh_find_patch", weights=lambda v, g: [n / sum(v) for n in v])),
    "law onset_exponent_1 3": ("default criterion and exponents", law("onset_exponent_1", 3.0)),
    "law toughness_exponent_2 1.9": ("default criterion and exponents", law("toughness_exponent_2", 1.9)),
    "law gradient 0.01": ("gradient of a law by default", law("gradient", 0.01)),
    "law criterion": ("default criterion and exponents", law("criterion", "benzeggagh-kenane")),
    "power criterion with exponent 1": ("default exponents of the power criterion",
                                        law_text("power", "onset_exponent", 1.0)),
    "exponent 1 of Benzeggagh and Kenane": ("default exponents of Benzeggagh and Kenane",
                                            law_text("benzeggagh-kenane", "toughness_exponent", 1.0)),
    "mixity as share of mode I": ("default criterion and exponents", given("law_toughness", mixity=SHARE)),
    "jumps with the normal last": ("response of a law", given("law_respond", jump=swap(0, -1, of("dimension")))),
    "jumps by component": ("response of a law", given("law_respond", jump=by(of("dimension")))),
    "softening table by traction": ("softening table", given("law_set_table", xi=lambda v, g: g["s"][::-1],
                                                             s=lambda v, g: g["xi"][::-1])),
    "plane stress by default": ("nine constants in the plane", then(
        "problem_create", lambda host, g: host.status("problem_set_plane", g["out"], "plane-stress"))),
    "standard by default": ("formulation by default", then(
        "problem_create", lambda host, g: host.status("problem_set_formulation", g["out"], -1, "standard"))),
    "body -1 is body 0": ("materials of all bodies", given("problem_set_elastic", body=default(0, -1)) | given(
        "problem_set_orthotropic", body=default(0, -1)) | given("solver_average", body=default(0, -1))),
    "axes 2 and 1": ("material axes", axes(lambda v, g: blocks(v, 3, (1, 0)))),
    "axes by component": ("material axes", axes(by(3))),
    "eigenstrain not doubled": ("eigenstrain", given("problem_add_eigenstrain",
                                                     strain=lambda v, g: [*v[:3], *DOUBLE(v[3:], g)])),
    "eigenstrain zx before yz": ("eigenstrain", given("problem_add_eigenstrain", strain=swap(4, 5))),
    "gaps backwards": ("gaps", given("problem_set_gaps", gaps=backwards)),
    "gaps as overlaps": ("gaps", given("problem_set_gaps", gaps=NEGATED)),
    "gaps NULL is none": ("gaps of the mesh", {"problem_set_gaps": lambda host, real, g: real(
        gaps=[0.0, 0.0] if g["gaps"] is None else g["gaps"])}),
    "no gap is adjusted": ("gaps of the mesh", given("problem_set_gaps", adjust=each(lambda n: 0.0))),
    "kernel by row": ("host stiffness", given("problem_set_stiffness", kernel=by(lambda g: 2 * g["count"]))),
    "rows of the matrix by node": ("host stiffness", given("problem_set_stiffness", dofs=lambda v, g: None)),
    "kernel_count -1 is none": ("host stiffness", given("problem_set_stiffness", kernel_count=default(0, -1))),
    "adhesion as damage": ("initial adhesion", given("problem_set_adhesion", adhesion=SHARE)),
    "adhesion of a box as damage": ("adhesion in a box", given("problem_set_adhesion_box", adhesion=SHARE)),
    "coefficients by pattern": ("prescribed displacements",
                                given("problem_prescribe_nodes", coefficients=by(of("pattern_count")))),
    "directions of any length": ("prescribed displacements", given(
        "problem_prescribe_nodes",
        coefficients=lambda v, g: [n / max(1.0, math.hypot(*g["direction"][:2])) for n in v])),
    "means without weights": ("prescribed displacements", given("problem_prescribe_mean", weights=each(lambda n: 1.0))),
    "equations by component": ("prescribed displacements", given("problem_add_equation", coefficients=by(2))),
    "constraints that end count from 1": ("constraints that begin and end", given(
        "problem_end_constraints", first=lambda v, g: v - 1)),
    "constraints that begin count from 1": ("constraints that begin and end", given(
        "problem_begin_constraints", first=lambda v, g: v - 1)),
    "right sides by pattern": ("prescribed displacements", told("problem_constraints", coefficients=by(3))),
    "reaction on the machine": ("prescribed displacements", field("reaction", NEGATED)),
    "control nodes": ("periodic cell", given("problem_add_periodic", control_nodes=swap(0, 1))),
    "forces by component": ("host stiffness", given("problem_add_forces", forces=by(2))),
    "columns of a body by component": ("stiffness of a body", told(
        "problem_body_matrix", columns=each(lambda n: n % 2 * 4 + n // 2))),
    "half the energy of eigenstrains": ("eigenstrain", told("problem_eigenstrain_energy", matrix=HALF)),
    "factors backwards": ("histories", told("problem_factors", factors=backwards)),
    "histories backwards": ("histories", given("solver_set_history", values=backwards)),
    "length of the zone and spacing": ("process zone", exchanged("problem_process_zone", ("length", "spacing"))),
    "strengths exchanged": ("proposal for a law", exchanged("problem_propose",
                                                            ("normal_strength", "tangential_strength"))),
    "adhesion of the last pair first": ("adhesion of a displacement step",
                                        given("solver_equilibrate", adhesion=backwards)),
    "adhesion NULL is 1": ("adhesion of a displacement step", {"solver_equilibrate": adhesion_of_none}),
    "rotation in degrees": ("connectivity of hex8", field("rotation", DEGREES)),
    "rotation_max in degrees": ("connectivity of hex8", value_of("rotation_max", DEGREES)),
    "rotation as curl": ("connectivity of hex8", field("rotation", DOUBLE)),
    "stress zx before yz": ("nine constants", field("stress", swap(4, 5, 6, only=3))),
    "stress yz before xy": ("nine constants", field("stress", swap(3, 4, 6, only=3))),
    "stress xy before zz": ("nine constants in the plane", field("stress", swap(2, 3, 4, only=2))),
    "strain not doubled": ("nine constants", told("solver_average",
                                                  strain=lambda v, g: [*v[:3], *HALF(v[3:], g)])),
    "average strain zx before yz": ("nine constants", told("solver_average", strain=swap(4, 5))),
    "average stress yz before xy": ("nine constants", told("solver_average", stress=swap(3, 4))),
    "pressure positive": ("rows of frames", field("traction", NEGATED)),
    "traction as force": ("rows of frames", field("traction", HALF)),
    "field mixity as share of mode I": ("mixity_rule", field("mixity", SHARE)),
    "contact as opening": ("initial adhesion", field("contact", SHARE)),
    "displacement by component": ("connectivity of hex8", field("displacement", by(of("d")))),
    "rates of modes II and III": ("crack fronts in space", told("solver_front", rates=swap(1, 2, 3))),
    "rates by mode": ("crack fronts in the plane", told("solver_front", rates=by(3))),
    "fronts into the crack": ("crack fronts in the plane", told("solver_front", directions=NEGATED)),
    "zones in pairs": ("crack fronts in the plane", told("solver_front",
                                                         zone_lengths=lambda v, g: DOUBLE(g["zone_pairs"], g))),
    "fronts that are open": ("crack fronts in space", told("solver_front", closed=lambda v, g: [*v[:-1], 1 - v[-1]])),
    "tangent with damage": ("tangents", {"solver_tangent": with_damage}),
    "bodies that are always shared": ("bodies that solvers share", told("solver_shares_bodies", shares=lambda v, g: 1)),
    "patterns of the tangent backwards": ("tangents", told("solver_tangent", matrix=backwards)),
    "sign of the step tangent": ("tangents", told("solver_step_tangent", matrix=NEGATED)),
    "condensed loads by unknown": ("condensed operator", told("solver_condensed", load=by(root))),
    "offsets by pattern": ("condensed operator", told("solver_condensed", offset=by(3))),
    "half the condensed stiffness": ("condensed operator", told("solver_condensed", stiffness=HALF)),
    "the record backwards": ("record", told("solver_recorded", values=backwards)),
    "what a jump releases and dissipates": ("jump_tolerance", exchanged("solver_jump", ("dissipated", "released"))),
    "step -1 is the first": ("selecting earlier steps", given("solver_look", step=default(0, -1))),
    "energies of bodies and interfaces": ("values of a bar", key_as(
        {"stored_bulk": "stored_interface", "stored_interface": "stored_bulk"})),
    "damage without its slope": ("values of a bar", key_as({"dissipated": "dissipated_slides"})),
    "front as zone": ("values of a bar", key_as({"front": "process_zone"})),
    "error of a mesh as a norm": ("error of a mesh", value_of("mesh_error", each(lambda n: math.sqrt(abs(n))))),
    "error of all cells": ("error at a front", key_as({"mesh_error_fronts": "mesh_error"})),
    "excess as error": ("error of a mesh", key_as({"mesh_excess": "mesh_error"})),
    "error of cells as share": ("error of a mesh", field("mesh_error", lambda v, g: [n / max(sum(v), 1e-300) for n in v])),
    "reaction of the body": ("values of a bar", value_of("reaction:", NEGATED)),
    "levels of the log upside down": ("callbacks of a context", callback(
        "context_set_log", None, ctypes.c_int32, ctypes.c_char_p,
        turn=lambda own, level, text, user: own(2 - level, text, user))),
    "progress that stops nothing": ("callbacks of a context", callback(
        "context_set_progress", ctypes.c_int32, ctypes.c_char_p, ctypes.c_int64, ctypes.c_int64,
        turn=lambda *a: 0)),
    "commit without a step": ("commit and rollback without a step", answer("solver_commit", "ERROR_STATE", "OK")),
    "a step into the past out of order": ("time of a step", answer("solver_advance", "ERROR_ARGUMENT", "ERROR_STATE")),
    "contact that stays without adhesion": ("adhesion after contact and bonds", contact_stays()),
    "a box that only lowers": ("adhesion in a box again", only_lower()),
    "step tangent by columns": ("rows of the step tangent", told("solver_step_tangent", matrix=by(root))),
    "lists of a state in another order": ("states of earlier versions",
                                          told("solver_save", bytes=reordered) | given("solver_load", bytes=reordered)),
    "old formats refused": ("states of earlier versions", {"solver_load": old_refused}),
    "a cancel that is forgotten": ("a cancel before a call", {"context_cancel": lambda host, real, before: (0, {})}),
}
BREAKS |= {f"constants {j} {i}": ("nine constants", given("problem_set_orthotropic", constants=swap(j, i)))
           for i in range(9) for j in range(i)}
# Another default of each option, and the row that must see it.
OPTIONS = {
    "solution": "energetic", "backtracking": "on", "backtracking_limit": 50, "backtracking_depth": 500,
    "search_limit": 50000, "search_tolerance": 0.05, "step_control": "adaptive", "step_tolerance": 0.02,
    "mixity_step_tolerance": 0.01, "smallest_step": 1e-3, "jump_tolerance": 1e-2, "jump_size": 0.25,
    "damage_tolerance": 1e-4, "minimisation_limit": 4000, "backtracking_tolerance": 1e-2, "minimisation": "alternate",
    "reduction": "feti", "contact": "always", "mixity": "always", "mixity_rule": "frozen", "path_step": 0.2,
    "accuracy": 6e-3, "kinematics": "corotational",
    "contact_limit": 100, "subdomains": 4, "gluing": "redundant", "preconditioner": "dirichlet",
    "scaling": "multiplicity", "linear_tolerance": 1e-12, "linear_limit": 1000, "threads": 2, "memory_limit": 1e-7,
}
HASH = "hash of the defaults"
ROW_OF = {"backtracking": "solution", "smallest_step": "step_control", "accuracy": "path_step", "search_limit": HASH, "linear_limit": HASH}
BREAKS |= {f"option {key} {other}": (ROW_OF.get(key, key), option(key, other)) for key, other in OPTIONS.items()}
