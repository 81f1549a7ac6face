# SPDX-License-Identifier: BSD-3-Clause
# Contracts of the package; DELAM_LIBRARY names the library.
using Delam
using Test

include("scenes.jl")

@testset "Delam" begin
    include("test_mesh.jl")
    include("test_law.jl")
    include("test_problem.jl")
    include("test_solver.jl")
    include("test_callbacks.jl")
end
