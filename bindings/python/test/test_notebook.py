# SPDX-License-Identifier: BSD-3-Clause
"""The notebooks run, cell by cell, and hold no output. The cells run in this process with what a kernel adds, the value
of a last line; test_long_notebook runs them in a kernel. Skipped without matplotlib."""
import ast
import contextlib
import importlib.util
import io
import json
import unittest

import support
import numpy as np

NOTEBOOKS = sorted((support.HERE.parent / "notebooks").glob("*.ipynb"))
DRAWS = importlib.util.find_spec("matplotlib") is not None
if DRAWS:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt


def run(notebook):
    """(names at the end, values of the cells' last lines, what they print)."""
    names, values, out = {"__name__": "__main__"}, [], io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
        for number, cell in enumerate(notebook["cells"]):
            if cell["cell_type"] != "code":
                continue
            source = "".join(cell["source"])
            tree = ast.parse(source, f"cell {number}")
            last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
            exec(compile(tree, f"cell {number}", "exec"), names)
            if last is not None:
                values.append(eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names))
    return names, values, out.getvalue()


class Files(unittest.TestCase):
    def test_they_hold_no_output(self):
        self.assertTrue(NOTEBOOKS)
        for path in NOTEBOOKS:
            notebook = json.loads(path.read_text(encoding="utf-8"))
            self.assertEqual((notebook["nbformat"], len({cell["id"] for cell in notebook["cells"]})),
                             (4, len(notebook["cells"])))
            for cell in notebook["cells"]:
                self.assertIn(cell["cell_type"], ("code", "markdown"))
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), path.name)


@unittest.skipUnless(DRAWS, "matplotlib is not installed")
class Cells(unittest.TestCase):
    def test_first_steps(self):
        path = support.HERE.parent / "notebooks" / "first_steps.ipynb"
        before = len(plt.get_fignums())
        names, values, printed = run(json.loads(path.read_text(encoding="utf-8")))
        self.assertEqual(len(plt.get_fignums()) - before, 4)
        for number in plt.get_fignums():
            plt.figure(number).canvas.draw()
        plt.close("all")
        # The arms are not clamped at the tip of the notch: beam theory is above, but not far.
        self.assertTrue(0.85 * names["beam"] < names["peak"] < names["beam"], printed)
        self.assertRegex(printed, r"peak \d+ N/m, beam theory \d+ N/m\n"
                                  r"largest traction \d+\.\d MPa; the crack is 5\d\.\d mm")
        self.assertEqual(names["again"].time, 1.0)
        np.testing.assert_array_equal(names["again"].field("traction", 0), names["traction"])
        self.assertGreater(len(values), 5)

    def test_a_broken_cell_is_noticed(self):
        broken = {"cells": [{"cell_type": "code", "source": ["1 / 0\n"]}]}
        with self.assertRaises(ZeroDivisionError):
            run(broken)


if __name__ == "__main__":
    support.main()
