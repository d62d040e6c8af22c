# SPDX-License-Identifier: BSD-3-Clause
# Tests of particles on one rank.

# Returns the least distance of two particles over the mean of their d, from all pairs.
function closest_of(particles)
    x, d = particles.points, particles.spacing
    return minimum(sqrt(sum(abs2, x[:, i] - x[:, j])) / ((d[i] + d[j]) / 2)
                   for i in eachindex(d) for j in 1:(i - 1))
end

function square_inset(context)
    body = square_domain(context)
    inset = add_offset!(0.1, Domain(context), body, -Inf, -0.42; tag = 7)
    placement = set_spacing!(Placement(inset; steps = 40), 0.1076)
    run!(placement)
    return placement, body
end

function cube_inset(context)
    body = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
    inset = add_offset!(0.2, Domain(context; dim = 3), body, -Inf, -0.46; tag = 7)
    placement = set_spacing!(Placement(inset; steps = 40), 0.2294)
    run!(placement)
    return placement, body
end

# Checks the particles of a body whose measure is 1.
function check_particles(placement, body)
    particles = Particles(placement, body)
    n = particles.count
    @test size(particles.points) == (ndims(body), n) && length(particles.ids) == n
    @test sum(particles.volumes) ≈ 1 rtol = 0 atol = 1e-12
    @test all(particles.volumes .> 0) && all(0 .< particles.points .< 1)
    @test n + particles.left_out == node_count(placement) && 0 <= particles.moved <= n
    @test particles.closest > 0.6 && particles.closest ≈ closest_of(particles)
    @test issorted(particles.ids) && Set(particles.tags) == Set([0, 7])
    @test occursin("$n here, $n in all", string(particles))
    return particles
end

@testset "particles" begin
    Context() do context
        for make in (square_inset, cube_inset)
            placement, body = make(context)
            particles = check_particles(placement, body)
            close(placement)
            close(particles)
            close(particles)
            @test !isopen(particles) && sum(particles.volumes) ≈ 1
            @test !(particles in context.children)
            @test fails(() -> write_file(particles, "x.csv"), :error_handle, "Particles", "closed")
            @test fails(() -> Particles(placement, body), :error_handle, "Placement")
        end
    end
end

@testset "particles of a context that is closed" begin
    context = Context()
    particles = Particles(square_inset(context)...)
    close(context)
    @test !isopen(particles)
end

@testset "bodies that have no particles" begin
    Context() do context
        placement, body = square_inset(context)
        wide = add_polyline!(Domain(context), [-1 2 2 -1; -1 -1 2 2])
        box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
        @test fails(() -> Particles(placement, wide), :error_domain, "fill")
        @test fails(() -> Particles(placement, placement.domain), :error_domain)
        @test fails(() -> Particles(placement, box), :error_argument, "body")
        @test fails(() -> Particles(Placement(body), body), :error_state, "no nodes")
        close(body)
        @test fails(() -> Particles(placement, body), :error_handle, "Domain", "closed")
    end
end

@testset "files of particles" begin
    Context() do context
        particles = Particles(square_inset(context)...)
        x, volumes, n = particles.points, particles.volumes, particles.count
        mktempdir() do folder
            a, b = joinpath(folder, "a.csv"), joinpath(folder, "b.txt")
            @test write_file(particles, a) === :ok
            @test length(readlines(a)) == n + 1
            @test add_output_field(particles, "mass", 2 .* volumes) === particles
            add_output_field(particles, "velocity", x)
            @test write_files(particles, [a, b]; formats = [nothing, "csv"]) === :ok
            @test read(a) == read(b)
            lines = readlines(a)
            @test endswith(lines[1], "spacing,volume,mass,velocity:0,velocity:1")
            @test [parse.(Float64, split(line, ",")) for line in lines[2:end]] ==
                  [[particles.ids[i]; x[:, i]; particles.tags[i]; particles.spacing[i]; volumes[i];
                    2 * volumes[i]; x[:, i]] for i in 1:n]
            @test fails(() -> add_output_field(particles, "mass", volumes), :error_argument, "mass")
            @test fails(() -> add_output_field(particles, "few", volumes[2:end]), :error_argument,
                        "n = $(n - 1)")
            @test fails(() -> write_file(particles, joinpath(folder, "a.ele")), :error_argument,
                        "ele")
            @test fails(() -> write_file(particles, "/none/x.csv"), :error_file, "/none")
            @test_throws DimensionMismatch write_files(particles, [a, b]; formats = ["csv"])
        end
    end
end
