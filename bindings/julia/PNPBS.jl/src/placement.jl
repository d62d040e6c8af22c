# SPDX-License-Identifier: BSD-3-Clause

"""
    Placement(domain::Domain; options...)

Creates a placement of nodes in a domain, on the context of the domain. Set a spacing with
[`set_spacing!`](@ref), then call [`run!`](@ref). `options` are those of [`set!`](@ref); other
options have the values of the context. The domain is read when the placement is initialised.
Collective.

With Plots.jl and Julia 1.9 or later, `plot(placement)` draws the nodes of this rank of a placement
in the plane, and edges between them: those of the triangles, the pairs of the adjacency lists with
`edges = :adjacency`, or none with `edges = :none`. Drawing is collective.
"""
mutable struct Placement
    handle::LibPNPBS.pnpbs_placement
    context::Context
    domain::Domain
    # The library holds the addresses of callbacks, so they must live. The current nodes refer to
    # the spacing with which they were placed, so a replaced one is needed until the next run.
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

Returns the radius of the sphere on which the nodes lie, or 0 if the domain is not on a sphere.
Local.
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

Sets the spacing d(x), the requested distance between neighbouring nodes near x, and returns the
placement. If the placement has nodes, it keeps them, and the next run starts from them. Arrays are
copied. Collective.

- A number is a constant spacing.
- A function `f(x)` receives points as the columns of a `(dim, n)` matrix and returns a vector of n
  values. It must be pure. Ranks call it with different points, so it must do nothing collective.
  The placement keeps it. An exception that it throws is thrown by the call in progress. With
  `per_point` it is called as `f(x, y)`, or in space `f(x, y, z)`, for each point and returns a
  number.
- A matrix, in space an array of three dimensions, has the values on a rectangular grid. `origin` is
  the first grid point, and `step` the distance of grid points in each direction; the first index
  runs along x. The spacing is linear between grid points and constant beyond the edge. On a sphere
  the grid is a matrix over longitude and latitude in degrees; columns all around the sphere are
  joined.
- A vector has the values at the nodes of this rank, in the order of [`nodes`](@ref). The spacing is
  linear on each triangle or tetrahedron of their triangulation.

Throws `:error_spacing` for values that are zero, negative or not finite; those of a function throw
in [`initialise!`](@ref) or [`run!`](@ref).

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

# Returns the dimension of elements of a background mesh: 2 for triangles, also on a sphere.
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
    # The library checks the length, because it reports errors on all ranks.
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_at_nodes(live(placement), length(d),
                                                        convert(Vector{Float64}, d)))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_mesh!(placement, points, d, corners)

Sets the spacing to values `d` at the nodes of a background mesh, the columns of `points`, and
returns the placement. It is linear on each element. Beyond the mesh it is equal to the value at the
nearest point of the mesh. The columns of `corners` are triangles, in space tetrahedra, by indices
of nodes from 1. Every rank passes the same arrays and stores a copy. Throws `:error_spacing` for
values that are zero, negative or not finite, and `:error_argument` for an index out of range, a
flat element, or arrays that differ between ranks. Collective.
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

Sets the spacing to values `d` at scattered points, the columns of `points`, and returns the
placement. It equals the given value at each point. Elsewhere it is a weighted mean of the values of
the 8 (in space 16) nearest points, in which points behind others count less or not at all. On a
sphere distances are along it. Every rank passes the same arrays and stores a copy. Throws
`:error_spacing` for values that are zero, negative or not finite, and for coincident points with
different values. Collective.
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

Sets the spacing to values at points from a file, and returns the placement. Every rank reads the
file. Collective.

- `path`: an unstructured grid of VTK (.vtu), a mesh of Gmsh with values at nodes (.msh), or a table
  with columns x, y, (z) and others (.csv). Triangles and quadrangles, in space tetrahedra, form a
  mesh as in [`set_spacing_mesh!`](@ref); on a sphere elements are those of the plane. Without
  elements the points are used as in [`set_spacing_points!`](@ref). In the plane z is ignored.
- `field`: the name of the values in the file. By default it is the only name, or "spacing".

Throws `:error_file` for a file that cannot be read, and for a missing field.
"""
function set_spacing_file!(placement::Placement, path::AbstractString; field::AbstractString = "")
    check(placement, LibPNPBS.pnpbs_placement_set_spacing_file(live(placement), path, field))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_from_shape!(placement; nodes_per_turn = 0, nodes_across = 0, nodes_per_edge = 0,
                            growth = 0, min_spacing = 0, max_spacing = 0)

Sets the spacing from the current shape of the domain, and returns the placement. It is the minimum
of the values that curves and surfaces require, each growing with the distance from them.
Collective.

- `nodes_per_turn`: by curvature: number of nodes on a full circle of the radius of curvature.
- `nodes_across`: by width: number of nodes across the diameter of the largest ball that touches the
  boundary at a point and meets no other part of it ahead.
- `nodes_per_edge`: by the input: number of nodes along a segment, or along the mean edge of a
  triangle.
- `growth`: growth of d per distance; 0 stands for 0.15.
- `min_spacing`, `max_spacing`: bounds of d; 0 stands for no bound.

The first three are not used if they are 0. Throws `:error_domain` if the domain is invalid, and
`:error_argument` for negative numbers.
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

# Keeps the callback of the current spacing alive, and those of earlier ones until the next run.
function keep_spacing!(placement, callback)
    placement.spacing === nothing || push!(placement.spacings_before, placement.spacing)
    placement.spacing = callback
    return placement
end

"""
    set_monitor!(f, placement)
    set_monitor!(placement, nothing)

Sets a function `f(fraction, step, nodes, max_speed)` that is called from time to time during a run,
and returns the placement. If it returns `true`, the run ends early with valid nodes and the outcome
`:stopped`. Any other value continues the run. `fraction` is the completed part of the call in
progress, from 0 to 1, and `max_speed` is in spacings per unit time. While the first nodes are laid,
or the growth of the spacing is limited, `fraction` is 0 and each rank calls the monitor by its own
clock, so it must do nothing collective then. The second form removes the monitor. Local.
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

# The library always has a monitor, because Ctrl-C takes effect there.
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

Sets inner nodes from which the simulation starts instead of the initial fill, and returns the
placement. They are the columns of `coordinates`, anywhere in the domain, different ones on each
rank. `ids` are distinct global ids from 0; without them the library chooses ids. The library places
the boundary nodes. Points outside the domain or too close to its boundary are dropped. In a periodic
domain each point stands for its image in the box. The current nodes are removed. Collective.
"""
function set_nodes!(placement::Placement, coordinates::AbstractMatrix{<:Real};
                    ids::Union{Nothing,AbstractVector{<:Integer}} = nothing)
    points = as_points(coordinates, ndims(placement), "coordinates")
    n = size(points, 2)
    wrong = ids !== nothing && length(ids) != n
    # If the number of ids is wrong on one rank, an invalid call informs the library and thus the
    # other ranks, which otherwise block.
    given = ids === nothing ? C_NULL : convert(Vector{Int64}, ids)
    code = LibPNPBS.pnpbs_placement_set_nodes(live(placement), wrong ? -1 : n, points, given)
    wrong && require_length(ids, n, "ids")
    check(placement, code)
    return placement
end

# ---------------------------------------------------------------- running -----------------------
# Runs a call that may take long. Ctrl-C ends it with an InterruptException, after which the
# placement remains usable.
function compute(placement::Placement, call, arguments...)
    handle = live(placement)
    return check(placement, interruptible(() -> call(handle, arguments...), placement.context))
end

"""
    estimate(placement) -> (nodes, bytes, seconds)

Estimates a run from scratch, from domain, spacing and options alone. Returns the number of nodes on
all ranks, mostly within a few percent, the memory in bytes of each process for the run alone, and
the approximate time in seconds. The current nodes do not change. Collective.
"""
function estimate(placement::Placement)
    nodes, bytes, seconds = Ref{Int64}(0), Ref{Int64}(0), Ref(0.0)
    compute(placement, LibPNPBS.pnpbs_placement_estimate, nodes, bytes, seconds)
    return (nodes = nodes[], bytes = bytes[], seconds = seconds[])
end

"""
    initialise!(placement)

Checks domain and spacing, lays the nodes from which the simulation starts, and returns the
placement. [`run!`](@ref) and [`step!`](@ref) do this if necessary. Throws `:error_domain` or
`:error_spacing` for an invalid domain or spacing, and `:error_memory` if the nodes that d requires
do not fit into memory. Collective.
"""
function initialise!(placement::Placement)
    compute(placement, LibPNPBS.pnpbs_placement_initialise)
    return placement
end

"""
    run!(placement) -> Symbol

Runs the whole placement: initialises if necessary, simulates until the bubbles are at rest or the
option `steps` is reached, and finishes. A later run, for example with another spacing, starts from
the current nodes. The nodes are valid for every outcome. Collective.

- `:ok`: the bubbles are at rest.
- `:not_converged`: the step limit was reached before the bubbles were at rest. This is not an
  error.
- `:spacing_missed`: in a band of [`edge_bands`](@ref) with 50 edges or more, the mean differs from
  1 by more than 0.1. A warning names the band.
- `:not_conforming`: the elements do not fill the domain. A warning names the place.
- `:stopped`: the monitor has stopped the run.

Ctrl-C ends a run, like every call that computes, within a second or two with an
`InterruptException`. The nodes are then those of a run that a monitor has stopped, and the other
ranks return `:stopped`.
"""
function run!(placement::Placement)
    outcome = compute(placement, LibPNPBS.pnpbs_placement_run)
    empty!(placement.spacings_before)
    return outcome
end

"""
    step!(placement, n = 1) -> Symbol

Advances the simulation by n steps. Initialises if necessary. Returns `:ok` if the bubbles are at
rest, `:not_converged` if they still move, or `:stopped`. Collective.
"""
step!(placement::Placement, n::Integer = 1) =
    compute(placement, LibPNPBS.pnpbs_placement_step, n)

"""
    adjust_population!(placement) -> (inserted, deleted)

Performs one population adjustment: deletes nodes where they are too dense and inserts nodes where
they are too sparse. Initialises if necessary. Returns the numbers of inserted and deleted nodes.
Collective.
"""
function adjust_population!(placement::Placement)
    inserted, deleted = Ref{Int64}(0), Ref{Int64}(0)
    compute(placement, LibPNPBS.pnpbs_placement_adjust_population, inserted, deleted)
    return (inserted = inserted[], deleted = deleted[])
end

"""
    rebalance!(placement)

Repartitions the work over the ranks and returns the placement. The nodes do not change, but their
owners and the ghosts do. A run repartitions by itself if the imbalance exceeds the option
`rebalance_above`. Collective.
"""
function rebalance!(placement::Placement)
    compute(placement, LibPNPBS.pnpbs_placement_rebalance)
    return placement
end
