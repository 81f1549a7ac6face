# SPDX-License-Identifier: BSD-3-Clause
"""What chapter (h) asks of every analysis: a closed ledger, and a record of every jump."""
import bending
from case import axis, check, plot, series

LEDGER, WORK, DROP = 3e-3, 1e-3, 0.02  # LEDGER: the accuracy of steps by default
ROLES = ("first", "second", "third", "fourth", "fifth", "sixth")


def defect_of(of):
    return max(abs(d) for d in bending.defects(of.at)) / of.at["dissipated"][-1]


def balance(analyses):
    worst, name = max((defect_of(m), n) for n, m in analyses.items())
    return check("stored + dissipated + released - work, over what is dissipated", worst, LEDGER,
                 "four numbers, each computed by itself; the worst step of all analyses "
                 f"({name}), over the dissipated energy at the end: the accuracy that steps have by default")


def work(analyses, due):
    """Of the analyses of most steps: the ledger's work is that of the load."""
    off = {}
    for name, of in analyses.items():
        by_load, left_open = bending.work_of(of, due[name])
        off[name] = max(abs(of.at["work"][-1] - by_load) - left_open, 0.0) / of.at["work"][-1]
    return check("work off the integral of the load", max(off.values()), WORK, "trapezia of analyses of most steps, "
                 "with the recorded instants and loads of jumps; allowed besides: half of a fall at an unknown instant "
                 "times its step, and what trapezia of twice the length differ by")


def falls_at_once(analyses, scene):
    """Steps of each analysis, by its name, in which the load falls at once. scene: of an analysis, what distinguishes it from
    others besides the steps."""
    found = {}
    for key in {scene(m) for m in analyses.values()}:
        names = [n for n, m in analyses.items() if scene(m) == key]
        found.update(zip(names, bending.at_once([analyses[n] for n in names])))
    return found


def named(analyses, due):
    """Every fall at once has its jump."""
    missing = {name: bending.unnamed(m, due[name]) for name, m in analyses.items()}
    where = "; ".join(f"{name}: steps {', '.join(str(k) for k in steps[:4])}"
                      for name, steps in missing.items() if steps)
    return check("falls of the load without a recorded jump", sum(len(s) for s in missing.values()), 0,
                 f"more than {100 * DROP:g} % in a step, and not less in shorter steps"
                 + (f". {where}" if where else ""))


def picture(analyses, scale, label, unit):
    """Of the defects."""
    lines = [series(name, role, [scale * v for v in m.down],
                    [d / m.at["dissipated"][-1] for d in bending.defects(m.at)], marker=False)
             for (name, m), role in zip(analyses.items(), ROLES)]
    return plot("Defect of the ledger", axis(label, unit), axis("defect", "of the dissipated energy at the end"), lines,
                [{"kind": "horizontal", "value": v, "label": ""} for v in (-LEDGER, LEDGER)],
                "stored + dissipated + released - work; dotted: what is allowed.")
