# SPDX-License-Identifier: BSD-3-Clause
# Tests of Julia functions as callbacks, and of the exceptions that they throw.

struct Unlucky <: Exception
    point::Vector{Float64}
end

@testset "spacing functions" begin
    Context() do context
        placement = Placement(square_domain(context); steps = 20)
        shapes = Set()
        set_spacing!(placement) do x
            push!(shapes, (typeof(x), size(x, 1)))
            fill(0.1, size(x, 2))
        end
        GC.gc()
        @test run!(placement) in (:ok, :not_converged)
        @test shapes == Set([(Matrix{Float64}, 2)])
        constant = Placement(placement.domain; steps = 20)
        set_spacing!(constant, 0.1)
        run!(constant)
        @test statistic(constant, "hash") == statistic(placement, "hash")
        # A function may change its argument, which is a copy.
        set_spacing!(x -> (x .= 7; fill(0.1, size(x, 2))), constant)
        run!(set_nodes!(constant, zeros(2, 0)))
        @test node_count(constant) > 0
    end
end

# Functions of one point result in the same nodes as functions of batches.
@testset "functions of one point" begin
    Context() do context
        hash(set!) = (placement = Placement(square_domain(context); steps = 10); set!(placement);
                      run!(placement); statistic(placement, "hash"))
        @test hash(placement -> set_spacing!((x, y) -> 0.1 + 0.05x * y, placement; per_point = true)) ==
              hash(placement -> set_spacing!(x -> 0.1 .+ 0.05 .* x[1, :] .* x[2, :], placement))

        curve(t) = (cos(t), 0.5 * sin(t))
        ellipse = add_curve!(curve, Domain(context), 0, 2pi; per_point = true)
        @test measure(ellipse) == measure(add_curve!(t -> [cos.(t) 0.5 .* sin.(t)]', Domain(context),
                                                     0, 2pi))

        ball(x, y, z) = x^2 + (y - 0.1)^2 + (z + 0.3)^2 - 1
        balls(x) = [ball(x[:, k]...) for k in axes(x, 2)]
        body(f; options...) = add_level_set!(f, Domain(context; dim = 3), (-2, -2, -2), (2, 2, 2),
                                             0.5; options...)
        @test bounds(body(ball; per_point = true)) == bounds(body(balls))
        placement = Placement(body(balls))
        seen = Set()
        set_spacing!((x...) -> (push!(seen, typeof(x)); 0.5), placement; per_point = true)
        initialise!(placement)
        @test seen == Set([NTuple{3,Float64}])

        # Functions that return no number or no point, or take other arguments.
        square = Placement(square_domain(context))
        set_spacing!((x, y) -> [0.1], square; per_point = true)
        wrong = thrown(() -> run!(square))
        @test wrong isa ArgumentError && occursin("spacing function returned [0.1]", wrong.msg)
        set_spacing!(x -> 0.1, square; per_point = true)
        @test_throws MethodError run!(square)
        @test_throws DimensionMismatch add_curve!(t -> 1.0, Domain(context), 0, 1; per_point = true)
        @test_throws ArgumentError body((x...) -> "out"; per_point = true)
    end
end

@testset "exceptions come out as they are" begin
    Context() do context
        placement = Placement(square_domain(context); steps = 20)
        set_spacing!(x -> throw(Unlucky(x[:, 1])), placement)
        e = thrown(() -> run!(placement))
        @test e isa Unlucky && length(e.point) == 2
        # No pending exception remains: the next call and the next run succeed.
        @test node_count(placement) == 0
        set_spacing!(x -> fill(0.1, size(x, 2)), placement)
        @test run!(placement) in (:ok, :not_converged)

        # An exception in a later run does not change the nodes.
        hash = statistic(placement, "hash")
        set_spacing!(x -> error("no more"), placement)
        @test_throws ErrorException("no more") run!(placement)
        @test statistic(placement, "hash") == hash

        # The size of a result is checked before the library receives it.
        set_spacing!(x -> [0.1], placement)
        @test_throws DimensionMismatch run!(placement)
        set_spacing!(x -> fill(0.1, 1, size(x, 2)), placement)
        @test_throws DimensionMismatch run!(placement)
        set_spacing!(x -> 0.1, placement)
        @test_throws ArgumentError run!(placement)
        # The library checks the values.
        set_spacing!(x -> fill(NaN, size(x, 2)), placement)
        @test fails(() -> run!(placement), :error_spacing, "nan")
    end
end

@testset "monitors" begin
    Context() do context
        placement = Placement(square_domain(context); steps = 100)
        set_spacing!(placement, 0.05)
        seen = []
        set_monitor!((arguments...) -> (push!(seen, arguments); nothing), placement)
        @test run!(placement) in (:ok, :not_converged)
        @test !isempty(seen) && seen[1] isa Tuple{Float64,Int64,Int64,Float64}
        @test issorted(first.(seen)) && all(0 .<= first.(seen) .<= 1)

        set_nodes!(placement, zeros(2, 0))
        set_monitor!((fraction, step, n, speed) -> fraction > 0.3, placement)
        @test run!(placement) === :stopped
        @test node_count(placement) > 0

        set_monitor!((_...) -> error("in the monitor"), placement)
        @test_throws ErrorException("in the monitor") run!(placement)
        set_monitor!(placement, nothing)
        @test run!(placement) in (:ok, :not_converged)
    end
end

@testset "curves" begin
    Context() do context
        domain = Domain(context)
        @test_throws ErrorException("no curve") add_curve!(t -> error("no curve"), domain, 0, 1)
        @test_throws DimensionMismatch add_curve!(t -> zeros(length(t), 2), domain, 0, 1)
        # This curve fails later, when a placement is initialised.
        healthy = Ref(true)
        add_curve!(domain, 0, 2pi) do t
            healthy[] || error("worn out")
            [cos.(t) sin.(t)]'
        end
        placement = Placement(domain; steps = 10)
        set_spacing!(placement, 0.2)
        healthy[] = false
        @test_throws ErrorException("worn out") run!(placement)
        healthy[] = true
        # The function stays alive after the domain is closed and collected.
        close(domain)
        GC.gc()
        @test run!(placement) in (:ok, :not_converged)
    end
end

@testset "inside a callback only queries work" begin
    Context() do context
        placement = Placement(square_domain(context); steps = 100)
        set_spacing!(placement, 0.2)
        for (forbidden, what) in ((() -> run!(placement), "run"), (() -> close(context), "close"),
                                  (() -> set_spacing!(placement, 1), "set"))
            inside = Any[nothing]
            set_monitor!((_...) -> (inside[1] = thrown(forbidden); true), placement)
            @test run!(placement) === :stopped
            @test inside[1] isa PNPBSError && inside[1].status === :error_state
        end
        @test isopen(context) && isopen(placement)
        counts = Int[]
        set_monitor!((_...) -> (push!(counts, node_count(placement)); false), placement)
        run!(placement)
        @test !isempty(counts)
    end
end
