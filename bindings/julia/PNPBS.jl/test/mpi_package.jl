# SPDX-License-Identifier: BSD-3-Clause
# Communicators of MPI.jl, on several ranks; run by mpirun. The MPI.jl is the stand-in beside this
# file, so this tests what PNPBS does with MPI.jl's names, and not MPI.jl.
push!(LOAD_PATH, joinpath(@__DIR__, "stand_in"))
using PNPBS
using Test

include("support.jl")

# Before MPI is loaded, no communicator is known.
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
    # An unknown option: the context is there, and is closed with MPI.
    @test fails(() -> Context(MPI.COMM_WORLD; stepz = 3), :error_key, "steps")
    @test length(PNPBS.contexts_of_mpi) == 1
    @test_throws ArgumentError Context("world")
end

# Values that their owners have arrive at the ghosts: numbers, integers, several for each node.
@testset "ghosts" begin
    context = Context(MPI.COMM_WORLD)
    placement = placed_square(context)
    own, others, pattern = nodes(placement), ghosts(placement), exchange_pattern(placement)
    n, g = node_count(placement), ghost_count(placement)
    @test g > 0
    update!(values; options...) = update_ghosts!(values, pattern, MPI.COMM_WORLD; options...)
    @test update!([own.ids; zeros(Int64, g)]) == [own.ids; others.ids]
    @test update!([own.spacing; zeros(g)]; tag = 7) == [own.spacing; others.spacing]
    @test update!([own.points zeros(2, g)]) == [own.points others.points]
    @test_throws ArgumentError update_ghosts!(zeros(n + g), pattern)
    close(context)
    alone = Context(context -> exchange_pattern(placed_square(context)))
    @test update_ghosts!([1.0, 2.0], alone) == [1.0, 2.0]
end

module Older
Waitall!(requests) = "waited for $(length(requests))"
end

@testset "MPI.jl before 0.20" begin
    @test PNPBS.wait_all(Older, [1, 2]) == "waited for 2"
end

# The kinds of handles that MPI.jl has with different MPIs.
@testset "handles" begin
    handle = MPI.OpenMPI.fortran_handle(MPI.COMM_WORLD.val)
    @test PNPBS.fortran_handle(MPI, MPI.COMM_WORLD.val) == handle
    @test PNPBS.fortran_handle(MPI, UInt(MPI.COMM_WORLD.val)) == handle
    @test PNPBS.fortran_handle(MPI, Cint(7)) == 7
end

# What Julia 1.9 and later load by themselves, where packages come from a project.
which(Context, Tuple{MPI.Comm}).module === PNPBS && include("../ext/PNPBSMPIExt.jl")

@testset "by the extension" begin
    @test which(Context, Tuple{MPI.Comm}).module !== PNPBS
    Context(context -> Domain(context), MPI.COMM_WORLD)
    @test fails(() -> Context(MPI.COMM_NULL), :error_mpi, "NULL")
end

# MPI.Finalize closes what is open, on all ranks in the same order.
const contexts = [one_run(), one_run()]
MPI.Finalize()

@testset "after MPI.Finalize" begin
    @test !any(isopen, contexts) && isempty(PNPBS.contexts_of_mpi)
    @test fails(() -> Context(MPI.COMM_WORLD), :error_mpi, "finali")
end
