# SPDX-License-Identifier: BSD-3-Clause

"""
    Placement(domain::Domain; options...)

A placement of nodes in a domain, on the domain's context. Options are as in [`set!`](@ref); the
others are those of the context. Set a spacing ([`set_spacing!`](@ref)), then [`run!`](@ref).
Collective.

With Plots.jl and Julia 1.9 or later, `plot(placement)` draws this rank's nodes, of a placement in
the plane, and the edges between them: those of the triangles, or with `edges = :adjacency` the pairs
of the adjacency lists, or with `edges = :none` none. Collective.
"""
mutable struct Placement
    handle::LibPNPBS.pnpbs_placement
    context::Context
    domain::Domain
    # Kept alive: the library holds their addresses. The nodes there are remember the spacing that
    # they were placed with, so a spacing that is replaced is needed until the next run.
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

The node spacing d(x), the wanted distance between neighbouring nodes about x. On a placement that
has nodes the spacing is replaced: the nodes stay, and the next run starts from them. Collective.

- A number: the same everywhere.
- A function: `f(x)` gets points as the columns of a `(dim, n)` matrix and returns a vector of n
  values. It must always give the same value for the same point, and is asked for different points
  on different ranks, so nothing collective may happen inside. An exception that it throws comes
  out of the call in progress. With `per_point` it is called for each point by itself, as `f(x, y)`
  or, in space, `f(x, y, z)`, and returns a number.
- A matrix, in space an array of three dimensions: values on a rectangular grid whose first point is
  `origin`, with distances `step`; the first index goes along x. Linear between the grid's points,
  constant beyond its edge.
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

function set_spacing!(placement::Placement, values::AbstractArray{<:Real}; origin, step)
    dim = ndims(placement)
    ndims(values) == dim || throw(DimensionMismatch(
        "values has size $(size(values)); an array of $dim dimensions was expected"))
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_grid(live(placement), Int64[size(values)...],
                                                    as_point(origin, dim, "origin"),
                                                    as_point(step, dim, "step"),
                                                    convert(Array{Float64}, values)))
    return keep_spacing!(placement, nothing)
end

function set_spacing!(placement::Placement, d::AbstractVector{<:Real})
    # A wrong length is the library's to find: it tells all ranks.
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_at_nodes(live(placement), length(d),
                                                        convert(Vector{Float64}, d)))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_mesh!(placement, points, d, corners)

The spacing from values `d` at the nodes of a background mesh, the columns of `points`: linear on each
element, and beyond the mesh what it is at the mesh's nearest point. The columns of `corners` are
triangles, in space tetrahedra, by node numbers from 1 on. Collective; every rank gives the same
arrays, and holds a copy.
"""
function set_spacing_mesh!(placement::Placement, points::AbstractMatrix{<:Real},
                           d::AbstractVector{<:Real}, corners::AbstractMatrix{<:Integer})
    dim = ndims(placement)
    coordinates = as_points(points, dim, "points")
    require_length(d, size(points, 2), "d")
    require_columns(corners, dim + 1, "corners")
    check(placement,
          LibPNPBS.pnpbs_placement_set_spacing_mesh(live(placement), length(d), coordinates,
                                                    convert(Vector{Float64}, d), size(corners, 2),
                                                    Matrix{Int64}(corners) .- 1))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_points!(placement, points, d)

The spacing from values `d` at scattered points, the columns of `points`: at each of them its own
value, elsewhere a plane fitted to the 8 (in space 16) nearest ones by weighted least squares, never
below the least nor above the largest of their values. Collective; every rank gives the same arrays,
and holds a copy.
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

The spacing from a file with values at points: VTK's unstructured grid (.vtu), Gmsh's mesh with values
at nodes (.msh), or a table with columns x, y, (z) and others (.csv). Triangles and quadrangles, in
space tetrahedra are a mesh as [`set_spacing_mesh!`](@ref) takes it; without any the points are as for
[`set_spacing_points!`](@ref). In the plane z is left out. `field` is the name of the values in the
file; without it they are the only ones, or those called "spacing". Collective; every rank reads the
file.
"""
function set_spacing_file!(placement::Placement, path::AbstractString; field::AbstractString = "")
    check(placement, LibPNPBS.pnpbs_placement_set_spacing_file(live(placement), path, field))
    return keep_spacing!(placement, nothing)
end

"""
    set_spacing_from_shape!(placement; nodes_per_turn = 0, nodes_across = 0, nodes_per_edge = 0,
                            growth = 0, min_spacing = 0, max_spacing = 0)

The spacing from the shape of the domain as it is now: the least that its curves and surfaces ask
for, each growing with the distance from it. What is 0 does not count. Collective.

- `nodes_per_turn`: by curvature, nodes on a full circle of its radius.
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

Calls `f(fraction, step, nodes, max_speed)` now and then during a run; while the first nodes are laid,
or the growth of the spacing is limited, with `fraction` 0 and on each rank by its own clock: do
nothing collective then. When it returns `true`, the run ends early with valid nodes and the outcome
`:stopped`. Anything else goes on. The second form removes the monitor. Local.
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

# The library's monitor stays: it is where Ctrl-C acts.
set_monitor!(placement::Placement, ::Nothing) = set_monitor!(keep_going, placement)

keep_going(fraction, step, nodes, max_speed) = false

"""
    set_nodes!(placement, coordinates; ids = nothing)

Inner nodes to start from instead of the library's own: the columns of `coordinates`, on any ranks, with
distinct global ids from 0 on if `ids` are given. The boundary is laid by the library. Clears the
nodes there are. Collective.
"""
function set_nodes!(placement::Placement, coordinates::AbstractMatrix{<:Real};
                    ids::Union{Nothing,AbstractVector{<:Integer}} = nothing)
    points = as_points(coordinates, ndims(placement), "coordinates")
    n = size(points, 2)
    wrong = ids !== nothing && length(ids) != n
    # Where the ids are too many or too few on one rank, the library hears of it, and so do the
    # other ranks, which would wait otherwise.
    given = ids === nothing ? C_NULL : convert(Vector{Int64}, ids)
    code = LibPNPBS.pnpbs_placement_set_nodes(live(placement), wrong ? -1 : n, points, given)
    wrong && require_length(ids, n, "ids")
    check(placement, code)
    return placement
end

# ---------------------------------------------------------------- running -----------------------
# What takes long, and Ctrl-C ends with an InterruptException; the placement goes on to be usable.
function compute(placement::Placement, call, arguments...)
    handle = live(placement)
    return check(placement, interruptible(() -> call(handle, arguments...), placement.context))
end

"""
    estimate(placement) -> (nodes, bytes, seconds)

What a run from nothing would come to, from domain, spacing and options alone: how many nodes on all
ranks, mostly within a few percent, the memory of each process for the run alone, and roughly the
time. No inner node is made, and the nodes there are stay as they are. Collective.
"""
function estimate(placement::Placement)
    nodes, bytes, seconds = Ref{Int64}(0), Ref{Int64}(0), Ref(0.0)
    compute(placement, LibPNPBS.pnpbs_placement_estimate, nodes, bytes, seconds)
    return (nodes = nodes[], bytes = bytes[], seconds = seconds[])
end

"""
    initialise!(placement)

Checks domain and spacing and lays the nodes that the simulation starts from. [`run!`](@ref) and
[`step!`](@ref) do it where it is needed. Collective.
"""
function initialise!(placement::Placement)
    compute(placement, LibPNPBS.pnpbs_placement_initialise)
    return placement
end

"""
    run!(placement) -> Symbol

Places the nodes: the whole job. Run again, after another spacing perhaps, it starts from the nodes
there are. The outcome is `:ok`; `:not_converged` if the step limit came before the bubbles rested,
which is no failure; `:spacing_missed` if in one of the bands of [`edge_bands`](@ref) with 50 edges
or more the mean is off 1 by more than 0.1, whether the bubbles rest or not, with a warning that
names the band; `:not_conforming` if the elements do not fill the domain, with a warning that says
where; or `:stopped` by the monitor. In all cases the nodes are valid. Collective.

Ctrl-C ends it, as every call that computes, within a second or two with an `InterruptException`;
the nodes are then as if a monitor had stopped the run, which is what it returns on the other ranks.
"""
function run!(placement::Placement)
    outcome = compute(placement, LibPNPBS.pnpbs_placement_run)
    empty!(placement.spacings_before)
    return outcome
end

"""
    step!(placement, n = 1) -> Symbol

Advances the simulation by n steps. The outcome is as in [`run!`](@ref), `:ok` when the bubbles
rest. Collective.
"""
step!(placement::Placement, n::Integer = 1) =
    compute(placement, LibPNPBS.pnpbs_placement_step, n)

"""
    adjust_population!(placement) -> (inserted, deleted)

Deletes nodes where they are too dense and inserts where they are too sparse, once, now. Collective.
"""
function adjust_population!(placement::Placement)
    inserted, deleted = Ref{Int64}(0), Ref{Int64}(0)
    compute(placement, LibPNPBS.pnpbs_placement_adjust_population, inserted, deleted)
    return (inserted = inserted[], deleted = deleted[])
end

"""
    rebalance!(placement)

Deals the work out to the ranks anew. The nodes stay as they are; who owns them changes. A run does
so by itself where it pays. Collective.
"""
function rebalance!(placement::Placement)
    compute(placement, LibPNPBS.pnpbs_placement_rebalance)
    return placement
end
