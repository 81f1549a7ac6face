# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results: what plot.py of the command line writes, and Result.plot and History.plot return.

Nothing in here needs libdelam: plot.py imports this folder as a package of its own. Each function takes a result and
returns a figure, or raises Nothing, which says why there is none."""
