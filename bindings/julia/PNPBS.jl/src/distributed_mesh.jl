# SPDX-License-Identifier: BSD-3-Clause
# Distributed meshes, as plain arrays of the part of each rank. They need not be closed.

"""
    DistributedMesh(placement; ghost_layers = 0)

Creates a distributed mesh of the current nodes. On each rank it has the nodes, elements and facets
that the rank owns, and layers of ghost elements with their nodes. No rank holds more than its part.
Collective.

Elements are triangles in the plane, tetrahedra in space, and triangles on surfaces alone. All have
a positive orientation; on surfaces alone they are counter-clockwise as seen from the side to which
the normal points. A node belongs to the rank that owns it in the placement, and an element to the
owner of its node with the lowest id. The mesh is a copy: nodes may move afterwards, and the
placement may be closed.

`ghost_layers` is 0 to 16, the same on all ranks. With 0 this rank has only the elements that it
owns. With 1 it also has the elements of other ranks that share a node with these elements or
contain a node that it owns, and therefore all elements at its nodes. Each further layer adds the
elements that share a node with the previous layer.

Local indices count from 1: first what this rank owns, then the ghosts. Numbers count from 0 over
all ranks and are contiguous by rank, as in [`numbering`](@ref). Ids and ranks count from 0, too.

- `dim`: number of coordinates of a node, 2 or 3.
- `owned_nodes`, `owned_elements`: how many this rank owns.
- `first_node`, `first_element`: the owned node i has the number `first_node + i - 1`; likewise for
  elements.
- `all_nodes`, `all_elements`: how many exist over all ranks, each counted once.
- `coordinates`: those of the nodes on this rank, `(dim, nodes)`.
- `numbers`, `ids`, `owners`, `tags`: one of each per node; tags are those of [`nodes`](@ref).
- `elements`: local indices of corners, `(3, elements)` or `(4, elements)`.
- `element_numbers`, `element_owners`, `element_tags`: one of each per element. The tag is that of
  the region ([`add_region!`](@ref)), or 0 if the region has none; on surfaces alone it is that of
  the surface.
- `connectivity`: numbers of the nodes at the corners, in the size of `elements`.
- `facets`: local indices of the nodes of the facets of these elements, `(2, facets)` or `(3,
  facets)`. In the plane, facets are edges on the boundary or on inner curves, in the direction of
  the curve. In space, they are triangles on the boundary, counter-clockwise as seen from outside,
  or on inner surfaces, oriented as the surface. On surfaces alone, they are the edges of only one
  triangle. Each facet occurs once on a rank.
- `facet_tags`: tag of the curve or surface; on surfaces alone that of the surface.
- `facet_elements`: local indices of the elements at each facet, `(2, facets)`. The second is 0 if
  it does not exist or is not on this rank.
- `facet_opposite`: index, from 1, of the corner of the first element that is not a corner of the
  facet.
- `facet_inner`: whether elements lie on both sides of the facet, on any ranks.
- `facet_owners`: the rank to which the facet belongs, the owner of its element with the lowest
  number.
- `shared_nodes`: local indices of the nodes that this rank shares, in the order of numbers. A node
  is shared by its owner and the ranks that own an element at it.
- `sharing_ranks`: [`CompressedRows`](@ref) with the other ranks that share each of `shared_nodes`.

A loop over the elements of this rank, for example, is

    mesh = DistributedMesh(placement; ghost_layers = 1)
    for e in 1:mesh.owned_elements
        corners = mesh.elements[:, e]
        add_element!(matrix, mesh.numbers[corners], mesh.coordinates[:, corners])
    end

A mesh on one rank is converted for Ferrite.jl by `Ferrite.Grid(mesh)` and for Gridap.jl by
`Gridap.Geometry.UnstructuredDiscreteModel(mesh)`. The facets with tag 7 become a facet set or a tag
named `"tag_7"`. The elements with tag 7 become the cell set `"tag_7"` in Ferrite, and have the tag
`"region_7"` in Gridap. Julia 1.9 and later load these methods with the packages.
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

Writes a distributed mesh of the current nodes (see [`DistributedMesh`](@ref)) into files of Gmsh's
format 4.1, partitioned as Gmsh does it: rank r writes partition r + 1 to `prefix_<r + 1>.msh`.
`prefix` is the folder and the beginning of the names of the files, the same on all ranks.
Collective.

A file has the nodes, elements and ghost elements of the rank and the facets that it owns. Nodes and
elements have their numbers plus 1, and facets are numbered after all elements, so all files use the
same numbers. Tags are physical groups, named as by [`write_file`](@ref); the inside is a group,
too. Programs that read ghost elements, such as deal.II, need one ghost layer. All files appear when
all are complete. If the call throws, existing files do not change. Files of an earlier mesh on more
ranks remain.

Throws `:error_file` if a rank cannot write, with the name of its file.
"""
function write_mesh(placement::Placement, prefix::AbstractString; ghost_layers::Integer = 1)
    with_mesh(placement, ghost_layers) do mesh
        check(placement.context, LibPNPBS.pnpbs_mesh_write(mesh, prefix))
    end
    return placement
end

# Returns body(mesh) for a new mesh of the library, which is destroyed afterwards.
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
