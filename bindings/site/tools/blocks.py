# SPDX-License-Identifier: BSD-3-Clause
"""The fenced blocks of a page of the site.

The words after the language say what a block is:

    ```toml file=scene.toml     is written into the folder of the page; `add=scene.toml` adds to a file
    ```text output              what the block before prints; a line `...` stands for any lines, `...` within one
                                for any text
    ```bash exit=2              ends with this code
    ```text skip="reason"       is not run
"""
import re
import shlex
from dataclasses import dataclass, field

FENCE = re.compile(r"^(`{3,})\s*(.*)$")
LANGUAGES = {"bash", "toml", "text", "c", "cpp", "fortran", "python", "julia"}
KEYS = {"file", "add", "exit", "skip", "output"}


@dataclass
class Block:
    """lines: of the page, from 1, the fences excluded."""
    page: str
    line: int
    language: str
    text: str
    words: dict = field(default_factory=dict)

    @property
    def place(self):
        return f"{self.page}:{self.line}"


class BlockError(Exception):
    """A block that cannot be what it says."""


def words_of(info, place):
    """language and attributes of the words behind a fence; directives ({figure}, {math}) have language ""."""
    if not info:
        raise BlockError(f"{place}: a block without a language")
    if info.startswith("{"):
        return "", {}
    language, *rest = shlex.split(info)
    words = {}
    for word in rest:
        key, _, value = word.partition("=")
        if key not in KEYS:
            raise BlockError(f"{place}: unknown word {word!r} of a block")
        words[key] = value
    if language not in LANGUAGES:
        raise BlockError(f"{place}: nothing runs blocks of the language {language!r}")
    return language, words


def blocks_of(text, page):
    """All blocks of a page but its directives."""
    found, fence, first, lines = [], None, 0, []
    for number, line in enumerate(text.splitlines(), 1):
        match = FENCE.match(line)
        if fence is None:
            if match:
                fence, info, first, lines = match[1], match[2], number + 1, []
            continue
        if match and match[1] == fence and not match[2]:
            language, words = words_of(info, f"{page}:{first - 1}")
            if language:
                found.append(Block(page, first, language, "".join(line + "\n" for line in lines), words))
            fence = None
            continue
        lines.append(line)
    if fence is not None:
        raise BlockError(f"{page}:{first - 1}: a block without an end")
    return found


NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def unit(number):
    """One in the last digit that a number shows."""
    mantissa, _, power = number.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(power or 0) - decimals)


def same_number(shown, printed):
    """The printed number rounds to the shown one; of more than three digits, the last may differ by one."""
    one, value = unit(shown), float(shown)
    return abs(value - float(printed)) <= 1.001 * one * (1.0 if one <= 1.001e-3 * abs(value) else 0.5)


def words_pattern(shown):
    """An expression for a printed line: numbers in groups, `...` any text, any number of blanks between words."""
    parts = []
    for part in re.split(r"(\.\.\.)", " ".join(shown.split())):
        if part == "...":
            parts.append(".*")
            continue
        ends = [0, *(k for match in NUMBER.finditer(part) for k in match.span()), len(part)]
        for k, (first, last) in enumerate(zip(ends, ends[1:])):
            parts.append("(" + NUMBER.pattern + ")" if k % 2 else re.escape(part[first:last]))
    return "".join(parts)


def same_line(shown, printed):
    """Equal words, and numbers that agree to the digits that are shown; `...` is any text."""
    printed = " ".join(printed.split())
    if " ".join(shown.split()) == printed:
        return True
    match = re.fullmatch(words_pattern(shown), printed)
    numbers = [number for part in shown.split("...") for number in NUMBER.findall(part)]
    return match is not None and all(same_number(a, b) for a, b in zip(numbers, match.groups()))


def difference(shown, printed):
    """None, or the first line that differs: (shown, printed). A line `...` stands for any number of lines."""
    want, have = shown.rstrip().splitlines(), printed.rstrip().splitlines()
    at, free = 0, False
    for number, line in enumerate(want):
        if line.strip() == "...":
            free = True
            continue
        while True:
            if at >= len(have):
                return line, "(nothing more is printed)"
            at += 1
            if same_line(line, have[at - 1]):
                break
            if not free:
                return line, have[at - 1]
        free = False
    if at < len(have) and not free:
        return "(nothing more is shown)", have[at]
    return None


def filled(shown, printed):
    """The shown text with what was printed in the place of lines `?`, for --update; None: its other lines differ."""
    want, have = shown.rstrip().splitlines(), printed.rstrip().splitlines()
    lines, at = [], 0
    for number, line in enumerate(want):
        if line.strip() in ("...", "?"):
            rest = next((other for other in want[number + 1:] if other.strip() not in ("...", "?")), None)
            end = next((k for k in range(at, len(have)) if rest is not None and same_line(rest, have[k])), len(have))
            lines += ["..."] if line.strip() == "..." else [text.rstrip() for text in have[at:end]]
            at = end
            continue
        if at >= len(have) or not same_line(line, have[at]):
            return None
        lines.append(line)
        at += 1
    return "\n".join(lines) + "\n"
