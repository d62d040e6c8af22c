# SPDX-License-Identifier: BSD-3-Clause

"""
    Transfer(placement, values; order = 1)

A field on its way to other nodes: takes the values at the nodes that the placement has now, together
with these nodes and their triangles or tetrahedra, each rank its own. `values` is a vector with an
entry for each node of this rank, or an array whose last index is that of the node. The nodes may then
move, be replaced or change their ranks, and the placement may be closed. The field is linear on each
triangle or tetrahedron; beyond their rim, next to curved boundaries, it goes on as on the one behind
the nearest place of the rim. So fields that are linear stay what they are, and others change by a
part of the second order in d. With `order = 2` a polynomial of second order is fitted to the
neighbours of each node: then fields that are quadratic in the coordinates stay what they are, others
change by a part of the third order, and next to jumps they may leave the range of the values there
([`linear_nodes`](@ref) tells where that could not be done). A value that is not finite is a [`PNPBSError`](@ref) that names it.
Collective.

    transfer = Transfer(placement, u)
    set_spacing!(placement, d)
    run!(placement)
    u = at_nodes(transfer, placement)
    close(transfer)
"""
mutable struct Transfer
    handle::LibPNPBS.pnpbs_transfer
    context::Context
    shape::Dims  # of the values at one node
end

function Transfer(placement::Placement, values::AbstractArray{<:Real}; order::Integer = 1)
    order in (1, 2) || throw(ArgumentError("order is $order; 1 or 2 was expected"))
    context = placement.context
    handle = Ref{LibPNPBS.pnpbs_transfer}(C_NULL)
    create = order == 1 ? LibPNPBS.pnpbs_transfer_create : LibPNPBS.pnpbs_transfer_create_second_order
    check(context, create(live(placement), places_of(values), components_of(values), dense(values),
                          handle))
    transfer = Transfer(handle[], context, size(values)[1:(end - 1)])
    push!(context.children, transfer)
    return transfer
end

Base.isopen(transfer::Transfer) = transfer.handle != C_NULL

function Base.close(transfer::Transfer)
    isopen(transfer) || return nothing
    check(transfer.context, LibPNPBS.pnpbs_transfer_destroy(Ref(transfer.handle)))
    transfer.handle = C_NULL
    forget!(transfer.context, transfer)
    return nothing
end

Base.show(io::IO, transfer::Transfer) =
    print(io, "PNPBS.Transfer(", isopen(transfer) ? "of shape $(transfer.shape)" : "closed", ")")

function Base.ndims(transfer::Transfer)
    dim = Ref{Int32}(0)
    check(transfer.context, LibPNPBS.pnpbs_transfer_sizes(live(transfer), dim, C_NULL))
    return Int(dim[])
end

"""
    linear_nodes(transfer) -> Int

At how many nodes, on all ranks, a transfer of the second order has no polynomial of that order: they
had too few neighbours, or are on surfaces alone. -1 for one of the first order. Local.
"""
function linear_nodes(transfer::Transfer)
    count = Ref{Int64}(0)
    check(transfer.context, LibPNPBS.pnpbs_transfer_order(live(transfer), C_NULL, count))
    return Int(count[])
end

"""
    at_nodes(transfer, placement; conserve = false) -> Array{Float64}

The field at the nodes of this rank that a placement has now: the same bits for any number of ranks
and threads, then and now. A node where there was one before gets its value as it was. The placement
may be another one of the same context, in the same dimension. With `conserve` the same number is
added to the values of each component, so that the integral of the field that is linear on the
triangles or tetrahedra there are now is the integral that it had on those before. Collective.
"""
function at_nodes(transfer::Transfer, placement::Placement; conserve::Bool = false)
    n = node_count(placement)
    values = zeros(transfer.shape..., n)
    check(transfer.context, LibPNPBS.pnpbs_transfer_at_nodes(live(transfer), live(placement),
                                                             conserve, n, values))
    return values
end

"""
    at_points(transfer, points) -> Array{Float64}

The field at any points, `(dim, n)`, of which each rank asks those it wants, 0 or more. Collective.
"""
function at_points(transfer::Transfer, points::AbstractMatrix{<:Real})
    n = size(points, 2)
    values = zeros(transfer.shape..., n)
    # Of another dimension, no number of points at all: an error on all ranks.
    right = size(points, 1) == ndims(transfer)
    check(transfer.context, LibPNPBS.pnpbs_transfer_at_points(live(transfer), right ? n : -1,
                                                              dense(points), values))
    return values
end
