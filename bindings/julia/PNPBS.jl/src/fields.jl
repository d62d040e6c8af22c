# SPDX-License-Identifier: BSD-3-Clause
# Values of a solver at nodes: a vector with an entry for each node, or an array whose last index is
# that of the node. The other indices count components.

components_of(values::AbstractArray) = prod(size(values)[1:(end - 1)])
places_of(values::AbstractArray) = size(values, ndims(values))

# Returns the values without gaps in memory, as the library reads them.
dense(values::Array{Float64}) = values
dense(values::AbstractArray) = Array{Float64}(values)

"""
    update_ghosts!(placement, values) -> values

Updates the values at ghosts from their owners. `values` is a vector of `Float64` with an entry for
each node of this rank, followed by one for each ghost, or an array with that last index. On one
process there are no ghosts, and the call has no effect. Collective.

    u = zeros(node_count(placement) + ghost_count(placement))
    ...
    update_ghosts!(placement, u)
"""
function update_ghosts!(placement::Placement, values::AbstractArray{Float64})
    filled = dense(values)
    check(placement, LibPNPBS.pnpbs_placement_update_ghosts(live(placement), places_of(values),
                                                            components_of(values), filled))
    return filled === values ? values : copyto!(values, filled)
end

"""
    begin_update_ghosts(placement, values)
    end_update_ghosts!(placement, values) -> values

The two halves of [`update_ghosts!`](@ref), for a solver that computes while messages travel. The
first starts sending the values of this rank's nodes; `values` may be changed after it returns. The
second waits for the received values and fills the ghosts. A placement has at most one update in
progress; other calls are allowed in between. The first is collective; the second is local, and does
not wait for other ranks to end theirs.

    begin_update_ghosts(placement, u)
    multiply!(q, inner_rows, u)
    end_update_ghosts!(placement, u)
    multiply!(q, rows_with_ghosts, u)
"""
begin_update_ghosts, end_update_ghosts!

function begin_update_ghosts(placement::Placement, values::AbstractArray{Float64})
    check(placement,
          LibPNPBS.pnpbs_placement_begin_update_ghosts(live(placement), places_of(values),
                                                       components_of(values), dense(values)))
    return nothing
end

function end_update_ghosts!(placement::Placement, values::AbstractArray{Float64})
    filled = dense(values)
    check(placement,
          LibPNPBS.pnpbs_placement_end_update_ghosts(live(placement), places_of(values),
                                                     components_of(values), filled))
    return filled === values ? values : copyto!(values, filled)
end

"""
    sum_over_nodes(placement, values)

Sums a field over the nodes of all ranks: returns a number for a vector, and for an array with more
than one index an array of the sums of each component. It is the exact sum, rounded once, so it has
the same bits for any number of ranks and threads. NaN where a value is NaN or where there are
infinities of both signs; otherwise an infinity where a value is, or where the sum is beyond the
largest number. Entries after those of this rank's nodes, for its ghosts, are ignored. Collective.
"""
function sum_over_nodes(placement::Placement, values::AbstractArray{<:Real})
    sums = zeros(size(values)[1:(end - 1)])
    check(placement, LibPNPBS.pnpbs_placement_sum(live(placement), places_of(values),
                                                  components_of(values), dense(values), sums))
    return ndims(sums) == 0 ? sums[] : sums
end

"""
    dot_over_nodes(placement, x, y)

Computes the dot product of two fields over the nodes of all ranks, for each component: the sum of
the exact products, rounded once, otherwise as [`sum_over_nodes`](@ref). No product overflows or
underflows; one of an infinity and 0 is NaN. Collective.
"""
function dot_over_nodes(placement::Placement, x::AbstractArray{<:Real}, y::AbstractArray{<:Real})
    products = zeros(size(x)[1:(end - 1)])
    # Fields of different shapes get the length -1, which is an error on all ranks.
    n = components_of(x) == components_of(y) ? min(places_of(x), places_of(y)) : -1
    check(placement, LibPNPBS.pnpbs_placement_dot(live(placement), n, components_of(x), dense(x),
                                                  dense(y), products))
    return ndims(products) == 0 ? products[] : products
end
