# SPDX-License-Identifier: BSD-3-Clause
# Particles as plain arrays, with a handle of the library through which files are written.

"""
    Particles(placement, body)

Creates particles that fill `body`, a [`Domain`](@ref), from the current nodes of a placement. These
nodes lie in the offset that [`add_offset!`](@ref) makes of the body. Each particle represents a
piece of matter of about d^2, or d^3 in space. Collective.

Where two nodes are closer than 0.5 times the mean of their d, as at creases and in thin places, one
of them is left out. Then pairs closer than 0.85 times that mean in space, or 0.9 times in the
plane, are pushed apart by at most 0.3 d. Of pairs that are still closer than 0.611 in space, or
0.651 in the plane, one is left out. All others keep their positions. The volumes add up to that of
the body. The bits do not depend on the number of ranks and threads. The particles are a copy: nodes
may move afterwards, and the placement may be closed.

Throws `:error_domain` if the body is invalid, if a node is not strictly inside the body, or if the
nodes do not fill it, and `:error_state` without nodes.

Fields for the particles of this rank, in the order of their ids:

- `points`: positions, `(dim, n)`.
- `volumes`: volumes, or areas in the plane.
- `spacing`: d of the nodes from which the particles were made.
- `ids`: ids of these nodes; some numbers may be missing.
- `tags`: tags of these nodes: the outermost ones have that of the offset, all others 0.

Fields over all ranks:

- `count`: number of particles.
- `left_out`: number of nodes left out because others are too close.
- `moved`: number of particles that were pushed away from the positions of their nodes.
- `closest`: the least distance of two particles over the mean of their d; infinity if no two are
  closer than that mean.

For example

    add_offset!(0.1, inset, body, -Inf, -0.42)
    placement = Placement(inset)
    set_spacing!(placement, 0.1076)
    run!(placement)
    particles = Particles(placement, body)
    add_output_field(particles, "mass", 7.8 .* particles.volumes)
    write_file(particles, "particles.vtu")
"""
mutable struct Particles
    handle::LibPNPBS.pnpbs_particles
    context::Context
    points::Matrix{Float64}
    volumes::Vector{Float64}
    spacing::Vector{Float64}
    ids::Vector{Int64}
    tags::Vector{Int32}
    count::Int
    left_out::Int
    moved::Int
    closest::Float64
end

function Particles(placement::Placement, body::Domain)
    context = placement.context
    handle = Ref{LibPNPBS.pnpbs_particles}(C_NULL)
    check(context, LibPNPBS.pnpbs_particles_create(live(placement), live(body), handle))
    particles = copy_of_particles(context, handle[])
    push!(context.children, particles)
    return particles
end

Base.isopen(particles::Particles) = particles.handle != C_NULL

function Base.close(particles::Particles)
    isopen(particles) || return nothing
    check(particles.context, LibPNPBS.pnpbs_particles_destroy(Ref(particles.handle)))
    particles.handle = C_NULL
    forget!(particles.context, particles)
    return nothing
end

Base.show(io::IO, particles::Particles) =
    print(io, "PNPBS.Particles(", length(particles.ids), " here, ", particles.count, " in all)")

function copy_of_particles(context, handle)
    dim, n, count = Ref{Int32}(0), Ref{Int64}(0), Ref{Int64}(0)
    left_out, moved, closest = Ref{Int64}(0), Ref{Int64}(0), Ref(0.0)
    check(context, LibPNPBS.pnpbs_particles_sizes(handle, dim, n, count))
    check(context, LibPNPBS.pnpbs_particles_figures(handle, left_out, moved, closest))
    points, volumes, spacing = zeros(dim[], n[]), zeros(n[]), zeros(n[])
    ids, tags = zeros(Int64, n[]), zeros(Int32, n[])
    check(context, LibPNPBS.pnpbs_particles_get(handle, n[], points, volumes, spacing, ids, tags))
    return Particles(handle, context, points, volumes, spacing, ids, tags, count[], left_out[],
                     moved[], closest[])
end

# ---------------------------------------------------------------- files -------------------------
write_file(particles::Particles, path::AbstractString) =
    write_particles(particles, [path], nothing)

write_files(particles::Particles, paths::AbstractVector{<:AbstractString};
            formats::Union{Nothing,AbstractVector} = nothing) =
    write_particles(particles, paths, formats)

function write_particles(particles, paths, formats)
    code = with_file_names(paths, formats) do n, c_paths, c_formats
        LibPNPBS.pnpbs_particles_write(live(particles), n, c_paths, c_formats)
    end
    return check(particles.context, code)
end

function add_output_field(particles::Particles, name::AbstractString,
                          values::AbstractArray{<:Real})
    check(particles.context,
          LibPNPBS.pnpbs_particles_add_output_field(live(particles), name, places_of(values),
                                                    components_of(values), dense(values)))
    return particles
end
