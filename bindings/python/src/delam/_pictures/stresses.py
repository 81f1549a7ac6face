# SPDX-License-Identifier: BSD-3-Clause
"""Stresses at some instants."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from .cells import boundary_edges, cell_blocks
from .result import Nothing, axis, fields_of, plt
from .snapshots import load_text, snapshot_steps


def draw_stress(ax, moved, file, step, factor, largest):
    """Cells by their stress along x; what came off is white between them."""
    cells, stress = file["mesh/cells"][()], step["stress"][:, 0] / factor
    number = (cells >= 0).sum(1)
    for n in np.unique(number):
        of = number == n
        corners = cells[of][:, :{3: 3, 4: 4, 6: 3, 8: 4, 9: 4}[n]]
        drawn = PolyCollection(moved[corners], cmap="RdBu_r", edgecolors="face", linewidths=0.1,
                               norm=plt.Normalize(-largest, largest))
        drawn.set_array(stress[of])
        ax.add_collection(drawn)
    return drawn


def stresses_figure(result):
    """Draws the stress along x of a plane scene with prescribed strains; the colours end at a stress that few cells
    exceed."""
    output = result.about["output"]
    if not result.prescribed_strains() or result.about["scene"]["dimension"] != 2 or "stress" not in output["fields"]:
        raise Nothing("stresses are drawn of plane scenes with prescribed strains that store the field stress")
    with fields_of(result) as file:
        shots = snapshot_steps(file, output["snapshots"])
        points = file["mesh/points"][:, :2]
        if "displacement" not in shots[0][1]:
            raise Nothing("no displacement in fields.h5")
        factor, unit = result.stress_unit(max(np.abs(step["stress"][:, 0]).max() for _, step in shots))
        height = min(4.0, 0.75 + 10 * np.ptp(points[:, 1]) / np.ptp(points[:, 0]))
        figure, axes = plt.subplots(len(shots), 1, squeeze=False, layout="constrained",
                                    figsize=(11.0, 1.0 + len(shots) * height))
        for ax, (time, step) in zip(axes.flat, shots):
            moved = points + output["displacement_scale"] * step["displacement"][:, :2]
            largest = np.percentile(np.abs(step["stress"][:, 0]), 99) / factor or 1.0
            drawn = draw_stress(ax, moved, file, step, factor, largest)
            outline, _ = boundary_edges(cell_blocks(file))
            ax.add_collection(LineCollection(moved[outline], colors="#50555c", linewidths=0.5))
            ax.autoscale_view()
            ax.set_aspect("equal")
            ax.axis("off")
            ax.set_title(f"t = {time:.6g}   {load_text(result, time)}", fontsize=9, loc="left")
            bar = figure.colorbar(drawn, ax=ax, shrink=0.9, aspect=12, pad=0.01)
            bar.set_label(axis("stress xx", unit), fontsize=8)
            bar.outline.set_visible(False)
        figure.suptitle(result.title(f"stress along x, displacements × {output['displacement_scale']:g}"), fontsize=11)
        result.stamp(figure)
    return figure
