# SPDX-License-Identifier: BSD-3-Clause
"""Reads a result of `delam run` from its folder for the pictures, and sets how pictures look."""
import contextlib
import errno
import os
import stat

import matplotlib
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np

from .input_file import MOST_RESULT, Unreadable, fields_file, read_columns, read_json

LEAST_SHOWN, MOST_SHOWN = 0.2, 2000  # of the unit that a scene names: text/unit.cpp has the same for lines
WITHIN = ("strain", "gap")  # these patterns act inside the bodies and between them: their factors are no loads
BLUE, RED, GREEN, ORANGE, GREY = "#1f5a99", "#b3312c", "#2f7d4f", "#d18b1f", "#7a7f87"
STYLE = {
    "font.size": 11.5, "axes.titlesize": 12, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#e4e6ea", "grid.linewidth": 0.8, "axes.axisbelow": True,
    "text.parse_math": False,  # names of scenes are no formulas
    "axes.formatter.useoffset": False,  # ticks say what they are, and no difference from a number above the axis
    "axes.edgecolor": "#50555c", "lines.linewidth": 1.6, "legend.frameon": False, "figure.dpi": 110, "savefig.dpi": 150,
}


class Nothing(Exception):
    """Why there is no picture. expected: a result of this kind has none."""

    def __init__(self, reason, expected=True):
        super().__init__(reason)
        self.expected = expected


def fields_of(result):
    """The open fields.h5 of a result. Nothing: its scene writes no fields."""
    if not result.about["output"]["fields"]:
        raise Nothing("the scene writes no fields")
    return fields_file(os.path.join(result.folder, "fields.h5"))


def for_files():
    """Pictures are written, not shown: for scripts."""
    matplotlib.use("Agg")
    plt.rcParams.update(STYLE)


@contextlib.contextmanager
def styled():
    """The style for a while. Not pyplot's rc_context: at its end it forgets what a notebook sets with its first
    figure."""
    before = {key: plt.rcParams[key] for key in STYLE}
    plt.rcParams.update(STYLE)
    try:
        yield
    finally:
        plt.rcParams.update(before)


def axis(label, unit):
    return f"{label} [{unit}]" if unit else label


def suiting(scales, largest):
    """(factor, name) of the unit in which numbers up to `largest` are shown: that of the scene (factor 1) where they
    are neither tiny nor huge, else one with another prefix. scales: a list of result.json, from the smallest unit to
    the largest, which the program makes of its table of units (bindings/cli/src/text/unit.hpp)."""
    if len(scales) == 1:
        return scales[0]
    own = next((scale for scale in scales if scale[0] == 1), (1.0, ""))
    usual = LEAST_SHOWN <= largest < MOST_SHOWN
    if not scales or usual or not np.isfinite(largest) or largest * scales[0][0] < LEAST_SHOWN:
        return own
    return next((scale for scale in reversed(scales) if largest * scale[0] >= 1 - 1e-9), scales[0] if scales else own)


def name_axis(of, label, scales, largest=None):
    """Labels an axis (ax.xaxis, ax.yaxis) that shows numbers of the scene, in the unit that suits those drawn on it."""
    low, high = of.get_data_interval()
    factor, unit = suiting(scales, max(abs(low), abs(high)) if largest is None else largest)
    of.set_label_text(axis(label, unit))
    if factor != 1:
        of.set_major_formatter(_Scaled(factor))


class _Scaled(matplotlib.ticker.ScalarFormatter):
    """Numbers times a factor, which is a power of ten: ticks stay round."""

    def __init__(self, factor):
        super().__init__(useOffset=False)
        self.set_scientific(False)  # else its power of ten stands beside the prefix of the unit
        self._factor = factor

    def __call__(self, x, pos=None):
        return f"{x * self._factor:.10g}".replace("-", "\N{MINUS SIGN}")


def save(figure, path):
    """Beside and renamed, like every other file of a result. FileExistsError: something has the name that is no picture
    which this module has drawn."""
    if os.path.lexists(path) and not _is_drawn(path):
        raise FileExistsError(errno.EEXIST, "this is no picture that delam has drawn; move it away", path)
    beside = f"{path}.new-{os.getpid()}"
    new = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
    with os.fdopen(os.open(beside, new, 0o666), "wb") as file:
        try:
            figure.savefig(file, format=os.path.splitext(path)[1][1:] or "png")
            file.flush()
            os.replace(beside, path)
        except BaseException:
            os.unlink(beside)
            raise
    plt.close(figure)


def _is_drawn(path):
    """True for a regular file, with one name, that Matplotlib has written: it says so near the beginning of a PNG or
    an SVG."""
    about = os.lstat(path)
    if not stat.S_ISREG(about.st_mode) or about.st_nlink > 1:
        return False
    with open(path, "rb") as file:
        head = file.read(1024)
    return (head.startswith(b"\x89PNG\r\n") and b"Software\0Matplotlib" in head
            or head.startswith(b"<?xml") and b"<dc:title>Matplotlib" in head)


def early_end(result):
    """Step up to which to look more closely: twice as far as where half of what dissipates has done so, if that is in
    the first sixth of the march; else None."""
    dissipated = result.history["dissipated"]
    time = result.history["time"]
    half = int(np.argmax(dissipated >= 0.5 * dissipated[-1]))
    if dissipated[-1] <= 0 or time[half] - time[0] > (time[-1] - time[0]) / 6:
        return None
    return min(2 * half + 1, len(time) - 1)


def zoom(ax, x, curves):
    """Limits of the axes to what lies before x; curves: pairs of x and y."""
    seen = np.concatenate([np.asarray(y)[np.asarray(at) <= x] for at, y in curves])
    room = 0.05 * (seen.max() - seen.min())
    first = min(at[0] for at, _ in curves)
    ax.set_xlim(first - 0.02 * (x - first), x + 0.02 * (x - first))
    if room > 0:
        ax.set_ylim(seen.min() - room, seen.max() + room)


def four_digits(value, digits=4):
    return f"{value:.0f}" if 1e3 <= abs(value) < 1e7 else f"{value:.{digits}g}"


def _plain_scales(length, force):
    """Returns the scales of results that name their units alone, such as those of earlier versions: they take no
    prefixes."""
    known = bool(length and force)
    work = "J" if (force, length) == ("N", "m") else f"{force} {length}"
    names = {"length": length, "area": f"{length}²" if length else "", "force": force,
             "line_force": f"{force}/{length}", "energy": work, "line_energy": f"{work}/{length}",
             "release_rate": f"{force}/{length}", "stress": f"{force}/{length}²"}
    return {key: [{"factor": 1, "name": name if known or key in ("length", "area") else ""}]
            for key, name in names.items()}


class Result:
    """Reads the files of a result's folder."""

    def __init__(self, folder):
        self.folder = folder
        self.about = read_json(os.path.join(folder, "result.json"), MOST_RESULT)
        path = os.path.join(folder, "history.csv")
        # The last columns are words: which solution the row belongs to.
        self.history = {name: np.array(column) for name, column in read_columns(path).items()
                        if not isinstance(column, list)}
        if not self.history or not next(iter(self.history.values())).size:
            raise Unreadable(f"{path}: there are no rows of numbers")
        self.cell = self.about.get("cell")
        self.name_units()

    def name_units(self):
        """Units of lengths, times, forces and energies, "" where they are not known, and the scales of quantities."""
        units = self.about["units"]
        self.flat = self.about["scene"]["dimension"] == 2
        scales = units.get("scales") or _plain_scales(units["length"], units["force"])
        self._scales = {key: [(float(one["factor"]), one["name"]) for one in list_] for key, list_ in scales.items()}
        self._one_unit()
        self.time = units["time"]
        self.length, self.force, self.energy = (self.unit(key) for key in ("length", "force", "energy"))

    def _one_unit(self):
        """Chooses one unit for all pictures of a result, that which suits the largest, for energies, forces and energy
        release rates, which are compared with each other. Lengths reach from displacements to specimens, and stresses
        differ by step."""
        patterns, line = self.about["patterns"], "line_" if self.flat else ""
        suffixes = {p["name"]: f"_{p['name']}" if len(patterns) > 1 else "" for p in patterns}
        within = [p["name"] for p in patterns if self.cell or p["drives"] in WITHIN]
        outside = [p["name"] for p in patterns if p["name"] not in within and p["drives"] == "displacement"]
        columns = {line + "energy": ["stored_bulk", "stored_interface", "dissipated", "work", "load_potential",
                                     *("reaction" + suffixes[name] for name in within)],
                   line + "force": ["reaction" + suffixes[name] for name in outside],
                   "release_rate": ["energy_release_rate"]}
        for key, names in columns.items():
            there = [np.abs(self.history[name]) for name in names if name in self.history]
            largest = max((np.nanmax(column, initial=0.0) for column in there), default=0.0)
            self._scales[key] = [suiting(self._scales[key], largest)]

    def scales(self, quantity):
        """Returns the scales of "length", "area", "force", "energy", "release_rate" or "stress"; forces and energies of
        plane scenes are per unit of thickness."""
        return self._scales[f"line_{quantity}" if self.flat and quantity in ("force", "energy") else quantity]

    def unit(self, quantity, largest=1.0):
        return suiting(self.scales(quantity), largest)[1]

    def text(self, value, quantity, digits=4, largest=0.0):
        """"5.08 mm" for 0.00508 in a scene in m; in the unit of numbers up to `largest` if they stand together."""
        factor, unit = suiting(self.scales(quantity), max(abs(value), largest))
        return f"{four_digits(value * factor, digits)} {unit}".rstrip()

    def jump_times(self):
        """Instants of the larger jumps."""
        path = os.path.join(self.folder, "jumps.csv")
        if not os.path.exists(path):
            return []
        columns = read_columns(path)
        rows = list(zip(columns["time"], columns["debonded"]))
        # On a coarse mesh every pair that breaks is one.
        largest = max((debonded for _, debonded in rows), default=0)
        return [time for time, debonded in rows if debonded > 0.2 * largest]

    def patterns(self):
        """(label, drives, load column, reaction column) of each pattern; of those WITHIN only if all are."""
        names = self.about["patterns"]
        if len(names) <= 1:
            first = names[0] if names else {"name": "", "drives": "displacement"}
            return [(first["name"], first["drives"], "load", "reaction")]
        loads = [p for p in names if p["drives"] not in WITHIN] or names
        return [(p["name"], p["drives"], "load_" + p["name"], "reaction_" + p["name"]) for p in loads]

    def prescribed_strains(self):
        return any(p["drives"] == "strain" for p in self.about["patterns"])

    def averages(self):
        """(component, strain, stress) of those in the history: of the periodic cell, else of all bodies."""
        h = self.history
        for prefix in ("cell_", ""):
            found = [(c, h[f"{prefix}strain_{c}"], h[f"{prefix}stress_{c}"])
                     for c in ("xx", "yy", "zz", "xy", "yz", "zx")
                     if {f"{prefix}strain_{c}", f"{prefix}stress_{c}"} <= h.keys()]
            if found:
                return found
        return []

    def stress_unit(self, largest):
        """Returns the number by which stresses up to `largest` are divided for a picture, and their unit then."""
        factor, unit = suiting(self.scales("stress"), largest)
        return 1 / factor, unit

    def load_curve(self, pattern=0):
        """Displacement and load. Of a dead force the factor is the load and minus the reaction the displacement of its
        points."""
        _, drives, load, reaction = self.patterns()[pattern]
        if drives == "force":
            return -self.history[reaction], self.history[load]
        return self.history[load], self.history[reaction]

    def load_path(self, pattern=0):
        """The load curve with, in the steps of jumps, the points between which it jumps: the peaks that rows miss."""
        x, y = self.load_curve(pattern)
        name, drives, _, _ = self.patterns()[pattern]
        suffix = f"_{name}" if len(self.about["patterns"]) > 1 else ""
        path = os.path.join(self.folder, "jumps.csv") if self.folder else ""
        columns = read_columns(path) if os.path.exists(path) else {}
        wanted = [f"load{suffix}", f"reaction_before{suffix}", f"reaction_after{suffix}"]
        if drives != "displacement" or not set(wanted) <= columns.keys():
            return x, y
        at = np.searchsorted(self.history["step"], np.repeat(columns["step"], 2))
        loads, before, after = (np.asarray(columns[key], float) for key in wanted)
        return np.insert(x, at, np.repeat(loads, 2)), np.insert(y, at, np.column_stack([before, after]).ravel())

    def label_load(self, axes, pattern=0):
        if self.cell or self.patterns()[pattern][1] in WITHIN:
            for ax in axes:
                ax.set_xlabel("load factor")
            name_axis(axes[0].yaxis, "conjugate of the factor", self.scales("energy"))
            return
        force = self.patterns()[pattern][1] == "force"
        for ax in axes:
            name_axis(ax.xaxis, "conjugate displacement" if force else "prescribed displacement", self.scales("length"))
        if force:
            axes[0].set_ylabel("load factor")
        else:
            name_axis(axes[0].yaxis, "reaction", self.scales("force"))

    def name(self):
        scene = self.about["scene"]
        return scene["title"] or os.path.basename(scene["file"])

    def concept(self):
        """Returns, in words, the choices that decide which solution this is, each by its name."""
        named = self.about["concept"]
        out = {}
        if "solution" in named:
            out["solution"] = f"{named['solution']} solution"
        if "mixity_rule" in named:
            out["mixity_rule"] = f"{named['mixity_rule']} mixity"
        if named.get("backtracking", "auto") != "auto":
            out["backtracking"] = f"backtracking {named['backtracking']}"
        if float(named.get("jump_tolerance", 0)) > 0:
            out["jump_tolerance"] = f"jumps located to {named['jump_tolerance']} of a step"
        if float(named.get("mixity_step_tolerance", 0)) > 0:
            out["mixity_step_tolerance"] = f"mixity error of a step ≤ {named['mixity_step_tolerance']}"
        steps = f"{self.about['steps']} steps"
        out["steps"] = "adaptive steps in " + steps if named.get("step_control") == "adaptive" else steps
        edge = self.about["scene"]["shortest_edge"]
        out["h"] = f"h = {self.text(edge, 'length')}"
        return out

    def title(self, what):
        about = self.about
        state = "" if about["status"] == "complete" else f"   INCOMPLETE ({about['steps_done']}/{about['steps']} steps)"
        return f"{self.name()} – {what}{state}\n{', '.join(self.concept().values())}"

    def stamp(self, figure, caption=""):
        about = self.about
        height = figure.get_size_inches()[1]
        foot = (0.4 if caption else 0.22) / height
        figure.text(0.995, 0.004 + 0.17 / height, caption, ha="right", va="bottom", fontsize=7, color=GREY)
        figure.get_layout_engine().set(rect=(0, foot, 1, 1 - foot))
        figure.text(0.995, 0.004, f"delam {about['version']} · commit {about['commit'][:13]} · "
                    f"scene {about['scene_hash']}",
                    ha="right", va="bottom", fontsize=7, color=GREY)

    def save(self, figure, name):
        save(figure, os.path.join(self.folder, name))
