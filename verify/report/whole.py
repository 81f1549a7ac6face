# SPDX-License-Identifier: BSD-3-Clause
"""Files that are whole or not there: an interruption leaves no half of one."""
from __future__ import annotations

import json
import os
import pathlib

UNFINISHED = ".unfinished"


def write_text(path: pathlib.Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + UNFINISHED)
    unfinished.write_text(text, encoding="utf-8")
    os.replace(unfinished, path)


def write_json(path: pathlib.Path, data) -> None:
    write_text(path, json.dumps(data, indent=1, allow_nan=False) + "\n")
