# SPDX-License-Identifier: BSD-3-Clause
# Conversion of distributed meshes to discrete models of Gridap.jl. Julia 1.9 and later load this
# extension with both packages.
module PNPBSGridapExt

using Gridap.Arrays: Table
using Gridap.Geometry: FaceLabeling, NonOriented, Oriented, UnstructuredDiscreteModel,
                       UnstructuredGrid, UnstructuredGridTopology, add_tag!, get_faces,
                       num_cell_dims, num_faces
using Gridap.ReferenceFEs: LagrangianRefFE, TET, TRI
using Gridap.TensorValues: VectorValue
import Gridap
import PNPBS

"""
    Gridap.UnstructuredDiscreteModel(mesh::PNPBS.DistributedMesh)

Returns the mesh as a discrete model of triangles or tetrahedra. Cells and nodes have the indices of
elements and nodes in `mesh`. The tag `"tag_7"` has the facets with tag 7 of the boundary and of
inner curves or surfaces, with their edges and vertices; on surfaces alone also the triangles of the
surface. The tag `"region_7"` has the cells of regions with tag 7, with their faces, edges and
vertices; entities between regions have the tags of all of them. The tag `"boundary"` has the
entities on the boundary, `"interior"` all others. The corners of a cell are in the order of their
indices, as Gridap's oriented simplices require; on surfaces alone they have the orientation of
`mesh`. Gridap does not use ranks here, so the function throws an `ArgumentError` unless all nodes
are on this rank. Local.
"""
function Gridap.Geometry.UnstructuredDiscreteModel(mesh::PNPBS.DistributedMesh)
    PNPBS.require_whole_mesh(mesh, "Gridap")
    grid = grid_of(mesh)
    topology = UnstructuredGridTopology(grid)
    return UnstructuredDiscreteModel(grid, topology, labels_of(mesh, topology))
end

function grid_of(mesh)
    corners, n = size(mesh.elements)
    nodes = VectorValue.(PNPBS.columns_as_tuples(Float64, mesh.coordinates))
    elements = on_surfaces(mesh) ? copy(mesh.elements) : sort(mesh.elements, dims = 1)
    cells = Table(vec(elements), Int32.(1:corners:(corners * n + 1)))
    shape = corners == 3 ? TRI : TET
    return UnstructuredGrid(nodes, cells, [LagrangianRefFE(Float64, shape, 1)], fill(Int8(1), n),
                            on_surfaces(mesh) ? NonOriented() : Oriented())
end

on_surfaces(mesh) = size(mesh.elements, 1) == mesh.dim

# The classification of a vertex, edge, triangle or cell: the sorted tags of its curves or surfaces,
# the sorted tags of its regions, and whether it lies on the boundary. All faces with the same
# classification form an entity of Gridap.
struct Place
    tags::Vector{Int32}
    regions::Vector{Int32}
    boundary::Bool
end

Base.:(==)(a::Place, b::Place) =
    a.tags == b.tags && a.regions == b.regions && a.boundary == b.boundary

function labels_of(mesh, topology)
    entities, places = entities_of_faces(mesh, topology)
    labels = FaceLabeling(entities, Vector{Int32}[], String[])
    add_tag!(labels, "interior", findall(place -> !place.boundary, places))
    add_tag!(labels, "boundary", findall(place -> place.boundary, places))
    for tag in sort!(reduce(union, (place.tags for place in places)))
        add_tag!(labels, PNPBS.tag_label(tag), findall(place -> tag in place.tags, places))
    end
    for tag in sort!(reduce(union, (place.regions for place in places)))
        add_tag!(labels, "region_$tag", findall(place -> tag in place.regions, places))
    end
    return labels
end

# Returns the entity of each face of each dimension, and the classification of each entity.
function entities_of_faces(mesh, topology)
    dim = num_cell_dims(topology)
    places = Place[Place(Int32[], Int32[], false)]
    entities = [ones(Int32, num_faces(topology, d)) for d in 0:dim]
    known = Dict{Tuple{Int32,Int32,Symbol},Int32}()
    function add_place!(d, face, tag, kind)
        entity = entities[d + 1][face]
        entities[d + 1][face] = get!(known, (entity, tag, kind)) do
            return entity_with!(places, entity, tag, kind)
        end
    end
    for (k, facet) in enumerate(facet_numbers(mesh, topology))
        for (d, face) in faces_in(topology, dim - 1, facet)
            add_place!(d, face, mesh.facet_tags[k], mesh.facet_inner[k] ? :inner : :boundary)
        end
    end
    kind = on_surfaces(mesh) ? :inner : :region
    for (cell, tag) in enumerate(mesh.element_tags)
        kind == :region && tag == 0 && continue
        for (d, face) in faces_in(topology, dim, cell)
            add_place!(d, face, tag, kind)
        end
    end
    return entities, places
end

# Returns the entity that has the classification of `entity` plus this curve, surface or region.
function entity_with!(places, entity, tag, kind)
    old = places[entity]
    with(tags) = tag in tags ? tags : sort([tags; tag])
    place = kind == :region ? Place(old.tags, with(old.regions), old.boundary) :
            Place(with(old.tags), old.regions, old.boundary || kind == :boundary)
    found = findfirst(==(place), places)
    found === nothing || return found
    push!(places, place)
    return length(places)
end

# Returns a face and all faces on its boundary, with their dimensions.
function faces_in(topology, dim, face)
    own = ((d, f) for d in 0:(dim - 1) for f in get_faces(topology, dim, d)[face])
    return Iterators.flatten((((dim, face),), own))
end

# Returns Gridap's index of each facet of the mesh.
function facet_numbers(mesh, topology)
    dim = num_cell_dims(topology)
    of_cells, vertices = get_faces(topology, dim, dim - 1), get_faces(topology, dim - 1, 0)
    return map(axes(mesh.facets, 2)) do k
        facet = view(mesh.facets, :, k)
        return first(f for f in of_cells[mesh.facet_elements[1, k]] if issubset(vertices[f], facet))
    end
end

end
