# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as people read them; the same in the pages and in the README."""
import math


def show(value) -> str:
    """Four digits, powers of ten where they are shorter."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if not math.isfinite(value):
        return str(value)
    if value == int(value) and abs(value) < 1e6:
        return f"{int(value):,}".replace(",", "\u202f") if abs(value) >= 10000 else str(int(value))
    size = abs(value)
    if 1e-3 <= size < 1e5:
        return f"{value:.4g}" if size < 9999.5 else f"{value:,.0f}".replace(",", "\u202f")
    if 1e5 <= size < 1e6:
        return f"{value:,.0f}".replace(",", "\u202f")
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}e{int(exponent)}"
