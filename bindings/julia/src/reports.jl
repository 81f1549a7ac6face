# SPDX-License-Identifier: BSD-3-Clause
# Reports of a solver: its plan, its options, its searches, its jumps.

"The parts of the method that the scene needs and those left out, as text."
plan(solver::Solver) = ask_text(handle -> Raw.delam_solver_plan(handle), solver)

"The same as data: subject, decision, reason, cost, saving, unit."
function plan_items(solver::Solver)
    count = Ref(Int64(0))
    ask(handle -> Raw.delam_solver_plan_count(handle, count), solver)
    return [plan_item(solver, i) for i in 0:count[]-1]
end

function plan_item(solver, index)
    subject, decision, reason, unit = (Ref{Cstring}(C_NULL) for _ in 1:4)
    cost, saving = Ref(0.0), Ref(0.0)
    ask(solver) do handle
        Raw.delam_solver_plan_item(handle, index, subject, decision, reason, cost, saving, unit)
    end
    # The solver owns the texts.
    return GC.@preserve solver (subject=unsafe_string(subject[]), decision=unsafe_string(decision[]),
        reason=unsafe_string(reason[]), cost=cost[], saving=saving[], unit=unsafe_string(unit[]))
end

"Value of an option as text, as copied by the solver."
function option(solver::Solver, key)
    value = ask_text(handle -> Raw.delam_solver_option(handle, key), solver)
    value === nothing && throw(KeyError(key))
    return value
end

"What the energetic search of the last step compared."
searched(solver::Solver) = ask_text(handle -> Raw.delam_solver_searched(handle), solver)

"Jumps of the state, in the order of time. `first_pair`, `last_pair`: 0 for none; reactions: one for each pattern."
function jumps(solver::Solver)
    count = Ref(Int64(0))
    ask(handle -> Raw.delam_solver_jump_count(handle, count), solver)
    return [jump(solver, i) for i in 0:count[]-1]
end

function jump(solver, index)
    step, number, first_pair, last_pair = (Ref(Int64(0)) for _ in 1:4)
    before, time, stored, dissipated, released, debonded = (Ref(0.0) for _ in 1:6)
    ask(solver) do handle
        Raw.delam_solver_jump(handle, index, step, before, time, stored, dissipated, released, debonded, number,
            first_pair, last_pair)
    end
    reaction_before, reaction_after = (zeros(length(patterns(solver.problem))) for _ in 1:2)
    ask(solver) do handle
        Raw.delam_solver_jump_reactions(handle, index, length(reaction_before), reaction_before, reaction_after)
    end
    return (step=step[], before=before[], time=time[], stored=stored[], dissipated=dissipated[], released=released[],
        debonded=debonded[], interface=number[] + 1, first_pair=first_pair[] + 1, last_pair=last_pair[] + 1,
        reaction_before, reaction_after)
end
