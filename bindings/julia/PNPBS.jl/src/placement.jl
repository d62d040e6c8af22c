# SPDX-License-Identifier: BSD-3-Clause

"""
    Placement(domain::Domain; options...)

Creates a placement of nodes in a domain, on the domain's context. Options are as in [`set!`](@ref);
the others are those of the context. Set a spacing ([`set_spacing!`](@ref)), then [`run!`](@ref).
Collective.

With Plots.jl and Julia 1.9 or later, `plot(placement)` draws this rank's nodes, of a placement in
the plane, and the edges between them: those of the triangles, with `edges = :adjacency` the pairs
of the adjacency lists, or with `edges = :none` none. Collective.
"""
mutable struct Placement
    handle::LibPNPBS.pnpbs_placement
    context::Context
    domain::Domain
    # These are kept alive because the library holds their addresses. The current nodes refer to the
    # spacing that they were placed with, so a replaced spacing is needed until the next run.
    spacing::Union{Callback,Nothing}
    spacings_before::Vector{Callback}
    monitor::Callback
end

function Placement(domain::Domain; options...)
    context = domain.context
    handle = Ref{LibPNPBS.pnpbs_placement}(C_NULL)
    check(context, LibPNPBS.pnpbs_placement_create(live(context), live(domain), handle))
    monitor = Callback(keep_going, context)
    placement = Placement(handle[], context, domain, nothing, Callback[], monitor)
    push!(context.children, placement)
    try
        return set!(set_monitor!(placement, nothing); options...)
    catch
        close(placement)
        rethrow()
    end
end

Base.isopen(placement::Placement) = placement.handle != C_NULL

function Base.close(placement::Placement)
    isopen(placement) || return nothing
    check(placement, LibPNPBS.pnpbs_placement_destroy(Ref(placement.handle)))
    placement.handle = C_NULL
    forget!(placement.context, placement)
    return nothing
end

function Base.ndims(placement::Placement)
    dim = Ref{Int32}(0)
    check(placement, LibPNPBS.pnpbs_placement_dimension(live(placement), dim))
    return Int(dim[])
end

"""
    sphere_radius(placement)

Returns the radius of the sphere that the nodes lie on; 0 if the domain is not on one. Local.
"""
function sphere_radius(placement::Placement)
    radius = Ref{Float64}(0)
    check(placement, LibPNPBS.pnpbs_placement_sphere_radius(live(placement), radius))
    return radius[]
end

function Base.show(io::IO, placement::Placement)
    what = isopen(placement) ? "$(node_count(placement)) nodes here" : "closed"
    print(io, "PNPBS.Placement(", what, ")")
end

check(placement::Placement, code) = check(placement.context, code)

function set!(placement::Placement; options...)
    for (key, value) in options
        check(placement, set_placement_option(live(placement), string(key), value))
    end
    return placement
end

set_placement_option(handle, key, value::Integer) =
    LibPNPBS.pnpbs_placement_set_int64(handle, key, value)
set_placement_option(handle, key, value::Real) =
    LibPNPBS.pnpbs_placement_set_double(handle, key, value)
set_placement_option(handle, key, value) =
    LibPNPBS.pnpbs_placement_set(handle, key, string(value))

# ---------------------------------------------------------------- spacing -----------------------
"""
    set_spacing!(placement, d::Real)
    set_spacing!(f, placement; per_point = false)
    set_spacing!(placement, values::AbstractArray; origin, step)
    set_spacing!(placement, d::AbstractVector)

Sets the node spacing d(x), the requested distance between neighbouring nodes near x. On a placement
that has nodes it replaces the spacing: the nodes are kept, and the next run starts from them.
Collective.

- A number: constant spacing.
- A function: `f(x)` gets points as the columns of a `(dim, n)` matrix and returns a vector of n
  values. It must always return the same value for the same point. It is called with different
  points on different ranks, so it must do nothing collective. An exception that it throws is
  rethrown by the call in progress. With `per_point` it is called for each point by itself, as `f(x,
  y)` or, in space, `f(x, y, z)`, and returns a number.
- A matrix, in space an array of three dimensions: values on a rectangular grid whose first point is
  `origin`, with distances `step`; the first index goes along x. Linear between grid points,
  constant beyond the grid's edge. On a sphere a matrix: longitude and latitude in degrees; columns
  all around are joined.
- A vector: values at the nodes of this rank, in the order of [`nodes`](@ref); linear on each
  triangle or tetrahedron of their triangulation.

For example

    set_spacing!(placement) do x
        0.01 .+ 0.05 .* hypot.(x[1, :], x[2, :])
    end
    set_spacing!(placement; per_point = true) do x, y
        0.01 + 0.05 * hypot(x, y)
    end
"""
function set_spacing!(placement::Placement, d::Real)
    check(placement, LibPNPBS.pnpbs_placement_set_spacing_constant(live(placement), d))
    return keep_spacing!(placement, nothing)
end

function set_spacing!(f, placement::Placement; per_point::Bool = false)
    callback = Callback(for_batches(f, "spacing", per_point), placement.context)
    GC.@preserve callback begin
        code = LibPNPBS.pnpbs_placement_set_spacing_callback(live(placement), spacing_pointer[],
                                                             user_pointer(callback))
    end
    check(placement, code)
    return keep_spacing!(placement, callback)
end

# Returns the dimension of the triangles or tetrahedra: 2 for triangles, also on a sphere.
extent_of_elements(placement) = sphere_radius(placement) > 0 ? 2 : ndims(placement)

function set_spacing!(placement::Placement, values::AbstractArray{<:Real}; origin, step)
    directions = extent_of_elements(placement)
    ndims(values) == directions || throw(DimensionMismatch(
        "values has size $(size(values)); an array of $directions dimensions was expected"))
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_grid(live(placement), Int64[size(values)...],
                                                    as_point(origin, directions, "origin"),
                                                    as_point(step, directions, "step"),
                                                    convert(Array{Float64}, values)))
    return keep_spacing!(placement, nothing)
end

function set_spacing!(placement::Placement, d::AbstractVector{<:Real})
    # The library checks the length, as it reports an error to all ranks.
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_at_nodes(live(placement), length(d),
                                                        convert(Vector{Float64}, d)))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_mesh!(placement, points, d, corners)

Sets the spacing to values `d` at the nodes of a background mesh, the columns of `points`. It is
linear on each element, and beyond the mesh equal to the value at the nearest point of the mesh. The
columns of `corners` are triangles, in space tetrahedra, by node numbers from 1. Collective; every
rank passes the same arrays, and holds a copy.
"""
function set_spacing_mesh!(placement::Placement, points::AbstractMatrix{<:Real},
                           d::AbstractVector{<:Real}, corners::AbstractMatrix{<:Integer})
    coordinates = as_points(points, ndims(placement), "points")
    require_length(d, size(points, 2), "d")
    require_columns(corners, extent_of_elements(placement) + 1, "corners")
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_mesh(live(placement), length(d), coordinates,
                                                    convert(Vector{Float64}, d), size(corners, 2),
                                                    Matrix{Int64}(corners) .- 1))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_points!(placement, points, d)

Sets the spacing to values `d` at scattered points, the columns of `points`. It equals the given
value at each point and elsewhere a weighted mean of the values of the 8 (in space 16) nearest points,
of which those behind others count less or not at all; on a sphere, with ways along it.
Collective; every rank passes the same arrays, and holds a copy.
"""
function set_spacing_points!(placement::Placement, points::AbstractMatrix{<:Real},
                             d::AbstractVector{<:Real})
    coordinates = as_points(points, ndims(placement), "points")
    require_length(d, size(points, 2), "d")
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_points(live(placement), length(d), coordinates,
                                                      convert(Vector{Float64}, d)))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_file!(placement, path; field = "")

Sets the spacing to values at points from a file: VTK's unstructured grid (.vtu), Gmsh's mesh with
values at nodes (.msh), or a table with columns x, y, (z) and others (.csv). Triangles and
quadrangles, in space tetrahedra, form a mesh as in [`set_spacing_mesh!`](@ref); without any, the
points are used as in [`set_spacing_points!`](@ref). In the plane z is ignored; on a sphere elements
are as in the plane. `field` is the name
of the values in the file; the default is the only ones, or those called "spacing". Collective;
every rank reads the file.
"""
function set_spacing_file!(placement::Placement, path::AbstractString; field::AbstractString = "")
    check(placement, LibPNPBS.pnpbs_placement_set_spacing_file(live(placement), path, field))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_from_shape!(placement; nodes_per_turn = 0, nodes_across = 0, nodes_per_edge = 0,
                            growth = 0, min_spacing = 0, max_spacing = 0)

Sets the spacing from the current shape of the domain: the minimum of what its curves and surfaces
require, each value growing with the distance from them. Zero arguments are not used. Collective.

- `nodes_per_turn`: by curvature, nodes on a full circle of the radius of curvature.
- `nodes_across`: by width, nodes across the diameter of the largest ball that touches the boundary
  there and meets nothing ahead.
- `nodes_per_edge`: by the input, nodes along its segments and the mean edge of its triangles.
- `growth`: of d per unit of distance; 0 is 0.15.
- `min_spacing`, `max_spacing`: bounds of d.
"""
function set_spacing_from_shape!(placement::Placement; nodes_per_turn::Real = 0,
                                 nodes_across::Real = 0, nodes_per_edge::Real = 0,
                                 growth::Real = 0, min_spacing::Real = 0, max_spacing::Real = 0)
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_from_shape(live(placement), nodes_per_turn,
                                                          nodes_across, nodes_per_edge, growth,
                                                          min_spacing, max_spacing))
    return keep_spacing!(placement, nothing)
end

function keep_spacing!(placement, callback)
    placement.spacing === nothing || push!(placement.spacings_before, placement.spacing)
    placement.spacing = callback
    return placement
end

"""
    set_monitor!(f, placement)
    set_monitor!(placement, nothing)

Calls `f(fraction, step, nodes, max_speed)` from time to time during a run. While the first nodes
are laid, or the growth of the spacing is limited, `fraction` is 0 and each rank calls it by its own
clock: do nothing collective then. When it returns `true`, the run ends early with valid nodes and
the outcome `:stopped`. Any other value continues. The second form removes the monitor. Local.
"""
function set_monitor!(f, placement::Placement)
    callback = Callback(f, placement.context)
    GC.@preserve callback begin
        code = LibPNPBS.pnpbs_placement_set_monitor(live(placement), monitor_pointer[],
                                                    user_pointer(callback))
    end
    check(placement, code)
    placement.monitor = callback
    return placement
end

# The library keeps a monitor, because Ctrl-C takes effect in it.
set_monitor!(placement::Placement, ::Nothing) = set_monitor!(keep_going, placement)

keep_going(fraction, step, nodes, max_speed) = false

"""
    add_spacing_hints!(placement, coordinates)

Adds points at which the spacing is sampled as well, the columns of `coordinates`, `dim` x n. A
function is sampled at some points of each cell of a tree, so a place with a small d that is much
smaller than the cells around it may be missed: give one point in each such place. The points are
used from the next [`run!`](@ref) or [`initialise!`](@ref) on, until another spacing is set. Points
outside a body in space are ignored. Collective; each rank may pass other points, including none.
"""
function add_spacing_hints!(placement::Placement, coordinates::AbstractMatrix{<:Real})
    points = as_points(coordinates, ndims(placement), "coordinates")
    check(placement,
          LibPNPBS.pnpbs_placement_add_spacing_hints(live(placement), size(points, 2), points))
    return placement
end

"""
    set_nodes!(placement, coordinates; ids = nothing)

Sets inner nodes to start from instead of the initial fill: the columns of `coordinates`, on any
ranks, with distinct global ids from 0 if `ids` are given. The library places the boundary nodes.
Clears the current nodes. Collective.
"""
function set_nodes!(placement::Placement, coordinates::AbstractMatrix{<:Real};
                    ids::Union{Nothing,AbstractVector{<:Integer}} = nothing)
    points = as_points(coordinates, ndims(placement), "coordinates")
    n = size(points, 2)
    wrong = ids !== nothing && length(ids) != n
    # If the number of ids is wrong on one rank, the library gets a number of -1. The other ranks,
    # which would wait otherwise, then get an error too.
    given = ids === nothing ? C_NULL : convert(Vector{Int64}, ids)
    code = LibPNPBS.pnpbs_placement_set_nodes(live(placement), wrong ? -1 : n, points, given)
    wrong && require_length(ids, n, "ids")
    check(placement, code)
    return placement
end

# ---------------------------------------------------------------- running -----------------------
# Makes a call that takes long. Ctrl-C ends it with an InterruptException, and the placement can be
# used afterwards.
function compute(placement::Placement, call, arguments...)
    handle = live(placement)
    return check(placement, interruptible(() -> call(handle, arguments...), placement.context))
end

"""
    estimate(placement) -> (nodes, bytes, seconds)

Estimates a run from scratch, from domain, spacing and options alone: the number of nodes on all
ranks, mostly within a few percent, the memory of each process for the run alone, and roughly the
time. No inner node is created, and the current nodes are unchanged. Collective.
"""
function estimate(placement::Placement)
    nodes, bytes, seconds = Ref{Int64}(0), Ref{Int64}(0), Ref(0.0)
    compute(placement, LibPNPBS.pnpbs_placement_estimate, nodes, bytes, seconds)
    return (nodes = nodes[], bytes = bytes[], seconds = seconds[])
end

"""
    initialise!(placement)

Checks domain and spacing and lays the nodes that the simulation starts from. [`run!`](@ref) and
[`step!`](@ref) do this if necessary. Collective.
"""
function initialise!(placement::Placement)
    compute(placement, LibPNPBS.pnpbs_placement_initialise)
    return placement
end

"""
    run!(placement) -> Symbol

Runs the whole placement. A later run, for example after another spacing, starts from the current
nodes. The outcome is `:ok`; `:not_converged` if the step limit was reached before the bubbles were
at rest, which is no failure; `:spacing_missed` if in one of the bands of [`edge_bands`](@ref) with
50 edges or more the mean differs from 1 by more than 0.1, whether or not the bubbles are at rest,
with a warning that names the band; `:not_conforming` if the elements do not fill the domain, with a
warning that says where; or `:stopped` by the monitor. In all cases the nodes are valid. Collective.

Ctrl-C ends it, like every call that computes, within a second or two with an `InterruptException`;
the nodes are then as if a monitor had stopped the run, which is what it returns on the other ranks.
"""
function run!(placement::Placement)
    outcome = compute(placement, LibPNPBS.pnpbs_placement_run)
    empty!(placement.spacings_before)
    return outcome
end

"""
    step!(placement, n = 1) -> Symbol

Advances the simulation by n steps. The outcome is as in [`run!`](@ref), `:ok` if the bubbles are at
rest. Collective.
"""
step!(placement::Placement, n::Integer = 1) =
    compute(placement, LibPNPBS.pnpbs_placement_step, n)

"""
    adjust_population!(placement) -> (inserted, deleted)

Performs one population adjustment: deletes nodes where they are too dense and inserts nodes where
they are too sparse. Collective.
"""
function adjust_population!(placement::Placement)
    inserted, deleted = Ref{Int64}(0), Ref{Int64}(0)
    compute(placement, LibPNPBS.pnpbs_placement_adjust_population, inserted, deleted)
    return (inserted = inserted[], deleted = deleted[])
end

"""
    rebalance!(placement)

Repartitions the work over the ranks. The nodes are unchanged; their owners change. A run does this
by itself where it pays. Collective.
"""
function rebalance!(placement::Placement)
    compute(placement, LibPNPBS.pnpbs_placement_rebalance)
    return placement
end
