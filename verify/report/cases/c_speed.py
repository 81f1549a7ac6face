# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (c): what a march costs beside the baseline that a competent engineer would write, and beside itself at equal error. Ratios of
interleaved measurements; absolute times only where somebody wants to know how long it took."""
import math

from bench import MACHINE_WHY, bench, middle
from case import Case, Failed, axis, check, column, figure, largest, plot, reference, result, series, table
from words import show

BASELINE = reference("direct solver",
                     "plain alternate minimisation with CHOLMOD's factorisation of the whole system whenever its matrix has changed, on the same scene, with the same "
                     "stopping test, in turns with the library (verify/bench); that it is right is the test cases/test_baseline",
                     "times: the column A/A, the ratio of two series of the same solve; results: the stopping test, 1e-5 of the adhesion")
NAMES = {"baseline": "baseline", "feti": "FETI", "condensed": "condensed", "accelerated": "accelerated"}
COSTS = "LSE: CHOLMOD's analysis, factor and one solve of the assembled system"
ENF = dict(geometry="two arms 120 mm x 3 mm, notch 30 mm, 4-node cells, plane strain", supports="bottom corners on points, midspan pressed by 6 mm in 40 steps",
           units=f"ratios; {COSTS}")
DUCTILE = "E = 75 GPa, nu = 0.3; k = 125e9 N/m3, Go = 100, Gc = 250 J/m2"
BRITTLE = "E = 75 GPa, nu = 0.3; k = 125e15 N/m3, Go = 0.01, Gc = 25 J/m2"
FREE = {"past": "free"}


def energies(difference):
    return max(difference[k] for k in ("reaction", "stored_bulk", "stored_interface", "dissipated"))


def noise(ratio):
    return max(ratio, 1.0 / ratio) - 1.0


def march_case(scene, *, quick, expected, asked, cap, shipped=False):
    """asked: linear solves at most, baseline over this at least; what was set as a goal, and is said where it is missed."""
    name = f"{scene}-shipped" if shipped else scene
    brittle = "brittle" in scene

    def run(context):
        limit = 2 if context.quick else cap
        data = bench(context, "march", "--repeat", "3", "--cap", str(limit), "--threads", "1", "--scene", scene, **({"DELAM_BENCH_AS_SHIPPED": "1"} if shipped else {}))
        found = data["scenes"][scene]
        part, memory = found["threads"]["1"], found["memory"]
        if "error" in part:
            raise Failed(f"{scene}: {part['error']}")
        lse, peak = middle(part["lse_s"]), memory["lse"]["peak_MB"]
        rows = [["one linear solve", 1.0, None, None, None, None, None, None, None, peak, "measured"]]
        losses, checks = [], []
        for key, label in NAMES.items():
            m = part["methods"][key]
            if "skipped" in m:
                rows.append([label, *[None] * 8, None, "skipped: " + m["skipped"]])
                continue
            stopped = m["label"].startswith("stopped") or "lower bound" in m["label"]
            counts = [None if stopped else m["counts"][c] for c in ("am_iterations", "active_set_steps", "bulk_factorisations")]
            rows.append([label, m["lse"], m.get("baseline_over_this"), *(middle(m[p]) / lse for p in ("setup_s", "factor_s", "iterate_s")), *counts,
                         memory.get(key, {}).get("peak_MB"), m["label"]])
            ratio = m.get("baseline_over_this")
            if ratio is not None and ratio < 1.0:
                losses.append(f"{label} takes {1.0 / ratio:.3g} times as long as the baseline")
            if m["label"].startswith("stopped"):
                losses.append(f"{label} was stopped after {limit} s without an end ({m['lse']:.3g} linear solves up to there)")
        best = part["methods"]["accelerated"]
        if "skipped" in best or best["label"].startswith("stopped"):
            raise Failed("the accelerated march did not end: " + best.get("skipped", best["label"]))
        cost, ratio = best["lse"], best["baseline_over_this"]
        priced = part["methods"]["baseline"]["label"] != "measured"
        if cost > asked[0]:
            losses.append(f"the march costs {cost:.3g} linear solves, asked for were {asked[0]}")
        if ratio < asked[1]:
            losses.append(f"the baseline takes {ratio:.3g} times as long, asked for was {asked[1]}" + (", its time priced from counted factorisations" if priced else ""))
        peaks = memory["accelerated"]["peak_MB"] / peak
        if peaks > 1.0:
            losses.append(f"the march holds {peaks:.2g} times the memory of one factorisation")
        checks += [check("baseline over the march" + (", baseline extrapolated" if priced else ""), ratio, 20.0, "tens of times is what is claimed"
                         + ("; the baseline is priced from counted factorisations, of which a part was timed" if priced else ""), ">="),
                   check("steps of the accelerated march that did not converge", best["counts"]["not_converged"], 0, "a step at its limit is no evidence")]
        pairs = part.get("agreement", {})
        agreed = [[pair, "1e-5", d["common_steps"], *(d[k] for k in ("reaction", "stored_bulk", "stored_interface", "dissipated"))] for pair, d in pairs.items()]
        tight = found.get("agreement_1e-10", {}).get("agreement", {})
        agreed += [[pair, "1e-10", d["common_steps"], *(d[k] for k in ("reaction", "stored_bulk", "stored_interface", "dissipated"))] for pair, d in tight.items()]
        if brittle:
            end = found["critical"]["methods"]["accelerated"]
            kkt = end.get("end_state_kkt")
            checks.append(check("one more damage step moves the adhesion, worst of the steps", end["damage_fixed_point_worst_of_steps"], 1e-4,
                                "ten times the stopping test, which looks at the last change: where the crack jumps, several states are critical and histories may differ"))
            if isinstance(kkt, dict):
                checks.append(check("primal KKT of the end state", kkt["worst"], 1e-8, "evaluated outside the solver from exported fields"))
        else:
            for pair in ("baseline / accelerated", "condensed / accelerated"):
                if pair in pairs and pairs[pair]["common_steps"]:
                    checks.append(check(f"agreement, {pair}, delta = 1e-5", energies(pairs[pair]), 1e-4, "ten times the stopping test"))
                if pair in tight and tight[pair]["common_steps"]:
                    checks.append(check(f"agreement, {pair}, delta = 1e-10", energies(tight[pair]), 1e-7, "the iterations end; what is left is no difference of the method"))
        over = [(r[0], r[1]) for r in rows if r[1] is not None]
        roles = {"one linear solve": "reference", "baseline": "baseline", "FETI": "feti", "condensed": "condensed", "accelerated": "accelerated"}
        history = []
        for label, key in (("baseline", "baseline"), ("condensed", "condensed"), ("accelerated", "accelerated")):
            steps = part["methods"][key].get("history", {})
            if steps.get("load") and steps.get("reaction"):
                history.append(series(label, roles[label], [1e3 * v for v in steps["load"]], steps["reaction"]))
        key = scene.removeprefix("enf-").replace("-", "_") + ("_shipped" if shipped else "")
        text = f"{'Brittle' if brittle else 'Ductile'} ENF, {scene.rsplit('-', 1)[1]} mm{', OpenMP as Debian CHOLMOD sets it' if shipped else ''}"
        held = {r[0]: r[9] / peak for r in rows if r[9] is not None}
        plots = [plot("Time and memory of the march", axis("peak memory", "of one factorisation"), axis("time", "linear solves", "log"),
                      [series(label, roles[label], [held[label]], [value], line="none") for label, value in over if label in held],
                      [{"kind": "horizontal", "value": float(asked[0]), "label": "asked for"}], "Further left and further down is better. Where the note in the table says so, the baseline is "
                      "priced from counted factorisations, and what was stopped would be higher.")]
        if history:
            plots.append(plot("What they all compute", axis("displacement of mid-span", "mm"), axis("reaction", "N/m"), history))
        return result(
            BASELINE, checks=checks, losses=losses, plots=plots,
            warnings=[f"A/A: two series of the same solve differ by {100 * noise(part['noise_floor']['ratio_of_medians']):.0f} %; smaller differences are noise."],
            tables=[table("Cost over one linear solve of the scene", [column("method", key=True), column("whole", "LSE", optional=True, **FREE), column("baseline / this", "", optional=True, **FREE),
                          *(column(n, "LSE", optional=True, **FREE) for n in ("setup", "factor", "iterate")), column("alternations", optional=True, past="count", capped=True),
                          column("active-set steps", optional=True, past="count", capped=True), column("factorisations of the bodies", optional=True, past="count", capped=True),
                          column("peak memory", "MB", optional=True, **FREE), column("note", may=True)], rows, MACHINE_WHY),
                    *([table("Agreement: largest relative difference over the common steps", [column("methods", key=True), column("delta", key=True), column("common steps", **FREE),
                             *(column(n, "relative", **FREE) for n in ("reaction", "bodies", "interface", "dissipated"))], agreed, "Where a brittle crack jumps, several states are critical: such differences are not judged." if brittle else "")] if agreed else [])],
            figures=[figure(f"speed_{key}_unknowns", part["primal_dofs"], "", f"{text}: unknowns"),
                     figure(f"speed_{key}_seconds", middle(best["total_s"]), "s", f"{text}: whole march", past="free"),
                     figure(f"speed_{key}_lse", cost, "linear solves", f"{text}: whole march in linear solves of the scene", past="free"),
                     figure(f"speed_{key}_ratio", ratio, "", f"{text}: alternate minimisation with a factorisation in every iteration, over this", past="free"),
                     figure(f"speed_{key}_noise", noise(part["noise_floor"]["ratio_of_medians"]), "", f"{text}: A/A, by how much two series of the same solve differ", past="free"),
                     figure(f"speed_{key}_memory", peaks, "", f"{text}: peak memory over that of one factorisation", past="free")])

    return Case(id=f"c-march-{name.removeprefix('enf-')}", chapter="c", title=f"March, {'brittle' if brittle else 'ductile'}, cells of {scene.rsplit('-', 1)[1]} mm"
                + (", OpenMP as shipped" if shipped else ""),
                requirement=f"A march to the same tolerance takes a twentieth of the baseline's time at most and gives the same history"
                f"{' (brittle: ends in critical points)' if brittle else ''}; asked for were {asked[0]} linear solves and {asked[1]} times the baseline.",
                materials=BRITTLE if brittle else DUCTILE, **ENF, run=run, quick=quick, timing=True, seconds=1500, expected=expected)


ELEMENTS = {"quad4": "first", "quad4-incompatible": "second", "tri6": "third", "quad8": "fourth", "quad9": "fifth"}


def equal_error(points, target):
    """Time at which the curve over the meshes has the error `target`: (time, how), log-log between two meshes."""
    points = sorted(points, key=lambda p: -p[2])
    for i, (error, seconds, h) in enumerate(points):
        if error > target:
            continue
        if i == 0:
            return seconds, f"met by the coarsest mesh, {h:g} mm: at most"
        before, time_before, h_before = points[i - 1]
        part = math.log(before / target) / math.log(before / error)
        return math.exp(math.log(time_before) * (1 - part) + math.log(seconds) * part), f"between {h_before:g} and {h:g} mm"
    return None, "not reached by these meshes"


def precision(context):
    data = bench(context, "precision", *(("--quick",) if context.quick else ("--repeat", "3")))
    source = data["reference"]
    rows = [r for r in data["rows"] if r["complete"]]
    stopped = [r for r in data["rows"] if not r["complete"]]
    fine = (source["element"], source["h_mm"])
    anchor_h = 0.5 if context.quick else 0.25
    anchor = next(r for r in rows if r["element"] == "quad4" and r["h_mm"] == anchor_h and r["steps"] == 40 and r["delta"] == 1e-5)
    unit = middle(anchor["seconds"])
    of_line = [r for r in rows if r["steps"] == 40 and r["delta"] == 1e-5 and (r["element"], r["h_mm"]) != fine]
    losses, ratios, curves, figures, checks = [], [], {}, [], []
    for what, key in (("reaction", "error_reaction_mesh"), ("dissipated energy", "error_dissipated_mesh")):
        target, own = anchor[key], source["reaction" if what == "reaction" else "dissipated"]["error_h"]
        curves[key] = []
        for name, role in ELEMENTS.items():
            points = [(r[key], middle(r["seconds"]), r["h_mm"]) for r in of_line if r["element"] == name and r[key] > 0]
            if not points:
                losses.append(f"{name}: not known to this library")
                continue
            # What is below the reference's own error tells how alike the meshes are, not how good.
            line = sorted((p for p in points if p[0] >= own), key=lambda p: p[2]) or sorted(points)[-1:]
            curves[key].append(series(name, role, [p[0] for p in line], [p[1] / unit for p in line]))
            seconds, how = equal_error(points, target)
            ratio = unit / seconds if seconds else None
            ratios.append([what, name, target, ratio, how])
            if ratio is None:
                losses.append(f"{what}: {name} does not reach the error of quad4 at {anchor_h:g} mm ({target:.2g})")
            elif ratio < 1.0 and name != "quad4":
                losses.append(f"{what}: {name} takes {1 / ratio:.3g} times as long as quad4 at equal error")
            if ratio is not None and name != "quad4":
                figures.append(figure(f"equal_error_{what.split()[0]}_{name}", ratio, "", f"Ductile ENF at the error in the {what} of 4-node cells of {anchor_h:g} mm: their time over that of "
                                      f"{name}", past="free"))
    errors = {r["delta"]: r for r in rows if r["element"] == "quad4" and r["h_mm"] == (1.0 if context.quick else 0.5) and r["steps"] == 40}
    tightest = min(errors)
    moved = max(abs(errors[d]["error_reaction"] - errors[tightest]["error_reaction"]) for d in errors if d <= 1e-3)
    for name in ("quad8", "quad9", "tri6"):
        line = {r["h_mm"]: r["error_reaction_mesh"] for r in of_line if r["element"] == name}
        if line:
            checks.append(check(f"{name} at its coarsest mesh: error of the reaction over that of quad4 at {anchor_h:g} mm", line[max(line)] / anchor["error_reaction_mesh"], 1.0,
                                "elements of second order bend: their coarsest mesh has the error of fine linear ones"))
    found = {name: {r["h_mm"]: r["error_reaction_mesh"] for r in of_line if r["element"] == name} for name in ("quad4", "quad4-incompatible")}
    shared = [h for h in found["quad4"] if h in found["quad4-incompatible"]]
    checks += [check("incompatible modes: error of the reaction over that without, same mesh", largest(found["quad4-incompatible"][h] / found["quad4"][h] for h in shared), 0.1,
                     "they bend exactly where 4-node cells are too stiff by their part of the arm, which is nearly all of the error of these"),
               check("change of the error between tolerances of 1e-3 and less", moved / errors[tightest]["error_reaction"], 1e-9,
                     "a step ends with a Newton step, exact on its piece of the law, whatever the tolerance: rounding and the march's amplification of it are left"),
               check("steps that did not converge", largest(r["counts"]["not_converged"] for r in rows), 0, "a step at its limit is no evidence")]
    if stopped:
        losses.append(f"{len(stopped)} of {len(data['rows'])} marches were stopped by the cap")
    listed = [[r["element"], r["h_mm"], r["steps"], r["delta"], r["primal_dofs"], middle(r["seconds"]) / unit, r.get("lse"), r["error_reaction"], r["error_reaction_mesh"],
               r["error_dissipated"], r["error_dissipated_mesh"]] for r in rows]
    label = f"time over that of quad4 at {anchor_h:g} mm"
    return result(
        reference("Richardson", f"the finest mesh of {source['element']} ({source['h_mm']:g} mm, {source['steps']} steps, {source['primal_dofs']} unknowns)",
                  f"of its reaction {source['reaction']['error_h']:.1e} by the mesh (observed order {source['reaction']['observed_order_h']:.2g}) and {source['reaction']['error_tau']:.1e} by the "
                  f"step; of its dissipated energy {source['dissipated']['error_h']:.1e} and {source['dissipated']['error_tau']:.1e}; errors below ten times that are said to be at least so small"),
        checks=checks, losses=losses, figures=figures,
        tables=[table(f"At equal error: that of quad4 at {anchor_h:g} mm, 40 steps, mesh alone", [column("error of", key=True), column("element", key=True), column("target", "relative", past=1e-4),
                      column("quad4 / this", "time", optional=True, **FREE), column("how", **FREE)], ratios, MACHINE_WHY),
                table("All marches", [column("element", key=True), column("h", "mm", key=True), column("steps", key=True), column("delta", key=True), column("unknowns"),
                      column("time", "of quad4's", **FREE), column("march", "LSE", optional=True, **FREE), *(column(n, "relative L1", past=1e-2) for n in ("reaction", "reaction, mesh alone", "dissipated")),
                      column("dissipated, mesh alone", "relative L1", past="free")], listed)],
        plots=[plot("Work against precision: reaction", axis("error of the reaction, mesh alone", "relative", "log"), axis("time", label, "log"), curves["error_reaction_mesh"],
                    [{"kind": "vertical", "value": anchor["error_reaction_mesh"], "label": "equal error"}], f"Down to the reference's own error, {source['reaction']['error_h']:.1e}. 40 steps; further left and further down is better."),
               plot("Work against precision: dissipated energy", axis("error of the dissipated energy, mesh alone", "relative", "log"), axis("time", label, "log"), curves["error_dissipated_mesh"],
                    [{"kind": "vertical", "value": anchor["error_dissipated_mesh"], "label": "equal error"}], f"Down to the reference's own error, {source['dissipated']['error_h']:.1e}. What the spacing of the pairs decides: here elements that bend gain less.")])


def energetic(context):
    scenes = ["enf-brittle-1"] if context.quick else ["enf-brittle-0.5", "enf-brittle-0.1"]
    data = bench(context, "energetic", "--repeat", "3", "--cap", "60", "--threads", "1", *[w for s in scenes for w in ("--scene", s)])
    costs, finds, losses, checks, curves, figures = [], [], [], [], [], []
    for scene in scenes:
        part, memory = data["scenes"][scene]["threads"]["1"], data["scenes"][scene]["memory"]
        if "error" in part:
            raise Failed(f"{scene}: {part['error']}")
        jumps = {}
        for key in ("local", "backtracking", "energetic"):
            m = part["methods"][key]
            if "skipped" in m or m["label"] != "measured":
                raise Failed(f"{scene}, {key}: {m.get('skipped', m['label'])}")
            to_local = middle(m["to_local"]) if "to_local" in m else None
            costs.append([scene, key, m["lse"], m.get("lse_processor"), to_local, memory[key].get("peak_MB", 0) / memory["lse"]["peak_MB"], m["spent"]["am_iterations"],
                          m["spent"]["displacement_solves"]])
            jump = m["jump"] or {}
            finds.append([scene, key, jump.get("step"), 1e3 * jump["load"] if jump else None, 1e3 * jump["advance"] if jump else None, jump.get("released"), m.get("defect_end"),
                          len(m["violated"]), m["spent"]["search_candidates"], (m.get("search") or {}).get("gap_relative")])
            jumps[key] = jump.get("load")
            checks.append(check(f"{scene}, {key}: steps that did not converge", m["counts"]["not_converged"], 0, "a step at its limit is no evidence"))
            if scene == scenes[-1]:
                curves.append(series(key, key, [1e3 * v for v in m["history"]["load"]], [1e3 * v for v in m["history"]["debonded_length"]], marker=False))
        found = part["methods"]["energetic"]
        if None in jumps.values():
            raise Failed(f"{scene}: a march without a jump")
        if found["lse"] > 8:
            losses.append(f"{scene}: the energetic march costs {found['lse']:.3g} linear solves, asked for were 8")
        if "to_local" in found and middle(found["to_local"]) > 1:
            losses.append(f"{scene}: it takes {middle(found['to_local']):.2g} times as long as the local march")
        if jumps["backtracking"] >= jumps["local"]:
            losses.append(f"{scene}: with backtracking alone the jump comes no earlier than in the local march, the estimate sees no violation")
        checks += [check(f"{scene}: load of the energetic jump over that of the local one", jumps["energetic"] / jumps["local"], 1.0, "a state of lower energy is found at the same load or earlier"),
                   check(f"{scene}: steps of the energetic march outside the two-sided estimate", len(found["violated"]), 0, "by more than eta = 1e-3 of max(stored, work)")]
        if (found.get("search") or {}).get("gap_relative") is not None:
            checks.append(check(f"{scene}: what the search left open, over the energy", found["search"]["gap_relative"], 0.05, "search_tolerance is 1e-2 of it by step; the worst of 40 steps"))
        figures += [figure(f"energetic_{scene.rsplit('-', 1)[1]}_lse", found["lse"], "linear solves", f"Energetic march, brittle ENF, {scene.rsplit('-', 1)[1]} mm", past="free")]
    return result(
        reference("own past", "the local march of the same scene in the same rounds, and the LSE in turns with it (verify/bench, table energetic)",
                  "times: quartiles of the rounds; what is found does not depend on the clock; how good it is against an exhaustive scan is chapter (b)"),
        checks=checks, losses=losses, figures=figures,
        tables=[table("What each solution costs", [column("scene", key=True), column("solution", key=True), column("whole", "LSE", **FREE), column("processor time", "LSE", optional=True, **FREE),
                      column("over local, same round", "", optional=True, **FREE), column("peak memory", "of one factorisation", **FREE), column("alternations", past="count"),
                      column("displacement solves", past="count")], costs, MACHINE_WHY),
                table("What each finds", [column("scene", key=True), column("solution", key=True), column("step of the jump", optional=True), column("load", "mm", optional=True),
                      column("advance", "mm", optional=True, past=1e-3), column("released", "J/m", optional=True, past=1e-2), column("defect at the end", "J/m", optional=True, past="free"),
                      column("violated", "steps"), column("candidates", past="count"), column("gap", "relative", optional=True, past="free")], finds)],
        plots=[plot(f"Debonded length, {scenes[-1]}", axis("displacement of mid-span", "mm"), axis("debonded length", "mm"), curves, (),
                    "The local march waits until the state before has lost its stability; the energetic one goes where the energy is lowest.")])


def scene_files(context):
    wanted = ["fibre"] if context.quick else ["fibre", "mmb", "fibres-30"]
    settings = ["--set", "time.steps=40"] if context.quick else []
    data = bench(context, "scene-file", "--repeat", "1", "--cap", "5" if context.quick else "20", *[w for s in wanted for w in ("--scene", f"examples/{s}/{s}.toml")], *settings)
    rows, losses, checks, at = [], [], [], {}
    for r in data:
        name, how = r["scene"].rsplit("/", 1)[-1].removesuffix(".toml"), "chosen" if r["reduction"] == "auto" else "FETI"
        lse = middle(r["lse_s"])
        cost = middle(r["march_s"]) / lse
        at[name, how] = (r, cost)
        steps = r["steps"]
        rows.append([name, how, r["unknowns"], r["pairs"], steps, cost, cost / max(steps, 1), r["setup_s"] / lse, r["alternations"] if r["whole"] else None,
                     r["linear_iterations"] if r["whole"] else None, r["peak_MB"] / max(r["lse_MB"], 1e-9), "" if r["whole"] else "stopped by the cap"])
        if how == "chosen":
            if cost > 8:
                losses.append(f"{name}: the march costs {show(cost)} linear solves for {steps} steps")
            if r["peak_MB"] > r["lse_MB"]:
                losses.append(f"{name}: it holds {r['peak_MB'] / max(r['lse_MB'], 1e-9):.2g} times the memory of one factorisation")
    for name in wanted:
        chosen, feti = at[name, "chosen"], at[name, "FETI"]
        checks.append(check(f"{name}: whole marches by the library's own choice", int(chosen[0]["whole"]), 1, "what it chooses goes to the end", ">="))
        if chosen[0]["whole"] and feti[0]["whole"]:
            checks.append(check(f"{name}: dissipated energy, chosen against FETI", abs(chosen[0]["dissipated"] / feti[0]["dissipated"] - 1.0), 1e-4, "two realisations of one problem"))
        if not chosen[0]["whole"]:
            raise Failed(f"{name}: the march did not end")
        if chosen[1] / chosen[0]["steps"] > feti[1] / max(feti[0]["steps"], 1):
            losses.append(f"{name}: the library's choice is slower a step than FETI")
    first = at[wanted[0], "chosen"]
    return result(
        reference("direct solver", "CHOLMOD's analysis, factor and one solve of the undamaged whole system of the same scene file, between the marches",
                  "a factor of 1.2 on a machine that does other things"),
        checks=checks, losses=losses,
        tables=[table("Scene files: whole marches by the library's own choice, and by FETI within the cap", [column("scene", key=True), column("realisation", key=True), column("unknowns"),
                      column("pairs"), column("steps", **FREE), column("march", "LSE", **FREE), column("a step", "LSE", **FREE), column("setup", "LSE", **FREE),
                      column("alternations", optional=True, past="count", capped=True), column("Krylov iterations", optional=True, past="count", capped=True), column("peak memory", "of one factorisation", **FREE),
                      column("note", may=True)], rows, MACHINE_WHY)],
        plots=[plot("A step of the march", axis("pairs", "", "log"), axis("time of a step", "linear solves", "log"),
                    [series("chosen", "condensed", [r[3] for r in rows if r[1] == "chosen"], [r[6] for r in rows if r[1] == "chosen"], line="none"),
                     series("FETI", "feti", [r[3] for r in rows if r[1] == "FETI"], [r[6] for r in rows if r[1] == "FETI"], line="none")], (), "One point a scene.")],
        figures=[figure("scene_file_lse", first[1], "linear solves", f"Scene {wanted[0]}, {first[0]['steps']} steps: whole march", past="free")])


def cases():
    return [march_case("enf-ductile-0.5", quick=True, expected=35, asked=(8, 50), cap=5),
            march_case("enf-ductile-0.1", quick=False, expected=180, asked=(4, 100), cap=20),
            march_case("enf-ductile-0.1", quick=False, expected=220, asked=(4, 100), cap=20, shipped=True),
            march_case("enf-brittle-0.1", quick=False, expected=300, asked=(6, 500), cap=20),
            Case(id="c-precision", chapter="c", title="Work against precision", requirement="At equal error elements that bend take less time than 4-node cells; the error is one of mesh and "
                 "step, not of the tolerance.", geometry="two arms 120 mm x 3 mm, notch 30 mm, five elements, cells of 3 to 0.1 mm, plane strain", materials=DUCTILE,
                 supports="means over patches of 2 mm (points have no limit as the mesh is refined), midspan pressed by 6 mm", units=f"relative L1 errors; ratios of times; {COSTS}",
                 run=precision, quick=True, timing=True, seconds=1500, expected=150),
            Case(id="c-energetic", chapter="c", title="What an energetic march costs", requirement="An energetic march jumps no later than a local one and stays within the two-sided "
                 "estimate; asked for were 8 linear solves.", materials=BRITTLE, **ENF, run=energetic, quick=True, timing=True, seconds=1200, expected=90),
            Case(id="c-scene-files", chapter="c", title="Marches of scene files", requirement="The library's own choice ends every march, gives what FETI gives, and is listed where it costs "
                 "more than a few linear solves.", geometry="fibre and thirty fibres in periodic cells, mixed-mode bending: examples/", materials="as the scene files say", supports="as the "
                 "scene files say", units=f"ratios; {COSTS}", run=scene_files, quick=True, timing=True, seconds=900, expected=150)]
