# SPDX-License-Identifier: BSD-3-Clause
"""Checks the English of the public headers.

    python3 verify/style/sentences.py [--list] [HEADER ...]

A sentence of a comment has at most LONGEST words, and all sentences together at most AVERAGE on average. Rows of tables
and lists (indented lines) and the comments behind constants are no sentences: they do not enter the average, but what
stands between two full stops in them is limited as well. Formulas count as words, lines in brackets do not count.
The comment of a function or callback begins with a verb: "Returns ..". Words of the house (PRIVATE) do not occur.
--list prints the sentences, longest first.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "verify" / "abi"))
import header as headers  # noqa: E402

HEADERS = ("delam.h", "petsc.h", "experimental.h")
LONGEST, AVERAGE = 30, 18
# Outside of names such as delam_solver_look.
PRIVATE = re.compile(r"\b(?:march(?:es|ed)?|look(?:s|ed)?|book(?:s|ed)?|hollow|debts?|ow(?:e|es|ed)|fresh|afresh|aside|scouts?|"
                     r"violent|creeping|beneath|ledger)\b", re.I)
CONTRACT = re.compile(r"^\[(?:unit|null|owns|status|thread|source|since) .*\]$", re.M | re.S)
# A full stop that ends no sentence.
ABBREVIATED = re.compile(r"\b(?:e\.g|i\.e|cf|eqs?|Eng|Fract|Mech|Compos|Sci|Technol|Int|J|Numer|Meth|Comput)\.$")
FUNCTION = re.compile(r"\s*(?:DELAM_API\b[^;]*?(delam_\w+)\(|typedef \w+ \(\*(delam_\w+)\))")


def cut(text):
    """The sentences of a paragraph."""
    begun = []
    for piece in re.split(r"(?<=\S[.?!])\s+", " ".join(text.split())):
        begun.append(piece)
        if not ABBREVIATED.search(piece):
            yield " ".join(begun)
            begun = []
    if begun:
        yield " ".join(begun)


def parts(comment):
    """(text, row?) of each paragraph and each row of a table or list."""
    prose, row = [], []
    for line in [*comment.split("\n"), ""]:
        indent = len(line) - len(line.lstrip())
        if prose and (indent or not line.strip()):
            yield " ".join(prose), False
            prose = []
        if row and indent <= 2:
            yield " ".join(row), True
            row = []
        if line.strip():
            (row if indent else prose).append(line)


def words(sentence):
    return sum(any(c.isalnum() for c in word) for word in sentence.split())


def sentences(text):
    """(line, sentence, row?, first of the comment of a function?) of all comments of a header."""
    for match in headers.COMMENT.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        behind = text[:match.start()].rsplit("\n", 1)[-1].strip() != ""
        comment = re.sub(r"^(?:SPDX-License-Identifier:.*|-{4} .*)$", "", headers.plain(match.group()), flags=re.M)
        first = FUNCTION.match(text, match.end()) is not None
        for part, row in parts(CONTRACT.sub("", comment)):
            for sentence in cut(part):
                yield line, sentence, row or behind, first
                first = False


def problems(name, text):
    lengths = []
    for line, sentence, row, first in sentences(text):
        if not row and words(sentence):
            lengths.append(words(sentence))
        start = " ".join(sentence.split()[:6])
        if words(sentence) > LONGEST:
            yield f"{name}:{line}: {words(sentence)} words, at most {LONGEST}: '{start} ..'"
        if first and not re.match(r"[A-Z][a-z]*s\b", sentence):
            yield f"{name}:{line}: '{start} ..' does not begin with a verb such as 'Returns'"
        for word in PRIVATE.findall(sentence):
            yield f"{name}:{line}: '{word}' is a word of the house: '{start} ..'"
    if lengths and sum(lengths) > AVERAGE * len(lengths):
        yield f"{name}: {sum(lengths) / len(lengths):.1f} words per sentence on average, at most {AVERAGE}"


def main():
    paths = [pathlib.Path(path) for path in sys.argv[1:] if path != "--list"]
    paths = paths or [ROOT / "include" / "delam" / name for name in HEADERS]
    wrong = []
    for path in paths:
        text = path.read_text(encoding="utf-8")
        found = [(words(sentence), line, sentence) for line, sentence, row, _ in sentences(text) if not row]
        lengths = [length for length, _, _ in found if length]
        print(f"{path.name}: {len(lengths)} sentences, longest {max(lengths)}, average {sum(lengths) / len(lengths):.1f} words, "
              f"{sum(length > LONGEST for length in lengths)} over {LONGEST}; {sum(length > 40 for length in lengths)} over 40")
        if "--list" in sys.argv:
            print("\n".join(f"{length:4d} {line}: {sentence}" for length, line, sentence in sorted(found, reverse=True)))
        wrong += problems(path.name, text)
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
