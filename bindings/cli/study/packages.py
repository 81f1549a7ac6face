# SPDX-License-Identifier: BSD-3-Clause
"""Packages that the scripts need, asked for before they are imported; the program and plot.py use it."""
import importlib.util
import sys

from command import WRONG, complain


def require(*names):
    """Ends with one line if this interpreter lacks one of the packages."""
    missing = [name for name in names if importlib.util.find_spec(name) is None]
    if missing:
        complain(f"{sys.executable} has no {', '.join(missing)}; /usr/bin/python3 has what is needed with Debian's "
                 f"packages {', '.join('python3-' + name for name in names)}")
        sys.exit(WRONG)  # as of a program that is not installed completely
