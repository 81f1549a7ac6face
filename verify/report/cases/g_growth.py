# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (g): how time, memory and counts grow with the number of unknowns n, in the plane and in space."""
import orders
from bench import COSTS, MACHINE_WHY, bench, middle
from case import Case, Failed, axis, check, column, figure, plot, reference, result, series, table

REFERENCE = reference("closed form",
                      "operation counts: nested dissection costs n^(3/2) in the plane and n^2 in space, its factor takes n log n and n^(4/3) numbers (George, SIAM J. "
                      "Numer. Anal. 10, 1973; Lipton, Rose and Tarjan, SIAM J. Numer. Anal. 16, 1979); the dense operator of an interface with n^(1/2) or n^(2/3) "
                      "pairs takes n or n^(4/3) numbers and n^(3/2) or n^2 operations",
                      "upper bounds for large n; on these meshes terms of lower order still count, so that smaller exponents are expected")
METHODS = [("one linear solve", "direct", "one linear solve"), ("condensed", "condensed", "condensed"), ("accelerated", "accelerated", "condensed, accelerated"),
           ("feti", "feti", "FETI"), ("baseline", "baseline", "baseline")]
PARTS = (("total", "total_s"), ("setup", "setup_s"), ("factor", "factor_s"), ("iterate", "iterate_s"))
QUICK = ("The quick report judges no time here: of its few small meshes, each timed once, the growth of what is counted is judged, alternations and bytes of "
         "peak memory. Exponents of times are shown, and judged in the full report alone.")
# A fit over few meshes of small scenes.
NOISE = 0.3
GOAL = 1.2  # of the accelerated analysis in the plane


def growth(context, scenes, time_limit, memory_limit, cap, space):
    data = bench(context, "growth", "--repeat", "1" if context.quick or space else "3", "--cap", str(cap), *[w for s in scenes for w in ("--scene", s)])
    found = next(iter(data["families"].values()))["scenes"]
    rows, points, counts, losses, stops, alternations = [], {}, [], [], {}, []
    for name in scenes:
        part = found[name]
        if "error" in part:
            raise Failed(f"{name}: {part['error']}")
        n = part["primal_dofs"]
        lse = middle(part["lse_s"])
        rows.append([name, "one linear solve", n, None, None, None, 1.0, None, "measured"])
        points.setdefault("one linear solve", {}).setdefault("total", []).append((n, lse))
        for key, _, label in METHODS[1:]:
            m = part["methods"].get(key)
            if m is None or "skipped" in m:
                continue
            stopped = m["label"].startswith("stopped")
            rows.append([name, label, n, *(middle(m[p]) / lse for p in ("setup_s", "factor_s", "iterate_s")), m["lse"],
                         None if stopped else m["counts"]["am_iterations"], m["label"]])
            if stopped:
                quickest = middle(part["methods"]["accelerated"]["total_s"])
                stops.setdefault(label, []).append(middle(m["total_s"]) / quickest)
                continue
            if key in ("condensed", "accelerated"):
                alternations.append([name, label, m["counts"]["am_iterations"]])
            if key == "condensed":
                counts.append((n, m["counts"]["am_iterations"]))
            for what, where in PARTS:
                points.setdefault(key, {}).setdefault(what, []).append((n, middle(m[where])))
    losses += [f"{label} was stopped by the cap on {len(over)} of {len(scenes)} meshes, after {min(over):.2g} times the time of the accelerated analysis or more"
               for label, over in stops.items()]
    memory, peaks = [], {}
    for name in scenes:
        n = found[name]["primal_dofs"]
        for key, _, label in METHODS[:2]:
            m = context.command("delam_bench", "--child", "memory", name, "lse" if key == "one linear solve" else key, str(cap))
            if "peak_MB" not in m or m.get("capped"):
                continue
            used = m["peak_MB"] - m["before_MB"]
            memory.append([name, label, n, used, 1e6 * used / n])
            peaks.setdefault(key, []).append((n, max(used, 1e-3)))
    dimension = "space" if space else "the plane"
    fits, checks, curves, held = [], [], [], []
    for key, role, label in METHODS:
        by_part = points.get(key, {})
        for what, _ in PARTS:
            line = [(a, b) for a, b in by_part.get(what, []) if b > 0]
            if len(line) < 2:
                continue
            p = orders.fit(*zip(*line))
            fits.append([f"{label}, {what}", len(line), p, time_limit])
            if key in ("condensed", "accelerated") and what == "total" and not context.quick:
                checks.append(check(f"exponent of the time, {label}", p, time_limit + NOISE, f"operations grow as n^{time_limit:.3g} at most; {NOISE} for few meshes and a "
                                    "machine that does other things"))
        line = by_part.get("total", [])
        if line:
            curves.append(series(label, role, [a for a, _ in line], [b / points["one linear solve"]["total"][0][1] for _, b in line]))
        line = peaks.get(key, [])
        if len(line) > 1:
            p = orders.fit(*zip(*line))
            fits.append([f"{label}, memory", len(line), p, memory_limit])
            held.append(series(label, role, [a for a, _ in line], [b for _, b in line]))
            if key == "condensed":
                checks.append(check("exponent of the memory, condensed", p, memory_limit + NOISE, "numbers of the sparse factor and of the dense operator; the "
                                    "allocator rounds small ones up"))
    steady = orders.fit([n for n, _ in counts], [c for _, c in counts])
    fits.append(["alternations, condensed", len(counts), steady, 0.0])
    checks.append(check("exponent of the alternations, condensed", steady, 0.1, "the stopping test is one of the continuous problem: its count must not grow with the mesh"))
    total = next(f for f in fits if f[0] == "condensed, total")
    linear = next(f for f in fits if f[0] == "one linear solve, total")
    if total[2] > linear[2] + NOISE:
        losses.append(f"the analysis grows faster than one linear solve: n^{total[2]:.2f} against n^{linear[2]:.2f}")
    analysis = next(f for f in fits if f[0] == "condensed, accelerated, total")
    if not space and not context.quick and analysis[2] > GOAL:
        losses.append(f"the accelerated analysis grows as n^{analysis[2]:.2f}; the goal is n^{GOAL}")
    key = "space" if space else "plane"
    return result(
        REFERENCE, losses=losses, checks=checks, warnings=[QUICK] if context.quick else [],
        tables=[table("Fitted exponents p of c n^p, beside the largest expected", [column("of", key=True), column("meshes", past="free"), column("fitted", past="free"),
                      column("expected at most", past="free")], fits),
                table("Parts of an analysis, in linear solves of the same mesh", [column("scene", key=True), column("method", key=True), column("unknowns"),
                      *(column(n, "linear solves", optional=True, past="free") for n in ("setup", "factor", "iterate")), column("whole", "linear solves", past="free"),
                      column("alternations", "", optional=True, past="free"), column("note", may=True)], rows, MACHINE_WHY),
                table("Alternations of the condensed analyses", [column("scene", key=True), column("method", key=True), column("alternations", past="count")], alternations,
                      "Counts that no cap on the time cuts short; these alone have a past."),
                table("Peak memory beyond the mesh", [column("scene", key=True), column("method", key=True), column("unknowns"), column("peak", "MB", past="free"),
                      column("per unknown", "bytes", past="free")], memory, "The kernel's high-water mark, each in a process of its own.")],
        plots=[plot("Time against size", axis("unknowns n", "", "log"), axis("time", "solves of the coarsest mesh", "log"), curves,
                    [{"kind": "slope", "order": time_limit, "label": f"n^{time_limit:.3g}"}], f"Whole analyses in {dimension}; what the cap stopped is left out."),
               plot("Peak memory against size", axis("unknowns n", "", "log"), axis("memory beyond the mesh", "MB", "log"), held,
                    [{"kind": "slope", "order": memory_limit, "label": f"n^{memory_limit:.3g}"}])],
        figures=[figure(f"growth_{key}_time", total[2], "", f"Exponent of the time of a condensed analysis over the unknowns, in {dimension} (at most {time_limit:.3g} expected)", past="free"),
                 *(figure(f"growth_{key}_memory", f[2], "", f"Exponent of its memory, in {dimension} (at most {memory_limit:.3g} expected)", past="free")
                   for f in fits if f[0] == "condensed, memory")])


def cases():
    def plane(context):
        return growth(context, ["enf-ductile-2", "enf-ductile-1.5", "enf-ductile-1"] if context.quick else
                      ["enf-ductile-1", "enf-ductile-0.75", "enf-ductile-0.5", "enf-ductile-0.25", "enf-ductile-0.1"], 1.5, 1.1, 2 if context.quick else 20, False)

    def space(context):
        return growth(context, ["block-2", "block-1", "block-0.6666667", "block-0.5"], 2.0, 4.0 / 3.0, 60, True)

    return [Case(id="g-plane", chapter="g", title="Growth in the plane", requirement="Over the unknowns n the time of a condensed analysis grows as n^1.5 at most, its memory as n "
                 "log n (n^1.1 here), and the number of alternations does not grow; fits within 0.3. The full report alone judges times.",
                 geometry="two arms 120 mm x 3 mm, notch 30 mm, 4-node cells of 1 to 0.1 mm (quick: 2 to 1), plane strain", materials="E = 75 GPa, nu = 0.3; k = 125e9 N/m3, "
                 "Go = 100, Gc = 250 J/m2", supports="bottom corners on points, midspan pressed by 6 mm in 40 steps", units=COSTS, run=plane, quick=True, timing=True, seconds=1200, expected=180),
            Case(id="g-space", chapter="g", title="Growth in space", requirement="Over the unknowns n the time of a condensed analysis grows as n^2 at most, its memory as n^(4/3), "
                 "and the number of alternations does not grow; fits within 0.3.",
                 geometry="two arms 40 mm x 10 mm x 2 mm, notch 10 mm, 8-node bricks of 2 to 0.5 mm", materials="E = 75 GPa, nu = 0.3; k = 125e9 "
                 "N/m3, Go = 100, Gc = 250 J/m2", supports="bottom edges on lines, midspan pressed by 1.5 mm in 10 steps", units=COSTS, run=space, timing=True, seconds=1800, expected=300)]
