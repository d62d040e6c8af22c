# SPDX-License-Identifier: BSD-3-Clause
# A rank's part of a mesh in plain arrays. No object of the library has to be closed.

"""
    DistributedMesh(placement; ghost_layers = 0)

Makes a distributed mesh of the current nodes: on each rank the nodes, elements and facets that it
owns, and layers of ghost elements with their nodes, in arrays that solvers take. No rank holds more
than its part. Elements are triangles in the plane, tetrahedra in space, and triangles on surfaces
alone, all with positive orientation (on surfaces alone counter-clockwise as seen from the side that
the normal points to). A node belongs to the rank that owns it in the placement, and an element to
the owner of its node with the lowest id. The mesh is a copy: nodes may move afterwards, and the
placement may be closed.

With `ghost_layers = 0` this rank has only the elements that it owns. With 1 it also has those of
other ranks that have a node in common with these, or with the nodes that it owns, so all elements
at its nodes. Each further layer, up to 16, adds the elements that have a node in common with the
layer before. All ranks give the same number. Collective.

Local indices count from 1: first what this rank owns, then the ghosts. Numbers count from 0 over
all ranks, contiguously by rank, as in [`numbering`](@ref); ids and ranks count from 0, too.

- `dim`: coordinates of a node, 2 or 3.
- `owned_nodes`, `owned_elements`: how many this rank owns.
- `first_node`, `first_element`: its node i has the number `first_node + i - 1`; elements likewise.
- `all_nodes`, `all_elements`: how many there are over all ranks, each counted once.
- `coordinates`: of the nodes here, `(dim, nodes)`.
- `numbers`, `ids`, `owners`, `tags`: of each node; tags as in [`nodes`](@ref).
- `elements`: local indices of their corners, `(3, elements)` or `(4, elements)`.
- `element_numbers`, `element_owners`, `element_tags`: of each element; the tag is that of the
  region it lies in ([`add_region!`](@ref)), or 0 if the region has none; on surfaces alone, that of
  the surface.
- `connectivity`: numbers of the nodes at the corners, of the same size as `elements`.
- `facets`: local indices of the nodes of facets of these elements, `(2, facets)` or `(3, facets)`:
  edges of triangles in the plane that are parts of the boundary or of inner curves, in the
  direction of the curve; triangles of tetrahedra that are parts of the boundary or of inner
  surfaces, counter-clockwise as seen from outside, or turning as the inner surface does; on
  surfaces alone the edges of only one triangle. Each comes once on a rank.
- `facet_tags`: of the curve or surface; on surfaces alone, of the surface.
- `facet_elements`: local indices of the elements at it, `(2, facets)`; the second is 0 if there is
  none, or if it is not on this rank.
- `facet_opposite`: the corner of the first of them, from 1, that is none of the facet's.
- `facet_inner`: whether there are elements on both sides, on whichever ranks.
- `facet_owners`: the rank it belongs to, the owner of its element with the lowest number.
- `shared_nodes`: local indices of the nodes that this rank shares, by number. A node is shared by
  its owner and the ranks that own an element at it.
- `sharing_ranks`: [`CompressedRows`](@ref) of the other ranks that share each of `shared_nodes`.

For example, what a loop over the elements of this rank needs:

    mesh = DistributedMesh(placement; ghost_layers = 1)
    for e in 1:mesh.owned_elements
        corners = mesh.elements[:, e]
        add_element!(matrix, mesh.numbers[corners], mesh.coordinates[:, corners])
    end

A mesh that is on one rank goes to Ferrite.jl by `Ferrite.Grid(mesh)`, to Gridap.jl by
`Gridap.Geometry.UnstructuredDiscreteModel(mesh)`, with a facet set or a tag of the name `"tag_7"`
for the facets with tag 7. The elements with tag 7 are the cell set of this name in Ferrite, and have
the tag `"region_7"` in Gridap. Julia 1.9 and later load these methods with the packages.
"""
Base.@kwdef struct DistributedMesh
    dim::Int
    owned_nodes::Int
    first_node::Int64
    all_nodes::Int64
    owned_elements::Int
    first_element::Int64
    all_elements::Int64
    coordinates::Matrix{Float64}
    numbers::Vector{Int64}
    ids::Vector{Int64}
    owners::Vector{Int32}
    tags::Vector{Int32}
    elements::Matrix{Int32}
    element_numbers::Vector{Int64}
    element_owners::Vector{Int32}
    element_tags::Vector{Int32}
    connectivity::Matrix{Int64}
    facets::Matrix{Int32}
    facet_tags::Vector{Int32}
    facet_elements::Matrix{Int32}
    facet_opposite::Vector{Int32}
    facet_inner::Vector{Bool}
    facet_owners::Vector{Int32}
    shared_nodes::Vector{Int32}
    sharing_ranks::CompressedRows{Int32}
end

function DistributedMesh(placement::Placement; ghost_layers::Integer = 0)
    return with_mesh(mesh -> copy_of_mesh(placement.context, mesh), placement, ghost_layers)
end

"""
    write_mesh(placement, prefix; ghost_layers = 1) -> Placement

Writes a distributed mesh of the current nodes (see [`DistributedMesh`](@ref)) in files of Gmsh's
format 4.1, in parts as Gmsh partitions a mesh: rank r writes `prefix_<r + 1>.msh`, partition r + 1.
The file has the nodes, elements and ghost elements of the rank and the facets that it owns. Nodes
and elements have their numbers plus 1, and facets are numbered behind all elements, so that the
files have the same numbers for the same things. Tags are physical groups, named as by
[`write_file`](@ref); the inside is one, too. Programs that read ghost elements, such as deal.II,
need one ghost layer; with none the files have none. All files appear when all are complete; after
an error, existing files are unchanged. Files of an earlier mesh on more ranks remain. All ranks
give the same prefix: folder and begin of the names of the files. Collective.
"""
function write_mesh(placement::Placement, prefix::AbstractString; ghost_layers::Integer = 1)
    with_mesh(placement, ghost_layers) do mesh
        check(placement.context, LibPNPBS.pnpbs_mesh_write(mesh, prefix))
    end
    return placement
end

# Returns body(mesh), where the mesh of the library exists during this call only.
function with_mesh(body, placement, ghost_layers)
    context = placement.context
    handle = Ref{LibPNPBS.pnpbs_mesh}(C_NULL)
    check(context, LibPNPBS.pnpbs_mesh_create(live(placement), ghost_layers, handle))
    try
        return body(handle[])
    finally
        check(context, LibPNPBS.pnpbs_mesh_destroy(handle))
    end
end

function Base.show(io::IO, mesh::DistributedMesh)
    print(io, "PNPBS.DistributedMesh(", length(mesh.ids), " nodes, ", size(mesh.elements, 2),
          " elements, ", size(mesh.facets, 2), " facets here)")
end

function copy_of_mesh(context, mesh)
    dim, corners, owned_nodes, n, owned_elements, elements, facets = sizes_of_mesh(context, mesh)
    return DistributedMesh(; dim = dim, owned_nodes = owned_nodes, owned_elements = owned_elements,
                           numbering_of_mesh(context, mesh)...,
                           nodes_of_mesh(context, mesh, dim, n)...,
                           elements_of_mesh(context, mesh, corners, elements)...,
                           facets_of_mesh(context, mesh, corners, facets)...,
                           sharing_of_mesh(context, mesh)...)
end

function sizes_of_mesh(context, mesh)
    dim, corners = Ref{Int32}(0), Ref{Int32}(0)
    numbers = ntuple(_ -> Ref{Int64}(0), 5)
    check(context, LibPNPBS.pnpbs_mesh_sizes(mesh, dim, corners, numbers...))
    return map(number -> Int(number[]), (dim, corners, numbers...))
end

function numbering_of_mesh(context, mesh)
    first_node, all_nodes, first_element, all_elements = ntuple(_ -> Ref{Int64}(0), 4)
    check(context, LibPNPBS.pnpbs_mesh_numbering(mesh, first_node, all_nodes, first_element,
                                                 all_elements))
    return (first_node = first_node[], all_nodes = all_nodes[], first_element = first_element[],
            all_elements = all_elements[])
end

function nodes_of_mesh(context, mesh, dim, n)
    coordinates, numbers, ids = zeros(dim, n), zeros(Int64, n), zeros(Int64, n)
    owners, tags = zeros(Int32, n), zeros(Int32, n)
    check(context, LibPNPBS.pnpbs_mesh_get_nodes(mesh, n, coordinates, numbers, ids, owners, tags))
    return (coordinates = coordinates, numbers = numbers, ids = ids, owners = owners, tags = tags)
end

function elements_of_mesh(context, mesh, corners, n)
    elements, connectivity = zeros(Int32, corners, n), zeros(Int64, corners, n)
    numbers, owners, tags = zeros(Int64, n), zeros(Int32, n), zeros(Int32, n)
    check(context, LibPNPBS.pnpbs_mesh_get_elements(mesh, n, elements, numbers, owners, tags))
    check(context, LibPNPBS.pnpbs_mesh_get_connectivity(mesh, n, connectivity))
    return (elements = elements .+= 1, element_numbers = numbers, element_owners = owners,
            element_tags = tags, connectivity = connectivity)
end

function facets_of_mesh(context, mesh, corners, n)
    facets, tags, elements = zeros(Int32, corners - 1, n), zeros(Int32, n), zeros(Int32, 2, n)
    opposite, inner, owners = zeros(Int32, n), zeros(Bool, n), zeros(Int32, n)
    check(context, LibPNPBS.pnpbs_mesh_get_facets(mesh, n, facets, tags, elements, opposite,
                                                  reinterpret(Int8, inner), owners))
    return (facets = facets .+= 1, facet_tags = tags, facet_elements = elements .+= 1,
            facet_opposite = opposite .+= 1, facet_inner = inner, facet_owners = owners)
end

function sharing_of_mesh(context, mesh)
    n, entries = Ref{Int64}(0), Ref{Int64}(0)
    check(context, LibPNPBS.pnpbs_mesh_sharing_sizes(mesh, n, entries))
    nodes, offsets, ranks = zeros(Int32, n[]), zeros(Int64, n[] + 1), zeros(Int32, entries[])
    check(context, LibPNPBS.pnpbs_mesh_get_sharing(mesh, n[], entries[], nodes, offsets, ranks))
    return (shared_nodes = nodes .+= 1, sharing_ranks = CompressedRows(offsets .+= 1, ranks))
end
