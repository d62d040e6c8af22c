# SPDX-License-Identifier: BSD-3-Clause
# Tests of contexts on communicators of MPI.jl, on several ranks. mpirun starts this program. It
# uses the stand-in for MPI.jl next to this file, so it tests the calls of PNPBS and not MPI.jl.
push!(LOAD_PATH, joinpath(@__DIR__, "stand_in"))
using PNPBS
using Test

include("support.jl")

# Before MPI is loaded, no communicator is accepted.
@test_throws ArgumentError Context([1, 2])

import MPI

@test fails(() -> Context(MPI.COMM_WORLD), :error_mpi, "initiali")
MPI.Init()

function one_run()
    context = Context(MPI.COMM_WORLD; steps = 30)
    @test occursin("over ranks", string(context))
    placement = Placement(square_domain(context))
    set_spacing!(placement, 0.06)
    run!(placement)
    @test node_count(placement) < statistic(placement, "nodes")
    return context
end

@testset "communicators of MPI.jl" begin
    context = one_run()
    close(context)
    @test fails(() -> Context(MPI.COMM_NULL), :error_mpi, "NULL")
    # An unknown option throws after the context is created, which is then closed with MPI.
    @test fails(() -> Context(MPI.COMM_WORLD; stepz = 3), :error_key, "steps")
    @test length(PNPBS.contexts_of_mpi) == 1
    @test_throws ArgumentError Context("world")
end

# The kinds of handles that MPI.jl has with different MPI libraries.
@testset "handles" begin
    handle = MPI.OpenMPI.fortran_handle(MPI.COMM_WORLD.val)
    @test PNPBS.fortran_handle(MPI, MPI.COMM_WORLD.val) == handle
    @test PNPBS.fortran_handle(MPI, UInt(MPI.COMM_WORLD.val)) == handle
    @test PNPBS.fortran_handle(MPI, Cint(7)) == 7
end

# Julia 1.9 and later load the extension automatically if the packages come from a project.
which(Context, Tuple{MPI.Comm}).module === PNPBS && include("../ext/PNPBSMPIExt.jl")

@testset "by the extension" begin
    @test which(Context, Tuple{MPI.Comm}).module !== PNPBS
    Context(context -> Domain(context), MPI.COMM_WORLD)
    @test fails(() -> Context(MPI.COMM_NULL), :error_mpi, "NULL")
end

# MPI.Finalize closes open contexts in the same order on all ranks.
const contexts = [one_run(), one_run()]
MPI.Finalize()

@testset "after MPI.Finalize" begin
    @test !any(isopen, contexts) && isempty(PNPBS.contexts_of_mpi)
    @test fails(() -> Context(MPI.COMM_WORLD), :error_mpi, "finali")
end
