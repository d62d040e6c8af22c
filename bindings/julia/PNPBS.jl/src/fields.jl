# SPDX-License-Identifier: BSD-3-Clause
# Fields: values at nodes. A field is a vector with an entry for each node, or an array whose last
# index is that of the node; the other indices are those of components.

components_of(values::AbstractArray) = prod(size(values)[1:(end - 1)])
places_of(values::AbstractArray) = size(values, ndims(values))

# Returns a contiguous array of Float64, which is a copy if necessary.
dense(values::Array{Float64}) = values
dense(values::AbstractArray) = Array{Float64}(values)

"""
    update_ghosts!(placement, values) -> values

Updates the values at ghosts from their owners. `values` is a vector of `Float64` with an entry for
each node of this rank, followed by one for each ghost, or an array whose last index is that of the
node or ghost. It is changed in place. On one process there are no ghosts, and the call has no
effect. Throws `:error_argument` for a wrong number of entries. Collective.

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

Begin and end an update of ghosts, for a solver that computes while messages are being sent.
`begin_update_ghosts` copies the values of the nodes of this rank and starts sending them; `values`
may be changed afterwards. `end_update_ghosts!` waits for the received values and fills the ghosts.
A placement has at most one update in progress; other calls are allowed in between.
`begin_update_ghosts` is collective. `end_update_ghosts!` is local and does not wait for other ranks
to end their updates. Both throw `:error_state` in the wrong order.

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

Sums a field over the nodes of all ranks. Returns a number for a vector, and otherwise an array with
the sum of each component. The sum is exact and rounded once, so its bits do not depend on the
number of ranks and threads. It is NaN if a value is NaN or if there are infinities of both signs.
It is infinite if a value is, or if the sum exceeds the largest number. Entries for ghosts are
ignored. Collective.
"""
function sum_over_nodes(placement::Placement, values::AbstractArray{<:Real})
    sums = zeros(size(values)[1:(end - 1)])
    check(placement, LibPNPBS.pnpbs_placement_sum(live(placement), places_of(values),
                                                  components_of(values), dense(values), sums))
    return ndims(sums) == 0 ? sums[] : sums
end

"""
    dot_over_nodes(placement, x, y)

Computes the dot product of two fields over the nodes of all ranks, for each component. It is the
sum of the exact products, rounded once, with the properties of [`sum_over_nodes`](@ref). Products
do not overflow or underflow; the product of an infinity and 0 is NaN. Both fields must have the
same size, or the call throws `:error_argument`. Collective.
"""
function dot_over_nodes(placement::Placement, x::AbstractArray{<:Real}, y::AbstractArray{<:Real})
    products = zeros(size(x)[1:(end - 1)])
    # For different sizes the invalid length -1 makes the library report an error on all ranks.
    n = components_of(x) == components_of(y) ? min(places_of(x), places_of(y)) : -1
    check(placement, LibPNPBS.pnpbs_placement_dot(live(placement), n, components_of(x), dense(x),
                                                  dense(y), products))
    return ndims(products) == 0 ? products[] : products
end
