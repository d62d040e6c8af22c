# SPDX-License-Identifier: BSD-3-Clause
# Checks that every rank's part of a distributed mesh must pass.

measure_of(u, v) = (u[1] * v[2] - u[2] * v[1]) / 2
measure_of(u, v, w) = (u[1] * (v[2] * w[3] - v[3] * w[2]) + u[2] * (v[3] * w[1] - v[1] * w[3]) +
                       u[3] * (v[1] * w[2] - v[2] * w[1])) / 6

# Returns areas of triangles in the plane, or volumes of tetrahedra.
measures(mesh) = [measure_of((mesh.coordinates[:, k] - mesh.coordinates[:, corners[1]]
                              for k in corners[2:end])...) for corners in eachcol(mesh.elements)]

# Returns whether owned entities come first, with numbers from `first` on, and then those of other
# ranks in the order of numbers.
function in_order(numbers, owners, first, owned, rank)
    others = numbers[(owned + 1):end]
    return numbers[1:owned] == first .+ (0:(owned - 1)) && all(owners[1:owned] .== rank) &&
           !(rank in owners[(owned + 1):end]) && issorted(others) && allunique(others)
end

function check_mesh(mesh, rank)
    n, m, f = length(mesh.numbers), size(mesh.elements, 2), size(mesh.facets, 2)
    corners = size(mesh.elements, 1)
    @test size(mesh.coordinates) == (mesh.dim, n)
    @test length(mesh.ids) == length(mesh.owners) == length(mesh.tags) == n && allunique(mesh.ids)
    @test in_order(mesh.numbers, mesh.owners, mesh.first_node, mesh.owned_nodes, rank)
    @test length(mesh.element_tags) == m
    @test in_order(mesh.element_numbers, mesh.element_owners, mesh.first_element,
                   mesh.owned_elements, rank)
    @test mesh.connectivity == mesh.numbers[mesh.elements]
    corners == mesh.dim + 1 && @test all(measures(mesh) .> 0)

    @test size(mesh.facets) == (corners - 1, f) && size(mesh.facet_elements) == (2, f)
    @test length(mesh.facet_tags) == length(mesh.facet_owners) == f
    @test all(1:f) do k
        facet, (first, second) = mesh.facets[:, k], mesh.facet_elements[:, k]
        opposite = mesh.elements[mesh.facet_opposite[k], first]
        issetequal(mesh.elements[:, first], [facet; opposite]) && !(opposite in facet) &&
            (second == 0 || mesh.facet_inner[k] && issubset(facet, mesh.elements[:, second]))
    end
    @test length(mesh.sharing_ranks) == length(mesh.shared_nodes)
    @test issorted(mesh.numbers[mesh.shared_nodes])
    @test all(issorted(sharing) && !isempty(sharing) && !(rank in sharing)
              for sharing in mesh.sharing_ranks)
end
