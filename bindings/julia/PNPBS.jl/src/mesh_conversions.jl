# SPDX-License-Identifier: BSD-3-Clause
# Helpers of the extensions, which convert distributed meshes to grids of other packages.

# Throws unless this rank has the whole mesh, which packages without ranks need.
function require_whole_mesh(mesh::DistributedMesh, package)
    mesh.owned_nodes == mesh.all_nodes && return nothing
    throw(ArgumentError("this rank owns $(mesh.owned_nodes) of $(mesh.all_nodes) nodes; " *
                        "$package takes meshes that are on one rank"))
end

# Returns the columns of coordinates or corners as tuples of T.
columns_as_tuples(T, matrix) = reinterpret_columns(NTuple{size(matrix, 1),T}, T.(matrix))

tag_label(tag) = "tag_$tag"
