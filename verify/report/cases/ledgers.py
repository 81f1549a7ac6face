# SPDX-License-Identifier: BSD-3-Clause
"""What chapter (h) asks of every march: a closed ledger, and a record of every jump."""
import bending
from case import axis, check, plot, series

LEDGER, DROP = 1e-3, 0.02
ROLES = ("first", "second", "third", "fourth", "fifth", "sixth")


def defect_of(of):
    return max(abs(d) for d in bending.defects(of.at)) / of.at["work"][-1]


def balance(marches):
    worst, name = max((defect_of(m), n) for n, m in marches.items())
    return check("stored + dissipated + released - work, over the work", worst, LEDGER,
                 "an identity, with the path resolved where the state jumps; the worst step of all marches "
                 f"({name}), over the work at the end")


def named(marches, finest):
    """Every fall of the load that is no smooth one has its jump. finest: the march of most steps beside each."""
    missing = {name: bending.unnamed(m, bending.jumps_due(m, finest(m))) for name, m in marches.items()}
    where = "; ".join(f"{name}: steps {', '.join(str(k) for k in steps[:4])}"
                      for name, steps in missing.items() if steps)
    return check("falls of the load without a recorded jump", sum(len(s) for s in missing.values()), 0,
                 f"more than {100 * DROP:g} % in a step, in the march of most steps of a mesh; of the others the fall "
                 "at that instant" + (f". {where}" if where else ""))


def picture(marches, scale, label, unit):
    """Of the defects."""
    lines = [series(name, role, [scale * v for v in m.down],
                    [d / m.at["work"][-1] for d in bending.defects(m.at)], marker=False)
             for (name, m), role in zip(marches.items(), ROLES)]
    return plot("Defect of the ledger", axis(label, unit), axis("defect", "of the work at the end"), lines,
                [{"kind": "horizontal", "value": v, "label": ""} for v in (-LEDGER, LEDGER)],
                "stored + dissipated + released - work; dotted: what is allowed.")
