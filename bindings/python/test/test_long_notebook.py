# SPDX-License-Identifier: BSD-3-Clause
"""The notebooks in a kernel of Jupyter, as people run them: each picture comes once, and so does the progress bar.
Skipped without nbclient, ipykernel (Debian: python3-nbclient, python3-ipykernel) or matplotlib."""
import importlib.util
import os
import unittest

import support

NOTEBOOKS = sorted((support.HERE.parent / "notebooks").glob("*.ipynb"))
READY = all(map(importlib.util.find_spec, ("nbformat", "nbclient", "ipykernel", "matplotlib")))


@unittest.skipUnless(READY, "nbclient, ipykernel or matplotlib is not installed")
class InAKernel(unittest.TestCase):
    def test_they_run(self):
        import nbclient
        import nbformat
        os.environ["PYTHONPATH"] = str(support.SOURCES)
        self.assertTrue(NOTEBOOKS)
        for path in NOTEBOOKS:
            notebook = nbformat.read(path, as_version=4)
            nbformat.validate(notebook)
            nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
            outputs = [output for cell in notebook["cells"] for output in cell.get("outputs", [])]
            self.assertEqual(sum("image/png" in output.get("data", {}) for output in outputs), 4)
            self.assertTrue(any("40/40" in output.get("text", "") for output in outputs), "no progress bar")


if __name__ == "__main__":
    support.main()
