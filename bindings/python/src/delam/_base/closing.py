# SPDX-License-Identifier: BSD-3-Clause
"""The lines that end a history, without units, as the command line writes them (bindings/cli/src/result/closing)."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .arrays import FloatArray
from .records import Jump

_ROUNDING = 1e-9  # of the energy
_NOTICEABLE = 0.01  # of the work, or of the dissipated energy


def lines(columns: Mapping[str, FloatArray], jumps: Sequence[Jump], options: Mapping[str, Any]) -> list[str]:
    """columns: of a History, by the names of its values; options: step_control, mixity_rule and
    backtracking_tolerance."""
    out = [_of_jumps(jumps),
           _of_energies(columns, len(jumps)) if options["step_control"] == "load"
           else _of_balance(columns, options["mixity_rule"] == "variational"),
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
    return (f"{'' if share <= _NOTICEABLE else 'warning: '}energy balance: off by {_percent(share)} of the work "
            f"(stored + dissipated + released - work is {largest:.3g} in {_instant(columns, row)}; the work is up to "
            f"{work:.3g})")


def _percent(share: float) -> str:
    return "less than 0.001 %" if 0 < share < 1e-5 else format(100 * share, ".0f" if share >= 0.995 else ".2g") + " %"


def _of_energies(columns: Mapping[str, FloatArray], jumps: int) -> str:
    """Where steps follow their load, so that the four energies do not know of each other."""
    defect, work, dissipated = (columns[name] for name in ("defect", "work", "dissipated"))
    scale, row = float(np.abs(work).max()), int(np.nanargmax(np.abs(defect)))
    if scale == 0 and defect[row] == 0:
        return "energy balance: no work was done"
    energy = columns["stored_bulk"] + columns["stored_interface"] + columns["load_potential"]
    stored = energy[-1] - energy[0]
    released = defect[-1] + work[-1] - stored - dissipated[-1]
    if abs(released) <= _ROUNDING * scale:
        released = 0.0
    damaged = dissipated[-1] > 0
    share = abs(defect[row]) / (dissipated[-1] if damaged else scale)
    where = f" in {jumps} {'jump' if jumps == 1 else 'jumps'}" if jumps else ""
    return (f"{'' if share <= _NOTICEABLE else 'warning: '}energy balance: work {work[-1]:.3g} = stored {stored:.3g} + "
            f"dissipated {dissipated[-1]:.3g} + released{where} {released:.3g} + open {-defect[-1]:.3g}; open is "
            f"{_percent(share)} of the {'dissipated energy' if damaged else 'work'} at most ({-defect[row]:.3g} in "
            f"{_instant(columns, row)})")


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
