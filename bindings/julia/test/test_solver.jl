# SPDX-License-Identifier: BSD-3-Clause

@testset "solver" begin
    solver = Solver(double_cantilever())
    times = range(0.05, 1.0; length=20)
    rows = history(solver, times)
    @test length(rows) == 21
    @test rows["time"] ≈ [0.0; times]
    @test rows["dissipated"][end] > 0.0
    @test issorted(rows["dissipated"])

    # Fields have a column for each node or pair.
    @test size(field(solver, "displacement")) == (2, 204)
    @test size(field(solver, "traction", 1)) == (2, 51)
    adhesion = field(solver, "adhesion", 1)
    @test adhesion isa Vector && extrema(adhesion) == (0.0, 1.0)
    at = fronts(solver, 1)
    @test at.starts == [1, 2] && size(at.rates) == (3, 1)
    @test solver["crack_length"] > 0.03
    @test tangent(solver)[1, 1] > 0.0
    @test average(solver; body=0).volume ≈ 0.1 * 1.5e-3
    @test !isempty(plan(solver)) && !isempty(plan_items(solver))
    forecast = plan(solver.problem)
    @test forecast.plan == plan(solver) && forecast.setup > 0 && forecast.memory > 0
    @test option(solver, "solution") == "local"
    line = profile(solver, "adhesion")
    @test line.lines == [collect(1:51)] && line.values == adhesion

    # Rolled back, saved and loaded: bit for bit.
    state = save(solver)
    before = field(solver, "jump", 1)
    advance!(solver, 1.1)
    @test pending(solver)
    @test_throws StateError advance!(solver, 1.2)
    @test step_tangent(solver)[1, 1] > 0.0
    rollback!(solver)
    @test !pending(solver)
    @test field(solver, "jump", 1) == before
    other = Solver(double_cantilever())
    load!(other, state)
    @test field(other, "jump", 1) == before
    @test_throws SnapshotError load!(other, state[1:end-1])
    mktempdir() do folder
        path = joinpath(folder, "state")
        save(solver, path)
        load!(other, path)
        @test field(other, "jump", 1) == before
        @test_throws FileError load!(other, joinpath(folder, "none"))
    end
    @test_throws InvalidArgument solver["no such value"]

    # Values that each commit records.
    record!(other, "time")
    @test recorded(other, "time") == [other["time"]] && length(recorded_steps(other)) == 1
    @test_throws InvalidArgument recorded(other, "work")
    infos = Dict(value_infos(other))
    @test infos["kkt_gap"].cost == "recovers" && !infos["kkt_gap"].recorded
    @test infos["am_iterations"].alias == "staggered_iterations"
    @test other["staggered_iterations"] == other["am_iterations"] && haskey(other, "staggered_iterations")

    # A history from here on.
    set_history!(solver, 1, [2.0], [0.0])
    advance!(solver, 1.5)
    @test solver["load:opening"] ≈ 3e-3
    rollback!(solver)

    # The condensed operator has the energy of the bodies and the loads.
    small = condensed(solver)
    @test small.stiffness ≈ small.stiffness'
    @test size(small.offset) == (1, 102) && size(small.load, 2) == 1

    text = sprint(io -> write_csv(io, rows))
    @test length(split(text, "\n"; keepempty=false)) == 22
    close(solver)
    @test_throws InvalidHandle solver["time"]
end
