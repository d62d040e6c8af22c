# SPDX-License-Identifier: BSD-3-Clause
# Voronoi cells as plain arrays. They need not be closed.

"""
    VoronoiCells(placement)

Creates the Voronoi cells of the current nodes: for each node the part of the elements of the
placement that is closer to it than to any other node, with its volume, its faces to neighbours and
its share of the boundary. In the plane and on surfaces, volumes are areas, and areas of faces are
lengths. On surfaces alone distances are straight. On spheres lengths, areas and distances are along
the sphere. Each element is divided among the corners of all elements that touch it, so a cell does
not extend through a gap without elements. The volumes add up to that of the elements, up to
rounding; on spheres, to the area of the triangles along the sphere. The bits do not depend on the
number of ranks and threads. The cells are copies: nodes may move afterwards, and the placement may
be closed. Collective. Throws `:error_state` without nodes.

Cells are in the order of [`nodes`](@ref).

- `volumes`: volume of each cell.
- `boundary`: the outward normal integrated over the part of the boundary that is closest to the
  node, `(dim, nodes)`. Where the boundary is flat, its length is the area of this part. It is 0 for
  nodes away from the boundary. In the plane and in bodies, the areas of the faces of a cell times
  their normals and its share of the boundary add up to 0.
- `neighbours`: [`CompressedRows`](@ref) with the ids of the neighbours with which each cell shares
  a face, in the order of ids.
- `numbers`: numbers of these neighbours, as in [`numbering`](@ref). This array and the following
  ones have an entry for each of `neighbours.entries`.
- `areas`: areas of the faces. Both cells at a face have the same area to the last bit.
- `distances`: distances from the node to the neighbour.
- `normals`: unit vectors from the node to the neighbour, `(dim, faces)`.
"""
Base.@kwdef struct VoronoiCells
    volumes::Vector{Float64}
    boundary::Matrix{Float64}
    neighbours::CompressedRows{Int64}
    numbers::Vector{Int64}
    areas::Vector{Float64}
    distances::Vector{Float64}
    normals::Matrix{Float64}
end

function VoronoiCells(placement::Placement)
    context = placement.context
    handle = Ref{LibPNPBS.pnpbs_voronoi}(C_NULL)
    check(context, LibPNPBS.pnpbs_voronoi_create(live(placement), handle))
    try
        return copy_of_cells(context, handle[])
    finally
        check(context, LibPNPBS.pnpbs_voronoi_destroy(handle))
    end
end

function Base.show(io::IO, cells::VoronoiCells)
    print(io, "PNPBS.VoronoiCells(", length(cells.volumes), " cells, ", length(cells.areas),
          " faces here)")
end

function copy_of_cells(context, voronoi)
    dim, n, m = Ref{Int32}(0), Ref{Int64}(0), Ref{Int64}(0)
    check(context, LibPNPBS.pnpbs_voronoi_sizes(voronoi, dim, n, m))
    nodes, faces = n[], m[]
    volumes, boundary = zeros(nodes), zeros(dim[], nodes)
    check(context, LibPNPBS.pnpbs_voronoi_get_cells(voronoi, nodes, volumes, boundary))
    offsets, ids, numbers = zeros(Int64, nodes + 1), zeros(Int64, faces), zeros(Int64, faces)
    areas, distances, normals = zeros(faces), zeros(faces), zeros(dim[], faces)
    check(context, LibPNPBS.pnpbs_voronoi_get_faces(voronoi, nodes, faces, offsets, ids, numbers,
                                                    areas, distances, normals))
    return VoronoiCells(; volumes = volumes, boundary = boundary,
                        neighbours = CompressedRows(offsets .+= 1, ids), numbers = numbers,
                        areas = areas, distances = distances, normals = normals)
end
