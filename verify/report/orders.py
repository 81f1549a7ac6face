# SPDX-License-Identifier: BSD-3-Clause
"""Orders of convergence from data: fitted to errors, observed in values, and what the limit would be."""
from __future__ import annotations

import math


def fit(sizes, errors) -> float:
    """Slope of log error over log size, least squares. Errors that are not positive, or fewer than two, are no data."""
    sizes, errors = [float(s) for s in sizes], [float(e) for e in errors]
    if len(sizes) != len(errors) or len(sizes) < 2:
        raise ValueError(f"an order needs two levels at least: {len(sizes)} sizes, {len(errors)} errors")
    if any(not (s > 0 and math.isfinite(s)) for s in sizes) or any(not (e > 0 and math.isfinite(e)) for e in errors):
        raise ValueError(f"sizes and errors must be positive: {sizes}, {errors}")
    x, y = [math.log(s) for s in sizes], [math.log(e) for e in errors]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    spread = sum((a - mean_x) ** 2 for a in x)
    if not spread > 0:
        raise ValueError("all sizes are the same")
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / spread


def rates(sizes, errors) -> list:
    """From each level to the next; None for the first and where there is none."""
    out: list = [None]
    for i in range(1, len(sizes)):
        try:
            out.append(fit(sizes[i - 1:i + 1], errors[i - 1:i + 1]))
        except ValueError:
            out.append(None)
    return out


def above_floor(sizes, errors, floor: float):
    """The levels before the errors reach rounding: what comes after is not the method's."""
    kept = []
    for s, e in zip(sizes, errors):
        if not e > floor:
            break
        kept.append((s, e))
    return [s for s, _ in kept], [e for _, e in kept]


def observed(sizes, values, low: float = 0.05, high: float = 8.0) -> float | None:
    """Order p of v = v0 + c size^p through the last three, whatever the ratio of the sizes; None where there is none."""
    if len(values) < 3:
        return None
    (s1, s2, s3), (v1, v2, v3) = sizes[-3:], values[-3:]
    if v2 == v3:
        return None
    ratio = (v1 - v2) / (v2 - v3)

    def predicted(p: float) -> float:
        return ((s1 / s3) ** p - (s2 / s3) ** p) / ((s2 / s3) ** p - 1.0)

    if not predicted(low) <= ratio <= predicted(high):
        return None
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if predicted(middle) < ratio else (low, middle)
    return low


def richardson(sizes, values, p: float) -> tuple[float, float]:
    """Limit of the last two values at order p, and the size of the extrapolation, which bounds nothing but tells how far."""
    step = (values[-1] - values[-2]) / ((sizes[-2] / sizes[-1]) ** p - 1.0)
    return values[-1] + step, abs(step)
