# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (c): analyses of scene files, and beside other programs."""
from bench import COSTS, MACHINE_WHY, bench, middle
from c_speed import FREE, GOALS, MEMORY
from case import Case, Failed, axis, check, column, figure, largest, plot, reference, result, series, table
from words import show


def scene_files(context):
    # In the quick report a scene that FETI brings to its end, too.
    wanted = ["enf-ductile"] if context.quick else ["fibre", "mmb", "dcb-alfano", "fibres-30"]
    settings = ["--set", "time.steps=20"] if context.quick else []
    data = bench(context, "scene-file", "--repeat", "1", "--cap", "20", *[w for s in wanted for w in ("--scene", f"examples/{s}/{s}.toml")], *settings)
    rows, losses, checks, at = [], [], [], {}
    for r in data:
        name, how = r["scene"].rsplit("/", 1)[-1].removesuffix(".toml"), "chosen" if r["reduction"] == "auto" else "FETI"
        lse = middle(r["lse_s"])
        cost = middle(r["analysis_s"]) / lse
        at[name, how] = (r, cost)
        steps = r["steps"]
        rows.append([name, how, r["unknowns"], r["pairs"], steps, cost, cost / max(steps, 1), r["setup_s"] / lse, r["alternations"] if r["whole"] else None,
                     r["linear_iterations"] if r["whole"] else None, r["peak_MB"] / max(r["lse_MB"], 1e-9), "" if r["whole"] else "stopped by the cap"])
        if how == "chosen":
            if cost > GOALS.get(name, 8):
                losses.append(f"{name}: the analysis costs {show(cost)} linear solves for {steps} steps; the goal is {GOALS.get(name, 8)}")
            if r["peak_MB"] > r["lse_MB"]:
                losses.append(f"{name}: it holds {r['peak_MB'] / max(r['lse_MB'], 1e-9):.2g} times the memory of one factorisation"
                              + (f"; the goal is {MEMORY[name]}" if name in MEMORY else ""))
    for name in wanted:
        chosen, feti = at[name, "chosen"], at[name, "FETI"]
        checks.append(check(f"{name}: analyses by the library's own choice that were stopped", int(not chosen[0]["whole"]), 0, "what it chooses goes to the end"))
        if chosen[0]["whole"] and feti[0]["whole"]:
            checks.append(check(f"{name}: dissipated energy, chosen against FETI", abs(chosen[0]["dissipated"] / feti[0]["dissipated"] - 1.0), 1e-4, "two realisations of one problem"))
        if not chosen[0]["whole"]:
            raise Failed(f"{name}: the analysis did not end")
        if chosen[1] / chosen[0]["steps"] > feti[1] / max(feti[0]["steps"], 1):
            losses.append(f"{name}: the library's choice is slower a step than FETI")
    first = at[wanted[0], "chosen"]
    return result(
        reference("direct solver", "CHOLMOD's analysis, factor and one solve of the undamaged whole system of the same scene file, between the analyses",
                  "a factor of 1.2 on a machine that does other things"),
        checks=checks, losses=losses,
        tables=[table("Scene files: whole analyses by the library's own choice, and by FETI within the cap", [column("scene", key=True), column("realisation", key=True), column("unknowns"),
                      column("pairs"), column("steps", **FREE), column("analysis", "linear solves", **FREE), column("a step", "linear solves", **FREE), column("setup", "linear solves", **FREE),
                      column("alternations", optional=True, past="count", capped=True), column("Krylov iterations", optional=True, past="count", capped=True), column("peak memory", "of one factorisation", **FREE),
                      column("note", may=True)], rows, MACHINE_WHY)],
        plots=[plot("A step of the analysis", axis("pairs", "", "log"), axis("time of a step", "linear solves", "log"),
                    [series("chosen", "condensed", [r[3] for r in rows if r[1] == "chosen"], [r[6] for r in rows if r[1] == "chosen"], line="none"),
                     series("FETI", "feti", [r[3] for r in rows if r[1] == "FETI"], [r[6] for r in rows if r[1] == "FETI"], line="none")], (), "One point a scene.")],
        figures=[figure("scene_file_lse", first[1], "linear solves", f"Scene {wanted[0]}, {first[0]['steps']} steps: whole analysis", past="free")])


SHARED = {"at_once/in_turn": ("at once over in turn, time", 1.1), "processor, at_once/in_turn": ("at once over in turn, processor time", 1.1),
          "idle/one_thread": ("idle, over one thread", 1.1), "loaded/one_thread": ("beside loops, over one thread", 1.1)}


def side_by_side(context):
    scenes = ["examples/enf-ductile/enf-ductile.toml"] if context.quick else ["examples/fibre/fibre.toml", "examples/enf-3d/enf-3d.toml"]
    settings = ["--set", "time.steps=20"] if context.quick else []
    data = bench(context, "side-by-side", "--repeat", "1" if context.quick else "3", *[w for scene in scenes for w in ("--scene", scene)], *settings)
    rows, losses = [], []
    for r in data:
        name = r["scene"].rsplit("/", 1)[-1].removesuffix(".toml")
        ratios = [middle(r[key]) for key in SHARED]
        rows.append([name, r["threads"], middle(r["in_turn_s"]), middle(r["at_once_s"]), *ratios])
        for (words, limit), value in zip(SHARED.values(), ratios):
            if value > limit:
                losses.append(f"{name}, {r['threads']}: {words}: {value:.3g}; the goal is {limit}")
    checks = [check("variants of threads that gave a time", len(rows), 3 * len(scenes), "an analysis that ends with an error gives none", ">=")]
    if not context.quick:
        worst = largest(value for row in rows for value in row[6:8])
        checks.append(check("idle or beside busy loops, over one thread, worst", worst, 1.5, "waiting threads that spin cost 10 to 20 times as much; 1.1 is the goal, and schedulers scatter"))
    return result(
        reference("own past", "the same analysis with one thread of everything, as separate processes in turns (verify/bench, table side-by-side)", "the scheduler: 1.1 is seen without any difference"),
        checks=checks, losses=losses,
        tables=[table("Four analyses at once against one after another, and one beside as many busy loops as there are cores",
                      [column("scene", key=True), column("threads", key=True), column("four in turn", "s", **FREE), column("four at once", "s", **FREE),
                       *(column(words, **FREE) for words, _ in SHARED.values())], rows, MACHINE_WHY)],
        plots=[plot("Time over that with one thread", axis("", bars=[f"{r[0]}, {r[1]}" for r in rows]), axis("ratio", ""),
                    [series("idle", "condensed", list(range(len(rows))), [r[6] for r in rows]), series("beside loops", "accelerated", list(range(len(rows))), [r[7] for r in rows])])])


def cases():
    return [Case(id="c-scene-files", chapter="c", title="Analyses of scene files", requirement="The library's own choice ends every analysis, gives what FETI gives, and is listed where it costs "
                 "more than a few linear solves.", geometry="fibre and thirty fibres in periodic cells, mixed-mode bending, double cantilever (quick: end-notched flexure): examples/", materials="as the scene files say", supports="as the "
                 "scene files say", units=f"ratios; {COSTS}", run=scene_files, quick=True, timing=True, seconds=900, expected=150),
            Case(id="c-side-by-side", chapter="c", title="Beside other programs", requirement="Idle or beside other programs, an analysis takes no more than 1.5 times as long as with one thread. The goals are 1.1, also for the "
                 "processor time of four at once over that of four in turn; what misses them is listed.", geometry="fibre in a periodic cell, flexure in space (quick: in the plane): examples/", materials="as the scene files say",
                 supports="as the scene files say", units="ratios of times", run=side_by_side, quick=True, timing=True, seconds=900, expected=300)]
