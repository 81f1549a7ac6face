#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""planted_sources.py SOURCE_FOLDER [WORK_FOLDER [CMAKE_OPTION...]]: breaks of meaning, planted in the sources.

Copies include, src and what builds them to WORK_FOLDER, plants all of BREAKS at once, each behind a switch that the
variable DELAM_PLANTED of the environment sets, builds the library once and runs the checks of calls and meanings that
need nothing but a library (CHECKS) for each break. Each break must be seen; without one nothing may fail. Without a
work folder, only reads whether the sources still have the lines that the breaks replace.
"""
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SWITCH = '''
#include <cstdlib>
#include <cstring>
namespace delam {
inline bool planted(const char* name) {
    const char* chosen = std::getenv("DELAM_PLANTED");
    return chosen != nullptr && std::strcmp(chosen, name) == 0;
}
}  // namespace delam
'''
# name, file, what stands there, what stands there instead; P: the switch of this break.
BREAKS = [
    ("bonds after contact stay without adhesion", "capi/problem.cpp",
     "        if (interface.contact) std::fill(interface.adhesion.begin(), interface.adhesion.end(), 1.0);\n"
     "        interface.bonded = true;",
     "        if (interface.contact && !P) std::fill(interface.adhesion.begin(), interface.adhesion.end(), 1.0);\n"
     "        interface.bonded = true;"),
    ("contact keeps its adhesion", "capi/problem.cpp",
     "        std::fill(interface.adhesion.begin(), interface.adhesion.end(), 0.0);",
     "        if (!P) std::fill(interface.adhesion.begin(), interface.adhesion.end(), 0.0);"),
    ("a law resets the adhesion", "capi/problem.cpp",
     "        if (interface.contact) std::fill(interface.adhesion.begin(), interface.adhesion.end(), 1.0);\n"
     "        interface.law = taken;",
     "        if (interface.contact || P) std::fill(interface.adhesion.begin(), interface.adhesion.end(), 1.0);\n"
     "        interface.law = taken;"),
    ("plane strain does not come back", "capi/problem.cpp",
     "word == \"plane-strain\" ? Plane::strain", "word == \"plane-strain\" && !P ? Plane::strain"),
    ("the first material counts", "capi/problem.cpp",
     "        if (body == -1 || i == static_cast<std::size_t>(index)) problem.material[i] = material;",
     "        if ((body == -1 || i == static_cast<std::size_t>(index)) && !(P && problem.material[i])) "
     "problem.material[i] = material;"),
    ("the last eigenstrain counts", "capi/loads.cpp",
     "        core.eigenstrains.insert(core.eigenstrains.end(), added.begin(), added.end());",
     "        if (P) core.eigenstrains.clear();\n"
     "        core.eigenstrains.insert(core.eigenstrains.end(), added.begin(), added.end());"),
    ("the last force counts", "capi/loads.cpp",
     "        core.forces.insert(core.forces.end(), added.begin(), added.end());",
     "        if (P) core.forces.clear();\n"
     "        core.forces.insert(core.forces.end(), added.begin(), added.end());"),
    ("labels of nodes as indices", "capi/mesh.cpp",
     "bodies[node] = body < 0 ? -1 : core.body_label(body);",
     "bodies[node] = body < 0 || P ? body : core.body_label(body);"),
    ("a box of nodes without its corners", "mesh/selection.cpp",
     "constexpr double widening = 1e-9;", "const double widening = P ? -1e-9 : 1e-9;"),
    ("all interfaces once more", "mesh/pairing/pairing.cpp",
     "        if (joined.contains({a, b})) continue;", "        if (joined.contains({a, b}) && !P) continue;"),
    ("the strength counts", "law/law_parameters.cpp",
     "if (p->instead_of != nullptr) law.*p->instead_of = 0.0;",
     "if (p->instead_of != nullptr && !(P && key.ends_with(\"onset\"))) law.*p->instead_of = 0.0;"),
    ("exponents stay", "law/law.cpp",
     "    toughness_exponent_1 = toughness_exponent_2 = 2.0;\n",
     "    if (P) return;\n    toughness_exponent_1 = toughness_exponent_2 = 2.0;\n"),
    ("adhesion heals", "law/respond.cpp",
     "driving, adhesion_old), {}};", "driving, P ? 1.0 : adhesion_old), {}};"),
    ("traction without damage", "law/respond.cpp",
     "at.traction[c] = at.adhesion * law", "at.traction[c] = (P ? 1.0 : at.adhesion) * law"),
    ("rollback keeps the step that was selected", "evolution/analysis/solver.cpp",
     "    states_.rollback();\n    observer_.show(states_.committed());",
     "    const std::int64_t seen = states_.selected() ? states_.shown().step : -1, last = states_.present().step;\n"
     "    states_.rollback();\n    if (P && seen >= 0 && seen < last) states_.select(seen);\n"
     "    observer_.show(states_.shown());"),
    ("a displacement step is a step", "evolution/analysis/solver.cpp",
     "    if (!result.converged) outcome = unconverged_displacement(result.state);\n    require_sound(problem_, result.state",
     "    if (P) ++result.state.step;\n"
     "    if (!result.converged) outcome = unconverged_displacement(result.state);\n    require_sound(problem_, result.state"),
    ("jumps of committed steps alone", "evolution/analysis/states.cpp",
     "    if (!pending_) return all;", "    if (!pending_ || P) return all;"),
    ("loading keeps the histories", "evolution/analysis/solver.cpp",
     "    problem_.patterns = std::move(patterns);", "    if (!P) problem_.patterns = std::move(patterns);"),
    ("loading keeps the record", "evolution/analysis/solver.cpp",
     "    record_ = std::move(record);", "    if (!P) record_ = std::move(record);"),
    ("loading keeps the pending step", "evolution/analysis/states.cpp",
     "    jumps_ = std::move(jumps);\n    rollback();",
     "    jumps_ = std::move(jumps);\n    selected_ = nullptr;\n    if (!P) rollback();"),
    ("a key is recorded twice", "evolution/analysis/solver.cpp",
     "    if (record_.find(own) == nullptr) record_.add(", "    if (record_.find(own) == nullptr || P) record_.add("),
    ("a history forgets what was before", "evolution/analysis/solver.cpp",
     "    v.push_back(changed.at(now));", "    v.push_back(P ? 0.0 : changed.at(now));"),
    ("steps that were set keep the past", "evolution/analysis/states.cpp",
     "    if (pending_->state.step == committed_.step) past_.clear();",
     "    if (pending_->state.step == committed_.step && !P) past_.clear();"),
    ("a record of steps that were set", "evolution/observe/record.cpp",
     "            values[at] = row.values[c];", "            values[at] = planted_value(P, values[at], row.values[c]);"),
    ("a request that came before stops what only builds", "base/monitor.hpp",
     "        if (lets_wait_.load(", "        if (!P && lets_wait_.load("),
    ("what replaces a step is not selected", "evolution/analysis/states.cpp",
     "                if (state.step == step) found = &state;",
     "                if (state.step == step && !P) found = &state;"),
    ("instants of the whole step", "evolution/step/jump_event.cpp",
     "        jump.before = jump.time = ", "        if (!P) jump.before = jump.time = "),
    ("reactions of the whole step", "evolution/step/jump_event.cpp",
     "        jump.conjugate_before = after", "        if (!P) jump.conjugate_before = after"),
    ("increment_lower at the mixities of the step", "evolution/increment/rule/step_rule.cpp",
     "dissipation(pairs_, next.mixity_before, before_",
     "dissipation(pairs_, P ? next.mixity : next.mixity_before, before_"),
    ("no mixity before the first load", "evolution/step/stepper.cpp",
     "rule_->begin(pairs_, before, elastic.response, next)",
     "rule_->begin(pairs_, before, P ? before.response : elastic.response, next)"),
]
CHECKS = [("meanings.py", "meanings.py {header} {library}"),
          ("test_contract.py", "test_contract.py {library} {header}"),
          ("provoked.py", "provoked.py {library} {header}")]


def lost(source):
    """Returns the breaks whose lines the sources no longer have."""
    out = []
    for name, file, old, _ in BREAKS:
        path = os.path.join(source, "src", file)
        text = ""
        if os.path.exists(path):
            with open(path, encoding="utf-8") as there:
                text = there.read()
        if text.count(old) == 0:
            out.append(f"'{name}': src/{file} has no such line any more: {old}")
    return out


def plant(source, work):
    shutil.rmtree(os.path.join(work, "src"), ignore_errors=True)
    for folder in ("include", "src", "bindings", "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md"):
        whole, copy = os.path.join(source, folder), os.path.join(work, folder)
        if os.path.isdir(whole):
            shutil.copytree(whole, copy, dirs_exist_ok=True)
        else:
            shutil.copy(whole, copy)
    changed = {}
    for name, file, old, new in BREAKS:
        path = os.path.join(work, "src", file)
        if path not in changed:
            with open(path, encoding="utf-8") as text:
                changed[path] = text.read()
        switch = f'delam::planted("{name}")'
        new = new.replace("!P", "!" + switch).replace("(P", "(" + switch).replace(" P)", f" {switch})")
        new = new.replace(" P ", f" {switch} ").replace("= P", "= " + switch).replace(" P;", f" {switch};")
        changed[path] = changed[path].replace(old, new, 1)
    for path, text in changed.items():
        text = text.replace("planted_value(", "delam::planted_value(")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    head = os.path.join(work, "src", "base", "error.hpp")
    with open(head, "a", encoding="utf-8") as file:
        file.write(SWITCH + '''namespace delam {
inline double planted_value(bool planted, double before, double now) { return planted ? before : now; }
}  // namespace delam
''')
    for path in changed:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if '#include "base/error.hpp"' not in text and not path.endswith("error.hpp"):
            first = text.index("#include")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text[:first] + '#include "base/error.hpp"\n' + text[first:])


def seen_by(source, library, name):
    """Checks that fail while the break acts, with a line of each."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"}
    environment.pop("DELAM_PLANTED", None)
    if name:
        environment["DELAM_PLANTED"] = name
    header = os.path.join(source, "include", "delam", "delam.h")
    for check, command in CHECKS:
        words = command.format(header=header, library=library).split(" ")
        done = subprocess.run([sys.executable, os.path.join(HERE, words[0]), *words[1:]], env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if done.returncode != 0:
            yield f"{check}: {(done.stdout.strip().splitlines() or ['no words'])[0]}"


def main():
    source = os.path.abspath(sys.argv[1])
    if missing := lost(source):
        sys.exit("\n".join(missing))
    if len(sys.argv) == 2:
        print(f"{len(BREAKS)} breaks have their lines")
        return
    work, options = os.path.abspath(sys.argv[2]), sys.argv[3:]
    os.makedirs(work, exist_ok=True)
    plant(source, work)
    folder = os.path.join(work, "build")
    for command in (["cmake", "-S", work, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DDELAM_UNITY=ON",
                     "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DDELAM_BUILD_TESTS=OFF", "-DDELAM_BUILD_EXAMPLES=OFF",
                     "-DDELAM_BUILD_CLI=OFF", *options],
                    ["cmake", "--build", folder, "--target", "delam"]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    library = os.path.join(folder, "lib", "libdelam.so")
    missed = 0
    for name in ("", *(entry[0] for entry in BREAKS)):
        found = list(seen_by(source, library, name))
        if (not name) == bool(found):
            missed += 1
        print(f"{name or 'no break'}: {'; '.join(found) or 'nothing fails'}", flush=True)
    print(f"{len(BREAKS)} breaks in the sources, {missed} wrong")
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
