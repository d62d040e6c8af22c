# SPDX-License-Identifier: BSD-3-Clause
# Runs the tests in one process. Arguments select files, as in `runtests.jl package domains`. Tests
# on several ranks are in ranks.jl, which mpirun starts.
using PNPBS
using Test

include("support.jl")

const FILES = ["package", "domains", "placements", "space", "callbacks", "interrupts", "handles",
               "adapting", "arrays", "sparse", "meshes", "grids", "voronoi", "particles",
               "shapes", "pictures"]

@testset "PNPBS" begin
    for name in (isempty(ARGS) ? FILES : ARGS)
        include("test_$name.jl")
    end
end
