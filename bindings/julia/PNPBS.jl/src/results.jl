# SPDX-License-Identifier: BSD-3-Clause
# Results of a placement, which are copied into arrays. Local indices count the nodes of this rank
# from 1, followed by its ghosts. Global ids count from 0 and do not depend on the number of ranks.

# Returns an array for n results, which is the given one if possible. Julia can change the length of
# a vector, but not the size of a matrix.
fitted!(values::Vector, n) = resize!(values, n)
fitted!(values::Matrix{T}, rows, n) where {T} =
    size(values) == (rows, n) ? values : zeros(T, rows, n)

no_nodes() = (points = zeros(0, 0), ids = Int64[], tags = Int32[], spacing = Float64[])
no_rows(T = Int64) = CompressedRows(Int64[1], T[])

"""
    node_count(placement) -> Int

Returns the number of nodes of this rank. Local.
"""
function node_count(placement::Placement)
    n = Ref{Int64}(0)
    check(placement, LibPNPBS.pnpbs_placement_count(live(placement), n))
    return Int(n[])
end

"""
    nodes(placement) -> (points, ids, tags, spacing)
    nodes!(placement, placed) -> placed

Returns a copy of the nodes of this rank, in their local order. `points` is `(dim, n)`. `ids` are
global. `tags` are 0 for inner nodes and otherwise that of the curve, surface or fixed node.
`spacing` is d at the nodes. Local.

`nodes!` reuses the arrays of an earlier result. Vectors are resized. A matrix of another size is
replaced, so use the returned value. After an exception the content of the arrays is undefined.

    placed = nodes!(placement, placed)
"""
nodes, nodes!

nodes(placement::Placement) = nodes!(placement, no_nodes())

function nodes!(placement::Placement, placed::NamedTuple)
    n = node_count(placement)
    points, ids = fitted!(placed.points, ndims(placement), n), fitted!(placed.ids, n)
    tags, spacing = fitted!(placed.tags, n), fitted!(placed.spacing, n)
    check(placement, LibPNPBS.pnpbs_placement_get_nodes(live(placement), n, points, ids, tags,
                                                        spacing))
    return (points = points, ids = ids, tags = tags, spacing = spacing)
end

"""
    ghost_count(placement) -> Int

Returns the number of ghosts: nodes of other ranks close to those of this rank. Collective.
"""
function ghost_count(placement::Placement)
    n = Ref{Int64}(0)
    check(placement, LibPNPBS.pnpbs_placement_ghost_count(live(placement), n))
    return Int(n[])
end

"""
    ghosts(placement) -> (points, ids, tags, spacing, owners)
    ghosts!(placement, others) -> others

Returns a copy of the ghosts in the order of their ids. `owners` are the ranks that own them. In
lists, stars, triangles and tetrahedra, ghost g has the local index `node_count(placement) + g`.
`ghosts!` reuses the arrays of an earlier result, as [`nodes!`](@ref) does. Collective.
"""
ghosts, ghosts!

ghosts(placement::Placement) = ghosts!(placement, (; no_nodes()..., owners = Int32[]))

function ghosts!(placement::Placement, others::NamedTuple)
    n = ghost_count(placement)
    points, ids = fitted!(others.points, ndims(placement), n), fitted!(others.ids, n)
    tags, spacing = fitted!(others.tags, n), fitted!(others.spacing, n)
    owners = fitted!(others.owners, n)
    check(placement, LibPNPBS.pnpbs_placement_get_ghosts(live(placement), n, points, ids, tags,
                                                         spacing, owners))
    return (points = points, ids = ids, tags = tags, spacing = spacing, owners = owners)
end

"""
    exchange_pattern(placement) -> (ranks, send, receive)

Returns the halo exchange pattern: send the values at the nodes `send[k]` to `ranks[k]`, and store
the values received from it at `receive[k]`, in the same order. `send` and `receive` are
[`CompressedRows`](@ref) of local indices; ranks count from 0, as in MPI. [`update_ghosts!`](@ref)
does this for numbers. The pattern is valid until nodes move. Collective.
"""
function exchange_pattern(placement::Placement)
    neighbours, sends, receives = Ref{Int32}(0), Ref{Int64}(0), Ref{Int64}(0)
    check(placement, LibPNPBS.pnpbs_placement_exchange_sizes(live(placement), neighbours, sends,
                                                             receives))
    ranks = zeros(Int32, neighbours[])
    send_offsets, send_nodes = zeros(Int64, neighbours[] + 1), zeros(Int64, sends[])
    receive_offsets, receive_nodes = zeros(Int64, neighbours[] + 1), zeros(Int64, receives[])
    check(placement, LibPNPBS.pnpbs_placement_get_exchange(live(placement), neighbours[], sends[],
                                                           receives[], ranks, send_offsets,
                                                           send_nodes, receive_offsets,
                                                           receive_nodes))
    return (ranks = ranks, send = rows_of_indices(send_offsets, send_nodes),
            receive = rows_of_indices(receive_offsets, receive_nodes))
end

"""
    numbering(placement) -> (first, count, ghosts)

Returns numbers that are contiguous per rank and start from 0 over all ranks, as PETSc and hypre
require. Local node i has the number `first + i - 1`, and ghost g has `ghosts[g]`. Unlike ids they
depend on the partition. Collective.
"""
function numbering(placement::Placement)
    first, count = Ref{Int64}(0), Ref{Int64}(0)
    numbers = zeros(Int64, ghost_count(placement))
    check(placement, LibPNPBS.pnpbs_placement_get_numbering(live(placement), length(numbers), first,
                                                            count, numbers))
    return (first = first[], count = count[], ghosts = numbers)
end

"""
    adjacency(placement) -> CompressedRows{Int64}
    adjacency!(placement, lists) -> lists

Returns the adjacency lists: row i has the local indices of all nodes within `adjacency_radius`
times the mean spacing of the pair, in the order of global ids. Pairs separated by a boundary are
not neighbours. `adjacency!` reuses earlier lists. Collective.
"""
adjacency, adjacency!

adjacency(placement::Placement) = adjacency!(placement, no_rows())

function adjacency!(placement::Placement, lists::CompressedRows{Int64})
    entries = Ref{Int64}(0)
    check(placement, LibPNPBS.pnpbs_placement_adjacency_size(live(placement), entries))
    offsets = fitted!(lists.offsets, node_count(placement) + 1)
    neighbours = fitted!(lists.entries, entries[])
    check(placement, LibPNPBS.pnpbs_placement_get_adjacency(live(placement), entries[], offsets,
                                                            neighbours))
    return rows_of_indices(offsets, neighbours)
end

"""
    stars(placement) -> (neighbours, triangle)
    stars!(placement, around) -> around

Returns the star of each node in the constrained Delaunay triangulation of the domain.
`neighbours[i]` has the local indices of the neighbours of node i, counter-clockwise.
`triangle[i][k]` is `true` if the node, its k-th neighbour and the next one around form a triangle
of the domain, and `false` if a gap outside the domain lies between them. In space the neighbours
are all nodes that share a tetrahedron with node i, in no particular order, and `triangle[i][k]` is
`false`. Both are [`CompressedRows`](@ref), with the same offsets. `stars!` reuses the arrays of an
earlier result. Collective.
"""
stars, stars!

stars(placement::Placement) =
    stars!(placement, (neighbours = no_rows(), triangle = no_rows(Bool)))

function stars!(placement::Placement, around::NamedTuple)
    entries = Ref{Int64}(0)
    check(placement, LibPNPBS.pnpbs_placement_star_size(live(placement), entries))
    offsets = fitted!(around.neighbours.offsets, node_count(placement) + 1)
    neighbours = fitted!(around.neighbours.entries, entries[])
    triangle = fitted!(around.triangle.entries, entries[])
    check(placement, LibPNPBS.pnpbs_placement_get_stars(live(placement), entries[], offsets,
                                                        neighbours, reinterpret(Int8, triangle)))
    rows = rows_of_indices(offsets, neighbours)
    return (neighbours = rows, triangle = CompressedRows(rows.offsets, triangle))
end

"""
    triangles(placement) -> Matrix{Int64}
    triangles!(placement, corners) -> corners

Returns the triangles of a placement in the plane or on a sphere, `(3, n)` local indices, each once,
counter-clockwise, on a sphere as seen from outside. A triangle belongs to the rank that owns its
node with the lowest id; its other corners may be ghosts. `triangles!` fills the matrix of an
earlier result if it has the required size, and otherwise returns a new one. Collective.
"""
triangles, triangles!

triangles(placement::Placement) = triangles!(placement, zeros(Int64, 3, 0))

triangles!(placement::Placement, corners::Matrix{Int64}) =
    elements!(placement, corners, LibPNPBS.pnpbs_placement_get_triangles, 3)

"""
    tetrahedra(placement) -> Matrix{Int64}
    tetrahedra!(placement, corners) -> corners

Returns the tetrahedra of a placement in space, `(4, n)` local indices, each once. Seen from the
fourth corner, the first three are counter-clockwise. A tetrahedron belongs to the rank that owns
its node with the lowest id; its other corners may be ghosts. `tetrahedra!` fills the matrix of an
earlier result if it has the required size, and otherwise returns a new one. Collective.
"""
tetrahedra, tetrahedra!

tetrahedra(placement::Placement) = tetrahedra!(placement, zeros(Int64, 4, 0))

tetrahedra!(placement::Placement, corners::Matrix{Int64}) =
    elements!(placement, corners, LibPNPBS.pnpbs_placement_get_tetrahedra, 4)

function elements!(placement, corners, get, rows)
    count = Ref{Int64}(0)
    check(placement, get(live(placement), 0, count, C_NULL))
    fitted = fitted!(corners, rows, count[])
    check(placement, get(live(placement), count[], count, fitted))
    return fitted .+= 1
end

"""
    edges(placement) -> (ends, numbers, midpoints, straight)

Returns the edges of the elements of this rank, and of its facets, with a mid node each, for elements
of second order: `ends` are local indices, `(2, n)`, `numbers` count from 0 over all ranks, and
`midpoints` are the positions of the mid nodes, `(dim, n)`. Mid nodes on curves and surfaces of the
domain lie on these, except for `straight` edges of all ranks, where an element would fold. Numbers
and mid nodes are the same for any number of ranks, several of which may have an edge. Collective.
"""
function edges(placement::Placement)
    count, straight = Ref{Int64}(0), Ref{Int64}(0)
    get(n, arrays...) = check(placement, LibPNPBS.pnpbs_placement_get_edges(live(placement), n,
                                                                            count, straight,
                                                                            arrays...))
    get(0, C_NULL, C_NULL, C_NULL)
    n = count[]
    ends, numbers = zeros(Int64, 2, n), zeros(Int64, n)
    midpoints = zeros(ndims(placement), n)
    get(n, ends, numbers, midpoints)
    return (ends = ends .+= 1, numbers = numbers, midpoints = midpoints,
            straight = Int(straight[]))
end

"""
    find_edges(placement, cells) -> Matrix{Int64}

Returns which of the [`edges`](@ref) elements or facets have, such as those of [`triangles`](@ref)
and [`tetrahedra`](@ref): in a triangle with the corners 1, 2, 3 those between 1 and 2, 2 and 3, 1
and 3, and in a tetrahedron also those between 1 and 4, 2 and 4, 3 and 4. An index is 0 if this rank
does not have the edge. Collective.
"""
function find_edges(placement::Placement, cells::AbstractMatrix{<:Integer})
    corners, n = size(cells)
    found = zeros(Int64, corners * (corners - 1) ÷ 2, n)
    check(placement, LibPNPBS.pnpbs_placement_find_edges(live(placement), n, corners,
                                                         Matrix{Int64}(cells .- 1), found))
    return found .+= 1
end

"""
    element_tags(placement) -> Vector{Int32}

Returns the tag of each element, which is that of its region ([`add_region!`](@ref)), or 0 if the
region has none. The order is that of [`triangles`](@ref), in space that of [`tetrahedra`](@ref).
Throws `:error_argument` on surfaces alone. Collective.
"""
function element_tags(placement::Placement)
    count = Ref{Int64}(0)
    get(n, tags) = check(placement, LibPNPBS.pnpbs_placement_get_element_tags(live(placement), n,
                                                                              count, tags))
    get(0, C_NULL)
    tags = zeros(Int32, count[])
    get(count[], tags)
    return tags
end

"""
    set_cracks!(placement, tags) -> placement

Sets which inner curves, in space inner surfaces, are cracks: those with these tags. Then
[`cracked_elements`](@ref) and files of elements in .msh, .msh2, .vtu and .vtkhdf have elements that
share no node across a crack; other formats of elements are an error, and all other results are
unchanged. The elements around a node fall into sectors that cracks separate. One of them keeps the
node, along a crack that on the left of a curve or in front of a surface, and each other one gets a
copy of it. At the tip of a crack there is no copy. Local, with the same tags on all ranks. Throws
`:error_argument` for the tag 0.
"""
function set_cracks!(placement::Placement, tags)
    given = Int32[tag for tag in tags]
    check(placement, LibPNPBS.pnpbs_placement_set_cracks(live(placement), length(given), given))
    return placement
end

"""
    crack_nodes(placement) -> (nodes, numbers, all)

Returns the pairs of nodes on cracks ([`set_cracks!`](@ref)): the local indices of the originals, of
copies of this rank's nodes, and then of copies of ghosts that its elements refer to. Copy `k` of
this list has the local index `k` behind all nodes and ghosts, and position, tag and spacing of its
original. `numbers` count from 0 over all ranks and do not depend on them; `all` is the number of
copies of all ranks. Throws `:error_argument` if no inner curve or surface has one of the tags, and
on surfaces alone. Collective.
"""
function crack_nodes(placement::Placement)
    count, all = Ref{Int64}(0), Ref{Int64}(0)
    get(n, arrays...) = check(placement,
                              LibPNPBS.pnpbs_placement_get_crack_nodes(live(placement), n, count,
                                                                       all, arrays...))
    get(0, C_NULL, C_NULL)
    nodes, numbers = zeros(Int64, count[]), zeros(Int64, count[])
    get(count[], nodes, numbers)
    return (nodes = nodes .+= 1, numbers = numbers, all = Int(all[]))
end

"""
    cracked_elements(placement) -> Matrix{Int64}

Returns the elements with doubled nodes along cracks ([`set_cracks!`](@ref)): triangles in the
plane, `(3, n)` local indices, in the order of [`triangles`](@ref), or tetrahedra in space, in that
of [`tetrahedra`](@ref), which is also that of [`element_tags`](@ref). Indices behind all nodes and
ghosts are those of [`crack_nodes`](@ref). Collective.
"""
function cracked_elements(placement::Placement)
    count = Ref{Int64}(0)
    get(n, elements) = check(placement,
                             LibPNPBS.pnpbs_placement_get_cracked_elements(live(placement), n,
                                                                           count, elements))
    get(0, C_NULL)
    in_space = ndims(placement) == 3 && sphere_radius(placement) == 0
    elements = zeros(Int64, in_space ? 4 : 3, count[])
    get(count[], elements)
    return elements .+= 1
end

"""
    crack_facets(placement) -> (front, back, tags, covered)

Returns both sides of the facets of cracks ([`set_cracks!`](@ref)), edges in the plane, `(2, n)`
local indices, and triangles in space, `(3, n)`, with their tags. Front is on the left of a curve
from the first to the second node, or in front of a surface, from where the corners are
counter-clockwise. The nodes of the sides coincide in pairs and are different except at tips.
`covered` is the area of all facets over that of the surfaces, 1 in the plane. Where d is too coarse
for elements to follow a surface, facets are missing, and elements connect its two sides there.
Collective.
"""
function crack_facets(placement::Placement)
    count, covered = Ref{Int64}(0), Ref(0.0)
    get(n, arrays...) = check(placement,
                              LibPNPBS.pnpbs_placement_get_crack_facets(live(placement), n, count,
                                                                        covered, arrays...))
    get(0, C_NULL, C_NULL, C_NULL)
    in_space = ndims(placement) == 3 && sphere_radius(placement) == 0
    front = zeros(Int64, in_space ? 3 : 2, count[])
    back, tags = similar(front), zeros(Int32, count[])
    get(count[], front, back, tags)
    return (front = front .+= 1, back = back .+= 1, tags = tags, covered = covered[])
end

"""
    boundary_edges(placement) -> (edges, tags)

Returns the edges between consecutive nodes on boundary and inner curves of a placement in the plane
or on a sphere: `(2, n)` local indices, and the tags of the curves. An edge belongs to the rank that
owns its first node; the other one may be a ghost. Local.
"""
function boundary_edges(placement::Placement)
    edges, tags = facets(placement, LibPNPBS.pnpbs_placement_get_boundary_edges, 2)
    return (edges = edges, tags = tags)
end

"""
    normals(placement)

Returns the surface normals at the nodes of this rank, `(3, n)`, for a placement in space. They are
the unit normals of the triangles on which the nodes lie. On feature edges and in corners they are
means of the adjacent normals. They are 0 at inner nodes. Local.
"""
function normals(placement::Placement)
    n = node_count(placement)
    found = zeros(Float64, 3, n)
    check(placement, LibPNPBS.pnpbs_placement_get_normals(live(placement), n, found))
    return found
end

"""
    boundary_triangles(placement) -> (triangles, tags)

Returns the boundary triangles of a placement in space, which are the faces of only one tetrahedron:
`(3, n)` local indices, counter-clockwise as seen from outside, and the tags of the surfaces there.
On surfaces alone, they are the triangles between the nodes. A triangle belongs to the rank that
owns its node with the lowest id. Collective.
"""
function boundary_triangles(placement::Placement)
    corners, tags = facets(placement, LibPNPBS.pnpbs_placement_get_boundary_triangles, 3)
    return (triangles = corners, tags = tags)
end

function facets(placement, get, rows)
    count = Ref{Int64}(0)
    check(placement, get(live(placement), 0, count, C_NULL, C_NULL))
    corners, tags = zeros(Int64, rows, count[]), zeros(Int32, count[])
    check(placement, get(live(placement), count[], count, corners, tags))
    return (corners .+= 1), tags
end

"""
    check_results(placement) -> Symbol

Checks the invariants of the results. Ids are unique, no two nodes coincide, and all lie inside or
on the boundary. Adjacency lists are symmetric. Stars form one conforming triangulation of the
domain, with every boundary edge and the right area, or in space with a closed boundary and the
right volume. Returns `:ok`, or `:not_conforming` where [`run!`](@ref) does, too. Throws
`:error_internal` if anything else is wrong, with ids and coordinates. Collective.
"""
check_results(placement::Placement) =
    check(placement, LibPNPBS.pnpbs_placement_check(live(placement)))

# ---------------------------------------------------------------- statistics --------------------
"""
    statistic(placement, key)

Returns a statistic by its name, such as `"nodes"`, `"hash"` or `:imbalance`, as an `Int64`, a
`Float64` or a `String`. [`statistic_table`](@ref) lists them. Throws `:error_key` for an unknown
name. Collective.
"""
function statistic(placement::Placement, key)
    name = string(key)
    row = findfirst(row -> row.name == name, statistic_table())
    return statistic(placement, name, row === nothing ? "real" : statistic_table()[row].type)
end

function statistic(placement::Placement, name, type)
    if type == "integer"
        value = Ref{Int64}(0)
        check(placement, LibPNPBS.pnpbs_placement_get_int64(live(placement), name, value))
        return value[]
    elseif type == "real"
        real = Ref(0.0)
        check(placement, LibPNPBS.pnpbs_placement_get_double(live(placement), name, real))
        return real[]
    else
        text = Ref{Cstring}()
        check(placement, LibPNPBS.pnpbs_placement_get_string(live(placement), name, text))
        return string_or_empty(text[])
    end
end

"""
    statistics(placement) -> Dict{String,Any}

Returns all statistics by name. Collective.
"""
statistics(placement::Placement) =
    Dict{String,Any}(row.name => statistic(placement, row.name, row.type)
                     for row in statistic_table())

"""
    edge_bands(placement) -> (d_from, d_to, edges, mean, deviation)

Measures how well the edges of the triangles or tetrahedra follow the spacing, by bands of d. There
are eight bands, equal in log d between the smallest and the largest d at the nodes, or one if the
largest is less than 1.1 times the smallest. Bands without edges are left out. Returns for each band
its lower and upper end, the number of edges, and the mean and standard deviation of their length
over d, the mean of d at their ends. Edges between two boundary nodes are not counted, because the
corners of the domain determine their positions. The result includes all ranks and is the same on
each. Collective.
"""
function edge_bands(placement::Placement)
    count = Ref{Int64}(0)
    ask(capacity, arrays...) =
        check(placement, LibPNPBS.pnpbs_placement_get_edge_bands(live(placement), capacity, count,
                                                                 arrays...))
    ask(0, C_NULL, C_NULL, C_NULL, C_NULL, C_NULL)
    d_from, d_to, mean, deviation = (zeros(count[]) for _ in 1:4)
    edges = zeros(Int64, count[])
    ask(count[], d_from, d_to, edges, mean, deviation)
    return (d_from = d_from, d_to = d_to, edges = edges, mean = mean, deviation = deviation)
end

"""
    regions(placement) -> (tags, nodes, elements, measures)

Measures the regions of the domain by the tags of their elements ([`element_tags`](@ref)), also the
elements without a tag if there are any. Returns for each tag the number of nodes of these elements,
the number of elements, and their volume, in the plane their area. Nodes of an interface are in
several regions. The result includes all ranks and is the same on each, with the same bits for any
number of them. Throws `:error_argument` on surfaces alone. Collective.
"""
function regions(placement::Placement)
    count = Ref{Int64}(0)
    get(n, arrays...) = check(placement, LibPNPBS.pnpbs_placement_get_regions(live(placement), n,
                                                                              count, arrays...))
    get(0, C_NULL, C_NULL, C_NULL, C_NULL)
    n = count[]
    tags, measures = zeros(Int32, n), zeros(n)
    nodes, elements = zeros(Int64, n), zeros(Int64, n)
    get(n, tags, nodes, elements, measures)
    return (tags = tags, nodes = nodes, elements = elements, measures = measures)
end

"""
    cell_bands(placement, measure) -> (d_from, d_to, number, mean, worst)

Measures the Voronoi cells of the nodes as finite volumes need them, by bands of d, in the plane and
on spheres; elsewhere there are no bands. A cell is the polygon of the circumcentres of the
triangles around an inner node that is not fixed. Collective.

`measure` is one of these:

- `:edge_ratio`: the shortest over the longest edge of each cell.
- `:area_ratio`: the smaller over the larger area of the two cells at each edge.
- `:dual_offset`: for each edge between two such nodes, the distance of its midpoint from that of
  the Voronoi edge across it, over its length.

On spheres, lengths and areas are along the sphere. Returns for each band its lower and upper end,
the number of cells or edges, the mean, and the smallest ratio or largest offset. The ends of the
bands are those of [`edge_bands`](@ref). Bands with neither a cell nor an edge are left out, so the
bands are the same for all measures. The d of a cell is that of its node; the d of an edge is the
mean at its ends. The result includes all ranks and is the same on each.
"""
function cell_bands(placement::Placement, measure)
    count = Ref{Int64}(0)
    ask(capacity, arrays...) =
        check(placement, LibPNPBS.pnpbs_placement_get_cell_bands(live(placement), string(measure),
                                                                 capacity, count, arrays...))
    ask(0, C_NULL, C_NULL, C_NULL, C_NULL, C_NULL)
    d_from, d_to, mean, worst = (zeros(count[]) for _ in 1:4)
    number = zeros(Int64, count[])
    ask(count[], d_from, d_to, number, mean, worst)
    return (d_from = d_from, d_to = d_to, number = number, mean = mean, worst = worst)
end

"""
    warnings(placement) -> Vector{String}

Returns the messages of warnings about domain and spacing, such as a feature smaller than the
spacing or an unused vertex, and, from the last run, about nodes that do not follow the spacing.
Local.
"""
function warnings(placement::Placement)
    count = Ref{Int32}(0)
    check(placement, LibPNPBS.pnpbs_placement_warning_count(live(placement), count))
    return String[warning(placement, i) for i in 0:(count[] - 1)]
end

function warning(placement, i)
    text = Ref{Cstring}()
    check(placement, LibPNPBS.pnpbs_placement_get_warning(live(placement), i, text))
    return string_or_empty(text[])
end

"""
    warning_data(placement) -> Vector{NamedTuple}

Returns the same warnings as data, for programs that act on them. Local.

- `code`: the name of the constant in the header, in lower case, such as `:feature_unresolved`.
- `text`: the message.
- `count`: number of nodes, edges, triangles or points that the warning is about; 0 if it is not
  known.
- `value`: a number that the warning is about, or `NaN`.
- `point`: the coordinates of the first point that the message names, or an empty vector.
"""
warning_data(placement::Placement) =
    [data_of_warning(placement, i - 1, text) for (i, text) in enumerate(warnings(placement))]

function data_of_warning(placement, i, text)
    code, count, value = Ref{Int32}(0), Ref{Int64}(0), Ref(NaN)
    point = fill(NaN, 3)
    check(placement, LibPNPBS.pnpbs_placement_get_warning_data(live(placement), i, code, count,
                                                               value, point))
    return (code = get(WARNING_NAMES, Int(code[]), :unknown), text = text, count = count[],
            value = value[], point = filter(!isnan, point))
end

# ---------------------------------------------------------------- files -------------------------
"""
    write_file(placement, path; elements = false, order = 1) -> Symbol
    write_file(particles, path) -> Symbol

Writes the nodes of all ranks, and the triangles or tetrahedra if `elements` is true, into one file.
The extension selects the format ([`format_table`](@ref)): .vtu, .pvtu, .vtkhdf, .xdmf, .msh, .msh2,
.node, .ele, .face, .gr3, .2dm, .ugrid, .csv, .peridigm, .lammps, .hdf5, .mpas, .graph. The file
appears when it is complete. Returns `:ok`, or `:stopped` if the monitor has stopped the call, which
keeps an existing file. Throws `:error_file` with the name of the file, and `:error_unsupported` if
a format requires HDF5 and the library has none. Collective.

With `order = 2` the elements are of second order, whatever `elements` is, with the mid nodes of
[`edges`](@ref), in .msh, .msh2, .vtu and .vtkhdf.

Files of [`Particles`](@ref) also have their `volume`, in formats with fields, and no elements. The
formats .pvtu, .ele, .face, .gr3, .2dm, .ugrid, .mpas and .graph throw `:error_argument` for them.
"""
write_file(placement::Placement, path::AbstractString; elements::Bool = false,
           order::Integer = 1) =
    check(placement, LibPNPBS.pnpbs_placement_write(live(placement), path,
                                                    order == 2 ? 2 : elements))

"""
    write_files(placement, paths; formats = nothing, elements = false, order = 1) -> Symbol
    write_files(particles, paths; formats = nothing) -> Symbol

Writes several files, which appear together when all are complete, or not at all. `formats` are
names of formats; `nothing`, for all or for single files, stands for the format of the extension.
`elements` is one value for all files or one for each, and `order` that of these elements. Otherwise the function is like
[`write_file`](@ref). Collective.
"""
function write_files(placement::Placement, paths::AbstractVector{<:AbstractString};
                     formats::Union{Nothing,AbstractVector} = nothing, elements = false,
                     order::Integer = 1)
    elements isa Bool || require_length(elements, length(paths), "elements")
    code = with_file_names(paths, formats) do n, c_paths, c_formats
        with_elements = elements isa Bool ? fill(Int32(elements), n) : Vector{Int32}(elements)
        with_elements .*= order == 2 ? 2 : 1
        LibPNPBS.pnpbs_placement_write_files(live(placement), n, c_paths, c_formats, with_elements)
    end
    return check(placement, code)
end

# Returns call(n, paths, formats) with C strings of paths and formats.
function with_file_names(call, paths, formats)
    formats === nothing || require_length(formats, length(paths), "formats")
    # The strings must live while the library reads them through pointers.
    own_paths = String.(paths)
    own_formats = formats === nothing ? nothing :
                  Union{String,Nothing}[f === nothing ? f : string(f) for f in formats]
    GC.@preserve own_paths own_formats begin
        return call(length(paths), c_strings(own_paths),
                    own_formats === nothing ? C_NULL : c_strings(own_formats))
    end
end

"""
    add_output_field(placement, name, values) -> Placement
    add_output_field(particles, name, values) -> Particles

Adds a field of the caller to files that are written afterwards. The field appears next to `id`,
`tag` and `spacing` in .vtu, .pvtu, .vtkhdf and .xdmf, in .msh and .msh2 as `\$NodeData`, and in
.csv as a column `name`, or `name:0`, `name:1` and so on. All ranks must add the same fields in the
same order. Local.

- `name`: 1 to 63 letters, digits, `_` and `-`.
- `values`: a vector with an entry for each node of this rank, or an array whose last index is that
  of the node, with up to 9 components. Entries for ghosts may follow and are ignored. The values
  are copied. They belong to the current nodes: once these have moved, writing throws until
  [`clear_output_fields`](@ref) is called.

Fields of [`Particles`](@ref), such as masses, are in the order of the particles. `volume` exists
already, and a name can be used once.
"""
function add_output_field(placement::Placement, name::AbstractString,
                          values::AbstractArray{<:Real})
    check(placement,
          LibPNPBS.pnpbs_placement_add_output_field(live(placement), name, places_of(values),
                                                    components_of(values), dense(values)))
    return placement
end

"""
    clear_output_fields(placement) -> Placement

Removes the fields that [`add_output_field`](@ref) has added. Local.
"""
function clear_output_fields(placement::Placement)
    check(placement, LibPNPBS.pnpbs_placement_clear_output_fields(live(placement)))
    return placement
end

"""
    write_checkpoint(placement, path) -> Placement

Writes a file from which [`read_checkpoint!`](@ref) continues, in another process and on any number
of ranks, bit for bit as if there was no interruption. The format is VTKHDF, which ParaView opens,
so name the file `.vtkhdf`. It replaces an existing file when it is complete. A monitor may call
this function, on all ranks, in its calls between two steps; its other calls throw `:error_state`.
Throws `:error_unsupported` without HDF5. Collective.
"""
function write_checkpoint(placement::Placement, path::AbstractString)
    check(placement, LibPNPBS.pnpbs_placement_write_checkpoint(live(placement), path))
    return placement
end

"""
    read_checkpoint!(placement, path) -> Placement

Restores a placement from a checkpoint. The placement must have the domain, options and spacing of
the first run, except a spacing given by values at nodes, which the file contains. The next `run!`
or `step!` does what it would have done where the checkpoint was written. If the call throws, the
placement does not change. Collective.
"""
function read_checkpoint!(placement::Placement, path::AbstractString)
    check(placement, LibPNPBS.pnpbs_placement_read_checkpoint(live(placement), path))
    return placement
end

c_strings(texts) = Cstring[text === nothing ? Cstring(C_NULL) :
                           Base.unsafe_convert(Cstring, text) for text in texts]
