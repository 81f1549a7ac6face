# SPDX-License-Identifier: BSD-3-Clause
"""Checks the English of comments, messages and names in src and bindings/cli/src: no comment begins with a fragment in
the place of a sentence, and no private word stands where the field has one. In the Python package, comments and docstrings
begin with no fragment. In verify, no private word stands but in its rules and in what earlier versions wrote.

    python3 verify/style/english.py [--glossary]
"""

import argparse
import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("src", "bindings/cli/src")
PACKAGE = "bindings/python/src/"
CODE = {".c", ".h", ".cpp", ".hpp", ".inc"}
VERIFY_TEXT = {".py", ".sh", ".json", ".txt"}  # besides code and documents

# These words never begin a sentence that is understood at once; behind code, they begin no noun phrase either.
NEVER = re.compile(r"(?:what|whether|which|how)\b", re.I)
# A comment that begins so refers to a name below it, which the reader has not read yet. Behind code, "of .." continues
# the name before it.
OWN_LINE = re.compile(r"(?:of|those)\b(?! course)", re.I)
# A subordinate clause needs a main clause, thus a comma.
CLAUSE = re.compile(r"(?:where|while|before|after|because|since|once|until)\b", re.I)
# A preposition needs a verb in the same sentence.
PREPOSITION = re.compile(r"(?:at|along|as|behind|between|beyond|by|for|from|in|into|on|out of|per|to|under|up to|with|within|without)\b",
                         re.I)
VERB = re.compile(r"\b(?:is|are|was|were|be|has|have|had|does|do|did|can|cannot|may|might|must|need|needs|will|would|lies?|stands?|gets?"
                  r"|gives?|costs?|gains?|reads?|holds?|releases?|releasing|leaves?|moves?|remain|suffices?|join|begins?|acts?|counts?"
                  r"|says?|handle|leave|become|becomes|follows?|says|means?|takes?|uses?|keeps?|makes?)\b|=", re.I)

# Private words: an expression over comments, messages and names, and the word of the field.
GLOSSARY = {
    "march": (r"march(?:es|ed|ing)?", "analysis, or load history"),
    "look": (r"look(?:s|ed|ing)?", "check; select, for an earlier step"),
    "booked": (r"book(?:s|ed|ing)?", "record"),
    "hollow": (r"hollow", "inconclusive"),
    "debt": (r"debts?|ow(?:e|es|ed|ing)", "excess cost; pending renewals"),
    "aside": (r"aside", "the other factor; lateral"),
    "fresh": (r"fresh(?:ly)?", "new, inserted, renewed"),
    "scout": (r"scout(?:s|ed|ing)?", "continuation of the fronts at larger loads"),
    "held against": (r"h[eo]ld(?:s|ing)? against", "compare with; support"),
    "patience": (r"patien(?:ce|t)", "back-off; longest wait"),
    "beneath": (r"beneath", "below; smaller cracks"),
    "violent": (r"violent(?:ly)?", "breaking softening"),
    "creeping": (r"creep(?:s|ing)?", "slow; converges slowly"),
}
# The rules of verify name these words, and earlier versions wrote them.
OWN_WORDS = re.compile(r"verify/(?:style/|kept/\w+/|fuzz/corpus/|cases/golden/)")
# What users and hosts have keeps its name, and a term of the field stays.
ALLOWED = re.compile(r"(?:delam_)?solver_look|`_look`|estimate_hollow|up-looking|(?<=solver\.)march(?=\()|\"CREEP\"")
WORDS = {name: re.compile(rf"(?<![A-Za-z])(?:{word})(?![A-Za-z])", re.I) for name, (word, _) in GLOSSARY.items()}

TOKEN = re.compile(r"//[^\n]*|/\*.*?\*/|R\"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)\"|\"(?:\\.|[^\"\\\n])*\""
                   r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.S)


def blocks(text):
    """Each comment of lines that begin in the same column: its first line, whether code stands before it, its text."""
    found = []  # first line, last line, column, behind code, lines
    for m in TOKEN.finditer(text):
        if not m.group().startswith("//"):
            continue
        line, column = text.count("\n", 0, m.start()) + 1, m.start() - text.rfind("\n", 0, m.start()) - 1
        own = not text[m.start() - column:m.start()].strip()
        last = found[-1] if found else None
        if last and own and last[1] == line - 1 and last[2] == column and not last[4][0].startswith("SPDX-"):
            last[1] = line
            last[4].append(m.group()[2:].strip())
        else:
            found.append([line, line, column, not own, [m.group()[2:].strip()]])
    for first, _, _, behind, lines in found:
        yield first, behind, " ".join(filter(None, lines))


def python_blocks(text):
    """Each docstring, and each comment on lines of its own: its first line, and its text."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)) and ast.get_docstring(node):
            yield node.body[0].lineno, " ".join(ast.get_docstring(node).split())
    before = False
    for n, line in enumerate(text.splitlines(), 1):
        comment = re.match(r"\s*#(?!!)\s*(.*)", line)
        if comment and not before:
            yield n, comment.group(1)
        before = comment is not None and not comment.group(1).startswith("SPDX-")


def is_fragment(comment, behind_code):
    """True if the comment begins with a fragment. Behind code, a noun phrase is complete with the name before it."""
    if NEVER.match(comment):
        return True
    if behind_code or not comment[:1].isupper():
        return False
    sentence = re.split(r"(?<=\w{2})[.:;?](?=\s|$)", comment)[0]
    if OWN_LINE.match(comment):
        return True
    if CLAUSE.match(comment):
        return "," not in sentence
    return bool(PREPOSITION.match(comment)) and not VERB.search(sentence)


def fragments(name, text):
    """Each comment of a file that begins with a fragment."""
    for line, behind, comment in blocks(text):
        if is_fragment(comment, behind):
            yield f"{name}:{line}: a comment needs a subject and a verb: {comment[:60]}"


def private_words(name, text):
    """Each private word of a file, with that of the field."""
    for n, line in enumerate(text.splitlines(), 1):
        for word in GLOSSARY:
            if WORDS[word].search(ALLOWED.sub("", line)):
                yield f"{name}:{n}: \"{word}\" is a private word, the field's is: {GLOSSARY[word][1]}"


def problems(name, text):
    """Lists what this rule refuses in a file, a line each."""
    if name.startswith(PACKAGE):
        yield from (f"{name}:{line}: a comment needs a subject and a verb: {comment[:60]}"
                    for line, comment in python_blocks(text) if is_fragment(comment, False))
        return
    if name.startswith("verify/"):
        yield from () if OWN_WORDS.match(name) else private_words(name, text)
        return
    if pathlib.PurePath(name).suffix in CODE:
        yield from fragments(name, text)
    yield from private_words(name, text)


def sources():
    paths = (p for folder in (*FOLDERS, "verify") for p in (ROOT / folder).rglob("*"))
    text = CODE | {".md", ".cmake"}
    return sorted(p for p in paths if p.is_file() and (p.name == "CMakeLists.txt" or p.suffix in text or
                  p.suffix in VERIFY_TEXT and p.is_relative_to(ROOT / "verify"))) + sorted((ROOT / PACKAGE).rglob("*.py"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--glossary", action="store_true", help="print the private words and those of the field")
    if parser.parse_args().glossary:
        for word, (_, field) in GLOSSARY.items():
            print(f"{word:14s}{field}")
        return 0
    texts = {p.relative_to(ROOT).as_posix(): p.read_text(encoding="utf-8") for p in sources()}
    wrong = [line for name, text in texts.items() for line in problems(name, text)]
    comments = sum(1 for name, text in texts.items() if pathlib.PurePath(name).suffix in CODE
                   and not name.startswith(("verify/", PACKAGE))
                   for _, _, comment in blocks(text) if comment and not comment.startswith("SPDX-"))
    print(f"{len(texts)} files, {comments} comments, {len(GLOSSARY)} private words")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
