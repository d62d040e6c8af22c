# SPDX-License-Identifier: BSD-3-Clause
# Tests of closing objects in any order, and of using closed objects.

@testset "closing" begin
    context = Context()
    placement = placed_square(context)
    domain = placement.domain
    @test isopen(context) && isopen(domain) && isopen(placement)
    close(domain)
    @test !isopen(domain) && isopen(placement)
    @test fails(() -> measure(domain), :error_handle, "Domain", "closed")
    @test fails(() -> Placement(domain), :error_handle, "Domain", "closed")
    @test run!(placement) in (:ok, :not_converged)
    close(placement)
    close(placement)
    @test fails(() -> run!(placement), :error_handle, "Placement", "closed")
    @test fails(() -> nodes(placement), :error_handle, "Placement", "closed")
    @test fails(() -> set!(placement; steps = 1), :error_handle, "Placement", "closed")
    @test isempty(context.children)
    close(context)
    close(context)
    @test fails(() -> Domain(context), :error_handle, "Context", "closed")
    @test fails(() -> set!(context; steps = 1), :error_handle, "Context", "closed")
end

@testset "a context closes what was made on it" begin
    context = Context()
    placement = placed_square(context)
    close(context)
    @test !isopen(placement) && !isopen(placement.domain)
    @test occursin("closed", string(context, placement, placement.domain))
end

@testset "do" begin
    kept = Ref{Any}()
    @test Context(context -> (kept[] = context; 42)) == 42
    @test !isopen(kept[])
    @test_throws ErrorException("on the way") Context() do context
        kept[] = context
        error("on the way")
    end
    @test !isopen(kept[])
end

@testset "stale handles of the library" begin
    Context() do context
        placement = placed_square(context)
        stale = placement.handle
        close(placement)
        code = PNPBS.LibPNPBS.pnpbs_placement_run(stale)
        @test PNPBS.status_name(code) === :error_handle
        @test !isempty(PNPBS.last_error(C_NULL))
    end
end

@testset "nothing is collected too early" begin
    Context() do context
        placements = [placed_square(context) for _ in 1:3]
        GC.gc()
        @test length(unique(statistic(p, "hash") for p in placements)) == 1
        foreach(run!, placements)
    end
end

# Stand-ins for MPI.jl from 0.20.19 on, which has the conversion, and for MPI.jl with MPICH, whose
# handles are Fortran handles.
module Converting
module API
const libmpi = "/none"
MPI_Comm_c2f(value) = Cint(value + 1)
end
end

module Earlier
const libmpi = "/none"
end

@testset "communicators" begin
    @test PNPBS.fortran_handle(Converting, 41) === Cint(42)
    @test PNPBS.fortran_handle(Converting, Cint(41)) === Cint(42)
    @test PNPBS.fortran_handle(Earlier, Cint(41)) === Cint(41)
    @test_throws ErrorException PNPBS.fortran_handle(Earlier, C_NULL)
    @test_throws ArgumentError Context("world")
    # MPI has not been started in this process, or the library was built without MPI.
    e = thrown(() -> Context(0))
    @test e isa PNPBSError && e.status in (:error_mpi, :error_unsupported) && !isempty(e.message)
end
