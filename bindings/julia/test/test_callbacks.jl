# SPDX-License-Identifier: BSD-3-Clause

struct Stop <: Exception end

@testset "callbacks" begin
    # A law by functions gives the history of the library's own.
    ours = history(Solver(double_cantilever(law=host_bilinear())), [0.25, 0.5, 0.75])
    theirs = history(Solver(double_cantilever()), [0.25, 0.5, 0.75])
    @test ours["reaction:opening"] ≈ theirs["reaction:opening"]

    # What a law throws is thrown by the call; the solver is where it was.
    failing = Ref(false)
    solver = Solver(double_cantilever(law=host_bilinear(spy=_ -> failing[] && throw(Stop()))))
    failing[] = true
    @test_throws Stop advance!(solver, 0.5)
    @test !pending(solver) && solver["time"] == 0.0
    failing[] = false
    advance!(solver, 0.5)
    @test pending(solver)

    # Progress is told, cancels with true, and hands on what it throws, Ctrl-C too.
    stages = String[]
    answer = Ref{Any}(false)
    function progress(stage, done, total)
        push!(stages, stage)
        answer[] isa Exception && throw(answer[])
        return answer[]
    end
    solver = Solver(double_cantilever(progress=progress))
    @test !isempty(stages)
    for (given, thrown) in ((true, Cancelled), (InterruptException(), InterruptException), (Stop(), Stop))
        answer[] = given
        @test_throws thrown advance!(solver, 0.5)
        @test !pending(solver) && solver["time"] == 0.0
    end
    answer[] = false
    advance!(solver, 0.5)
    @test solver["time"] == 0.5

    # A request waits for the next long call.
    commit!(solver)
    cancel(solver)
    @test_throws Cancelled advance!(solver, 0.6)

    # Calls from inside a callback are refused.
    inner = Ref{Any}(nothing)
    reentrant = Problem(Mesh(lengths=0.1, divisions=4, thickness=[1e-3], layer_divisions=[1]))
    reentrant.context.progress = function (stage, done, total)
        try
            dofs(reentrant)
        catch exception
            inner[] = exception
        end
        return false
    end
    set_elastic!(reentrant, 1e9, 0.3)
    prescribe!(reentrant, find_nodes(reentrant.mesh, (0, 0), (0, 1e-3)), "x")
    prescribe!(reentrant, find_node(reentrant.mesh, (0, 0)), "y")
    Solver(reentrant)
    @test inner[] isa StateError

    # Objects end in any order.
    for _ in 1:20
        Solver(double_cantilever(divisions=10))
    end
    GC.gc()
    @test true
end
