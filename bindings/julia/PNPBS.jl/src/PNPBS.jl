# SPDX-License-Identifier: BSD-3-Clause
"""
Parallel node placement by bubble simulation. Given a domain and a spacing d(x), the library places
nodes whose mutual distances follow d, and computes their adjacency lists, boundary tags and
Delaunay stars. Results are identical for any number of threads and MPI ranks.

    using PNPBS
    Context() do context
        domain = Domain(context)
        add_polyline!(domain, [0 1 1 0; 0 0 1 1])
        placement = Placement(domain)
        set_spacing!(placement, 0.05)
        run!(placement)
        nodes(placement).points
    end

Conventions:

- Points are the columns of `(dim, n)` matrices, where dim is 2 in the plane and 3 in space and on a
  sphere. Lengths, spacings and coordinates have one common unit, which the caller chooses.
- Local indices and offsets count from 1; global ids and MPI ranks count from 0.
- "Collective" functions must be called by all ranks of the context in the same order. If one rank
  throws, all ranks throw. "Local" functions may be called by any rank.
- Arrays that are passed are copied or only read during the call. Arrays that are returned belong to
  the caller.
- Errors of the library throw [`PNPBSError`](@ref). Arrays of a wrong size throw
  `DimensionMismatch`.
- One task at a time may use a context.
"""
module PNPBS

using Libdl
using SparseArrays: SparseArrays, sparse
using Base: disable_sigint, reenable_sigint

export Context, Domain, Placement, CompressedRows, PNPBSError
export set!, set_spacing!, set_spacing_from_shape!, set_monitor!, set_nodes!
export set_spacing_mesh!, set_spacing_points!, set_spacing_file!, add_spacing_hints!
export add_polyline!, add_arc!, add_curve!, add_pslg!, add_hole!, add_region!, add_fixed_nodes!
export add_surface!, read_surface!, add_box!, add_ball!, add_cylinder!, add_level_set!
export add_offset!
export sphere_domain, sphere_points, sphere_degrees, sphere_radius
export set_filled!, set_repair!, set_resurfaced!, set_fragment!, set_periodic!
export tag_outline!, set_corner_angle!, set_snap!, simplify!, simplify_by_file!
export read_msh!, file_dimension, set_role!, set_tag_name!, tag_names
export read_poly!, parse_poly!, check_domain, bounds, measure, distances, shape_spacing, outline
export regions_at
export estimate, initialise!, run!, step!, adjust_population!, rebalance!
export node_count, nodes, nodes!, normals, ghost_count, ghosts, ghosts!
export exchange_pattern, numbering, reinterpret_columns
export update_ghosts!, begin_update_ghosts, end_update_ghosts!, sum_over_nodes, dot_over_nodes
export add_from_ghosts!, incident_elements, incident_elements!
export Transfer, at_nodes, at_points, linear_nodes
export DistributedMesh, write_mesh, VoronoiCells, Particles
export adjacency, adjacency!, stars, stars!, triangles, triangles!, tetrahedra, tetrahedra!
export set_cracks!, crack_nodes, cracked_elements, crack_facets
export edges, find_edges, element_tags, boundary_edges, boundary_triangles, check_results
export statistic, statistics, edge_bands, cell_bands, regions, warnings, warning_data, write_file, write_files
export add_output_field, clear_output_fields
export write_checkpoint, read_checkpoint!
export Shapes, add_shapes!, shape_counts, projection, notes, write_prj, to_degrees, from_degrees
export GeoGrid, grid_values, inside_grid, grid_slopes, depth_spacing, grid_extent
export explain, geo_build_info
export option_table, statistic_table, format_table, library_version, build_info, mpi_library

include("LibPNPBS.jl")
include("LibPNPBSGeo.jl")
include("errors.jl")
include("rows.jl")
include("sparse.jl")
include("columns.jl")
include("callbacks.jl")
include("per_point.jl")
include("context.jl")
include("domain.jl")
include("placement.jl")
include("results.jl")
include("lines.jl")
include("fields.jl")
include("assembly.jl")
include("transfer.jl")
include("distributed_mesh.jl")
include("mesh_conversions.jl")
include("voronoi_cells.jl")
include("particles.jl")
include("shapes.jl")
include("tables.jl")
include("mpi.jl")

__init__() = make_callback_pointers()

end
