# SPDX-License-Identifier: BSD-3-Clause
"""Words of messages: what was meant by a name, what there is instead."""
from __future__ import annotations

import difflib
from collections.abc import Iterable

_MOST = 10  # names that a message lists


def listing(names: Iterable[object]) -> str:
    """Names one after another, of many the first ones and their number."""
    texts = [str(name) for name in names]
    more = "" if len(texts) <= _MOST else f" .. ({len(texts)} in all)"
    return ", ".join(texts[:_MOST]) + more


def meant(name: object, known: Iterable[object]) -> str:
    """A question for the nearest names, or "". Those of parts, "load:pull", are near to that of the whole, "load"."""
    texts, word = [str(one) for one in known], str(name)
    near = [one for one in texts if word and one.startswith(word + ":")][:3]
    near = near or difflib.get_close_matches(word, texts, 1)
    return f" (did you mean {' or '.join(map(repr, near))}?)" if near else ""
