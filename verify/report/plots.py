# SPDX-License-Identifier: BSD-3-Clause
"""Draws the plots of the JSON: once for a desktop's width, once for a phone's, both as SVG with letters as outlines."""
from __future__ import annotations

import base64
import io
import math
import re
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

import palette  # noqa: E402
from words import show  # noqa: E402

# Inches: the page's text at 1280 pixels, a phone. Letters of 9 points or more; those of the wide one are larger, for windows between the two.
WIDE, NARROW = (11.33, 5.2), (3.6, 3.9)
LARGER = 1.25
LETTERS = {"font.size": 9.5, "axes.labelsize": 9.5, "axes.titlesize": 10, "legend.fontsize": 9, "xtick.labelsize": 9, "ytick.labelsize": 9}
LINES = {"solid": "-", "dashed": "--", "dotted": ":", "none": ""}
matplotlib.rcParams.update({
    **LETTERS, "font.family": "DejaVu Sans", "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#E3E3E3",
    "grid.linewidth": 0.6, "axes.axisbelow": True, "lines.linewidth": 1.6, "lines.markersize": 5, "svg.fonttype": "path",
    "svg.hashsalt": "delam", "axes.edgecolor": "#555555", "legend.frameon": False,
})


def _label(axis: dict) -> str:
    return f"{axis['label']} ({axis['unit']})" if axis["unit"] else axis["label"]


def _positive(plot: dict, name: str) -> list[float]:
    marked = {"horizontal": "y", "vertical": "x"}
    values = [v for s in plot["series"] for v in s[name]] + [m["value"] for m in plot.get("marks", []) if marked.get(m["kind"]) == name]
    return [v for v in values if v is not None and v > 0]


def _coincide(one: dict, other: dict, scale: str) -> bool:
    """Curves that a reader would see as one; the lower is drawn thicker, so that both show."""
    second = dict(zip(other["x"], other["y"]))
    shared = [(y, second[x]) for x, y in zip(one["x"], one["y"]) if y is not None and second.get(x) is not None]
    size = max((abs(v) for pair in shared for v in pair), default=0.0)
    near = [abs(a - b) <= 0.02 * (max(abs(a), abs(b)) if scale == "log" else size) for a, b in shared]
    return bool(near) and sum(near) >= 0.5 * len(near)


def _log_ticks(ax, values: list[float], horizontal: bool, narrow: bool) -> None:
    """Few places are named themselves; within two decades 1, 2, 5; else the powers of ten."""
    if not values:
        return
    places = sorted(set(values))
    apart = all(b / a > (places[-1] / places[0]) ** (0.16 if narrow else 0.09) for a, b in zip(places, places[1:]))
    plain = matplotlib.ticker.FuncFormatter(lambda v, _: f"{float(f'{v:.3g}'):g}")
    if horizontal and len(places) <= (5 if narrow else 10) and apart and 1e-4 <= places[0] and places[-1] < 1e5:
        ax.set_major_locator(matplotlib.ticker.FixedLocator(places))
    elif max(values) / min(values) < 50 and 1e-4 <= min(values) and max(values) < 1e6:
        ax.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    elif max(values) / min(values) < 10:
        ax.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        plain = matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:.0e}".replace("e-0", "e-"))
    else:
        return
    ax.set_major_formatter(plain)
    ax.set_minor_formatter(matplotlib.ticker.NullFormatter())


def _draw_bars(plot: dict, size: tuple[float, float]):
    """Bars that lie, so that their names are read; the number at the end of each, its spread as a whisker."""
    names, scale = plot["x"]["bars"], 1.0 if size == NARROW else LARGER
    figure, axes = plt.subplots(figsize=(size[0], scale * (0.9 + 0.42 * len(names) * len(plot["series"]))), layout="constrained")
    thick = 0.62 / len(plot["series"])
    for place, s in enumerate(plot["series"]):
        colour, _, _ = palette.style(s["role"])
        at = [x + (place - 0.5 * (len(plot["series"]) - 1)) * thick for x in s["x"]]
        spread = [[max(y - low, 0.0) for y, low in zip(s["y"], s["low"])], [max(high - y, 0.0) for y, high in zip(s["y"], s["high"])]] if "low" in s else None
        axes.barh(at, s["y"], thick, color=colour, label=s["name"], xerr=spread, error_kw={"ecolor": palette.BLACK, "elinewidth": 1.2, "capsize": 3})
        for x, y, end in zip(at, s["y"], s.get("high", s["y"])):
            axes.annotate(show(y), (max(y, end, 0.0), x), xytext=(5, 0), textcoords="offset points", va="center", fontsize=9 * scale)
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.axvline(0.0, color="#555555", linewidth=0.8)
    axes.margins(x=0.28 if size == NARROW else 0.14)
    axes.set_xlabel(_label(plot["y"]))
    if size == NARROW:
        axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(5))
    if len(plot["series"]) > 1:
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return figure


def _draw(plot: dict, size: tuple[float, float]):
    if "bars" in plot["x"]:
        return _draw_bars(plot, size)
    figure, axes = plt.subplots(figsize=size, layout="constrained")
    narrow = size == NARROW
    scale = 1.0 if narrow else LARGER
    repeated: dict[str, int] = {}
    for place, s in enumerate(plot["series"]):
        below = min(sum(_coincide(s, other, plot["y"]["scale"]) for other in plot["series"][place + 1:]), 3)
        colour, marker, line = palette.style(s["role"])
        turn = repeated.get(s["role"], 0)
        repeated[s["role"]] = turn + 1
        # Several series of one role differ by their lines and by filled or unfilled markers.
        line = LINES[s["line"]] if "line" in s else ("-", "--", ":", "-.")[turn % 4] if line == "-" else line
        x, y = list(s["x"]), [math.nan if v is None else v for v in s["y"]]
        for name, values in (("x", x), ("y", y)):
            if plot[name]["scale"] == "log":
                values[:] = [v if v > 0 else math.nan for v in values]
        axes.plot(x, y, color=colour, linestyle=line or "none",
                  marker="" if s.get("marker") is False or (len(x) > 60 and line) else marker or ("o" if not line else ""),
                  markerfacecolor="white" if s.get("unfilled", turn % 2 == 1) else colour, label=s["name"], linewidth=1.6 + 0.9 * below,
                  markersize=scale * (5 + 2 * below))
    axes.set_xscale(plot["x"]["scale"])
    axes.set_yscale(plot["y"]["scale"])
    slopes = 0
    for mark in plot.get("marks", []):
        if mark["kind"] == "horizontal":
            axes.axhline(mark["value"], color=palette.GREY, linestyle=":", linewidth=1.3, label=mark["label"])
        elif mark["kind"] == "vertical":
            axes.axvline(mark["value"], color=palette.GREY, linestyle=":", linewidth=1.3, label=mark["label"])
        elif mark["kind"] == "slope":
            xs, ys = _positive(plot, "x"), _positive(plot, "y")
            if xs and ys:
                low, high = min(xs), max(xs)
                top = max(ys)
                axes.plot([low, high], [top * (low / high) ** mark["order"], top], color=palette.GREY, linewidth=1.2,
                          linestyle=((0, (1, 2)), (0, (5, 2)), "-.")[slopes % 3], label=mark["label"])
                slopes += 1
    axes.set_xlabel("\n".join(textwrap.wrap(_label(plot["x"]), 42)) if narrow else _label(plot["x"]))
    axes.set_ylabel(_label(plot["y"]))
    for name, ax in (("x", axes.xaxis), ("y", axes.yaxis)):
        if plot[name]["scale"] == "log":
            _log_ticks(ax, _positive(plot, name), name == "x", narrow)
        elif narrow:
            ax.set_major_locator(matplotlib.ticker.MaxNLocator(5))
    handles, labels = axes.get_legend_handles_labels()
    if len(handles) > 1 or plot.get("marks"):
        longest = max(len(text) for text in labels)
        columns = min(len(handles), (1 if longest > 17 else 2) if narrow else 2 if longest > 42 else 3 if longest > 28 else 4 if longest > 18 else 5)
        # Below the axes, where it covers nothing; the picture grows by its rows.
        room = scale * (0.2 * math.ceil(len(handles) / columns) + 0.08)
        height = size[1] + max(0.0, room - 0.3)
        figure.set_size_inches(size[0], height)
        figure.set_layout_engine("constrained", rect=(0.0, room / height, 1.0, 1.0 - room / height))
        figure.legend(handles, labels, loc="lower center", ncols=columns, handlelength=2.2, columnspacing=1.2, borderaxespad=0.1)
    return figure


def svg(plot: dict, size: tuple[float, float]) -> str:
    out = io.StringIO()
    with matplotlib.rc_context({} if size == NARROW else {name: LARGER * points for name, points in LETTERS.items()}):
        figure = _draw(plot, size)
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
        plt.close(figure)
    text = out.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r">\s+<", "><", text)  # letters are paths: no blank between elements is shown
    # Hundredths of a point are enough for lines; scales of letters keep all their digits.
    return re.sub(r' d="[^"]*"', lambda path: re.sub(r"(\d+\.\d{2})\d+", r"\1", re.sub(r"\s+", " ", path.group(0))), text)


def data_uri(text: str) -> str:
    return "data:image/svg+xml;base64," + base64.b64encode(text.encode("utf-8")).decode("ascii")


def both(plot: dict) -> dict:
    """The two drawings as addresses that need no file."""
    return {"wide": data_uri(svg(plot, WIDE)), "narrow": data_uri(svg(plot, NARROW)), "title": plot["title"],
            "caption": plot.get("caption", "")}
