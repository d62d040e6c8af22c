# SPDX-License-Identifier: BSD-3-Clause
# Functions with which a solver assembles the rows of its nodes where several ranks share elements.

"""
    incident_elements(placement) -> Matrix{Int64}
    incident_elements!(placement, corners) -> corners

Returns every element with a corner among the nodes of this rank, also those that belong to other
ranks: triangles in the plane and on surfaces alone, `(3, n)` local indices, or tetrahedra in space,
`(4, n)`. With these a rank assembles the rows of its nodes without communication. The corner with
the lowest id comes first. An element belongs to this rank, as defined by [`triangles`](@ref) and
[`tetrahedra`](@ref), if its first corner is one of the nodes of the rank. Elements are in the order
of the ids of their corners, so those of a node are the same, in the same order, for any number of
ranks. A row that is summed in this order always has the same bits. Collective.

`incident_elements!` fills the matrix of an earlier result if it has the required size, and
otherwise returns a new one.
"""
incident_elements, incident_elements!

incident_elements(placement::Placement) = incident_elements!(placement, zeros(Int64, 0, 0))

function incident_elements!(placement::Placement, elements::Matrix{Int64})
    count, corners = Ref{Int64}(0), Ref{Int32}(0)
    get = LibPNPBS.pnpbs_placement_get_incident_elements
    check(placement, get(live(placement), 0, count, corners, C_NULL))
    fitted = fitted!(elements, corners[], count[])
    check(placement, get(live(placement), count[], count, corners, fitted))
    return fitted .+= 1
end

"""
    add_from_ghosts!(placement, values) -> values

Adds the values at ghosts to the values of the nodes that they represent, on the ranks that own
these nodes. It is the reverse of [`update_ghosts!`](@ref), for sums over elements to which several
ranks contribute. `values` has the form described there; the entries of ghosts do not change.
Collective.

Each sum, of the value of a node and those at its ghosts, is exact and rounded once, so the order of
ranks has no effect. Values that a rank has summed before are rounded already. Unless those sums are
exact, results for different numbers of ranks differ by rounding. Use [`incident_elements`](@ref)
where all bits must agree.
"""
function add_from_ghosts!(placement::Placement, values::AbstractArray{Float64})
    summed = dense(values)
    check(placement, LibPNPBS.pnpbs_placement_add_from_ghosts(live(placement), places_of(values),
                                                              components_of(values), summed))
    return summed === values ? values : copyto!(values, summed)
end
