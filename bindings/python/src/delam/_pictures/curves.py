# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the history alone: load and displacement, average stress and strain, energies."""
import numpy as np

from .result import BLUE, GREEN, GREY, ORANGE, RED, Nothing, axis, early_end, name_axis, plt, zoom


def load_figure(result):
    """A picture for each pattern; of a single one also the beginning where that is where things happen."""
    patterns = result.patterns()
    number = len(patterns)
    closer = early_end(result) if number == 1 else None
    columns = number if closer is None else 2
    figure, axes = plt.subplots(1, columns, figsize=((6.8 if columns == 1 else 6.0) * columns, 4.4), squeeze=False,
                                layout="constrained")
    failed = set(result.about.get("not_converged", []))
    bad = [i for i, step in enumerate(result.history["step"]) if int(step) in failed]
    for p, (name, _, _, _) in enumerate(patterns):
        x, y = result.load_curve(p)
        drawn = axes[0] if number == 1 else axes[0][p:p + 1]
        for ax in drawn:
            # Markers show the steps, where there is room between them.
            ax.plot(*result.load_path(p), color=BLUE)
            if len(x) <= 100:
                ax.plot(x, y, "o", color=BLUE, markersize=3)
            if bad:
                ax.plot(x[bad], y[bad], "x", color=RED, label="not converged")
                ax.legend()
        result.label_load(drawn, p)
        if number > 1:
            drawn[0].set_title(name, fontsize=10)
        elif closer is not None:
            zoom(drawn[1], x[closer], [(x, y)])
            drawn[1].set_title("the beginning", fontsize=10, loc="left")
    figure.suptitle(result.title("load and displacement"), fontsize=11)
    result.stamp(figure)
    return figure


def averages_figure(result):
    """Average stress over average strain."""
    averages = result.averages()
    if not averages:
        raise Nothing("the history has no component of both average strain and average stress")
    factor, unit = result.stress_unit(max(np.abs(stress).max() for _, _, stress in averages))
    figure, ax = plt.subplots(figsize=(6.8, 4.4), layout="constrained")
    for component, strain, stress in averages:
        colour = BLUE if len(averages) == 1 else None
        line, = ax.plot(100 * strain, stress / factor, label=component, color=colour)
        # The stiffness of the beginning, as far as the picture is high.
        if len(strain) > 1 and strain[1] != strain[0]:
            slope = (stress[1] - stress[0]) / (strain[1] - strain[0])
            end = min(np.abs(strain).max(), 1.05 * np.abs(stress).max() / abs(slope)) if slope else 0
            ax.plot([0, 100 * end], [0, slope * end / factor], color=line.get_color(), linewidth=0.8, linestyle=":")
    ax.set_xlabel("average strain [%]")
    ax.set_ylabel(axis("average stress", unit))
    if len(averages) > 1:
        ax.legend()
    else:
        ax.set_title(averages[0][0], fontsize=10, loc="left")
    figure.suptitle(result.title("average stress and strain"), fontsize=11)
    result.stamp(figure)
    return figure


def draw_energies(ax, result):
    """Energies over the load, as in the presentation of PANM 15 ("Energetics of ENF test")."""
    h = result.history
    stored = h["stored_bulk"] + h["stored_interface"] + h.get("load_potential", 0)
    curves = [("stored, bodies", h["stored_bulk"], {"color": BLUE}),
              ("stored, interfaces", h["stored_interface"], {"color": GREEN})]
    if "load_potential" in h:
        curves.append(("potential of the dead loads", h["load_potential"], {"color": GREY}))
    curves += [("dissipated", h["dissipated"], {"color": RED}), ("total", stored + h["dissipated"], {"color": "black"}),
               ("work", h["work"] + stored[0], {"color": ORANGE, "linestyle": "--"})]
    for label, y, style in curves:
        ax.plot(h["time"], y, label=label, **style)
    for i, instant in enumerate(result.jump_times()):
        ax.axvline(instant, color=GREY, linestyle=":", linewidth=1.0, label="located jump" if i == 0 else None)
    return [(h["time"], y) for _, y, _ in curves]


def energies_figure(result):
    h = result.history
    t = h["time"]
    closer = early_end(result)
    if closer is None:
        figure, (top, bottom) = plt.subplots(2, 1, figsize=(7.2, 7.4), sharex=True, height_ratios=[3, 2],
                                              layout="constrained")
    else:
        figure = plt.figure(figsize=(12.4, 7.4), layout="constrained")
        grid = figure.add_gridspec(2, 2, height_ratios=[3, 2])
        top, bottom = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[1, :])
        beginning = figure.add_subplot(grid[0, 1])
        zoom(beginning, t[closer], draw_energies(beginning, result))
        beginning.set_title("the beginning", fontsize=10, loc="left")
        beginning.set_xlabel(axis("time", result.time))
        top.set_xlabel(axis("time", result.time))
    draw_energies(top, result)
    name_axis(top.yaxis, "energy", result.scales("energy"))
    if closer is not None:
        name_axis(beginning.yaxis, "", result.scales("energy"), np.max(np.abs(top.yaxis.get_data_interval())))
    # Above the axes: nowhere inside is free of curves in every result.
    top.legend(ncols=3, loc="lower left", bbox_to_anchor=(0, 1.0), fontsize=8)

    # The band of the two-sided estimate, cumulated and seen from its middle; at the scale of the work it is a line.
    lower, increment, upper = (np.cumsum(h[name]) for name in ("lower", "increment", "upper"))
    middle = 0.5 * (lower + upper)
    bottom.fill_between(t, lower - middle, upper - middle, color=BLUE, alpha=0.18, linewidth=0,
                        label="lower .. upper bound")
    bottom.plot(t, increment - middle, color="black", label="stored + dissipated")
    bottom.axhline(0, color=ORANGE, linestyle="--", linewidth=1.2, label="work, (lower + upper)/2")
    name_axis(bottom.yaxis, "cumulated − work", result.scales("energy"))
    bottom.set_xlabel(axis("time", result.time))
    bottom.legend(loc="upper left", bbox_to_anchor=(0, -0.2), ncols=3, fontsize=8)
    # The run has judged the estimate: the picture must not disagree with its closing line.
    violated = result.about.get("estimate_violated", [])
    eta = result.about["options"]["backtracking_tolerance"]
    said = "" if violated is None else ": met in every step" if len(violated) == 0 else (
        f": violated in {len(violated)} of {len(t) - 1} steps")
    bottom.set_title(f"two-sided estimate{said} (tolerance {eta:g})", fontsize=9, loc="left")
    returns = int(np.sum(h["backtracks"]))
    if returns:
        bottom.set_title(f"returns to earlier steps: {returns}", fontsize=9, loc="right")
    room = max(np.max(np.abs(upper - middle), initial=0), np.max(np.abs(increment - middle), initial=0))
    if room > 0:
        bottom.set_ylim(-1.15 * room, 1.15 * room)
    figure.suptitle(result.title("energies"), fontsize=11)
    result.stamp(figure)
    return figure
