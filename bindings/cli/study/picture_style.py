# SPDX-License-Identifier: BSD-3-Clause
"""The style of pictures of studies, which is that of results (_pictures)."""
import numpy as np

import command  # noqa: F401, finds _pictures
from _pictures.result import BLUE, GREY, ORANGE, RED, axis, for_files, name_axis, plt, save

for_files()
__all__ = ["BLUE", "GREY", "ORANGE", "RED", "axis", "colours_of", "name_axis", "plt", "save", "scales_of", "units_of"]


def units_of(about):
    """Of load, reaction and energy, as far as the scene names units."""
    length, force = about["units"]["length"], about["units"]["force"]
    flat = about["scene"]["dimension"] == 2
    if not (length and force):
        return "", "", ""
    return length, f"{force}/{length}" if flat else force, f"{force} {length}"


def scales_of(about, quantity):
    """The units of "length", "force" or "energy" in which a result of this scene is shown (result.json)."""
    flat = about["scene"]["dimension"] == 2 and quantity != "length"
    scales = about["units"].get("scales", {}).get(f"line_{quantity}" if flat else quantity, [])
    return [(float(one["factor"]), one["name"]) for one in scales]


def colours_of(values, log=False):
    """A colour for each value, and what a colour bar needs; dark blue to yellow, which all people can tell apart."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm, Normalize
    low, high = float(np.min(values)), float(np.max(values))
    norm = LogNorm(low, high) if log and low > 0 else Normalize(low, high if high > low else low + 1)
    mapped = ScalarMappable(norm, plt.get_cmap("cividis"))
    return mapped.to_rgba(values), mapped
