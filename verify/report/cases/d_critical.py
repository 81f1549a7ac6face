# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (d): a long step through softening with several critical states, by the Python package: where each way of minimising ends, beside the
energetic search, and how a process zone of several pairs leaves one state only."""
import logging
import types

import numpy as np

from case import LEDGER_VALUES, Case, axis, check, column, ledger_of, plot, reference, result, series
from e_closed import law_of

LENGTH, ARM, COLUMNS, NOTCH, LIFT, END = 0.04, 2e-3, 40, 11.75e-3, 1.5e-3, 0.75  # m; the analysis ends at time END
# Stiffness, onset, toughness, each of opening and shear: as those of the harness.
BRITTLE = ((1e13, 2e13), (50.0, 80.0), (200.0, 400.0))
DUCTILE = ((1e12, 2e12), (10.0, 16.0), (200.0, 400.0))
DELTA = 1e-12
FETI = dict(reduction="feti", subdomains=4)
# Of the same three steps: first those that are to agree.
ALTERNATE = dict(minimisation="alternate")
LONG = (("condensed, alternating", "second", ALTERNATE), ("FETI, alternating", "feti", FETI | ALTERNATE), ("condensed, joint", "condensed", {}),
        ("FETI, joint", "feti", FETI), ("energetic search", "energetic", dict(solution="energetic")))
KEPT = (*LEDGER_VALUES, "reaction:lift", "crack_length", "damage_change", "search_gap", "process_zone_pairs", "newton_solves")


class Warnings(logging.Handler):
    """What the library says on its own."""

    def __init__(self):
        super().__init__(logging.WARNING)
        self.lines = []

    def emit(self, record):
        self.lines.append(record.getMessage())


def scene(delam, law, **options):
    mesh = delam.Mesh.layers(LENGTH, COLUMNS, [ARM, ARM], [2, 2], "quad4")
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_formulation("standard")
    problem.set_elastic(70e9, 0.3)
    problem.set_law(interface, law_of(delam, *law))
    problem.set_adhesion(interface, interface.places[:, 0] < NOTCH, 0.0)
    for direction in ("x", "y"):
        problem.prescribe(mesh.find_nodes((LENGTH, 0.0), (LENGTH, 2 * ARM)), direction)
    lift = problem.add_pattern("lift", [0.0, 1.0], [0.0, LIFT])
    problem.prescribe(mesh.find_nodes((0.0, 2 * ARM), (0.0, 2 * ARM), body=1), "y", drive=lift)
    for key, value in {"reduction": "condensed", "damage_tolerance": DELTA, **options}.items():
        problem.options[key] = value
    return problem


def analyse(delam, law, steps, **options):
    """Values at the end and before, adhesions of every step, and the warnings said on the way."""
    heard, logger = Warnings(), logging.getLogger("delam")
    logger.addHandler(heard)
    out = types.SimpleNamespace(adhesion=[], status="converged", ledger=None, values={})
    try:
        with delam.Solver(scene(delam, law, **{"mixity_rule": "frozen", **options}), not_converged="raise") as solver:
            out.ledger = delam.History(solver, LEDGER_VALUES)
            for k in range(1, steps + 1):
                try:
                    solver.advance(END * k / steps)
                except delam.NotConverged:
                    out.status = "not converged"
                solver.commit()
                out.ledger.record()
                out.adhesion.append(np.array(solver.field("adhesion")).ravel())
            values = solver.values
            out.values = {name: float(values[name]) for name in KEPT}
    finally:
        logger.removeHandler(heard)
    v = out.values
    out.stored_and_spent = v["stored_bulk"] + v["stored_interface"] + v["dissipated"]
    out.defect = (out.stored_and_spent - v["work"]) / v["work"]
    out.warnings = heard.lines
    return out


def row(name, steps, m):
    v = m.values
    return [name, steps, m.stored_and_spent, v["dissipated"], v["crack_length"] * 1e3, v["reaction:lift"], m.defect, int(v["process_zone_pairs"]), v["damage_change"], m.status]


def columns(**past):
    """past: of what dissipation enters."""
    return [column("way", key=True), column("steps", key=True), column("stored + dissipated", "J/m", **past), column("dissipated", "J/m", **past), column("crack length", "mm"), column("reaction", "N/m"),
            column("defect", "of the work", **past), column("pairs in the process zone", past="count"), column("damage change", past="rounding"), column("status")]


def warned(m):
    return any("process zone" in line for line in m.warnings)


def distance(a, b):
    """Largest difference of two states: of adhesions, and of energies, crack length and reaction relative to theirs."""
    names = ("stored_bulk", "stored_interface", "dissipated", "crack_length", "reaction:lift")
    return max(float(np.abs(a.adhesion[-1] - b.adhesion[-1]).max()), *(abs(a.values[n] - b.values[n]) / abs(b.values[n]) for n in names))


def critical_states(context):
    delam = context.python()
    long = {name: analyse(delam, BRITTLE, 3, **options) for name, _, options in LONG}
    short = {(name, n): analyse(delam, BRITTLE, n, **options) for n in (20, 100) for name, _, options in LONG if name in ("condensed, joint", "energetic search")}
    alternating, feti, joint, feti_joint, energetic = long.values()
    found = energetic.stored_and_spent
    gap = energetic.values["search_gap"]
    apart = max(float(np.abs(m.adhesion[-2] - energetic.adhesion[-2]).max()) for m in long.values())
    below = max(found - m.stored_and_spent for m in long.values())
    worst = max(m.values["damage_change"] for m in (*long.values(), *short.values()))
    checks = [check("alternating: condensed and FETI", distance(alternating, feti), 1e-9, "one way through the same states to one fixed point; what is left is the tolerance of the damage, 1e-12, over the stability of the zone"),
              check("energy of joint FETI over that of the alternating ways", feti_joint.stored_and_spent / alternating.stored_and_spent, 1, "minimising jointly ends no higher than alternating does"),
              check("Newton solves of joint FETI in the last long step", feti_joint.values["newton_solves"], 1, "the supports of the clamped end leave its zone as it is", ">="),
              check("state before the last long step, all ways", apart, 1e-9, "nothing breaks until then, so that the last step starts from one state and energies of its ends may be compared"),
              check("energy of the energetic search above the lowest of the others, same steps", below / found, 1e-9, "it keeps the lowest of the states that it has seen, and theirs are among them; rounding"),
              check("damage change of all ends", worst, DELTA, "each is a fixed point of its own damage, to damage_tolerance"),
              check("ways that did not converge", sum(m.status != "converged" for m in (*long.values(), *short.values())), 0, "limits of iterations are not met")]

    smooth = {(rule, name): analyse(delam, DUCTILE, 3, mixity_rule=rule, **options) for rule in ("frozen", "converged") for name, options in (("condensed, joint", {}), ("FETI, alternating", FETI | ALTERNATE))}
    one, other = (smooth["frozen", name] for name in ("condensed, joint", "FETI, alternating"))
    checks.append(check("zone of several pairs, frozen mixity: condensed joint and FETI alternating", distance(one, other), 1e-9, "one critical state: the way does not matter; as above"))
    near, far = (smooth["converged", name] for name in ("condensed, joint", "FETI, alternating"))
    checks.append(check("zone of several pairs, converged mixity: adhesions of the two", float(np.abs(near.adhesion[-1] - far.adhesion[-1]).max()), 1e-9, "one critical state; as above"))
    checks.append(check("zone of several pairs: damage change of all ends", max(m.values["damage_change"] for m in smooth.values()), DELTA, "as above"))

    said = next((line for line in joint.warnings if "process zone" in line), "")
    checks.append(check("warnings of a zone too short, of the long steps but the energetic", sum(warned(m) for m in (alternating, feti, joint, feti_joint)), 4, "the library says so by itself", ">="))
    checks.append(check("warnings of a zone too short, zone of several pairs", sum(warned(m) for m in smooth.values()), 0, "there is none to say"))
    e_long = joint.stored_and_spent
    split = abs(near.values["dissipated"] - far.values["dissipated"]) / far.values["dissipated"]
    losses = [f"One step through the brittle softening ends in different states: with {joint.values['crack_length'] * 1e3:.1f} mm of crack at {e_long:.4g} J/m stored and dissipated (condensed, joint: the default), with "
              f"{alternating.values['crack_length'] * 1e3:.1f} mm at {alternating.stored_and_spent:.4g} J/m (alternating), with {energetic.values['crack_length'] * 1e3:.1f} mm at {found:.4g} J/m (energetic search): each end is critical (no pair "
              f"gains by itself), the default ends {100 * (e_long / found - 1):.1f} % above the lowest known",
              f"The reason is the process zone: it is {joint.values['process_zone_pairs']:.0f} pair long, so that every set of broken pairs is critical over a range of loads. The library says so: \"{said}\"",
              f"The energetic search ends at {found:.4g} J/m; what bounds the front positions that it left out from below leaves {gap:.2g} J/m ({100 * gap / found:.1f} %) open",
              "Shorter steps end elsewhere again: " + ", ".join(f"{m.stored_and_spent:.4g} J/m ({name}, {n} steps)" for (name, n), m in short.items())
              + ": the toughness follows the mode mixity of the step before, so that another history costs another energy",
              f"With a zone of several pairs and mixity_rule = converged the two ways end at the same adhesions, but record {100 * split:.1f} % different dissipation ({near.values['dissipated']:.4g} and {far.values['dissipated']:.4g} J/m): pairs that "
              "break within the step keep the mixity of the iterate in which they broke, so that the way, down to its rounding, decides; the past does not judge these numbers"]
    if distance(joint, feti_joint) > 1e-9:
        losses.insert(1, f"Joint FETI ends at {feti_joint.stored_and_spent:.4g} J/m, another critical state than the condensed operator's: which unstable pair comes first is decided by the rounding of the linear solves")
    rows = [*(row(name, 3, m) for name, m in long.items() if m is not feti_joint), *(row(name, n, m) for (name, n), m in short.items())]
    bars = [name for name, *_ in LONG]
    plots = [plot("Energy at the end of the same three steps", axis("", bars=bars), axis("stored + dissipated", "J/m"),
                  [series("brittle law", "first", list(range(len(bars))), [long[name].stored_and_spent for name in bars])], (), "All of them start the last step from one state.")]
    return result(reference("physics", "a critical state is a fixed point of the damage at its own jumps; two alternating ways share theirs; the energetic search keeps the lowest state that it has seen",
                            "damage_tolerance, 1e-12; of the search its own gap, tabled below"),
                  tables=[{"title": "Brittle law: three long steps, and shorter ones, to 0.75 of the lift", "note": "Stored + dissipated may be compared where the step began at the same state: among the three long steps. Shorter steps have histories of their own, at 20 steps the joint one the lower. Damage change: what a further damage step would change.",
                           "columns": columns(), "rows": rows},
                          {"title": "Brittle law by joint FETI, three long steps", "note": "The condensed operator's state on most machines; rounding may choose another critical state, so that the past does not judge it.",
                           "columns": [c if "key" in c else c | {"past": "free"} for c in columns()], "rows": [row("FETI, joint", 3, feti_joint)]},
                          {"title": "Law whose process zone is several pairs long, three steps", "note": "By the two rules for the mode mixity of a step: that of the step before (frozen), or its own (converged).",
                           "columns": [column("mixity rule", key=True), *columns(past="free")], "rows": [[rule, *row(name, 3, m)] for (rule, name), m in smooth.items()]},
                          {"title": "Energetic search, long steps", "note": "", "columns": [column("quantity", key=True), column("value", "J/m")], "rows": [["stored + dissipated", found], ["search gap", gap]]}],
                  checks=checks, plots=plots, losses=losses, ledger=ledger_of({name: m.ledger for name, m in long.items() if m is not feti_joint}, "J/m"))


def cases():
    return [Case(id="d-critical-states", chapter="d", title="Several critical states in one long step", run=critical_states, quick=True, expected=5,
                 requirement="Where the process zone is one pair long, a long step has several critical states, and the way of minimising decides where it ends: every end is a fixed point of the damage, alternating ways agree to 1e-9 whichever "
                             "realisation takes them, none is lower than the energetic search in the same three steps, and the library warns. With a zone of several pairs condensed and FETI end at the same adhesions, with a frozen mixity at the same energies, too.",
                 geometry="two arms 40 mm x 2 mm, 40 x 2 cells an arm, notch of 12 mm at the loaded end, plane strain", supports="right end clamped; upper left corner lifted by 1.5 mm at time 1, analysed to 0.75; FETI with 4 subdomains",
                 materials="arms E = 70 GPa, nu = 0.3; brittle: kn = 1e13, kt = 2e13 N/m3, Go 50/80, Gc 200/400 J/m2 by mode; zone of several pairs: 1e12, 2e12, 10/16, 200/400", units="SI, per unit thickness; differences relative")]
