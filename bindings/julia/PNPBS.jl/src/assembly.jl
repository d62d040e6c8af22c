# SPDX-License-Identifier: BSD-3-Clause
# Elements and sums with which a solver assembles the rows of its nodes if elements lie across
# ranks.

"""
    incident_elements(placement) -> Matrix{Int64}
    incident_elements!(placement, corners) -> corners

Returns every element with a corner among this rank's nodes, whichever rank it belongs to: triangles
in the plane, `(3, n)` local indices, tetrahedra in space, `(4, n)`, triangles on surfaces alone.
With these a rank assembles the rows of its nodes without communication. The corner with the lowest
id comes first; an element belongs to this rank, as defined by [`triangles`](@ref) and
[`tetrahedra`](@ref), if that is one of its nodes. Elements are in the order of the ids of their
corners, so those of a node are the same, in the same order, for any number of ranks, and a row
summed in this order has the same bits. `incident_elements!` fills the matrix of an earlier result
if it has the required size, and otherwise returns a new one. Collective.
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

Adds the values at ghosts to those of the nodes they represent, on the ranks that own these. It is
the reverse of [`update_ghosts!`](@ref), for sums over elements to which several ranks contribute.
The entries of ghosts are unchanged. Each sum, of a node's value and those at its ghosts, is exact
and rounded once, so the order of ranks has no effect. Values that a rank has summed by itself
before were rounded there: unless these sums are exact, results differ by rounding between numbers
of ranks. Where all bits must agree, use [`incident_elements`](@ref). Collective.
"""
function add_from_ghosts!(placement::Placement, values::AbstractArray{Float64})
    summed = dense(values)
    check(placement, LibPNPBS.pnpbs_placement_add_from_ghosts(live(placement), places_of(values),
                                                              components_of(values), summed))
    return summed === values ? values : copyto!(values, summed)
end
