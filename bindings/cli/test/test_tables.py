# SPDX-License-Identifier: BSD-3-Clause
"""Tables of test machines: numbers with grouped thousands, cells without numbers, words beside numbers, several specimens
and blocks in one file, sheets of crack lengths apart, and signs of compression."""
import os
import sys
from types import SimpleNamespace

import numpy as np
from support import expect, expect_error, finish, folder, start

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study"))
from command import Trouble  # noqa: E402
from measured.columns import choose  # noqa: E402
from measured.curve_data import upright  # noqa: E402
from measured.number_forms import form_of, number_of  # noqa: E402
from measured.one_test import read_test  # noqa: E402
from specimens.marks import Sheet  # noqa: E402

T = np.arange(40) * 0.5
X = np.linspace(0.0, 4.0, 40)
P = np.where(X < 2.5, 500 * X, 1250 - 300 * (X - 2.5))  # N, beyond a thousand


def file_of(text, encoding="utf-8", name="raw.csv"):
    path = os.path.join(folder(), name)
    with open(path, "wb") as file:
        file.write(text.encode(encoding))
    return path


def rows(form="{:.2f},{:.5f},{:.3f}\n", factor=1.0, before=""):
    return "".join(before + form.format(t, x, factor * p) for t, x, p in zip(T, X, P))


def refused(what, words, work, *arguments):
    try:
        work(*arguments)
        said = "nothing"
    except Trouble as trouble:
        said = str(trouble)
    expect(all(word in said for word in words), f"{what}: {said}")


def numbers():
    """Thousands may be grouped; what a sign is follows from the whole file."""
    for cell, decimal, value in (("1,008.11", ".", 1008.11), ("1'002.08", ".", 1002.08), ("1 234 567", ".", 1234567.0), ("\u22125.2", ".", -5.2),
                                 ("1.002,08", ",", 1002.08), ("1\u202f002,08", ",", 1002.08), ("1.002", ",", 1002.0), ("-1,5e-3", ",", -1.5e-3)):
        expect(number_of(cell, decimal) == value, f"{cell} with {decimal}: {number_of(cell, decimal)}")
    for cell, decimal in (("0,123", "."), ("1,23", "."), ("0.123", ","), ("12 34", "."), ("DCB 1", ".")):
        expect(number_of(cell, decimal) is None, f"{cell} with {decimal} is no number: {number_of(cell, decimal)}")
    for cell in ("#N/A", "---", "n/a", "****", "#WERT!", "-", ""):
        expect(number_of(cell, ".") != number_of(cell, "."), f"{cell!r} is an empty cell")
    expect(form_of(["1,234;2,345", "1,250;2,512"]).decimal == ",", "commas alone are decimal ones")
    expect(form_of(["1,234.5;2,345.0", "999.0;1.0"]).decimal == ".", "beside points they group thousands")
    form = form_of(["900,5;49,1;", "950,0;52;", "990;55", "995;60"])
    expect((form.decimal, form.width) == (",", 3), f"rows that end early count for the decimal sign: {form}")
    american = [("Time;Extension;Load\ns;mm;N\n", "{:.2f};{:.5f};{:,.3f}\n", lambda line: line),
                ('"Time","Extension","Load"\n"(s)","(mm)","(N)"\n', '"{:.2f}","{:.5f}","{:,.3f}"\n', lambda line: line),
                ("Zeit;Weg;Kraft\ns;mm;N\n", "{:.2f};{:.5f};{:,.3f}\n", lambda line: line.replace(",", "'")),
                ("Zeit;Weg;Kraft\ns;mm;N\n", "{:.2f};{:.5f};{:,.3f}\n", lambda line: line.replace(",", "#").replace(".", ",").replace("#", ".")),
                ("Temps;Déplacement;Force\ns;mm;N\n", "{:.2f};{:.5f};{:,.3f}\n", lambda line: line.replace(",", "\u202f").replace(".", ","))]
    for titles, form, change in american:
        table = read_test(file_of(titles + change(rows(form))))
        expect(np.allclose(table.columns[2], P, atol=1e-3) and table.units == ["s", "mm", "N"], f"{titles!r}: {table.columns[2].max()}")
    table = read_test(file_of("Status,Extension (mm),Load (N)\n" + "".join(f"{'up' if k < 20 else 'down'},{x:.4f},{'---' if k == 7 else p}\n"
                                                                           for k, (x, p) in enumerate(zip(X, P)))))
    expect(np.isnan(table.columns[2][7]) and np.isfinite(table.columns[2]).sum() == 39 and table.texts[0][:2] == ["up", "up"],
           "a column of words, and a cell of strokes")


def files():
    """What is no text says what to do; UTF-16 needs no mark at its beginning."""
    titles = "Weg\tKraft\nmm\tN\n" + "".join(f"{x:.4f}\t{p:.3f}\n" for x, p in zip(X, P)).replace(".", ",")
    for encoding in ("utf-16", "utf-16-le", "utf-16-be"):
        table = read_test(file_of(titles, encoding))
        expect(np.allclose(table.columns[1], P, atol=1e-3) and "UTF-16" in table.said, f"{encoding}: {table.said}")
    path = os.path.join(folder(), "book.xlsx")
    for begin, word in ((b"PK\x03\x04", "workbook (.xlsx)"), (b"\xd0\xcf\x11\xe0", "workbook (.xls)"), (b"a;b\n1;\0", "zero byte at 6")):
        with open(path, "wb") as file:
            file.write(begin + b"\0\1\2\3" * 20)
        refused(word, (word, "export the test as text (CSV or TXT)"), read_test, path)
    behind = "Extension (mm),Load (N)\n" + "".join(f"{x:.4f},{p:.3f}\n" for x, p in zip(X, P)) + "\nSummary\nMax,1250\n2.5,1250\nMean,625\n"
    table = read_test(file_of(behind))
    expect(len(table.lines) == 40 and "4 lines of text behind it" in table.said, f"results behind the table: {table.said}")
    before = "Results\nSpecimen,Load,Extension\n1,1250.0,2.5\n2,1240.0,2.6\nMean,1245.0,2.55\n\nTime,Extension,Load\n(s),(mm),(N)\n" + rows()
    table = read_test(file_of(before))
    expect(table.lines[0] == 9 and table.titles == ["Time", "Extension", "Load"], f"results of as many columns before it: {table.lines[0]}")
    bad = "Time (s),Extension (mm),Load (N)\n" + rows().replace(f"{P[20]:.3f}", "12:x", 1)
    refused("a wrong cell", ("row 21 of the numbers (line 22)", '"12:x"', "correct it, or leave the cell empty"), read_test, file_of(bad))
    last = "Time (s),Extension (mm),Load (N)\n" + rows() + "20,4.1,x\n"
    refused("a wrong last row", ("row 41 of the numbers (line 42)", '"x"'), read_test, file_of(last))


HEADER = "Data Header:\tTime:\t3.4\tSec\nData Acquisition: Timed\nTime\tAxial Displacement\tAxial Force\nSec\tmm\tN\n"


def several():
    """Specimens are told apart, whatever way the file has; blocks of one test are joined."""
    two = "Specimen,DCB-01\nTime (s),Extension (mm),Load (N)\n" + rows() + "\nSpecimen,DCB-02\nTime (s),Extension (mm),Load (N)\n" + rows(factor=2)
    column = "Specimen,Time (s),Extension (mm),Load (N)\n" + rows(before="{0},").replace("{0}", "DCB-01") + rows(factor=2, before="{0},").replace("{0}", "DCB-02")
    counted = column.replace("DCB-01", "1").replace("DCB-02", "2")
    under = "Time (s),Extension (mm),Load (N)\n" + rows() + "\n" + rows(factor=2)
    none = "Time (s),Extension (mm),Load (N)\n" + rows() + rows(factor=2)
    timeless = "Extension (mm),Load (N)\n" + "\n\n".join("".join(f"{x:.4f},{factor * p:.3f}\n" for x, p in zip(X, P)) for factor in (1, 2))
    beside = "DCB-01,,,DCB-02,,\nTime,Force,Stroke,Time,Force,Stroke\nsec,N,mm,sec,N,mm\n" + "".join(
        f"{t},{p:.3f},{x:.4f},{t},{2 * p:.3f},{x:.4f}\n" for t, x, p in zip(T, X, P))
    numbered = beside.replace("DCB-01,,,DCB-02,,\n", "").replace("Time,Force,Stroke,Time,Force,Stroke", "Time 1,Force 1,Stroke 1,Time 2,Force 2,Stroke 2")
    for what, text, named in (("one below the other", two, True), ("a column of names", column, True), ("a column of numbers", counted, False),
                              ("an empty line and a new time", under, False), ("a new time", none, False), ("an empty line, no time", timeless, False),
                              ("side by side", beside, True), ("with numbers in the titles", numbered, False)):
        path = file_of(text)
        refused(what, ("the file has 2 tests: 1", ", 2", "--specimen 1") + (('1 "DCB-01" (lines', '2 "DCB-02"') if named else ()), read_test, path)
        refused(what, ('no specimen "DCB-03": the file has 2 tests',), read_test, path, "DCB-03")
        for name in ("2", "DCB-02") if named else ("2",):
            table = read_test(path, name)
            y = table.columns[next(k for k, title in enumerate(table.titles) if title.split()[0] in ("Load", "Force"))]
            expect(np.allclose(y, 2 * P, atol=2e-3) and f'specimen "{name}" of 2 tests' in table.said, f"{what}, {name}: {table.said}")
    text = HEADER + "".join(f"{t}\t{x:.5f}\t{p:.4f}\n" for t, x, p in list(zip(T, X, P))[:25])
    text += "\n" + HEADER + "".join(f"{t}\t{x:.5f}\t{p:.4f}\n" for t, x, p in list(zip(T, X, P))[25:])
    table = read_test(file_of(text))
    expect(np.allclose(table.columns[1], X, atol=1e-4) and any("40 rows from line 5 on in 2 blocks, which are joined" in text for text in table.said),
           f"blocks of one test: {len(table.lines)} {table.said}")
    way = np.concatenate([X[:25], X[24::-1], X])  # an unloading between two blocks, whose time goes on
    text = "".join(f"{k * 0.5}\t{x:.5f}\t{100 * x:.4f}\n" + ("\n" if k in (24, 49) else "") for k, x in enumerate(way))
    table = read_test(file_of("Time (s)\tExtension (mm)\tLoad (N)\n" + text))
    expect(len(table.lines) == len(way), f"a test that unloads is one: {table.said}")


def remarks():
    """Columns in which an operator writes now and then are no rows with a fault, and no titles."""
    titles, noted = "Time (s),Extension (mm),Load (N),Event\n", {0: "start", 11: "crack seen", 30: "stop"}
    for wide in (True, False):  # the file has an empty cell where there is no remark, or ends the row before it
        text = titles + "".join(f"{t},{x:.5f},{p:.3f}" + ("," if wide or k in noted else "") + noted.get(k, "") + "\n"
                                for k, (t, x, p) in enumerate(zip(T, X, P)))
        table = read_test(file_of(text))
        expect(table.titles[:3] == ["Time", "Extension", "Load"] and len(table.lines) == 40 and np.allclose(table.columns[2], P, atol=1e-3),
               f"rows with a remark, empty cells {wide}: {table.titles} {len(table.lines)}")
        expect(len(table.texts[3]) == 40 and table.texts[3][11] == "crack seen", "and the remarks are kept")
    alone = titles + rows("{:.2f},{:.5f},{:.3f},\n").replace("5.00,", ",,,crack seen\n5.00,", 1)
    table = read_test(file_of(alone))
    expect(len(table.lines) == 40 and np.isfinite(table.columns[2]).all(), f"a remark in a row of its own: {len(table.lines)}")
    bad = titles + rows("{:.2f},{:.5f},{:.3f},\n").replace(f"{P[20]:.3f}", "12:x", 1)
    refused("a wrong cell beside them", ("row 21 of the numbers (line 22)", '"12:x"'), read_test, file_of(bad))
    marks = file_of("Prüfzeit [s];Risslänge [mm];Bemerkung\n131,2;49,1;Einriss sichtbar\n137,7;50,0;\n144,0;51,2;\n150,1;52,0;\n", "latin-1")
    sheet = Sheet(marks, SimpleNamespace(crack="", units=None))
    expect(np.allclose(sheet.crack, [0.0491, 0.05, 0.0512, 0.052]), f"crack lengths with a remark: {sheet.crack}")


def chosen():
    """A time is never taken for displacement or load, and what cannot be chosen is listed."""
    for titles, wanted in (("Zeit;Kanal 2;Kanal 3\n", [1, 2]), ("Zeit (s);Weg (mm);Kanal 3\n", [1, 2]), ("Zeit (s);Kanal 2;Kraft (N)\n", [1, 2]),
                           ("Temp;Kanal 2;Kraft\n", [0, 2]), ("a;b;c\n", [1, 2]), ("a;b\n", [0, 1]), ("", [0, 1])):
        table = read_test(file_of(titles + rows("{:.2f};{:.5f}\n" if titles == "a;b\n" else "{:.2f};{:.5f};{:.3f}\n")))
        expect(choose(table) == wanted, f"{titles!r}: {choose(table)}")
    table = read_test(file_of("Zeit (s);Weg (mm);Messzeit (s)\n" + rows("{:.2f};{:.5f};{:.3f}\n")))
    refused("two times", ('neither titles nor units say which columns are displacement and load: name two of 1 "Zeit" in s, 2 "Weg" in mm, 3',
                          "--columns X Y"), choose, table)


def signs():
    """Compression, and a crosshead that counts down, are turned and told; what goes up stays."""
    for x, y, words in ((-X, -P, ("x is negative", "y is negative")), (X, -P, ("y is negative",)), (9 - X, -P, ("y is negative", "x goes down while the load grows, from 9 on")),
                        (X - 9, P, ()), (X, P - 1.0, ())):
        said = []
        a, b = upright([x, y], (1.0, 1.0), said)
        expect(len(said) == len(words) and all(any(word in text for text in said) for word in words), f"from {x[0]:g}: {said}")
        expect(np.ptp(a - X) < 1e-9 and np.ptp(b - P) < 1e-9, f"and the curve is that of the test, from {x[0]:g} on")


def opened():
    """A DCB of beam theory whose machine writes compression, and its crack lengths apart: text and sheets."""
    a = np.concatenate([np.full(60, 50.0), np.linspace(50, 75, 100)])
    load = np.sqrt(0.28 * 25 ** 2 * 1.5 ** 3 * 140e3 / 12) / (a + 4)
    load[:60] *= np.linspace(0, 1, 60, endpoint=False)
    x = 8 * load * (a + 4) ** 3 / (25 * 1.5 ** 3 * 140e3)
    time = np.arange(160) * 2.0
    text = "Time (s);Position (mm);Force (kN)\n" + "".join(f"{t};{-u:.6f};{-p / 1e3:.8f}\n" for t, u, p in zip(time, x, load))
    kept = list(range(62, 160, 12))
    by_time = "Time (min);Crack length (mm)\n" + "".join(f"{time[k] / 60:.6f};{a[k]:.4f}\n" for k in kept)
    by_way = "Crack length (mm);Position (mm);Force (N)\n" + "".join(f"{a[k]:.4f};{-x[k]:.5f};{-load[k]:.4f}\n" for k in kept)
    return text, by_time, by_way


def cracks():
    """Crack lengths in a sheet apart find their place by time or displacement; what they cannot be is refused."""
    text, by_time, by_way = opened()
    test, out = file_of(text), os.path.join(folder(), "out")
    words = ["evaluate", "dcb", test, "--width", "25mm", "--arm", "1.5mm", "--notch", "50mm", "--out", out]
    for sheet, what in ((by_time, "time"), (by_way, "displacement")):
        code, shown, error = start(*words, "--marks", file_of(sheet, name="marks.csv"))
        expect(code == 0 and f"at 9 points, found by their {what}" in shown and "offset 4 mm" in shown and "load is negative, its sign is turned" in shown,
               f"by {what}: {shown} {error}")
        expect("modified beam theory: visual 280" in shown, f"the toughness, by {what}: {shown}")
    for sheet, pattern in ((by_way.replace("Position (mm)", "Position (cm)"), "the displacement .* mm of the crack of 50.* lies outside of the test, 0 to .* mm in .*is its unit"),
                           (by_time.replace("min", "s"), "the crack of .* mm is marked at a displacement of .* where the compliance is still that of the notch of 50mm: is the time"),
                           (by_time.replace("Time (min)", "Note (min)"), "a column of time or displacement beside the crack lengths is expected"),
                           (by_time.replace("Crack length", "Length"), "there is no column of crack lengths: a title such as \"Crack .mm.\"")):
        expect_error(start(*words, "--marks", file_of(sheet, name="marks.csv")), 2, pattern)
    code, shown, error = start(*words)
    expect(code == 0 and "a sheet apart (--marks FILE)" in error, f"without crack lengths the way to give them is told: {error}")
    both = file_of("Specimen;A\n" + text + "\nSpecimen;B\n" + text)
    expect_error(start(*words[:2], both, *words[3:]), 2, "the file has 2 tests: 1 \"A\" .*--specimen 1")
    code, shown, error = start(*words[:2], both, *words[3:], "--specimen", "B", "--replace")
    expect(code == 0 and 'specimen "B" of 2 tests' in shown, f"a specimen by its name: {shown} {error}")
    sheet = Sheet(file_of(by_time, name="marks.csv"), SimpleNamespace(crack="", units=None))
    expect(len(sheet.crack) == 9, "a sheet is read")



def doubtful_cracks():
    """Crack lengths that do not fit the compliance are told; those of an unloading, or that shrink, are left out and counted."""
    text, _, by_way = opened()
    test, out = file_of(text), os.path.join(folder(), "out")
    words = ["evaluate", "dcb", test, "--width", "25mm", "--arm", "1.5mm", "--notch", "50mm", "--out", out]
    rows = [line.split(";") for line in by_way.splitlines()[1:]]

    def sheet(change, kept=rows):
        return file_of("Crack length (mm);Position (mm)\n" + "".join(f"{change(float(row[0])):.4f};{row[1]}\n" for row in kept), name="marks.csv")

    code, shown, error = start(*words, "--E1", "140GPa", "--E2", "9GPa", "--G13", "5GPa", "--marks", sheet(lambda a: a))
    expect(code == 0 and "first crack" not in error and "offset" not in error and "differ" not in error, f"lengths that fit: {error}")
    code, shown, error = start(*words, "--marks", sheet(lambda a: a + 9))
    expect(code == 0 and "first crack is 59" in error and "by the compliance there 50" in error and "an offset below zero, which is taken as zero, and n of"
           in error and "the methods differ by" in error, f"lengths from elsewhere: {error}")
    code, shown, error = start(*words, "--E2", "9GPa", "--G13", "5GPa", "--marks", sheet(lambda a: 50 + 1.3 * (a - 50)))
    expect(code == 0 and "the offset of beam theory is" in error and "where the moduli give 2.7" in error, f"lengths in another scale: {error}")
    expect_error(start(*words, "--marks", sheet(lambda a: 3 * (a - 50))), 2, "the first crack is .* mm long, --notch is 50mm: .* no growths: add the notch")
    code, shown, error = start(*words, "--marks", sheet(lambda a: a - 2))
    expect(code == 0 and "marks: 8 of 9 count for the mean; the crack of the other is not longer than the notch" in shown, f"short ones: {shown} {error}")
    wrong = [[f"{float(row[0]) - 4 * (k == 6)}", row[1]] for k, row in enumerate(rows)]
    code, shown, error = start(*words, "--marks", sheet(lambda a: a, wrong))
    expect(code == 0 and "at 8 points, found by their displacement; 1 mark behind a longer crack is left out" in shown, f"a slip: {shown} {error}")
    # Rows of the test with a length while the machine goes back.
    lines = [line.split(";") for line in text.splitlines()[1:]]
    a = dict(zip(range(62, 160, 12), (row[0] for row in rows)))
    given = ["Position (mm);Force (N);Crack (mm)"] + [f"{line[1]};{1e3 * float(line[2]):.6f};{a.get(k, '')}" for k, line in enumerate(lines)]
    x, p = float(lines[100][1]), 1e3 * float(lines[100][2])
    back = [f"{part * x:.6f};{part * p:.6f};{66 if part == 0.5 else ''}" for part in (0.8, 0.5, 0.8)]
    test = file_of("\n".join(given[:102] + back + given[102:]) + "\n")
    words += ["--replace"]
    code, shown, error = start(*words[:2], test, *words[3:])
    expect(code == 0 and "at 9 points; 1 mark on an unloading is left out" in shown and "modified beam theory: visual 280" in shown,
           f"a mark on an unloading: {shown} {error}")
    code, shown, error = start(*words[:2], test, *words[3:], "--compliance", "0.04mm/N")
    expect(code == 0 and "of the displacement at the largest load are those of machine and fixture" in error and "% stiffer" in error,
           f"a machine that gives way: {shown} {error}")
    expect_error(start(*words[:2], test, *words[3:], "--compliance", "4mm/N"), 2, "that of the machine is less than that of the test")


numbers()
files()
remarks()
chosen()
several()
signs()
cracks()
doubtful_cracks()
finish()
