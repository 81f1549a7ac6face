# SPDX-License-Identifier: BSD-3-Clause

@testset "law" begin
    law = bilinear()
    check(law)
    @test all(toughness(law, [0.0, 1.0]) .≈ ([50.0, 50.0], [280.0, 280.0]))
    @test haskey(parameters("trapezoidal"), "plateau")
    @test parameters("exponential")["normal_stiffness"].type == "real"
    @test first(law_kinds()[1]) == "piecewise-linear"
    @test bounds("trapezoidal")["plateau"] == Bounds(0.0, 1.0, false, true)
    @test allows(bounds("trapezoidal")["plateau"], 0.0) && !allows(bounds("griffith")["normal_stiffness"], 0.0)
    @test_throws InvalidArgument Law("no such kind")
    @test_throws InvalidArgument set!(law; plateau=0.5)
    @test_throws InvalidArgument set!(law; normal_stiffness=-1.0)

    # The same response by the library and by functions of the host.
    jump = [2e-5 4e-5 1e-4; 0.0 1e-5 0.0]
    adhesion, traction = respond(law, jump, 0.0)
    by_host, traction_by_host = respond(host_bilinear(), jump, 0.0)
    @test adhesion ≈ by_host
    @test traction ≈ traction_by_host
    @test size(traction) == (2, 3)

    table = Law("tabulated"; normal_stiffness=1e12, tangential_stiffness=1e12, normal_onset=50.0,
        tangential_onset=50.0, normal_toughness=280.0, tangential_toughness=280.0, softening=([0.0, 1.0], [1.0, 0.0]))
    @test first(respond(table, jump, 0.0)) ≈ adhesion
end
