# SPDX-License-Identifier: BSD-3-Clause

"""
    Transfer(placement, values; order = 1)

Transfers a field to a later set of nodes: copies the values at the current nodes of the placement,
with these nodes and their triangles or tetrahedra, each rank its own. `values` is a vector with an
entry for each node of this rank, or an array whose last index is that of the node. The nodes may
then move, be replaced or change their ranks, and the placement may be closed. The field is linear
on each triangle or tetrahedron; beyond their boundary, next to curved boundaries, it is
extrapolated from the one at the nearest point of that boundary. Linear fields are thus preserved,
and others change by a term of second order in d. With `order = 2` a quadratic polynomial is fitted
to the neighbours of each node: then quadratic fields are preserved, others change by a term of
third order, and next to jumps they may leave the range of the values there ([`linear_nodes`](@ref)
returns the number of nodes where this was not possible). A value that is not finite is a
[`PNPBSError`](@ref) that names it. Collective.

    transfer = Transfer(placement, u)
    set_spacing!(placement, d)
    run!(placement)
    u = at_nodes(transfer, placement)
    close(transfer)
"""
mutable struct Transfer
    handle::LibPNPBS.pnpbs_transfer
    context::Context
    shape::Dims  # shape of the values at one node
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

Returns the number of nodes, on all ranks, at which a second-order transfer has no quadratic
polynomial: they had too few neighbours, or are on surfaces alone. -1 for a first-order one. Local.
"""
function linear_nodes(transfer::Transfer)
    count = Ref{Int64}(0)
    check(transfer.context, LibPNPBS.pnpbs_transfer_order(live(transfer), C_NULL, count))
    return Int(count[])
end

"""
    at_nodes(transfer, placement; conserve = false) -> Array{Float64}

Evaluates the field at the nodes of this rank that a placement has now: the same bits for any number
of ranks and threads, at creation and now. A node at the position of an earlier one gets its value
unchanged. The placement may be another one of the same context, in the same dimension. With
`conserve` the same number is added to the values of each component, so that the integral of the
field that is linear on the current triangles or tetrahedra equals its integral on the previous
ones; on a sphere that is the sum of the triangles' areas along it times the means of their corners'
values. Collective.
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

Evaluates the field at arbitrary points, `(dim, n)`; each rank passes its own, 0 or more.
Collective.
"""
function at_points(transfer::Transfer, points::AbstractMatrix{<:Real})
    n = size(points, 2)
    values = zeros(transfer.shape..., n)
    # Points of another dimension get the number -1, which is an error on all ranks.
    right = size(points, 1) == ndims(transfer)
    check(transfer.context, LibPNPBS.pnpbs_transfer_at_points(live(transfer), right ? n : -1,
                                                              dense(points), values))
    return values
end
