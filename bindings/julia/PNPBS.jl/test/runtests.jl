# SPDX-License-Identifier: BSD-3-Clause
# The package in one process. What needs several ranks is in ranks.jl, which mpirun starts.
using PNPBS
using Test

include("support.jl")

@testset "PNPBS" begin
    include("test_package.jl")
    include("test_domains.jl")
    include("test_placements.jl")
    include("test_callbacks.jl")
    include("test_handles.jl")
    include("test_adapting.jl")
end
