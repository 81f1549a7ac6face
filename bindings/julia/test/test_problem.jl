# SPDX-License-Identifier: BSD-3-Clause

@testset "problem" begin
    problem = double_cantilever()
    check(problem)
    @test patterns(problem) == ["opening"]
    @test dofs(problem) == (408, 102)
    @test factors(problem, 0.5) == [3e-3]
    @test length(problem_hash(problem)) == 16
    before = problem_hash(problem)
    problem["damage_tolerance"] = 1e-7
    problem["solution"] = "local"
    @test problem_hash(problem) != before
    @test options()["solution"].type == "text"
    @test_throws InvalidArgument setindex!(problem, 1.0, "no such option")

    # What the library has assembled: symmetric, of a free body.
    stiffness = Matrix(Delam.body_matrix(problem, 0))
    @test stiffness ≈ stiffness'
    @test maximum(abs, stiffness * repeat([1.0, 0.0], size(stiffness, 1) ÷ 2)) < 1e-9 * maximum(abs, stiffness)
    rows, coefficients = Delam.constraints(problem)
    @test size(coefficients) == (1, rows.rows)
    @test coefficients[1, 1:2] == [0.5, 0.5]

    # A notch by a box is that by pairs.
    boxed, listed = double_cantilever(), double_cantilever()
    @test set_adhesion_box!(boxed, 1, (0.0, 0.0), (0.04, 3e-3)) == 20
    set_adhesion!(listed, 1, places(interfaces(listed.mesh)[1])[1, :] .< 0.04 - 1e-6)
    @test problem_hash(boxed) == problem_hash(listed)
    @test propose(boxed, 1).stiffness ≈ 50 * 135e9 / 1.5e-3
    @test propose(boxed, 1; pairs=2.0).normal_strength > propose(boxed, 1).normal_strength > 0

    # Gaps of the mesh, of a number, and of one number per pair; small ones count as 0.
    pair = Mesh([0.0 1 0 1 0 1 0 1; 0 0 1 1 1.125 1.125 2 2])
    add_cells!(pair, "quad4", [1 5; 2 6; 4 8; 3 7], [0, 1])
    add_mortar_interface!(pair, 0, 1; gap=0.25)
    apart = Problem(pair)
    set_contact!(apart, 1)
    always = add_pattern!(apart, "always", [0, 1], [1, 1])
    hashes = [problem_hash(set_gaps!(apart, 1, always, gaps; adjust=adjust))
              for (gaps, adjust) in [(nothing, 0.0), (0.125, 0.0), ([0.125, 0.5], 0.25), ([0.0, 0.5], 0.0)]]
    @test hashes[1] == hashes[2] != hashes[3] == hashes[4]
    @test_throws DimensionMismatch set_gaps!(boxed, 1, 1, [0.0, 1.0])
    @test_throws ProblemError set_gaps!(boxed, 1, 1, 1e-3)

    # The same matrix handed back is the same problem.
    own = Problem(problem.mesh; plane="plane-strain")
    set_elastic!(own, 135e9, 0.3)
    set_formulation!(own, "incompatible")
    for body in 0:1
        matrix = Delam.body_matrix(own, body)
        ids = findall(==(body), node_bodies(own.mesh))
        set_stiffness!(own, ids, matrix.row_starts, matrix.columns, matrix.values)
    end
    @test Matrix(Delam.body_matrix(own, 0)) ≈ stiffness
    @test_throws DimensionMismatch set_stiffness!(own, [1, 2], [1], Int64[], Float64[])

    # Bodies without cells, and pairs by hand.
    bare = Mesh([0.0 1.0 0.0 1.0; 0.0 0.0 0.0 0.0])
    add_host_body!(bare, 0, [1, 2])
    add_host_body!(bare, 1, [3, 4])
    joint = add_pairs!(bare, 0, 1, [1, 2], [3, 4], [0.0, 1.0], 0.5; faces=reshape([1, 2], 2, 1))
    @test nodes_a(joint) == [1, 2] && nodes_b(joint) == [3, 4] && weights(joint) == [0.5, 0.5]
    @test faces(joint) == reshape([1, 2], 2, 1)

    incomplete = Problem(problem.mesh)
    @test_throws ProblemError check(incomplete)
    set_orthotropic!(incomplete, [140e9, 10e9, 10e9, 0.3, 0.3, 0.4, 5e9, 5e9, 3.5e9])
    set_orientation!(incomplete, [1.0 0.0; 0.0 1.0; 0.0 0.0])
    @test_throws DimensionMismatch set_orthotropic!(incomplete, [1.0, 2.0])
    @test_throws InvalidArgument prescribe!(incomplete, 1, "z")
    prescribe!(incomplete, [1, 2], "y")
    found, left = (add_pattern!(incomplete, name, [0.0], [1.0]) for name in ("found", "left"))
    begin_constraints!(incomplete, 1:2, 0.5, found)
    end_constraints!(incomplete, 2:2, 1.5, left)
    @test_throws ProblemError begin_constraints!(incomplete, 2:2, 2.0, found)
end
