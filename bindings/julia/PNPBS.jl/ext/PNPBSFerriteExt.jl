# SPDX-License-Identifier: BSD-3-Clause
# Conversion of distributed meshes to grids of Ferrite.jl. Julia 1.9 and later load this extension
# with both packages.
module PNPBSFerriteExt

import Ferrite
import PNPBS

"""
    Ferrite.Grid(mesh::PNPBS.DistributedMesh)

Returns the mesh as a grid of triangles or tetrahedra. Cells and nodes have the indices of elements
and nodes in `mesh`. The facet set `"tag_7"` has the facets with tag 7 of the boundary and of inner
curves or surfaces; an inner facet belongs to one of its two cells. The cell set `"tag_7"` has the
elements with tag 7: those of a region, on surfaces alone those of the surface. Elements with the
tag 0 are in no cell set. Ferrite does not use ranks, so the function throws an `ArgumentError`
unless all nodes are on this rank. Local.
"""
function Ferrite.Grid(mesh::PNPBS.DistributedMesh)
    PNPBS.require_whole_mesh(mesh, "Ferrite")
    cell = size(mesh.elements, 1) == 3 ? Ferrite.Triangle : Ferrite.Tetrahedron
    cells = cell.(PNPBS.columns_as_tuples(Int, mesh.elements))
    nodes = Ferrite.Node.(PNPBS.columns_as_tuples(Float64, mesh.coordinates))
    cellsets = sets_by_tag(mesh.element_tags, eachindex(cells))
    facetsets = sets_by_tag(mesh.facet_tags, facets_of_cells(mesh, cells))
    return Ferrite.Grid(cells, nodes; cellsets = cellsets, facetsets = facetsets)
end

# Returns each facet as that facet of its first cell that does not contain the opposite corner.
function facets_of_cells(mesh, cells)
    return map(axes(mesh.facets, 2)) do k
        element = Int(mesh.facet_elements[1, k])
        opposite = mesh.elements[mesh.facet_opposite[k], element]
        facet = findfirst(corners -> !(opposite in corners), Ferrite.facets(cells[element]))
        return Ferrite.FacetIndex(element, facet)
    end
end

# Groups members by tag. The tag 0 means no tag, so its members are left out.
function sets_by_tag(tags, members)
    sets = Dict{String,Vector{eltype(members)}}()
    for (tag, member) in zip(tags, members)
        tag == 0 && continue
        push!(get!(Vector{eltype(members)}, sets, PNPBS.tag_label(tag)), member)
    end
    return sets
end

end
