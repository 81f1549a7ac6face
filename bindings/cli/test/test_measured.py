# SPDX-License-Identifier: BSD-3-Clause
"""Files of test machines: what is read from them, in which units, and what becomes of jitter and unloading."""
import os
import re
import sys
from types import SimpleNamespace

import numpy as np
from support import expect, finish, folder

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study"))
from command import Trouble  # noqa: E402
from measured.broken import broken_at  # noqa: E402
from measured.columns import found  # noqa: E402
from measured.curve_data import CurveData, scale_of  # noqa: E402
from measured.loops import monotone, turning_points  # noqa: E402
from measured.one_test import read_test  # noqa: E402
from measured.units import kind_of, quantity, title_and_unit  # noqa: E402

GIVEN = SimpleNamespace(columns=None, scale=1.0, x_scale=1.0, width="", loops="cut", x="load", y="reaction", slack="find",
                        compliance="")
X = np.round(np.linspace(0.0, 3.0, 31), 4)  # in mm
Y = np.where(X < 1.5, 40 * X, 70 - 6.5 * X)  # in N


def file_of(text, encoding="utf-8"):
    path = os.path.join(folder(), "raw.csv")
    with open(path, "wb") as file:
        file.write(text.encode(encoding))
    return path


def rows(between, comma=False, x=X, y=Y, before="", behind="", factor=1.0):
    lines = [f"{a:.8f}{between}{factor * b:.6f}" for a, b in zip(x, y)]
    lines = [line.replace(".", ",") for line in lines] if comma else lines
    return "\n".join(before.format(k) + line + behind for k, line in enumerate(lines)) + "\n"


# A file, words that must be said of it, and whether it names units.
FILES = {
    "a German machine": (file_of("Prüfer;Müller\nBreite;25,0;mm\n\nZeit;Weg;Kraft\ns;mm;kN\n"
                                 + rows(";", True, before="{},5;", factor=1e-3), "latin-1"),
                         ("Latin-1", "2 lines before", "decimal commas", '"Weg" in mm', '"Kraft" in kN', "times 1000 is in N"), True),
    "an American one": (file_of("\ufeffTime (s)\tCrosshead (mm)\tLoad (N)\r\n" + rows("\t", before="{}\t").replace("\n", "\r\n")),
                        ("tabs", '"Crosshead" in mm', '"Load" in N'), True),
    "quotes": (file_of('"Displacement","Load"\n"(mm)","(N)"\n' + rows('","', True, before='"', behind='"')),
               ("commas between numbers with decimal commas", '"Displacement" in mm'), True),
    "a column of cracks with gaps": (file_of("Time,Extension,Load,Crack length\n(sec),(mm),(N),(mm)\n" + rows(",", before="{},", behind=",")),
                                     ('"Extension" in mm', "31 rows from line 3"), True),
    "dates": (file_of("Datum;Weg in mm;Kraft in N\n" + rows(";", True, before="12.05.2024 10:11:{:02d};")), ('"Weg" in mm',), True),
    "UTF-16": (file_of("Weg [mm]\tKraft [N]\n" + rows("\t"), "utf-16"), ("UTF-16", '"Weg" in mm'), True),
    "inches and pounds": (file_of("Stroke (in)  Force (lbf)\n".replace("  ", "\t") + rows("\t", x=np.round(X / 25.4, 9), y=Y / 4.4482216152605)),
                          ("times 0.0254", "times 4.44822"), True),
    "text behind": (file_of("displacement_mm,force_N\n" + rows(",") + "Test ended by operator\n"), ("1 line of text behind",), True),
    "the load first": (file_of("Load [N],Displacement [mm]\n" + rows(",", x=Y, y=X)), ('x is "Displacement" in mm',), True),
    "our own": (file_of("load,reaction\n" + rows(",", x=X / 1e3)), ('x is "load", y is "reaction"', "the file names no unit of x and y: numbers count in those of the scene (m, N)"), False),
    "blanks": (file_of("# measured\n" + rows("   ", x=X / 1e3)), ("blanks", "column 1"), False),
    "loads per width": (file_of("Extension (mm),Load (N/mm)\n" + rows(",", y=Y / 1e3)), ("times 1000 is in N/m",), True),
    "compression": (file_of("Weg [mm];Kraft [N]\n" + rows(";", x=-X, y=-Y)), ("x is negative, its sign is turned", "y is negative"), True),
}


def variants():
    for name, (path, words, _) in FILES.items():
        data = CurveData(path, GIVEN, ("m", "N"))
        expect(all(word in data.said for word in words), f"{name}: {data.said}")
        expect(len(data.x) == 31 and np.allclose(data.x, X / 1e3, atol=1e-8) and np.allclose(data.y, Y, rtol=1e-3, atol=1e-3),
               f"{name}: its numbers {data.x[:3]} {data.y[:3]}")
    for x, words in ((-X - 1.0, ("x is negative", "y is negative")), (X + 1.0, ("y is negative",))):
        data = CurveData(file_of("Weg [mm];Kraft [N]\n" + rows(";", x=x, y=-Y)), SimpleNamespace(**{**vars(GIVEN), "slack": "none"}),
                         ("m", "N"))
        expect(all(word in data.said for word in words) and np.all(data.x > 0) and np.allclose(data.y, Y, rtol=1e-3, atol=1e-3),
               f"negative loads, displacements from {x[0]:g} mm on: {data.said}")
    data = CurveData(file_of("Weg [mm];Kraft [N]\n" + rows(";")), SimpleNamespace(**{**vars(GIVEN), "scale": -1.0}), ("m", "N"), -1.0)
    expect("turned" not in data.said and np.all(data.y <= 0), f"--scale -1 keeps its signs: {data.said}")
    plain = CurveData(FILES["a German machine"][0], GIVEN, ("", ""))
    expect(np.allclose(plain.x, X) and np.allclose(plain.y, Y * 1e-3) and plain.named_units == ["mm", "kN"],
           "without units of the scene the numbers stay")
    two = file_of("Zeit (s),Weg (mm),Weg 2 (mm),Kraft (N)\n" + "".join(f"{k},{x},{2 * x},{y}\n" for k, (x, y) in enumerate(zip(X, Y))))
    first, second = (CurveData(two, SimpleNamespace(**{**vars(GIVEN), "columns": names})) for names in (None, ["3", "Kraft"]))
    expect('not taken: "Weg 2" in mm (--columns X Y)' in first.said and "not taken" not in second.said and np.allclose(second.x, 2 * first.x),
           f"a column of the same kind is named, and numbers count from 1: {first.said} {second.said}")
    bare = CurveData(file_of("".join(f"{k},{y},{x}\n" for k, (x, y) in enumerate(zip(X, Y)))), SimpleNamespace(**{**vars(GIVEN), "columns": ["3", "2"]}))
    expect('x is column 3, y is column 2' in bare.said and np.allclose(bare.x, X), f"without titles, too: {bare.said}")
    expect(found(read_test(file_of("Prüfzeit;Weg\ns;mm\n1,0;1,0\n2,0;2,0\n")), "time") == [0], "a German time")
    table = read_test(FILES["a column of cracks with gaps"][0])
    expect(found(table, "crack") == [], "an empty column is none")


def refusals():
    def refused(text, pattern, **more):
        try:
            CurveData(file_of(text), SimpleNamespace(**{**vars(GIVEN), **more}), ("m", "N"))
            said = "nothing"
        except Trouble as trouble:
            said = str(trouble)
        expect(pattern in said, f"{text[:30]!r}: {said}")

    refused("only text\nand more\n", "there are no numbers")
    swapped = "Weg (mm),Kraft (N)\n0.1,1\n0.2,2\n"
    refused(swapped, '"Weg" in mm is no y to compare with "reaction" of the scene: a force or a force per length is expected', columns=["Kraft", "Weg"])
    refused("Weg (mm),Kraft (N/mm)\n0.1,1\n0.2,2\n", '"Kraft" in N/mm is a load per width already', width="25mm")
    refused("Zeit (s),Kraft (N)\n0.1,1\n0.2,2\n", '"Zeit" in s is no x to compare with "load"', columns=["Zeit", "Kraft"])
    refused("\n \n", "the file is empty")
    refused("a;b\n1;2\n2;x\n3;4\n", 'row 2 of the numbers (line 3) has "x"')
    refused("a;b\n1;2\n2;3;4\n3;4\n", "row 2 of the numbers (line 3) has 3 columns, 2 are expected")
    refused("a;b\n1;2\n2;3\n", 'there is no column "weg"; it has: a, b', columns=["weg", "b"])
    refused("1;2\n2;3\n", 'there is no column "0"; it has: columns 1 to 2', columns=["0", "1"])
    refused("a;b\n2;2\n2;3\n", "must increase")
    refused("a;b\0\n2;2\n", "zero byte")
    refused("a;b\n1;2\n2;3\n", "--slack 3kg: a length is expected, such as 0.3mm", slack="3kg")
    refused("a;b\n1;2\n2;3\n", "--slack 3m leaves no points: x ends at 2", slack="3m")
    refused("a;b\n1;2\n2;3\n", "--compliance 3N: a length per force is expected, such as 2e-5mm/N", compliance="3N")
    for width, pattern in (("25kg", "a length > 0"), ("-1mm", "a length > 0"), ("x", "a length > 0")):
        try:
            scale_of(SimpleNamespace(width=width, scale=1.0), "mm")
            expect(False, f"--width {width}")
        except Trouble as trouble:
            expect(pattern in str(trouble), f"--width {width}: {trouble}")
    for width, unit, scale in (("25mm", "m", 40.0), ("2.5 cm", "mm", 0.04), ("0.5", "", 2.0), ("0.5", "mm", 2.0)):
        expect(abs(scale_of(SimpleNamespace(width=width, scale=1.0), unit) / scale - 1) < 1e-12, f"--width {width} in {unit}")


def units():
    known = {"kN": ("force", 1e3), "KN": ("force", 1e3), "mN": ("force", 1e-3), "MN": ("force", 1e6), "MM": ("length", 1e-3),
             "N/mm": ("force/length", 1e3), "GPa": ("stress", 1e9), "": (None, 1.0), "mPa": (None, 1.0), "%": (None, 1.0)}
    for text, answer in known.items():
        kind, size = kind_of(text)
        expect(kind == answer[0] and abs(size / answer[1] - 1) < 1e-12, f"unit {text!r}: {kind} {size}")
    for title, parts in {"Load (kN)": ("Load", "kN"), "Kraft [N]": ("Kraft", "N"), "Weg in mm": ("Weg", "mm"),
                         "load_N": ("load", "N"), "Channel (1)": ("Channel (1)", ""), "mm": ("mm", ""),
                         "Extension, mm": ("Extension", "mm")}.items():
        expect(title_and_unit(title) == parts, f"title {title}: {title_and_unit(title)}")
    expect(quantity("1.5e-3 m", "length") == (1.5e-3, "m") and quantity("7 N", "length") is None, "quantities")


def ways():
    """Jitter is averaged; loops are found however deep, cut or followed."""
    rng = np.random.default_rng(1)
    x = np.linspace(0, 1, 2001) + 2e-3 * rng.standard_normal(2001)
    y = 3 * x + 0.01 * rng.standard_normal(2001)
    expect(turning_points(x) == [0, 2000], f"jitter is no loop: {turning_points(x)[:5]}")
    a, b = monotone(x, y)
    expect((np.diff(a) > 0).all() and 200 < len(a) < 1200, f"of 2001 points {len(a)} remain")
    expect(abs(np.mean(b - 3 * a)) < 5e-4, "and averages are on the line")
    parts = [np.linspace(0, 1, 101), np.linspace(1, 0.9, 11)[1:], np.linspace(0.9, 2, 111)[1:], np.linspace(2, 0.2, 181)[1:],
             np.linspace(0.2, 3, 281)[1:], np.linspace(3, 2.5, 51)[1:]]
    x = np.concatenate(parts)
    loose = x + 1e-4 * rng.standard_normal(len(x))
    path = file_of("x,y\n" + "\n".join(f"{p!r},{2 * p!r}" for p in loose.tolist()))
    cut = CurveData(path, GIVEN)
    expect(abs(len(cut.x) - 301) < 12 and (np.diff(cut.x) > 0).all() and "3 unloadings by 3 %, 60 %, 17 %" in cut.said and
           "--loops follow" in cut.said, f"loops are cut: {len(cut.x)} {cut.said}")
    way = CurveData(path, SimpleNamespace(**{**vars(GIVEN), "loops": "follow"}))
    expect(np.allclose(way.turns, [0, 1, 0.9, 2, 0.2, 3, 2.5], atol=2e-3) and abs(np.max(way.at) - 7.3) < 0.01,
           f"loops are followed: {way.turns} {np.max(way.at)}")
    expect((np.diff(way.at) >= 0).all() and np.allclose(way.y, 2 * way.x), "along the way")


def slacks():
    """What comes before the load is taken off, and what is of the specimen stays: bends, noise, and what options say."""
    errors = np.random.default_rng(4)

    def made(before, noise=0.005, bend=0.0):
        x = np.linspace(0, 3, 301)
        free = np.maximum(x - before, 0.0)
        y = np.where(free < 1.5, 40 * free - bend * free ** 2, 70 - 6.5 * free) + noise * 60 * errors.standard_normal(301)
        return file_of("Weg [mm];Kraft [N]\n" + rows(";", x=x, y=y))

    def read(path, **more):
        return CurveData(path, SimpleNamespace(**{**vars(GIVEN), **more}), ("m", "N"), 40.0)

    for before in (0.2, -0.2):
        data = read(made(before))
        expect(re.search("slack: the load begins at 0.000[12]" if before > 0 else "preload: the line of the load begins 0.000[12]",
                         data.said), f"slack of {before} mm: {data.said}")
        middle = (data.x > 3e-4) & (data.x < 1.2e-3)
        expect(abs(np.mean(data.x[middle] - data.y[middle] / 1.6e6)) < 2e-5, "the line goes through 0 then")
    for path in (made(0.0), made(0.0, 0.02), made(0.0, 0.001, 10.0)):
        expect("slack" not in read(path).said and "preload" not in read(path).said, f"there is none: {read(path).said}")
    path = made(0.2, 0.0)
    expect(np.isclose(read(path, slack="none").x[-1], 3e-3) and np.isclose(read(path, slack="0.5mm").x[-1], 2.5e-3)
           and np.isclose(read(path, slack="2e-4").x[-1], 2.8e-3), "--slack is as it is given")
    # 1e-5 mm/N times the 60.25 N of the specimen, whose loads are divided by a width of 25 mm.
    stiff = read(made(0.0, 0.0), slack="none", compliance="1e-3 mm/N")
    top = int(np.argmax(stiff.y))
    expect(np.isclose(stiff.x[top], 1.5e-3 - 1e-6 * stiff.y[top] / 40) and "takes 6.025e-05 m off" in stiff.said,
           f"the compliance of the machine: {stiff.x[top]} {stiff.said}")


def breaks():
    """A load that is gone at once at the end is the break, with the points on its way; drops, unloadings and cracks that run
    through are none."""
    x = np.linspace(0, 3, 601)
    load = np.where(x < 1.5, 40 * x, 60 * np.sqrt(1.5 / np.maximum(x, 0.1))) + 0.1 * np.sin(50 * x)
    fallen = np.concatenate([load[:500], [0.5 * load[499], 0.2 * load[499]], np.zeros(99)])
    drop = np.where(x < 1.5, 40 * x, 20 + 5 * (x - 1.5))
    through = 60 * np.clip(np.minimum(x / 1.5, (3 - x) / 1.5), 0, 1)
    back = np.concatenate([x[:500], np.linspace(x[499], 0, 101)])
    unloaded = np.concatenate([load[:500], load[499] * np.linspace(1, 0, 101)])
    for what, at, y, wanted in (("a break", x, fallen, 500), ("a drop", x, drop, None), ("a crack that runs through", x, through, None),
                                ("an unloading", back, unloaded, None), ("a fast return", np.append(x, 0.0), np.append(load, 0.0), None),
                                ("a break of few points", x[:500:20], np.append(load[:480:20], 0.0), 24)):
        expect(broken_at(at, y) == wanted, f"{what}: {broken_at(at, y)}, {wanted} is right")
    data = CurveData(file_of("Weg [mm];Kraft [N]\n" + rows(";", x=x, y=fallen)), GIVEN, ("m", "N"))
    expect(len(data.x) == 500 and "the load drops to zero at 0.002495 m: the specimen breaks there, and the 101 rows behind are left out" in data.said,
           f"a fit leaves it out: {len(data.x)} {data.said}")


variants()
refusals()
units()
ways()
slacks()
breaks()
finish()
