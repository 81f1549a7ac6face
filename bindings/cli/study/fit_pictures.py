# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a fit: data and model, and beneath them the residuals."""
import os
import textwrap

from picture_style import BLUE, GREY, RED, axis, plt, save, units_of

TITLE = 88  # letters in a line of the title: what the width of the picture holds


def draw_fit(out, which, model, curve, history, drops, about, found):
    """drops: from where to where the model jumps; found: lines for the title, of parameters and of what the model cannot."""
    data = model.data[which]
    length, force, _ = units_of(about)
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.2, 5.4), sharex=True, constrained_layout=True,
                                          height_ratios=(3, 1))
    above.plot(data.x, data.y, "o", color=GREY, markersize=3.5, label="data")
    above.plot(history[model.x_name], history[model.y_name], color=BLUE, label="model")
    for k, (low, high) in enumerate(drops):
        name = "jump" if k == 0 else None
        if high > low:
            above.axvspan(low, high, color=RED, alpha=0.12, linewidth=0, label=name)
        else:
            above.axvline(low, color=RED, linewidth=0.8, linestyle=":", label=name)
    unit = force if model.y_name.startswith("reaction") else ""
    above.set_ylabel(axis(model.y_name, unit))
    above.legend()
    lines = [line for words in found for line in textwrap.wrap(words, TITLE)]
    above.set_title("\n".join([os.path.basename(model.files[which]), *lines]), fontsize=9)
    below.axhline(0.0, color=GREY, linewidth=0.8)
    below.plot(data.x, curve - data.y, "o", color=BLUE, markersize=3)
    below.set_ylabel("model - data" + f"\n[{unit}]" * bool(unit))
    below.set_xlabel(axis(model.named_x(which)[0], length if model.x_name.startswith("load") else ""))
    save(figure, os.path.join(out, "fit.png" if len(model.data) == 1 else f"fit-{which + 1}.png"))
