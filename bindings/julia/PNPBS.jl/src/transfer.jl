# SPDX-License-Identifier: BSD-3-Clause

"""
    Transfer(placement, values; order = 1)

Creates a transfer of a field to later sets of nodes. It holds copies of the values at the current
nodes of a placement, of these nodes, and of their triangles or tetrahedra, each rank its own. The
nodes may then move, be replaced or change their ranks, and the placement may be closed. Collective.

- `values`: a vector with an entry for each node of this rank, or an array whose last index is that
  of the node.
- `order`: 1 or 2. With 1 the field is linear on each triangle or tetrahedron. Beyond their
  boundary, next to curved boundaries, it is extrapolated from the element at the nearest point of
  that boundary. Linear fields are preserved, and others change by a term of second order in d. With
  2 a quadratic polynomial is fitted to the neighbours of each node: quadratic fields are preserved,
  and others change by a term of third order. Next to jumps such a field may leave the range of the
  values. [`linear_nodes`](@ref) returns the number of nodes without a polynomial.

Throws a [`PNPBSError`](@ref) that names the value if a value is not finite.

    transfer = Transfer(placement, u)
    set_spacing!(placement, d)
    run!(placement)
    u = at_nodes(transfer, placement)
    close(transfer)
"""
mutable struct Transfer
    handle::LibPNPBS.pnpbs_transfer
    context::Context
    shape::Dims  # size of the values at one node
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
polynomial, because they have too few neighbours or lie on surfaces alone. Returns -1 for a
first-order transfer. Local.
"""
function linear_nodes(transfer::Transfer)
    count = Ref{Int64}(0)
    check(transfer.context, LibPNPBS.pnpbs_transfer_order(live(transfer), C_NULL, count))
    return Int(count[])
end

"""
    at_nodes(transfer, placement; conserve = false) -> Array{Float64}

Evaluates the field at the current nodes of this rank of a placement. The placement may be another
one of the same context and dimension. A node at the position of an earlier one has its value
unchanged. The bits do not depend on the number of ranks and threads, at creation and now. With
`conserve` one number per component is added everywhere, so that the integral of the field on the
current triangles or tetrahedra equals that on the previous ones. On a sphere the integral is the
sum of the areas of the triangles along it times the means of the values at their corners.
Collective.
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

Evaluates the field at points, `(dim, n)`. Each rank passes its own points, or none. Throws
`:error_argument` for coordinates that are not finite. Collective.
"""
function at_points(transfer::Transfer, points::AbstractMatrix{<:Real})
    n = size(points, 2)
    values = zeros(transfer.shape..., n)
    # For another dimension the invalid number -1 makes the library report an error on all ranks.
    right = size(points, 1) == ndims(transfer)
    check(transfer.context, LibPNPBS.pnpbs_transfer_at_points(live(transfer), right ? n : -1,
                                                              dense(points), values))
    return values
end
