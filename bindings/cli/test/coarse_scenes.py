# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of examples/ at a size that takes seconds, and what has to hold of their results: a new scene is a row of COARSE."""
import csv
import json
import os

import h5py
import numpy as np

from support import delam, expect, folder


class Run:
    """A result: `history` by column, `about` is result.json, `fields()` the open fields.h5."""

    def __init__(self, out):
        self.out = out
        with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        self.history = {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])
                        if name not in ("solution", "mixity_rule")}
        with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
            self.about = json.load(file)

    def fields(self):
        return h5py.File(os.path.join(self.out, "fields.h5"), "r")


def coarse_run(scene, settings):
    """None, and a failure noted, where the analysis does not come to its end with every step converged."""
    out = os.path.join(folder(), "result")
    words = [word for setting in settings for word in ("--set", setting)]
    code, _, error = delam("run", scene, "--out", out, *words)
    # Of the progress only what says how it ended.
    expect(code == 0, f"{os.path.basename(scene)} runs, every step converged {error.strip().splitlines()[-3:] if code else ''}")
    return Run(out) if code == 0 else None


def last_step(file):
    return file["steps"][sorted(file["steps"])[-1]]


def sound(name, run):
    """Of every scene: energies within their bounds, no energy out of nothing, damage that only grows."""
    h = run.history
    size = max(np.abs(h["stored_bulk"]).max(), np.abs(h["work"]).max())
    # A jump, or pairs that pop, bring the energy below the lower bound by what they release.
    freed = np.where(h["jumps"] > 0, h["released"], h.get("popped", 0))
    expect(np.all(h["lower"] <= h["increment_lower"] + freed + 1e-3 * size) and
           np.all(h["increment"] + freed <= h["upper"] + 1e-3 * size), f"{name}: the two-sided estimate holds")
    stored = h["stored_bulk"] + h["stored_interface"] + h.get("load_potential", 0)
    gain = (stored - stored[0] + h["dissipated"] - h["work"]).max() / size
    expect(gain < 0.01, f"{name}: no more is stored and dissipated than work was done: excess {gain:.1e} of the work")
    expect(np.all(np.diff(h["dissipated"]) >= -1e-9 * size), f"{name}: dissipated energy never falls")


def grows(name, run):
    """A crack that advances while the load is on."""
    h = run.history
    start, end = h["crack_length"][0], h["crack_length"][-1]
    expect(end > 1.05 * start and h["dissipated"][-1] > 0.1 * h["work"][-1],
           f"{name}: the crack grows, {start:.4g} to {end:.4g}")


def softens(name, run):
    """The load passes a peak and falls from it."""
    reaction = run.history["reaction"]
    peak = int(reaction.argmax())
    expect(0 < peak < len(reaction) - 1 and reaction[-1] < 0.9 * reaction[peak],
           f"{name}: peak {reaction[peak]:.4g} in step {peak}, {reaction[-1]:.4g} at the end")


def pays_its_toughness(name, run):
    """A crack that grows steadily in mode I: at the front the toughness is released, and growth dissipates it."""
    h = run.history
    growing = h["crack_length"] > 1.1 * h["crack_length"][0]
    rates, toughness = h["energy_release_rate"][growing], 0.25
    spent = np.ptp(h["dissipated"][growing]) / np.ptp(h["crack_length"][growing])
    expect(growing.sum() > 20 and np.abs(rates / toughness - 1).max() < 0.05 and abs(spent / toughness - 1) < 0.01,
           f"{name}: rates {rates.min():.4g} to {rates.max():.4g}, dissipated {spent:.4g} per area, toughness {toughness}")


def mirrored(name, run):
    """Equal arms pulled apart: displacements are mirrored about the interface."""
    with run.fields() as file:
        x, u = file["mesh/points"][()], last_step(file)["displacement"][()]
        up = 1 if run.about["scene"]["dimension"] == 2 else 2
        body = np.zeros(len(x), dtype=int)
        cells, of = file["mesh/cells"][()], file["mesh/body"][()]
        body[cells[of == 1].ravel()] = 1
    flip = np.array([-1.0 if i == up else 1.0 for i in range(3)])
    middle = x[body == 1][:, up].min()
    lower, upper = np.flatnonzero(body == 0), np.flatnonzero(body == 1)
    seen = x[lower] * flip
    seen[:, up] += 2 * middle
    # The same order on both sides, by rounded place.
    key = np.round(1e9 * seen).astype(np.int64), np.round(1e9 * x[upper]).astype(np.int64)
    first, second = lower[np.lexsort(key[0].T)], upper[np.lexsort(key[1].T)]
    worst = np.abs(u[first] * flip - u[second]).max() / np.abs(u).max()
    expect(worst < 1e-6, f"{name}: the arms mirror each other, to {worst:.1e} of the largest displacement")


def both_open(name, run):
    """Two delaminations: both grow, and what lies between them touches where a crack is shut."""
    with run.fields() as file:
        first, last = file["steps"][sorted(file["steps"])[0]], last_step(file)
        for interface in sorted(file["interfaces"]):
            weights = file["interfaces"][interface]["weights"][()]
            before, after = ((weights * (1 - step[interface]["zeta"][()])).sum() for step in (first, last))
            expect(after > before + 0.01, f"{name}: {interface} loses {after - before:.3g} of adhesion")
            gap = last[interface]["jump"][()][:, 0]
            expect(gap.min() >= -1e-9, f"{name}: {interface} does not overlap, gap >= {gap.min():.1e}")
    expect(run.history["contact_pairs"].max() > 10, f"{name}: shut cracks touch")


def front_of(run, interface="interface_0", time=np.inf):
    """The front of the last step up to a time as x over y, [points][2], sorted by y; None where there is none."""
    with run.fields() as file:
        group = [file["steps"][step] for step in sorted(file["steps"])
                 if file["steps"][step].attrs["time"] <= time + 1e-9][-1][interface]
        if "front_points" not in group:
            return None
        points = group["front_points"][()][:, :2]
    return points[np.argsort(points[:, 1])]


def ahead_in_the_middle(name, run):
    """The front in space: ahead at mid-width (y = 0), behind at the free edge."""
    front = front_of(run)
    bow = front[0, 0] - front[-1, 0]
    expect(bow > 1e-3 and front[:, 0].argmax() < len(front) // 2, f"{name}: at mid-width the front is ahead by {bow:.3g}")


def plateau(name, run):
    """The moment between the noses is constant, so the load is while the crack grows: beam theory of two arms, plane strain."""
    young, depth, toughness, arm = 161e9 / (1 - 0.32 ** 2 * 11.38 / 161), 0.002, 774.0, 0.02
    exact = 2 / arm * np.sqrt(4 * young * depth ** 3 * toughness / 9)
    h = run.history
    flat = h["reaction"][(h["crack_length"] > 0.045) & (h["crack_length"] < 0.070)]
    expect(len(flat) > 3 and np.abs(flat / exact - 1).max() < 0.015,
           f"{name}: {len(flat)} loads {flat.min():.5g} to {flat.max():.5g} on the plateau, beam theory {exact:.5g}")


def half_and_half(name, run):
    """The lever sets the mixity: half of the energy in each mode, and the toughness that the criterion has for it."""
    h = run.history
    growing = (h["crack_length"] > 0.036) & (h["crack_length"] < 0.046)
    mixity, rate = h["front_mixity"][growing], h["energy_release_rate"][growing]
    criterion = 212 + (774 - 212) * mixity ** 2.1
    expect(growing.sum() > 2 and np.abs(mixity - 0.5).max() < 0.03, f"{name}: mixity {mixity}")
    expect(np.abs(rate / criterion - 1).max() < 0.06, f"{name}: energy release rates {rate}, criterion {criterion}")


def loses_stiffness(name, run):
    """Fibres come off: what carries the load is softer in the end."""
    h = run.history
    secant = h["reaction"][1:] / h["load"][1:]
    expect(secant[-1] < 0.7 * secant[0] and h["debonded_length"][-1] > 0, f"{name}: secant stiffness {secant[-1] / secant[0]:.2f} of the first")


def peels_when_pulled(name, run):
    """Cured, the grips at rest hold tension; pulled, plies separate and the laminate becomes softer."""
    h = run.history
    time, load, reaction = h["time"], h["load_pull"], h["reaction_pull"]
    cured = int(np.argmin(abs(time - 1.0)))
    first = (reaction[cured + 1] - reaction[cured]) / (load[cured + 1] - load[cured])
    last = (reaction[-1] - reaction[-2]) / (load[-1] - load[-2])
    expect(reaction[cured] > 0 and h["dissipated"][cured] < 1e-2 * h["dissipated"][-1], f"{name}: whole after the cure")
    expect(h["debonded_length"][-1] > 0 and last < 0.98 * first, f"{name}: stiffness falls to {last / first:.3f} of the first")


def nearly_straight(name, run):
    """Shearing arms with fibres along them: on the way to mid-span ahead at mid-width, by less than a cell."""
    front = front_of(run, time=0.5)
    bow = front[0, 0] - front[-1, 0]
    expect(0 < bow < 1.5e-3 and front[0, 0] > 0.0393, f"{name}: at mid-width the front is ahead by {bow:.3g}")


def load_of_lamination_theory(name, run):
    """A layer off a cut one: the load of the growth by lamination theory, strains of the cure included (see the scene)."""
    first, second, misfit, toughness = 0.0005 * 126e9, 0.001 * 11e9, 27e-6 * 150, 600.0
    exact = np.sqrt(2 * toughness * first * (first + second) / second) - first * misfit
    h = run.history
    growing = (h["crack_length"] > 0.008) & (h["crack_length"] < 0.024)
    loads = h["reaction_pull"][growing]
    expect(growing.sum() > 3 and np.abs(loads / exact - 1).max() < 0.01,
           f"{name}: {growing.sum()} loads {loads.min():.5g} to {loads.max():.5g}, lamination theory {exact:.5g}")
    # Cooled: in equilibrium, the cut layer in tension where it holds.
    cooled = int(np.argmin(np.abs(h["time"] - 1.0)))
    cut, whole = h["stress_xx:ninety"][cooled], h["stress_xx:zero"][cooled]
    expect(cut > 20e6 and abs(0.001 * cut + 0.0005 * whole - h["reaction_pull"][cooled]) < 0.02 * 0.001 * cut,
           f"{name}: after the cure {cut:.4g} in the cut layer, {whole:.4g} in the other")


def from_the_free_edge(name, run):
    """All of the free edge (y = 0) comes off, nothing at mid-width; before that the crack is ahead at the flaw (x = 0)."""
    with run.fields() as file:
        y = file["interfaces/interface_0/points"][:, 1]
        last = last_step(file)["interface_0"]
        zeta, opening = last["zeta"][()], last["jump"][:, 0]
    edge, middle = y < 1e-9, y > y.max() - 1e-9
    expect(zeta[edge].max() < 0.01 and zeta[middle].min() > 0.99, f"{name}: off at the edge, on at mid-width")
    expect(opening[edge].min() > 1e-6 and opening.min() > -1e-9, f"{name}: the edge opens by {opening[edge].min():.2g}")
    front = front_of(run, time=2.4)
    ahead = front[front[:, 0].argmin(), 1] - front[front[:, 0].argmax(), 1]
    expect(ahead > 2e-4, f"{name}: ahead at the flaw by {ahead:.2g}")


def yarns_come_off(name, run):
    """A weave pulled along its warp: softer in the end, most of each yarn is off, not where yarns press on each other."""
    secant = run.history["cell_stress_xx"][1:] / run.history["cell_strain_xx"][1:]
    expect(secant[-1] < 0.9 * secant[0], f"{name}: secant stiffness {secant[-1] / secant[0]:.2f} of the first")
    with run.fields() as file:
        for interface in file["interfaces"]:
            zeta = last_step(file)[interface]["zeta"][()]
            off = (zeta < 0.5).mean()
            expect(0.3 < off < 1.0 and zeta.max() > 0.9, f"{name}: {interface}: {off:.2f} of its pairs are off")


def resolved(name, run):
    """While the crack runs, beyond the peak, at least three pairs lie in its process zone."""
    h = run.history
    running = h["process_zone_pairs"][int(h["reaction"].argmax()):]
    expect(running.min() >= 3, f"{name}: {running.min():.0f} to {running.max():.0f} pairs in the process zone")


def published(name, run, width, points):
    """Loads on the specimen, N, at openings per arm, mm: (opening, load, relative tolerance)."""
    h = run.history
    opening, load = 1e3 * h["load"], 0.5 * width * h["reaction"]
    for at, reference, tolerance in points:
        found = float(np.interp(at, opening, load))
        expect(abs(found / reference - 1) <= tolerance,
               f"{name}: {found:.2f} N at {at} mm, published {reference} N, {100 * (found / reference - 1):+.1f} %")
    return load.max(), opening[load.argmax()]


def as_alfano_and_crisfield(name, run):
    """The peak between 3 % below the vendor's target and 3 % above what is read off the paper's plot, the points as they are read."""
    peak, at = published(name, run, 0.020, [(w, p, 2.0 / p) for w, p in ((2.0, 44.0), (3.0, 35.0), (4.0, 30.5))])
    expect(58.2 <= peak <= 63.3 and 0.9 <= at <= 1.1, f"{name}: peak {peak:.2f} N at {at:.3f} mm, published 60.0 to 61.5 N at 1.0 mm")


def as_krueger(name, run):
    """The points lie on both sides of the peak of the cohesive solution, which the finite strength rounds."""
    loads = {0.750: 60.7, 0.794: 58.8, 0.842: 57.3, 0.890: 55.6, 0.942: 54.2, 1.001: 52.5, 1.274: 46.7}
    peak, at = published(name, run, 0.025, [(w, p, 0.03) for w, p in loads.items()])
    expect(abs(peak / 60.7 - 1) <= 0.03, f"{name}: peak {peak:.2f} N at {at:.3f} mm, published 60.7 N at 0.750 mm")
    fronts = np.interp([0.794, 0.842, 0.890, 0.942, 1.001, 1.274], 1e3 * run.history["load"], 1e3 * run.history["crack_length"])
    off = np.abs(fronts - [31, 32, 33, 34, 35, 40]).max()
    expect(off < 0.5, f"{name}: fronts {np.round(fronts, 2)} mm, published 31, 32, 33, 34, 35, 40 mm")


def elastica(points):
    """Forces at displacements, from a shooting method for inextensible beams: (displacement, force, relative tolerance)."""
    def check(name, run):
        h = run.history
        for at, reference, tolerance in points:
            found = float(np.interp(at, h["load"], h["reaction"]))
            expect(abs(found / reference - 1) <= tolerance,
                   f"{name}: {found:.2f} at {at}, elastica {reference}, {100 * (found / reference - 1):+.2f} %")
    return check


def blisters(name, run):
    """Flat up to the critical strain, then on the branch that leaves it, and no growth before that of a clamped blister."""
    h, length = run.history, 0.054
    steps = np.flatnonzero(h["buckling_modes"])
    critical = h["buckling_time"][steps[0]] * h["load"][-1] / h["time"][-1] / length
    expect(len(steps) == 1 and abs(critical / 9.139e-4 - 1) < 0.03, f"{name}: buckles in steps {steps} at {critical:.4g}")
    stored = h["stored_bulk"] + h["stored_interface"]
    open_by = np.abs(stored + h["dissipated"] + np.cumsum(h["released"]) - h["work"]).max()
    expect(open_by < 1e-3 * h["work"].max(), f"{name}: the balance is open by {open_by:.3g}")
    grown = np.interp([0.97 * 2.793e-3, 1.03 * 2.793e-3], h["load"] / length, h["dissipated"]) / 200.0
    expect(grown[0] < 1.5e-3 and grown[1] > 5e-3, f"{name}: grown by {grown} m about the strain of growth")


def turns_and_fails(name, run):
    """A lap joint: softened at both edges, it fails at once under twice the load of small rotations; then both sheets are free."""
    h = run.history
    jump = int(np.flatnonzero(h["jumps"])[0])
    peak = h["reaction"][jump - 1]
    expect(h["jumps"].sum() == 1 and abs(peak / 406 - 1) < 0.02, f"{name}: a load of {peak:.4g} before it fails")
    expect(np.abs(h["reaction"][jump:]).max() < 1e-6 * peak and h["stored_bulk"][-1] < 1e-9 * h["work"][-1],
           f"{name}: no force and no energy in free sheets")
    with run.fields() as file:
        shown = [step for step in sorted(file["steps"]) if file["steps"][step].attrs["step"] < jump][-1]
        zeta = file["steps"][shown]["interface_0"]["zeta"][()]
        x = file["interfaces/interface_0/points"][:, 0]
    order = np.argsort(x)
    expect(zeta[order][[0, -1]].max() < 0.2 and zeta[order][len(x) // 2] > 0.99, f"{name}: soft at both edges, whole between them")
    expect(np.abs(zeta[order] - zeta[order[::-1]]).max() < 1e-2, f"{name}: both edges are alike")


def buckles_in_space(name, run):
    """A round sheet: flat up to the strain at which a clamped plate buckles, and growth on both axes only far beyond it."""
    h, length = run.history, 0.024
    steps = np.flatnonzero(h["buckling_modes"])
    critical = h["buckling_time"][steps[0]] * h["load"][-1] / h["time"][-1] / length
    expect(len(steps) == 1 and abs(critical / 9.339e-4 - 1) < 0.02, f"{name}: buckles in steps {steps} at {critical:.4g}")
    strain, area = h["load"] / length, h["crack_area"]
    off = np.abs(h["stored_bulk"] + h["stored_interface"] + h["dissipated"] + np.cumsum(h["released"]) - h["work"]).max()
    expect(off < 1e-3 * h["work"].max(), f"{name}: the balance is open by {off:.3g}")
    expect(h["debonded_length"][strain < 2e-3].max() == 0 and area[-1] > 1.1 * area[0],
           f"{name}: the delamination grows from {area[0]:.4g} to {area[-1]:.4g}")
    front = front_of(run)
    expect(front[0, 0] > 0.0165 and front[-1, 1] > 0.0165, f"{name}: the front is at x = {front[0, 0]:.4g}, y = {front[-1, 1]:.4g}")


def shortened(length, divisions):
    """A cantilever clamped closer to the crack, which never comes near the clamp: cells as small as those of the whole one."""
    return [f"geometry.length={length}", f"geometry.divisions={divisions}", f"supports[0].box.lower=[{length}, 0.0]",
            f"supports[0].box.upper=[{length}, 0.003]"]


def scene_file(examples, name):
    """The scene of a folder of examples/, or its deck of Abaqus."""
    scene = os.path.join(examples, name, name)
    return scene + (".toml" if os.path.exists(scene + ".toml") else ".inp")


# Scene: settings of its coarse size, and what must hold of its result besides `sound`.
COARSE = {
    "dcb-alfano": ([*shortened(0.075, 750), "time.steps=50"], [grows, softens, mirrored, resolved, as_alfano_and_crisfield]),
    "dcb-krueger": ([*shortened(0.050, 1000), "time.steps=35"], [grows, softens, mirrored, resolved, as_krueger]),
    # A pair that comes apart takes 0.9 % off the force.
    "dcb-elastica": ([], [grows, softens, mirrored,
                         elastica([(0.02, 988.58, 7e-3), (0.025, 895.58, 5e-3), (0.03, 828.20, 5e-3)])]),
    "peel": (["time.end=0.667", "time.steps=40"], [grows, elastica([(0.005, 582.69, 1e-2), (0.01, 511.68, 1e-2)])]),
    "blister": ([], [blisters]),
    "lap-joint": ([], [turns_and_fails]),
    "dcb-abaqus": ([], [grows, softens, mirrored, pays_its_toughness]),
    "dcb-double": (["geometry.divisions=120"], [grows, softens, both_open]),
    "dcb-3d": (["geometry.divisions=[40, 6]", "time.steps=28"], [grows, softens, mirrored, ahead_in_the_middle]),
    "enf-3d": (["geometry.divisions=[68, 6]", "time.steps=20"], [grows, nearly_straight]),
    "4enf": (["geometry.divisions=200", "time.steps=44"], [grows, plateau]),
    "mmb": (["geometry.divisions=400", "time.steps=40"], [grows, half_and_half]),
    "fibre": (["mesh.cells_around=48", "time.steps=25"], [loses_stiffness]),
    "fibres-30": (["mesh.fibres=6", "mesh.cells_around=16", "time.steps=12"], [loses_stiffness]),
    "laminate-thermal": ([], [grows, load_of_lamination_theory]),
    "laminate-edge": (["geometry.divisions=[16, 8]", "layers[0].divisions=2", "layers[1].divisions=2", "time.steps=20"],
                      [from_the_free_edge]),
    "laminate-enf": (["geometry.divisions=[97, 3]", "time.steps=20"], [grows]),
    "laminate-dcb": (["geometry.divisions=[97, 3]", "time.steps=20"], [grows, softens, mirrored]),
    "buckling-laminate": ([], [buckles_in_space]),
    "laminate-8": (["geometry.divisions=[10, 6]", "time.steps=20"], [peels_when_pulled]),
    "weave": (["mesh.h=0.6e-3", 'mesh.cell="tet4"', "time.steps=5"], [yarns_come_off]),
}
# Stiff and coarse: its avalanches begin with steps below rounding. The long tier has as many cells in a layer as the scene.
STIFF = ("dcb-alfano", ["geometry.divisions=400", "time.steps=50"], [grows, softens, mirrored])
