# SPDX-License-Identifier: BSD-3-Clause
"""The lines that end a history, without units, as the command line writes them (bindings/cli/src/result/closing)."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .arrays import FloatArray
from .records import Jump

_ROUNDING = 1e-9  # of the energy
_NOTICEABLE = 0.01  # of the work


def lines(columns: Mapping[str, FloatArray], jumps: Sequence[Jump], options: Mapping[str, Any]) -> list[str]:
    """columns: of a History, by the names of its values; options: mixity_rule and backtracking_tolerance."""
    out = [_of_jumps(jumps), _of_balance(columns, options["mixity_rule"] == "variational"),
           *_of_estimate(columns, options["backtracking_tolerance"])]
    return [line for line in out if line]


def _instant(columns: Mapping[str, FloatArray], row: int) -> str:
    return f"step {int(columns['step'][row])}, time {columns['time'][row]:.6g}"


def _of_jumps(jumps: Sequence[Jump]) -> str:
    if not jumps:
        return ""
    first = min(jumps, key=lambda jump: jump.time)
    released, debonded = (sum(getattr(jump, name) for jump in jumps) for name in ("released", "debonded"))
    return (f"{len(jumps)} {'jump' if len(jumps) == 1 else 'jumps'}, the first at time {first.time:.6g}: "
            f"{released:.3g} released, {debonded:.3g} debonded")


def _of_balance(columns: Mapping[str, FloatArray], slides: bool) -> str:
    # Each mixity rule closes the balance in one of the two splits of the interfaces' energy.
    defect, work = columns["defect_slides" if slides else "defect"], float(np.abs(columns["work"]).max())
    row = int(np.nanargmax(np.abs(defect))) if np.isfinite(defect).any() else 0
    largest = float(defect[row])
    if work == 0 and largest == 0:
        return "energy balance: no work was done"
    share = abs(largest) / work if work > 0 else np.inf
    percent = "less than 0.001" if 0 < share < 1e-5 else format(100 * share, ".0f" if share >= 0.995 else ".2g")
    return (f"{'' if share <= _NOTICEABLE else 'warning: '}energy balance: off by {percent} % of the work (stored + "
            f"dissipated + released - work is {largest:.3g} in {_instant(columns, row)}; the work is up to {work:.3g})")


def _of_estimate(columns: Mapping[str, FloatArray], tolerance: float) -> list[str]:
    """The first row is the state at the beginning, which is not the result of a step."""
    lower, increment, upper, work = (columns[name] for name in ("lower", "increment", "upper", "work"))
    scale = np.maximum(np.abs(columns["stored_bulk"] + columns["stored_interface"] + columns["load_potential"]),
                       np.abs(work))
    # Negated, so that NaN counts as violated.
    within = (lower - increment <= tolerance * scale) & (increment - upper <= tolerance * scale)
    violated = np.flatnonzero(~within[1:]) + 1
    hollow = np.flatnonzero((upper - lower)[1:] > np.maximum(np.abs(np.diff(work)), _ROUNDING * scale[1:])) + 1
    out = []
    if violated.size:
        steps = ", ".join(str(int(columns["step"][row])) for row in violated)
        out.append(f"two-sided estimate violated in steps: {steps} (tolerance eta = {tolerance:g})")
    if hollow.size:
        out.append(f"two-sided estimate says nothing in {hollow.size} {'step' if hollow.size == 1 else 'steps'} (the "
                   f"first is step {int(columns['step'][hollow[0]])}): its bounds lie farther apart than the work of "
                   f"the step")
    return out
