# SPDX-License-Identifier: BSD-3-Clause
"""Checks that src says some things in their own files only, and some nowhere; and that no constant of src or of the
command line stands in two files with one name and one value.

    python3 verify/style/words.py
"""

import pathlib
import re
import sys

import scanner

ROOT = pathlib.Path(__file__).resolve().parents[2]

# What may stand in the files listed only, as an expression over the code without comments and literals.
RULES = [
    ("dynamic_cast", r"\bdynamic_cast\b", []),
    ("a helper that makes an index of an integer, besides index() of base/numbers.hpp",
     r"\b(?:std::)?size_t \w+\([\w:]+ (\w+)\) (?:noexcept )?\{\s*return static_cast<(?:std::)?size_t>\(\1\);",
     ["base/numbers.hpp"]),
    ("a loop for the largest absolute value of a list, besides max_abs() of base/numbers.hpp",
     r"for \((?:const )?(?:double|auto)&? (\w+) : [\w.()\[\]]+\)\s*\{?\s*(\w+) = std::max\(\2, std::abs\(\1\)\);",
     ["base/numbers.hpp"]),
    ("a rule for the mode mixity, besides its own files and where a step is constructed",
     r"\b(?:MixityRule|(?:Frozen|Converged|Variational)Increment)\b",
     [f"evolution/increment/rule/{name}.{kind}" for kind in ("hpp", "cpp")
      for name in ("mixity_rule", "frozen_increment", "converged_increment", "variational_increment")]
     + ["evolution/step/stepper.hpp", "evolution/step/stepper.cpp"]),
    ("the option mixity_rule compared, besides the table of its rules and the check of a scene",
     r"\bmixity_rule\s*[!=]=|[!=]=\s*(?:\w+(?:\.|->))*mixity_rule\b",
     ["evolution/increment/rule/mixity_rule.cpp", "scene/check/kinematics.cpp",
      "scene/check/step_control.cpp", "scene/check/validate.cpp"]),
    ("the option mixity_rule read, besides where a step is constructed, the plan and the check of a scene",
     r"\boptions(?:\(\))?(?:\.|->)mixity_rule\b",
     ["evolution/step/stepper.cpp", "evolution/analysis/plan.cpp", "scene/check/kinematics.cpp",
      "scene/check/step_control.cpp", "scene/check/validate.cpp"]),
    ("the stiffness of a component chosen by hand, besides Law::stiffness() of law/law.hpp",
     r"\?\s*[\w.>-]*\bnormal_stiffness\s*:", ["law/law.hpp"]),
]


def problems(name, text, rules):
    """Each place of a file of src that a rule refuses."""
    code = scanner.bare(text)
    for what, pattern, files in rules:
        if name.removeprefix("src/") in files:
            continue
        for m in re.finditer(pattern, code):
            yield f"{name}:{code.count(chr(10), 0, m.start()) + 1}: {what}"


CONSTANTS = re.compile(r"\bconstexpr\s+(?:static\s+|const\s+)*[\w:<>]+\s+([^;(){}]*=[^;{}]*);")


def constants(text):
    """Yields (name, value) of the constants of a file that are numbers."""
    for m in CONSTANTS.finditer(scanner.bare(text)):
        for part in m.group(1).split(","):
            name, _, value = part.partition("=")
            value = re.sub(r"[\s']|(?<=\d)[uUlLfF]+$", "", value)
            if re.match(r"[-\d.(]", value):
                yield name.strip(), value


# The command line sees nothing of src but the C interface, and repeats these of its numbers: with their values.
REPEATED = {"noticeable", "resolving_pairs", "small_rotation"}


def twins(texts):
    """Yields constants that stand in more than one of the files, and repeated ones with two values: {name of the file:
    its text}."""
    places = {}
    for file, text in texts.items():
        for name, value in constants(text):
            places.setdefault(name, {}).setdefault(value, set()).add(file)
    for name, values in places.items():
        for value, files in values.items():
            if len(files) > (2 if name in REPEATED else 1):
                yield f"{name} = {value} stands in {', '.join(sorted(files))}: one of them, with its reason, is enough"
        if name in REPEATED and len(values) > 1:
            yield f"{name} has {len(values)} values: {', '.join(sorted(values))}"


def main():
    paths = sorted((ROOT / "src").rglob("*.[ch]pp"))
    wrong = [line for p in paths
             for line in problems(p.relative_to(ROOT).as_posix(), p.read_text(encoding="utf-8"), RULES)]
    both = [*paths, *sorted((ROOT / "bindings" / "cli" / "src").rglob("*.[ch]pp"))]
    wrong += twins({p.relative_to(ROOT).as_posix(): p.read_text(encoding="utf-8") for p in both})
    print(f"{len(paths)} files, {len(RULES)} rules")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
