# SPDX-License-Identifier: BSD-3-Clause
"""Records for the tests: a sound one, and ways to spoil it."""
import copy
import pathlib
import sys

REPORT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(REPORT))

import case as c  # noqa: E402

HEAD = dict(id="t-one", chapter="e", title="A bar", requirement="The end moves by F L / (E A).", geometry="1 m", materials="E = 1 Pa",
            supports="one end held", units="SI", reason="", command="none", commit="abc", library="0, abc", seconds=0.1)
SIZES = [0.4, 0.2, 0.1, 0.05]


def sound(**more) -> dict:
    """Errors of order 2, a check within its limit, a converged analysis."""
    import orders

    errors = [3.0 * h**2 for h in SIZES]
    table = c.table("Levels", [c.column("h", "m", key=True), c.column("error", "m"), c.column("rate", "", optional=True, past="free"),
                               c.column("iterations", "", past="count"), c.column("not_converged", "steps")],
                    [[h, e, None if i == 0 else 2.0, 100 + i, 0] for i, (h, e) in enumerate(zip(SIZES, errors))])
    plot = c.plot("Error", c.axis("h", "m", "log"), c.axis("error", "m", "log"), [c.series("error", "first", SIZES, errors)],
                  [{"kind": "slope", "order": 2, "label": "order 2"}])
    answer = c.result(c.reference("closed form", "F L / (E A)", "none"), tables=[table], plots=[plot],
                      orders=[c.order("error", "h", orders.fit(SIZES, errors), 2.0, 0.1, SIZES, errors)],
                      checks=[c.check("error at the finest level", errors[-1], 0.01, "ten times the expected error")],
                      figures=[c.figure("bar_error", errors[-1], "m", "Error of the bar")])
    nothing = {"verdict": "none", "value": None, "limit": None, "why": "not judged"}
    return copy.deepcopy({**HEAD, **answer, "judgement": {"reference": nothing, "past": nothing}, "status": "failed", **more})
