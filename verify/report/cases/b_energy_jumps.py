# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (b): energetic solutions beside the scan of fronts."""
import flexure
import orders
from case import (Case, Rows, axis, check, column, figure, largest, ledger_of, order, plot, reference, result, series,
                  table)
from flexure import ENF, BRITTLE


def jump_instant(context):
    rows = context.harness("jump-instant")
    delam = context.python()
    # The quadratic cells are nearest to the limit: theirs is the one that errors are taken to.
    limit = [v for v in rows.where(element="quad8").column("richardson_mm") if v is not None][-1]
    levels, found, expected = [], [], {"quad4": 1.0, "quad4-incompatible": 1.0}  # of energies, with a crack tip
    for element in rows.values("element"):
        of = rows.where(element=element)
        h, errors = of.column("h_mm"), [abs(v / limit - 1.0) for v in of.column("jump_mm")]
        if element in expected:
            found.append(order(f"load of the jump, {element}", "h", orders.fit(h, errors), expected[element], 0.2, h,
                               errors, "at least"))
        names = "step", "jump_mm", "to_beam", "richardson_mm", "front_mm", "griffith_mm", "griffith_to_beam"
        for i, rate in enumerate(orders.rates(h, errors)):
            levels.append([element, i + 1, h[i], flexure.dofs(delam, "enf-brittle", 1e-3 * h[i], element), errors[i],
                           rate, expected.get(element),
                           orders.fit(h, errors) if i + 1 == len(h) else None, *(of.column(name)[i] for name in names)])
    columns = [column("element", "", key=True), column("level", ""), column("h", "mm", key=True), column("DOFs", ""),
               column("error", "relative", past=1e-3),
               column("rate", "", optional=True, past="free"), column("expected", "at least", optional=True),
               column("fitted order", "", optional=True, past="free"),
               column("change", "relative", optional=True, past=1e-3), column("jump", "mm"), column("to beam theory",
                   "relative", past=1e-5), column("Richardson's limit", "mm", optional=True, past="free"),
                   column("front after it", "mm"),
               column("onset", "mm"), column("onset to beam theory", "relative", past=1e-5)]
    curves = [series(e, role, of.column("h_mm"), of.column("jump_mm")) for e, role in zip(rows.values("element"),
            ("first", "second", "third"))
              for of in [rows.where(element=e)]]
    finest = {e: rows.where(element=e).column("jump_mm")[-1] for e in rows.values("element")}
    spread = max(finest.values()) / min(finest.values()) - 1.0
    soft = "shear of the arms and the root, which beam theory omits, soften a plane specimen by 2 to 4 %"
    return result(reference("closed form", "beam theory without shear of the arms and compliance of the root "
                                           "(verify/report: a = 48.0 mm after a jump at 0.281 mm)",
                            "beam theory is stiffer than the plane solution: 2 to 4 % are expected; the meshes among "
                            "themselves have none of it"),
                  tables=[table("Load of the jump over meshes and elements", columns, levels,
                                "Error: to Richardson's limit of the quadratic cells; the crossing is exact for any "
                                "load, "
                                "there is no step. " + rows.note)], orders=found,
                  ledger="None: nothing is analysed. The energies of all fronts are scanned at one load, and the load "
                         "is that where two of them cross.",
                  checks=[check("beam theory above the finest meshes, most", max(1.0 - v / 0.281 for v in finest.values()), 0.04, soft),
                          check("beam theory above the finest meshes, least", min(1.0 - v / 0.281 for v in finest.values()), 0.02, soft, ">="),
                          check("spread among elements, finest meshes", spread, 6e-3 if context.quick else 6e-4,
                                "three elements share one limit; three times what was measured when it was set")],
                  plots=[plot("Load at which the energies of two fronts cross", axis("cell size h", "mm", "log"),
                              axis("load of the jump", "mm"), curves,
                              [{"kind": "horizontal", "value": 0.281, "label": "beam theory"}],
                              "Brittle ENF, supports and load on patches of 2 mm, exhaustive scan of fronts.")],
                  figures=[figure("jump_mm", finest["quad4-incompatible"], "mm",
                                  "Brittle ENF: load of the energetic jump, finest incompatible mesh (beam theory: "
                                  "0.281 mm)")])


def energetic_case(specimen, quick, expected):
    def run(context):
        rows = context.harness("energetic", "--specimen", specimen, *(() if context.quick else ("--finest", "0.4")))
        delam = context.python()
        unknowns = {h: flexure.dofs(delam, specimen, 1e-3 * h) for h in rows.values("h_mm")}
        rows = Rows({"table": rows.name, "note": rows.note, "columns": [*rows.columns, "dofs", "tau", "allowed"],
                     "rows": [[*r, unknowns[r[rows.index("h_mm")]], 1 / 40,
                               "-" if not r[rows.index("method")].startswith("energetic") else
                               1e-11 if specimen.startswith("enf") else "-" if r[rows.index("method")] != "energetic"
                               and r[rows.index("mixity")] == "frozen" else 1e-4]
                              for r in rows.rows]})
        columns = [column("exponent", "", key=True), column("mixity", "", key=True), column("h", "mm", key=True,
                **{"from": "h_mm"}), column("patch", "mm", key=True, **{"from": "patch_mm"}),
                   column("tau", "of the loading"), column("DOFs", "", **{"from": "dofs"}),
                   column("method", "", key=True), column("error", "over the scan's energy", past="free", optional=True,
                                                          **{"from": "excess"}),
                   column("expected, at most", "over the scan's energy", optional=True, past="free",
                          **{"from": "allowed"}), column("above", "steps", optional=True, past="free",
                                                         **{"from": "steps_above"}),
                   column("jump at step", "", optional=True, **{"from": "jump_step"}), column("scan's", "",
                       optional=True, **{"from": "scan_step"}),
                   column("jump at", "mm", optional=True, **{"from": "jump_mm"}), column("front", "mm", optional=True,
                       **{"from": "front_mm"}),
                   column("scan's front", "mm", optional=True, **{"from": "scan_front_mm"}), column("toughness", "J/m2",
                       optional=True, past=1e-4),
                   column("scan's toughness", "J/m2", optional=True, past=1e-4, **{"from": "scan_toughness"}),
                   column("defect", "J/m", optional=True, past=1e-3),
                   column("returns", "", optional=True, past="count", **{"from": "backtracks"}), column("candidates",
                       "", optional=True, past="count"),
                   column("not_converged", "steps", may=True, optional=True, past="count"), column("note", "",
                       optional=True)]
        methods = rows.values("method")
        checks, losses = [], []
        for method in methods:
            if not method.startswith("energetic"):
                continue
            of = rows.where(method=method)
            # Frozen mixity in mixed mode: locating the jump records other mixities than the scan's steps do; another
            # history, listed below.
            same = [r for r in of.rows if specimen.startswith("enf") or method == "energetic"
                    or r[of.index("mixity")] != "frozen"]
            # The scan records the mixities of fronts at rest, rule `converged` those of the path at the load at which a step
            # ends: where they differ, so may the energies, by no more.
            along = [r for r in same if r[of.index("mixity")] == "converged"]
            other = max((r[of.index("excess")] / max(1e-4, abs(r[of.index("toughness")] / r[of.index("scan_toughness")] - 1.0))
                         for r in along), default=0.0)
            rest = [r[of.index("excess")] for r in same if r not in along]
            limit, why = (1e-11, "no front of the exhaustive scan may be lower; in mode II both histories have the "
                                 "same toughness: rounding alone") if specimen.startswith("enf") else (
                1e-4, "no front of the exhaustive scan may be lower; in mixed mode the two histories record mixities of "
                      "their own states, which need not "
                      "agree to the last digits")
            if rest:
                checks.append(check(f"{method}: energy above the scan's", largest(rest), limit, why))
            if along:
                checks.append(check(f"{method}, converged: energy above the scan's, over the difference of the toughnesses",
                                    other, 1.0, "the scan records mixities of fronts at rest, this rule those of the path at "
                                    "the load at which the step ends; at least 1e-4"))
            checks.append(check(f"{method}: analyses whose jump is in another step than the scan's",
                                sum(r[of.index("jump_step")] != r[of.index("scan_step")] for r in same), 0,
                                "the jump is found in the step in which it pays"))
            checks.append(check(f"{method}: steps not converged", sum(r[of.index("not_converged")] for r in same), 0,
                                "a step at its limit is no evidence"))
        for method in methods:
            of = rows.where(method=method)
            for rule in of.values("mixity"):
                worst = [v for v in of.where(mixity=rule).column("excess") if v is not None]
                if worst and max(worst) > 1e-4:
                    named = "" if rule == "any" else f", mixity {rule}"
                    losses.append(f"{method}{named}: energy up to {100 * max(worst):.2g} % above the "
                                  f"exhaustive scan's in some step")
        h = min(rows.values("h_mm"))
        one = rows.where(h_mm=h)
        one = one.where(patch_mm=max(one.values("patch_mm")))
        one = one.where(exponent=one.values("exponent")[0])
        one = one.where(mixity=one.values("mixity")[0])
        curves = []
        for method, role in (("local", "local"), ("backtracking", "backtracking"), ("energetic", "energetic")):
            if method in methods:
                of = rows.where(method=method)
                points = sorted({(r[of.index("h_mm")],
                                  r[of.index("jump_mm")]) for r in of.rows if isinstance(r[of.index("jump_mm")], (int,
                                      float))
                                 and r[of.index("patch_mm")] == max(rows.values("patch_mm"))
                                 and r[of.index("mixity")] == rows.values("mixity")[0]
                                 and r[of.index("exponent")] == rows.values("exponent")[0]})
                if points:
                    curves.append(series(method, role, [p[0] for p in points], [p[1] for p in points]))
        figures = []
        points = rows.where(h_mm=1.0, patch_mm=0.0)
        for method in ("local", "backtracking", "energetic") if specimen == "enf-brittle" else ():
            at = points.where(method=method).column("jump_mm")
            figures.append(figure(f"jump_{method}_mm", at[0], "mm", f"Brittle ENF, 40 steps, points as supports: load "
                                                                    f"of the first jump, {method}"))
        analyses = {f"{name}, h = 1 mm, 40 steps": flexure.analyse(delam, specimen, 1e-3, 40, **options).at for name,
                   options in (
            ("local", {}), ("backtracking", {"backtracking": "on"}), ("energetic", {"solution": "energetic"}))}
        return result(reference("exhaustive scan", "verify/reference/fronts: every front position of every step, own "
                                                   "history and mixity",
                                "none within contiguous fronts on the same mesh; other sets of broken pairs are "
                                "outside the scan"),
                      tables=[rows.table("Analyses beside the scan", columns, "No order is expected: analysis and scan "
                                         "are of one mesh and one step, and must agree on each. Mixity: the rule for it; any: the mode is pure, "
                                         "no rule changes it. " + rows.note)],
                      checks=checks, losses=losses, figures=figures, ledger=ledger_of(analyses, "J/m"),
                      plots=[plot(f"Load of the first jump, {specimen}", axis("cell size h", "mm"),
                                  axis("load of the jump", "mm"), curves,
                                  [], "Supports and load on patches of 2 mm, 40 steps of 0.15 mm: the energetic analysis "
                                      "jumps in the step of the scan.")])

    return Case(id=f"b-energetic-{specimen}", chapter="b", title=f"Energetic analyses beside the scan of fronts, "
                                                                 f"{specimen}",
                requirement="An energetic analysis is never above the lowest front that an exhaustive scan finds, and "
                            "jumps in the same step.",
                materials=BRITTLE, run=run, quick=quick, seconds=2400, expected=expected, **ENF)


def cases():
    return [Case(id="b-jump-instant", chapter="b", title="Load of the energetic jump",
                 requirement="The load of the jump converges over meshes, is the same for three elements, "
                 "and lies 2 to 4 % below beam theory.", materials=BRITTLE, run=jump_instant, quick=True, seconds=1200,
                 expected=120,
                 **{**ENF, "supports": "as the slides, spread over patches of 2 mm"}),
            energetic_case("enf-brittle", True, 200), energetic_case("mmf-brittle", False, 400)]
