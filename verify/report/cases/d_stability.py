# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (d): hard cases, each over a range of one parameter, by the condensed operator, FETI and the direct reference. The scenes
are those of verify/harness/stability_*.cpp; what a row may be is decided here again, from its numbers."""
import dataclasses
import math

import orders as fitting
from case import Case, Failed, axis, check, column, figure, order, plot, reference, result, series

REALISATIONS = (("condensed", "condensed"), ("FETI", "feti"), ("direct", "direct"))
SAID = "DELAM_NOT_CONVERGED"
BY_ROUNDING = "its matrices' rounding"
DIRECT = reference("direct solver", "verify/reference/direct: SuiteSparse's CHOLMOD on the whole system of bodies, springs and supports, its own active set, "
                   "at the adhesions of the condensed analysis; FETI that ends at others is compared with a direct solution at its own; no solver code is shared", "its own KKT violation is drawn and tabled beside those of the others")
KKT_WHY = ("gap, pressure, complementarity, equilibrium, supports and law from exported fields, outside the library, each over the largest of "
           "its kind; iterations stop at 1e-12 of the residual, three decades and more are left for the condition of the scene")
LEDGER_WHY = "energies recorded against Clapeyron's theorem, springs and work computed from fields, over the largest; only rounding may differ"


LEGEND = ("KKT: worst violation of gap, pressure, complementarity, equilibrium, supports and law. Ledger: recorded energies against those computed from fields. Defect: what the balance of "
          "energy over the analysis misses; it falls with the length of the steps, is large where a step breaks much at once, and is judged only where a check above names it. Damage: what a "
          "further damage step would change.")


@dataclasses.dataclass(frozen=True)
class Subject:
    """One range of the harness and how it is drawn."""

    name: str
    title: str
    x: str                          # label of the parameter
    unit: str = ""
    scale: str = "log"
    place: object = float           # of a value on the axis
    acceptance: object = 1e-9       # of KKT and ledger: a number, or a function of the parameter, told in `accepts`
    accepts: str = ""               # none: the number
    defect: float = 0.0             # of the balance; 0: it falls with the steps, so that it is not judged here
    refused: str = ""               # words with which rows of it are to be refused, or ""
    past: object = "rounding"
    error: str = "relative"
    call: str = ""                  # subject to ask the harness for, where it answers with several
    quick: bool = True              # also part of --quick
    legend: str = ""                # below its table, beside what all tables say
    wide: str = ""                  # why errors of more than 1 % are accepted
    apart: object = lambda value: 1e-3  # from what difference of their defects on condensed and FETI have ended in different states

    def accepted(self, value):
        return self.acceptance(value) if callable(self.acceptance) else self.acceptance

    def accepting(self):
        return self.accepts or f"{self.acceptance:g}"


def parameter(rows):
    """Name and unit of the parameter, as the harness has them; the axis may show a function of it."""
    name, _, unit = rows.column("parameter")[0].partition(", ")
    return name, unit


def finite(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def bound_of(subject, value, limit, expected):
    """Of KKT and ledger: where rounding of the matrices decides, as much as it leaves."""
    return max(subject.accepted(value), limit) if BY_ROUNDING in expected else subject.accepted(value)


def judged(subject, rows):
    """Checks of one range. A row that says `converged` must be right; one that does not must have been expected to say so."""
    at = {name: rows.index(name) for name in rows.columns}
    acceptance = {}
    silent, unexpected, refused, worst, kkt, ledger, defect, missing = [], [], 0, 0.0, 0.0, 0.0, 0.0, []
    others = any(r[at["realisation"]] != "direct" and r[at["status"]] == "converged" for r in rows.rows)
    for row in rows.rows:
        def get(name):
            return row[at[name]]

        who = f"{get('realisation')} at {get('value'):g}"
        expected, status = get("expected"), get("status")
        if status == "left out":
            if not get("message"):
                unexpected.append(who)
            continue
        if expected.startswith("refused"):
            words = expected.split(": ", 1)[1]
            refused += words in get("message")
            if words not in get("message") or status == "converged":
                unexpected.append(who)
            continue
        if status != "converged":
            if not (status == SAID and "or says that it is not" in expected):
                unexpected.append(f"{who} ({status})")
            continue
        values = {name: get(name) for name in ("error", "limit", "kkt", "ledger", "defect", "damage")}
        holes = [name for name, v in values.items() if not finite(v)]
        if holes:
            missing.append(f"{who}: {holes[0]}")
            continue
        bound = bound_of(subject, get("value"), values["limit"], expected)
        used = values["error"] / values["limit"] if values["limit"] > 0 else (0.0 if values["error"] == 0.0 else 2.0)
        acceptance[who] = bound
        # The direct solver's own limit is twenty times its rounding: its share says nothing where others have answered.
        if get("realisation") != "direct" or not others:
            worst = max(worst, used)
        kkt, ledger = max(kkt, values["kkt"] / bound), max(ledger, values["ledger"] / bound)
        if get("realisation") != "direct":
            defect = max(defect, values["defect"])
        if used > 1 or values["kkt"] > bound or values["ledger"] > bound or get("verdict") != "pass":
            silent.append(who)
    if missing:
        raise Failed(f"{subject.name}: no number where one is needed: {missing[0]}")
    name = subject.title
    checks = [check(f"{name}: silent wrong answers", len(silent), 0, "rows with status converged whose error, KKT, ledger or damage, or balance where a check names it, is beyond its limit"
                    + (": " + ", ".join(silent[:3]) if silent else "")),
              check(f"{name}: rows that end otherwise than expected", len(unexpected), 0, "an answer where a refusal is expected, the reverse, or other words"
                    + (": " + ", ".join(unexpected[:3]) if unexpected else ""))]
    if acceptance:
        checks += [check(f"{name}: error over its limit", worst, 1, "the limit of every row is in the table, with what it is compared with"),
                   check(f"{name}: primal KKT over its limit", kkt, 1, f"limit {subject.accepting()}, or the rounding of the matrices where the row says so; {KKT_WHY}"),
                   check(f"{name}: ledger over its limit", ledger, 1, f"limit {subject.accepting()}, or the rounding of the matrices where the row says so; {LEDGER_WHY}")]
        if subject.defect:
            checks.append(check(f"{name}: defect of the balance", defect, subject.defect, "nothing is damaged or slides with loss: stored energy is work, to rounding"))
    if refused:
        checks.append(check(f"{name}: rows refused in the expected words", refused, sum(r[at["expected"]].startswith("refused") for r in rows.rows), "every one of them", ">="))
    return checks, bool(acceptance)


def told(subject, rows):
    """What the reader must know first: ends without an answer, as sentences."""
    out, missing, name = [], {}, parameter(rows)[0]
    for who, _ in REALISATIONS:
        picked = [r for r in rows.rows if r[rows.index("realisation")] == who]
        said = [r[rows.index("value")] for r in picked if r[rows.index("status")] == SAID]
        if said:
            out.append(f"{subject.title}: {who} does not converge, and says so, at {name} = " + ", ".join(f"{v:g}" for v in said))
        left = [(r[rows.index("value")], r[rows.index("message")]) for r in picked if r[rows.index("status")] == "left out"]
        if left:
            why = f"left out at {name} = " + ", ".join(f"{v:g}" for v, _ in left) + f": {left[0][1]}"
            missing.setdefault(why, []).append(who)
        answered = {r[rows.index("value")] for r in rows.rows if r[rows.index("status")] == "converged"}
        for r in picked:
            if r[rows.index("expected")].startswith("refused") and r[rows.index("value")] in answered:
                value, words = r[rows.index("value")], r[rows.index("message")]
                out.append(f"{subject.title}: {who} is refused at {name} = {value:g}: {words}")
    return out + [f"{subject.title}: {', '.join(of)} {why}" for why, of in missing.items()] + coarse(subject, rows) + parted(subject, rows)


def coarse(subject, rows):
    """What is accepted, and yet not as good as elsewhere: KKT conditions beyond 1e-8, and errors of more than 1 % that a reason is known for."""
    name, out = parameter(rows)[0], []
    at = {n: rows.index(n) for n in rows.columns}
    for who, _ in REALISATIONS:
        rough = [r for r in rows.rows if r[at["realisation"]] == who and r[at["status"]] == "converged" and finite(r[at["kkt"]]) and r[at["kkt"]] > 1e-8]
        if rough:
            worst = max(rough, key=lambda r: r[at["kkt"]])
            bound = bound_of(subject, worst[at["value"]], worst[at["limit"]], worst[at["expected"]])
            why = "twenty times the rounding of its matrices" if bound > subject.accepted(worst[at["value"]]) else subject.accepting()
            out.append(f"{subject.title}: {who} meets the KKT conditions to {worst[at['kkt']]:.1e} only at {name} = {worst[at['value']]:g}, and misses 1e-8 at {len(rough)} value{'s' if len(rough) > 1 else ''} of it "
                       f"(accepted up to {bound:.1e} there: {why})")
    off = [r for r in rows.rows if r[at["status"]] == "converged" and finite(r[at["error"]]) and r[at["error"]] > 0.01]
    if subject.wide and off:
        worst = max(off, key=lambda r: r[at["error"]])
        out.append(f"{subject.title}: off by {100 * worst[at['error']]:.1f} % at {name} = {worst[at['value']]:g}, accepted up to {100 * worst[at['limit']]:.1f} % there: {subject.wide}")
    return out


def parted(subject, rows):
    """Where condensed and FETI both converge but to different states: several are critical, and the way there decides. Each is compared with
    the direct solver at its own adhesion, so that the error does not show it; the defect of the balance does."""
    name, ends = parameter(rows)[0], {}
    for r in rows.rows:
        defect = r[rows.index("defect")]
        if r[rows.index("status")] == "converged" and finite(defect):
            ends.setdefault(r[rows.index("value")], {})[r[rows.index("realisation")]] = defect
    apart = {v: (d["condensed"], d["FETI"]) for v, d in ends.items() if {"condensed", "FETI"} <= set(d) and abs(d["condensed"] - d["FETI"]) > subject.apart(v)}
    if not apart:
        return []
    value, (one, other) = max(apart.items(), key=lambda item: abs(item[1][0] - item[1][1]))
    return [f"{subject.title}: condensed and FETI end in different critical states at {len(apart)} of {len(ends)} values of {name} (at {value:g} the balance misses {100 * one:.2g} and "
            f"{100 * other:.2g} % of the work): long steps through softening have several, each realisation is right at its own adhesion, and only shorter steps or solution = "
            "energetic tell which is lower (d-critical-states)"]


def pictures(subject, rows):
    """Error, KKT violation and iterations over the parameter, a series a realisation."""
    x_axis = axis(subject.x, subject.unit, subject.scale)
    errors, violations, counts, refused = [], [], [], []
    limits, own, bounds, zeros, answers = {}, {}, {}, False, False
    for who, role in REALISATIONS:
        picked = [r for r in rows.rows if r[rows.index("realisation")] == who and r[rows.index("status")] in ("converged", SAID)]
        if not picked:
            continue
        answers = True
        x = [subject.place(r[rows.index("value")]) for r in picked]

        def y(name):
            return [r[rows.index(name)] if finite(r[rows.index(name)]) else None for r in picked]

        # What is exactly zero has no place on a logarithmic axis.
        if any(v is not None for v in y("error")):
            errors.append(series(who, role, x, [None if v is None else max(v, 1e-18) for v in y("error")]))
            zeros = zeros or 0.0 in y("error")
        violations.append(series(who, role, x, [None if v is None else max(v, 1e-18) for v in y("kkt")]))
        bounds.update((a, bound_of(subject, r[rows.index("value")], limit, r[rows.index("expected")])) for a, limit, r in zip(x, y("limit"), picked))
        counts.append(series(f"{who}: Krylov" if who == "FETI" else f"{who}: active set", role, x, y("krylov" if who == "FETI" else "active_set")))
        (own if who == "direct" else limits).update(zip(x, y("limit")))
    for r in rows.rows:
        if r[rows.index("expected")].startswith("refused"):
            refused.append((r[rows.index("value")], r[rows.index("realisation")]))
    who = ", ".join(dict.fromkeys(of for _, of in refused)) + ": " if answers else ""
    note = f" Refused, as expected: {who}{parameter(rows)[0]} = " + ", ".join(f"{v:g}" for v in sorted({v for v, _ in refused})) + "." if refused else ""
    out = []
    if any(v is not None and v > 1e-18 for s in errors for v in s["y"]):
        drawn = []
        for label, of in (("limit", limits), ("limit of direct", {p: v for p, v in own.items() if v != limits.get(p)})):
            places = sorted(p for p in of if of[p] and of[p] > 0)
            if places and (label == "limit" or any(s["name"] == "direct" for s in errors)):
                drawn.append(series(label, "limit", places, [of[p] for p in places]))
        compared = next((s for s in dict.fromkeys(rows.column("reference")) if s != "is the reference"), "")
        out.append(plot(f"Error: {subject.title}", x_axis, axis("error", subject.error, "log"), [*drawn, *errors], (), f"Beside: {compared}." + (" Zero is drawn at 1e-18." if zeros else "") + note))
    if violations:
        out.append(plot(f"Violation of the KKT conditions: {subject.title}", x_axis, axis("worst violation", "relative", "log"),
                        [series("limit", "limit", list(bounds), list(bounds.values())), *violations], (),
                        "From exported fields." + (" Zero is drawn at 1e-18." if any(1e-18 in s["y"] for s in violations) else "") + note))
        out.append(plot(f"Iterations: {subject.title}", x_axis, axis("iterations, all steps", "", "log" if max(
            (v or 0 for s in counts for v in s["y"]), default=0) > 60 and all(v is None or v > 0 for s in counts for v in s["y"]) else "linear"), counts, (),
            "Krylov iterations of FETI, active-set steps of the others." + note))
    return out


def shown(subject, rows):
    name, unit = parameter(rows)
    counted = dict(optional=True, past="count")
    past = dict(optional=True, past=subject.past)
    return rows.table(f"{subject.title}", [
        column(name, unit, key=True, **{"from": "value"}), column("realisation", "", key=True), column("beside", "", **{"from": "reference"}),
        column("error", subject.error, **past), column("error limit", "", optional=True, past="free", **{"from": "limit"}), column("KKT", "relative", optional=True, past="rounding", **{"from": "kkt"}),
        column("ledger", "relative", optional=True, past="rounding"), column("defect", "of the work", optional=True, past="rounding"), column("damage", "", optional=True, past="rounding"),
        column("active set", "", **counted, **{"from": "active_set"}), column("Krylov", "", **counted, **{"from": "krylov"}), column("alternations", "", **counted),
        column("status"), column("expected outcome", "", **{"from": "expected"}), column("verdict"), column("in its own words", "", **{"from": "message"})], LEGEND + (" " + subject.legend if subject.legend else ""))


def falls(subject, rows, least, expected, tolerance):
    """Order of the condensed error in one over the parameter, from `least` on."""
    value, error, who = (rows.index(name) for name in ("value", "error", "realisation"))
    of = [(1.0 / r[value], r[error]) for r in rows.rows if r[who] == "condensed" and r[value] >= least]
    sizes, errors = [s for s, _ in of], [e for _, e in of]
    return order(f"error, {subject.title}", f"1/{parameter(rows)[0]}", fitting.fit(sizes, errors), expected, tolerance,
                 sizes, errors)


def stability(id, title, requirement, subjects, ref=DIRECT, quick=True, expected=30, seconds=1200, figures=(), rates=(), **scene):
    """rates: (subject, least value, order, tolerance) of errors that fall."""
    def run(context):
        tables, checks, plots, losses, answered, numbers, words, found = [], [], [], [], False, [], "", []
        wanted = [s for s in subjects if s.quick or not context.quick]
        # One run of the program for all of them: its libraries take a third of a second to load.
        called = dict.fromkeys(s.call or s.name for s in wanted)
        table = context.harness("stability", *(word for name in called for word in ("--subject", name)))
        for subject in wanted:
            rows = table.where(subject=subject.name)
            more, any_answer = judged(subject, rows)
            answered = answered or any_answer
            checks += more
            found += [falls(subject, rows, *rest) for name, *rest in rates if name == subject.name]
            losses += told(subject, rows)
            tables.append(shown(subject, rows))
            plots += pictures(subject, rows)
            words = words or next((m for m in rows.column("message") if m), "")
        for name, text in figures:
            used = [c["value"] for c in checks if c["what"].endswith("error over its limit")]
            numbers.append(figure(name, max(used), "of the limit", text, past="free"))
        return result(ref, tables=tables, checks=checks, plots=plots, losses=losses, orders=found, figures=numbers, refused="" if answered else words)

    scene.setdefault("units", "SI; errors relative to the largest value of their kind over the analysis")
    return Case(id=f"d-{id}", chapter="d", title=title, requirement=requirement, run=run, quick=quick, expected=expected, seconds=seconds, **scene)


CANTILEVER = dict(geometry="two arms 40 mm x 2 mm (in space 10 mm wide), 40 x 2 cells an arm (16 x 3 x 2 in space), notch of 12 mm at the loaded end, plane strain",
                  supports="right end clamped; upper left corner (edge) lifted, so that the crack tip is in mixed mode; FETI with 4 subdomains")
STEEL = "arms E = 70 GPa, nu = 0.3"
DUCTILE = "law Go 10/16, Gc 200/400 J/m2 by mode, kn = 1e12, kt = 2e12 N/m3: the process zone spans 8 to 16 pairs, so that a long step has one critical state"
BRITTLE = "law Go 50/80, Gc 200/400 J/m2 by mode, kn = 1e13, kt = 2e13 N/m3: the process zone is one pair"
DRIVEN = dict(geometry="two cells of 1 mm, one interface of two pairs that answer alike", supports="every node is held or driven: the jump is what the device prescribes")
SERIES = dict(geometry="bar of two halves of 1 m, 50 mm wide, the interface across", supports="one end held, the other pulled; sideways held or nu = 0")
KNOWN = ("Defect: the mixity of the step before, and work from the tractions at the ends of the steps, leave one that the law itself has; it is judged against that, to "
         "1e-10, within the verdict.")
OWN = reference("closed form", "the piecewise-linear law written apart from the library's, in extended precision, integrated with the jumps that the device prescribes",
                "extended precision; below 1e-15")
BAR = reference("closed form", "an elastic spring three times stiffer than the softening slope in series with the law: one continuous solution, linear in each branch",
                "double precision of the formula; exact for uniform stress")


def decades(value):
    return math.log10(value) if value > 0 else -330.0


def cases():
    none = " (none at -330)"
    sudden = "Defect: everything breaks within one step, whose work is recorded along a straight line of the load; it is what the interface sets free on the way, up to all of the work, and no fault of the state."
    k = dict(x="k", unit="N/m3")
    return [
        stability("stiffness", "Interface stiffness from 1e6 to 1e22 N/m3", "Sixteen decades of interface stiffness leave the elastic solution right to 3e-9, by either realisation, in the plane and in space.",
                  [Subject("stiffness", "plane", defect=1e-10, **k), Subject("stiffness-3d", "space", defect=1e-10, quick=False, **k)], materials=f"{STEEL}; kn = kt = k, unbreakable",
                  figures=[("stability_stiffness", "k from 1e6 to 1e22 N/m3: largest error over its limit of 3e-9")], expected=10, **CANTILEVER),
        stability("rigid", "The rigid limit, and bonds", "As k grows the difference to the bonded arms falls as that of springs in series with the cells beside them, a/(1 + a) with a = 0.3 E/(k h), to nothing; bonds themselves are right to 1e-10 over meshes.",
                  [Subject("rigid", "towards the bond", past=1e-3, defect=1e-10, wide="springs that are not rigid yet, a/(1 + a) with a = 0.3 E/(k h)", **k), Subject("bonded", "bonded", "columns", defect=1e-10)],
                  rates=[("rigid", 0.9e16, 1.0, 0.01)],
                  ref=reference("direct solver", "the bonded arms, eliminated by CHOLMOD; the difference that springs make is at most a/(1 + a), a = 0.3 E/(k h), of the cells of 1 mm", "1e-10, its rounding"),
                  materials=f"{STEEL}; kn = kt = k, or bonded", expected=2, **{**CANTILEVER, "geometry": CANTILEVER["geometry"].replace("notch of 12 mm at the loaded end", "no notch, or one of 12 mm (bonded)")}),
        stability("tractions", "Interface tractions do not oscillate", "Up to the rigid bond tractions follow the closed form, and their total variation is that of the smooth solution to 1 %.",
                  [Subject("tractions", "tractions", past=1e-4, defect=1e-9, acceptance=5e-9, **k), Subject("oscillation", "total variation", past=1e-4, defect=1e-9, acceptance=5e-9, error="of the smooth one", quick=False, **k)],
                  ref=reference("closed form", "Airy function of a layer of two halves with springs between, under the tension q (2 + cos(pi x/L))", "solved in extended precision, 1e-12; the mesh of 64 columns leaves "
                                "up to 2e-3 of the traction, 1e-2 of its variation"), geometry="layer 1 m x 0.5 m of two halves, 64 x 16 cells each, plane strain",
                  supports="frictionless base and ends; top under the tension q (2 + cos(pi x/L))", materials=f"{STEEL}; kn = kt = k, unbreakable", expected=8),
        stability("brittleness", "Gc/Go from 1 to 1e8", "From no softening at all to eight decades of it, the bar follows its closed form to 1e-10, or 1e-15 Gc/Go; on the cantilever every state meets KKT, ledger and law.",
                  [Subject("brittleness", "bar", "Gc/Go", acceptance=1e-8), Subject("brittleness-cantilever", "cantilever", "Gc/Go")],
                  ref=reference("closed form", BAR["source"] + "; of the cantilever the direct solver at its adhesions", "double precision of the formula; 1e-10 of the solver"),
                  geometry=SERIES["geometry"] + "; or " + CANTILEVER["geometry"], supports=SERIES["supports"] + "; or " + CANTILEVER["supports"], materials="Gc = 250 J/m2 (bar), 200 and 400 J/m2 by mode (cantilever), Go = Gc over the ratio", expected=5),
        stability("contrast", "Moduli of neighbours up to 1e8 apart", "A contrast of 1e-8 to 1e8 between the arms leaves the solution right to 1e-8.",
                  [Subject("contrast", "plane", "E upper / E lower", defect=1e-10, acceptance=1e-8), Subject("contrast-3d", "space", "E upper / E lower", defect=1e-10, acceptance=1e-8, quick=False)],
                  materials="the stiffer arm 70 GPa, nu = 0.3; k = 1e14 N/m3", expected=3, **CANTILEVER),
        stability("poisson", "Poisson's ratio up to 0.4999", "Solves stay right up to nu = 0.4999, and mean dilatation keeps cells from locking: the energy of a ring is that of Lame to 4e-4 with 4 nodes, 1e-6 with 8; without it 8-node cells lose as 1/(1 - 2 nu).",
                  [Subject(name, text, "1 - 2 nu", "", "log", lambda v: 1 - 2 * v, defect=1e-10, acceptance=1e-8 if "poisson" in name else 1e-9, past="rounding" if "poisson" in name else 1e-4) for name, text in
                   (("poisson-standard", "cantilever, standard"), ("poisson-mean-dilatation", "cantilever, mean dilatation"), ("ring-quad8-standard", "ring, quad8"),
                    ("ring-quad4-mean-dilatation", "ring, quad4, mean dilatation"), ("ring-quad8-mean-dilatation", "ring, quad8, mean dilatation"))],
                  ref=reference("closed form", "Lame's ring, its energy; of the cantilever the direct solver", "exact; the mesh of 24 x 12 cells leaves up to 4e-4 (quad4: straight edges), 1e-6 (quad8: parabolas), 1e-6/(1 - 2 nu) without mean dilatation"),
                  geometry="quarter of a ring, radii 1 and 2 m, two bonded halves; or " + CANTILEVER["geometry"], supports="planes of symmetry, inner face pushed by 1 mm; or " + CANTILEVER["supports"],
                  materials="E = 1 GPa (ring), 70 GPa (cantilever), nu from 0 to 0.4999", expected=6),
        stability("aspect", "Cells up to 1e4 times longer than thick", "Flat and tall cells, in the plane and in space: right to 1e-9, to 1e-11 times the ratio, or to twenty times what rounding of the matrices leaves, which the direct solver shows. FETI with a flat cell a piece converges in the plane up to 1e4. Longer pieces bend and lose digits by that: whole flat layers of cells of 10 in the plane, of 100 in space, tall cells of 1e4, and beyond, may say that the step did not converge, and by how much; condensed has no such place.",
                  [Subject(f"aspect-{n}", t, "aspect ratio of cells", quick=n != "3d", acceptance=1e-8) for n, t in (("flat", "flat, plane"), ("flat-whole", "flat, plane, layers whole"), ("tall", "tall, plane"), ("3d", "flat, space"))],
                  ref=reference("direct solver", DIRECT["source"], "its energy in two units of length differs by the rounding of the assembled matrices: the row 'direct'"),
                  materials=f"{STEEL}; k = 1e14 N/m3", **{**CANTILEVER, "geometry": "thin layers of one cell beside the interface, glued to arms of 40 mm x 4 mm; or arms of tall cells", "supports": "right end clamped; upper left corner (edge) lifted; FETI with a cell a piece, or 4 subdomains (tall cells; layers whole; space)"}, expected=30),
        stability("slender", "Plies 1000 times longer than thick", "Bending follows beams on springs within 0.1 % from l/t = 300 on; thicker arms differ by their shear and thickness, up to 15 (t/l)^2. Beside the direct solver solves are right to 5e-7 (a penetration below 1e-11 of the largest jump passes for rounding; where the arms just touch, it is 1e-7 of the largest traction), or to twenty times what rounding leaves; beyond 300 in the plane, and FETI beyond 80 in space, a step may say that it did not converge.",
                  [Subject("slender", "beam theory", "length / thickness", acceptance=lambda ratio: max(1e-8, 2e-16 * ratio ** 4), accepts="1e-8, or 2e-16 (l/t)^4: rounding of bending forces", past=1e-2,
                           wide="shear and thickness of arms that are not slender, which beams leave out, 15 (t/l)^2"), Subject("slender-direct", "plane", "length / thickness", call="slender", acceptance=1e-8),
                   Subject("slender-3d", "space", "length / thickness", quick=False, acceptance=1e-8)],
                  ref=reference("closed form", "double cantilever of beams on springs that resist opening alone, the arms touch behind them (compliance of both arms, root length 1/lambda); and the direct solver",
                                "0.1 % for pairs a twelfth of the root length apart, 15 (t/l)^2 for shear and thickness of the arms; rounding of the matrices, 2e-17 (l/t)^4 for a chain of cells"),
                  geometry="arms of 1 m, 120 cells of 8 nodes, 10 to 1000 times longer than thick; in space 16 x 2 x 2 cells", supports="right end clamped, left end opened", materials="E = 70 GPa, nu = 0 (0.3 in space)", expected=25),
        stability("size", "From nanometres to kilometres", "The same specimen of 40 nm to 40 km gives the same numbers to 1e-8: there is no hidden absolute tolerance.",
                  [Subject("size", "sizes", "length / 40 mm")], ref=reference("physics", "the same analysis at 40 mm, scaled", "none: an identity of the model; data of other sizes are rounded, 1e-16"),
                  materials=f"{STEEL}; {DUCTILE}; energies and stiffness scaled with the size; damage_tolerance = 1e-12", expected=4, **CANTILEVER),
        stability("units", "Units of length and force", "Powers of four leave all digits; so do odd powers of two of the unit of length, which change stiffness by powers of four, but not those of the unit of force, whose square root in Cholesky's factor rounds otherwise. These, and factors of ten, leave 1e-8: metres or micrometres, Pa or GPa, each realisation makes the same analysis.",
                  [Subject("unit-length-binary", "length, powers of four", "unit of length", "m"), Subject("unit-force-binary", "force, powers of four", "unit of force", "N"),
                   Subject("unit-length-odd", "length, odd powers of two", "unit of length", "m"), Subject("unit-force-odd", "force, odd powers of two", "unit of force", "N"), Subject("unit-length", "length", "unit of length", "m"),
                   Subject("unit-force", "force", "unit of force", "N"), Subject("unit-length-3d", "length, in space", "unit of length", "m", quick=False)],
                  ref=reference("physics", "the same analysis in SI units, scaled", "none: an identity of arithmetic for powers of four; 1e-16 of the data else"),
                  materials=f"{STEEL}; {DUCTILE}; damage_tolerance = 1e-12", expected=20, **CANTILEVER),
        stability("floating", "Bodies that nothing holds", "Loose plies that are pressed are held by contact; lifted, they float, at no stress; a bond that a dead load exceeds ends with the refusal `no equilibrium`.",
                  [Subject("floating-pressed", "pressed", "loose plies", scale="linear", defect=1e-10), Subject("floating-lifted", "lifted", "loose plies", scale="linear"),
                   Subject("dead-load-lifts", "dead load on a bond", "load / strength", defect=1e-10)],
                  ref=reference("closed form", "no stress (lifted), uniform tension (dead load); pressed: the direct solver with one node of each ply held sideways", "exact; 1e-10 of the solver"),
                  geometry="plies 40 mm x 3 mm, 20 x 2 cells, on a held one", supports="bottom held; top ply pressed or lifted in its middle third, or under a dead load",
                  materials="E = 70 GPa, nu = 0.3; no adhesion, or a bond of 50/200 J/m2", expected=4),
        stability("loose-load", "A dead load on a loose ply", "A dead load along a motion that nothing but contact could hold is refused before the analysis, in words, whatever its size.",
                  [Subject("dead-load-on-loose-ply", "dead load", "force", "N/m")], ref=reference("physics", "no equilibrium exists: a body without supports under a force that pushes it sideways or up", "none"),
                  geometry="two loose plies 40 mm x 3 mm on a held one", supports="bottom held; a dead load on the top ply", materials="E = 70 GPa, nu = 0.3; no adhesion", expected=1),
        stability("held-by-contact", "A block held by contact alone", "Pushed into the corner of two rigid walls under any angle the block is held by contact, and its solution is that of the direct solver.",
                  [Subject("held-by-contact", "block in a corner", "direction", "degrees", "linear", defect=1e-10)], geometry="block of 10 mm, 10 x 10 cells, two rigid obstacles",
                  supports="a dead load at the far corner, 1 to 89 degrees from the wall; no supports but contact", materials="E = 70 GPa, nu = 0.3; frictionless walls", expected=2),
        stability("open-close", "Contact that opens and closes in one step", "What was open closes and what was closed opens in one step, by up to a million times as much: right to 1e-10.",
                  [Subject("open-and-close", "reversal", "reverse / first load", defect=1e-10)], geometry="two arms 40 mm x 3 mm, 40 x 3 cells, glued at the last 5 mm", supports="right end clamped; end lifted and middle pressed, "
                  "then the reverse, then back", materials=f"{STEEL}; k = 1e14 N/m3", expected=2),
        stability("cross-points", "Cross points and redundant constraints", "Blocks that meet at crossings, glued with redundant or orthonormal constraints, bonded or on springs, are right to 1e-10.",
                  [Subject("cross-points", "on springs", "blocks a side", scale="linear", defect=1e-10), Subject("cross-points-redundant", "on springs, redundant gluing", "blocks a side", scale="linear", defect=1e-10),
                   Subject("cross-points-bonded", "bonded", "blocks a side", scale="linear", defect=1e-10)],
                  geometry="2 x 2 to 8 x 8 square blocks of 3 x 3 cells, FETI with n^2 + 4 subdomains", supports="bottom held, top pulled and turned", materials=f"{STEEL}; k = 1e14 N/m3 or bonded", expected=6),
        stability("supports-twice", "Supports given twice", "A support that was given already is refused, in words.", [Subject("supports-twice", "given twice", "blocks a side", scale="linear")],
                  ref=reference("physics", "the same row twice makes the reactions undetermined", "none"), geometry="blocks of 3 x 3 cells", supports="the bottom, held twice", materials=STEEL, expected=1),
        stability("pairs", "One pair to 3e4 pairs, and what 1e5 take", "One pair, a strip one cell thick under uniform tension: exact to 1e-10 by each realisation up to 1e3 pairs, by FETI and the direct solver to 1e4, by the direct solver to 1e5: there condensed refuses in words. FETI, whose coarse problem of 30,000 rigid motions at 1e5 pairs is sparse, is left out from 3e4 on for its time (once measured: right to 4e-13 in nine minutes and 6.3 GB). Pieces of FETI that are 20 times longer than thick leave 1e-12, longer ones say that they did not converge.",
                  [Subject("pairs", "strip", "pairs", defect=1e-10), Subject("pairs-pieces", "strip of 401 pairs, by its pieces", "length / thickness of a piece", defect=1e-10)], ref=reference("closed form", "uniform tension of two cells and a spring in series; one pair: the direct solver", "exact"),
                  geometry="two rows of cells of 1 mm, as long as there are pairs; one pair: corners of two triangles", supports="bottom held, top pulled by 1 micrometre; FETI with pieces of 20 cells", materials="E = 70 GPa, nu = 0; k = 1e14 N/m3", expected=240),
        stability("no-load", "No load at all", "Steps without any load give zeros, exactly.", [Subject("no-load", "no load", "steps")],
                  ref=reference("closed form", "nothing moves", "none: zeros"), materials=f"{STEEL}; {DUCTILE}", expected=1, **CANTILEVER),
        stability("cycles", "Load reversal and cycles", "Only the first pull damages: a hundred cycles of pull, release and pressure stay on the secant, and on the cantilever every state meets KKT and ledger.",
                  [Subject("cycles", "bar", "cycles"), Subject("cycles-cantilever", "cantilever", "cycles")], ref=reference("closed form", BAR["source"] + "; unloading on the secant, pressure closed; of the cantilever the direct solver", BAR["uncertainty"]),
                  geometry=SERIES["geometry"] + "; or " + CANTILEVER["geometry"], supports=SERIES["supports"] + "; or " + CANTILEVER["supports"], materials=f"k = 125e9 N/m3, Go = 100, Gc = 250 J/m2 (bar); cantilever: {DUCTILE}", expected=10),
        stability("mode-change", "Change of mode during softening", "Opened into softening, then slid until it breaks: traction, adhesion, energy and work are those of the law to 5e-12, and so is the defect of the balance, which the law gives, too: the mixity of a step is that of the step before.",
                  [Subject("mode-change", "open, then slide", "steps a leg", legend=KNOWN)], ref=OWN, materials="k = 125e9 N/m3; Go 100/200, Gc 250/900 J/m2 by mode", expected=2, **DRIVEN),
        stability("no-jump", "Mixity of no jump (0/0)", "A jump so small that its energy underflows does not decide the mode, at first or between steps: toughness is that of the jumps that load.",
                  [Subject(name, text, "log10 of the jump in m" + none, "", "linear", decades, legend=KNOWN) for name, text in (("psi-0/0", "first step"), ("psi-0/0-between", "between steps"))],
                  ref=OWN, materials="k = 125e9 N/m3; Go 100/200, Gc 250/900 J/m2 by mode", expected=2, **DRIVEN),
        stability("exponent", "Exponents of the criterion from 0.5 to 20", "The mixed-mode criterion with exponents from 0.5 to 20 is right to 5e-12.", [Subject("exponent", "mixed mode", "exponent", legend=KNOWN)],
                  ref=OWN, materials="kn = 1e12, kt = 2e12 N/m3; Go 100/200, Gc 300/900 J/m2 by mode", expected=2, **DRIVEN),
        stability("one-step", "Everything breaks in one step", "One step of up to a million times the load of full debond: the bar as its closed form, the cantilever with KKT and ledger.",
                  [Subject("one-step", "bar", "load / load of full debond", legend=sudden), Subject("one-step-cantilever", "cantilever", "lift / 1.5 mm", legend=sudden)], ref=reference("closed form", BAR["source"] + "; of the cantilever the direct solver", BAR["uncertainty"]),
                  geometry=SERIES["geometry"] + "; or " + CANTILEVER["geometry"], supports=SERIES["supports"] + "; or " + CANTILEVER["supports"], materials=f"k = 125e9 N/m3, Go = 100, Gc = 250 J/m2 (bar); cantilever: {BRITTLE}", expected=3),
        stability("damage-tolerance", "Tolerance of the minimisation, down to nothing", "What a further damage step would change falls with damage_tolerance (delta) down to rounding; fields and energies of these scenes, where the condensed analysis minimises jointly, are right to 1e-11 at any delta; with delta = 0 the analysis ends, converged or with the limit status.",
                  [Subject(name, text, "log10 of delta" + none, "", "linear", decades, apart=lambda delta: max(1e-3, delta)) for name, text in (("damage-tolerance", "bar"), ("damage-tolerance-cantilever", "cantilever"), ("damage-tolerance-0", "delta = 0"))],
                  ref=reference("closed form", BAR["source"] + "; limit 10 delta + 1e-11; of the cantilever the direct solver", BAR["uncertainty"]),
                  geometry=SERIES["geometry"] + "; or " + CANTILEVER["geometry"], supports=SERIES["supports"] + "; or " + CANTILEVER["supports"], materials=f"k = 125e9 N/m3, Go = 100, Gc = 250 J/m2 (bar); cantilever: {DUCTILE}", expected=8),
        stability("linear-tolerance", "Tolerance of FETI from 1e-2 to 1e-16", "The error follows the tolerance within twenty times, down to 1e-9; below 1e-13 FETI may say that it did not converge.",
                  [Subject("linear-tolerance", "elastic cantilever", "linear_tolerance", acceptance=lambda tolerance: 20 * tolerance + 1e-9, accepts="20 tolerances + 1e-9", wide="the tolerance that was asked for")], materials=f"{STEEL}; k = 1e14 N/m3", expected=2, **CANTILEVER),
        stability("subdomains", "1 to 512 subdomains", "The default preconditioner and those of the textbook (Dirichlet, lumped) are right to 1e-9 with any number of subdomains asked for (1 for two arms: one for each connected part, two).",
                  [Subject(f"subdomains-{n}", t, "subdomains", defect=1e-10) for n, t in (("series", "default (series)"), ("dirichlet", "Dirichlet"), ("lumped", "lumped"), ("1", "body on an obstacle"))],
                  materials=f"{STEEL}; k = 1e14 N/m3", expected=40, **{**CANTILEVER, "geometry": "the cantilever with 160 x 4 cells an arm; a body of 20 x 4 cells on a rigid obstacle, uncut to 8 parts"}),
        stability("combs", "Partitions that are all surface", "Combs pushed into each other, and cuts along them to 512 subdomains: right to 1e-10; FETI with two pieces of more than 16 teeth, which bend, may say that it is not.",
                  [Subject("combs-glued", "glued", "teeth", defect=1e-10, acceptance=5e-9), Subject("combs-on-springs", "on springs", "teeth", defect=1e-10, acceptance=5e-9), Subject("combs-cut", "glued, cut further", "subdomains", defect=1e-10, acceptance=5e-9)],
                  geometry="two combs with teeth one cell wide that fill each other's gaps, 16 rows of cells", supports="bottom held, top driven under 45 degrees", materials=f"{STEEL}; bonded, or k = 1e14 N/m3", expected=75),
        stability("host-stiffness", "Bodies that the host hands over", "An arm given as a matrix by the host gives what the arm of cells gives, over sixteen decades of k.",
                  [Subject("host-stiffness", "matrix beside cells", defect=1e-10, **k)], materials=f"{STEEL}; kn = kt = k, unbreakable", expected=2, **CANTILEVER),
    ]
