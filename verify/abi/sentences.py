#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sentences.py HEADER [--base delam.h] [--list]: sentences of the header that say until, before, only, restores or replaces are about
order and exclusion, which types and units do not show. Each has an entry in SENTENCES: a row of the table of meanings,
or a test that names what it provokes, or a reason why there is nothing to observe. A sentence without an entry, an entry
without a sentence, a row that is not there and a file that does not hold the words given: each fails. --list prints all.
With --base, HEADER is petsc.h, whose entries are in PETSC_SENTENCES.
"""
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "meaning")]
import contract_lint as lint  # noqa: E402
import header as headers  # noqa: E402
import table  # noqa: E402

table.load()

VERIFY = os.path.dirname(HERE)
WORDS = re.compile(r"\b(?:until|before|only|restores|replaces)\b")
FORMAT, ADVICE = "an order of entries or a shape, which the rows of the array tell", "advice to the host, no behaviour"
# function, words of the sentence, and: "row NAME", "FILE: WORDS" (of verify), or FORMAT or ADVICE.
SENTENCES = [
    ("blas_threads", "restores the number afterwards", "unit/test_blas_threads.cpp: an_analysis_leaves_the_number"),
    ("blas_threads", "only if the number is the same", ADVICE),
    ("context_cancel", "it only increments", "row a cancel before a call"),
    ("context_cancel", "only build or read", "abi/provoked.py: def wrong_wait"),
    ("context_cancel", "only if it arrives while they run", "abi/provoked.py: def wrong_wait"),
    ("mesh_add_conforming_cells", "exist before the call", "unit/test_conforming.cpp: = mesh.node_count(); }"),
    ("mesh_add_conforming_cells", "share only a corner", "unit/test_conforming.cpp: octants"),
    ("mesh_add_host_body", "affect only the rigid-body modes", "row places of a host's nodes"),
    ("mesh_add_pairs", "corners before mid-side", FORMAT),
    ("mesh_interface_faces", "corners before mid-side", FORMAT),
    ("law_create", "trapezoidal only", "row bounds of parameters"),
    ("law_create", "only on faces whose pairs all", "cases/test_gradient.cpp: adhered(std::size_t i)"),
    ("law_parameter_bounds", "check a number before it sets it", "row bounds of parameters"),
    ("law_create_host", "until that call ends", "cases/test_callbacks.cpp: law_that_ends_itself"),
    ("problem_set_stiffness", "it replaces the stiffness of their cells", "row what the last call replaces"),
    ("problem_set_stiffness", "serve only to compute the stresses", "row stiffness of one of two bodies"),
    ("problem_set_stiffness", "kept only the diagonal", "cases/test_host_body.cpp: emptied_rows"),
    ("problem_set_stiffness", "A later call replaces", "row stiffness of one of two bodies"),
    ("problem_add_pattern", "constant before the first", "row histories"),
    ("problem_begin_constraints", "beyond it from before", "cases/test_stages.cpp: time 1, at which supports begin or end"),
    ("problem_begin_constraints", "return to steps before it", "cases/test_stages.cpp: no_return_over_a_change"),
    ("problem_begin_constraints", "replaces the first", "cases/test_stages.cpp: replaced by the next call"),
    ("problem_add_forces", "only one of these", 'abi/provoked.py: ("problem_add_forces", "problem")'),
    ("problem_set_gaps", "have before they move", "row gaps"),
    ("problem_set_gaps", "acts only where that is 0", "row gaps"),
    ("problem_set_gaps", "replaces the gaps", "row gaps"),
    ("problem_set_number", "whole numbers only", "row what the last call replaces"),
    ("problem_constraints", "only DOFs of bodies and control nodes", "row constraints of tied nodes"),
    ("problem_plan", "before the first step", "row a plan beforehand"),
    ("solver_advance", "restores the previous state bit for bit", "row what a rollback restores"),
    ("solver_advance", "backtracking replaces are not divided", "row steps that a return replaces"),
    ("solver_advance", "only one of the two processes", ADVICE),
    ("solver_value", "with the damage before the step", "row two-sided estimate of a bar"),
    ("solver_value", "tests the lower bound only", "row backtracking_tolerance"),
    ("solver_value", "before the step are a > 0 times", "row two-sided estimate of a bar"),
    ("solver_value", "at the mixities of the step before", "row mixity_rule"),
    ("solver_value", "reactions before and after it", "row what a bar releases"),
    ("solver_value", "only where rounding may spoil", "unit/test_plan.cpp: bodies_are_factored_once"),
    ("solver_record", "replaces the entry of that", "row a record of steps that are set"),
    ("solver_record", "replaces the record by the one in the bytes", "row what loading replaces"),
    ("solver_recorded", "NaN for the steps before", "row record"),
    ("solver_field_shape", "of the state before the step", "row mixity_rule"),
    ("solver_look", "pending step replaces earlier steps", "row steps that a return replaces"),
    ("solver_jump", "between *before and *time", "row what a bar releases"),
    ("solver_jump", "*before and *time are both this instant", "row instant of a jump"),
    ("solver_jump", "E(time, state before)", "row jump_tolerance"),
    ("solver_jump_reactions", "NULL for those not wanted", FORMAT),
    ("solver_jump_reactions", "the load that the structure carries at most", "cases/test_path.cpp: ledger_of_a_jump"),
    ("solver_jump_reactions", "states before and after the jump", "row reactions of a jump"),
    ("solver_save", "only the size", "row saved state"),
    ("progress_callback", "Functions that only read ignore", "cases/test_cancelled_calls.cpp: read"),
]
PETSC_SENTENCES = [
    ("petsc_message", "on that rank only", "petsc/test_engine.cpp: is on that rank only"),
    ("petsc_set_part", "nodes that only the ranks know", "petsc/test_engine.cpp: move_hidden"),
    ("petsc_set_part", "Solvers made before are of no use", "abi/provoked_petsc.py: def other_parts"),
    ("petsc_set_rows", "each on one rank only", "petsc/handing.py: a node on two ranks"),
    ("petsc_set_cells", "only cells of rank 0's mesh", "petsc/handing.py: set_cells: {change}"),
    ("petsc_run", "only those of one rank or rank 0 alone", "abi/provoked_petsc.py: not in the work of rank 0"),
    ("petsc_set_task", "it replaces an earlier one", "petsc/test_engine.cpp: the later task"),
    ("petsc_recover", "until the next call or other parts", "petsc/handing.py: def kept"),
    ("petsc_task_callback", "before such a step", ADVICE),
]


def sentences_of(header):
    """(function, sentence)"""
    for function in [*header.functions.values(), *header.callbacks.values()]:
        prose = " ".join(lint.fields_of(function.comment)[1].split())
        for sentence in re.split(r"(?<=[.:;])\s+(?=[A-Z*`a-z])", prose):
            if WORDS.search(sentence):
                yield function.name[len("delam_"):], sentence


def wrong_place(place, rows):
    if place in (FORMAT, ADVICE):
        return None
    if place.startswith("row "):
        return None if place[4:] in rows else f"there is no row '{place[4:]}'"
    name, _, words = place.partition(": ")
    path = os.path.join(VERIFY, name)
    if not os.path.exists(path):
        return f"there is no {name}"
    with open(path, encoding="utf-8") as file:
        return None if words in file.read() else f"{name} does not hold '{words}'"


def gaps_of(header, entries):
    rows = {row.name for row in table.ROWS}
    used = set()
    for function, sentence in sentences_of(header):
        hits = [entry for entry in entries if entry[0] == function and entry[1] in sentence]
        used.update(hits)
        if not hits:
            yield f"delam_{function}: '{sentence[:120]}': neither a row nor another test is named for it"
    for entry in entries:
        if entry not in used:
            yield f"delam_{entry[0]}: '{entry[1]}': no such sentence in the header"
        wrong = wrong_place(entry[2], rows)
        if wrong:
            yield f"delam_{entry[0]}: '{entry[1]}': {wrong}"


def main():
    based = "--base" in sys.argv
    base = headers.read(sys.argv[sys.argv.index("--base") + 1]) if based else None
    header, entries = headers.read(sys.argv[1], base, promised=based), PETSC_SENTENCES if based else SENTENCES
    found = list(sentences_of(header))
    if "--list" in sys.argv:
        for function, sentence in found:
            print(f"delam_{function}: {sentence}")
    gaps = list(gaps_of(header, entries))
    # The check is only seen at work at a gap.
    if not any("neither a row" in gap for gap in gaps_of(header, entries[1:])):
        gaps.append("an entry that is gone is not noticed")
    for gap in gaps:
        print(gap)
    print(f"{len(found)} sentences, {len(entries)} entries, {len(gaps)} gaps")
    sys.exit(1 if gaps else 0)


if __name__ == "__main__":
    main()
