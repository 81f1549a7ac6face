# SPDX-License-Identifier: BSD-3-Clause
"""ENVIRONMENT: this process's, with what ranks need (environment.txt)."""
import os
import pathlib

LINES = pathlib.Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").splitlines()
ENVIRONMENT = dict(os.environ, **dict(line.split("=", 1) for line in LINES if line[:1].isupper()))
