# SPDX-License-Identifier: BSD-3-Clause
"""The picture of an evaluation: the load curve with its points, and the toughness over the length of the crack."""
import os

from look import BLUE, GREY, ORANGE, RED, plt, save


def draw(out, curve, answers, points, fitted):
    """Lengths in mm, loads in N, toughnesses in J/m2. fitted: toughnesses of a fit as bands."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    left.plot(1e3 * curve.displacement, curve.load, color=GREY)
    for point, marker in zip(points, "os^"):
        left.plot(1e3 * point.displacement, point.load, marker, color=RED, label=point.name.partition(" (")[0])
    left.set_xlabel("displacement (mm)")
    left.set_ylabel("load (N)")
    left.legend()
    styles = [("-", GREY), ("o", BLUE), ("s", ORANGE), ("^", RED), ("v", GREY)]
    for (name, (crack, rate, _, _)), (style, colour) in zip(answers.items(), styles):
        right.plot(1e3 * crack, rate, style, color=colour, label=name, fillstyle="none")
    for key, value, low, high in fitted:
        right.axhspan(low, high, color=BLUE, alpha=0.15, label=f"fit: {key}")
        right.axhline(value, color=BLUE, linewidth=0.8)
    right.set_xlabel("crack length (mm)")
    right.set_ylabel("toughness (J/m$^2$)")
    right.set_ylim(bottom=0)
    right.legend(fontsize="small")
    save(figure, os.path.join(out, "evaluate.png"))
