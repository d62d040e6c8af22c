# SPDX-License-Identifier: BSD-3-Clause
#
# A meshless Laplacian in an asteroid, and a solution of Poisson's equation with it, on any number
# of ranks. The stencil of a node has weights for the node and its adjacency list. Of all weights
# that are exact for the Laplacian of polynomials up to a degree, it has those with the least
# weighted sum of squares, in which distant nodes count more (generalized finite differences,
# T. Liszka, J. Orkisz, Comput. Struct. 11 (1980) 83-95).
#
# Results to check: the formula is exact for polynomials of degree m, up to rounding, at every node.
# The Laplacian of a smooth function converges with order m - 1, which is 2 inside and 1 on the
# surface. The solution of Poisson's equation converges with order 2.
#
#   julia asteroid_stencils.jl [FOLDER]                one process
#   mpiexec -n 4 julia asteroid_stencils.jl [FOLDER]   with MPI.jl in the environment
#
# If a folder is given, every rank writes its piece of the finest solution; the folder must exist.
using LinearAlgebra
using PNPBS
using Printf

# The program runs on all ranks if MPI.jl is in the environment. Otherwise `comm` is nothing and
# this process has all nodes.
const with_mpi = Base.find_package("MPI") !== nothing
if with_mpi
    import MPI
end

# ---------------------------------------------------------------- the problem -------------------
# The Laplacian of u is f.
u_exact(x, y, z) = sin(4x + 1) * cos(3y) * exp(2z)
f_exact(x, y, z) = -21 * u_exact(x, y, z)
at_points(f, points) = [f(points[1, i], points[2, i], points[3, i]) for i in 1:size(points, 2)]

# The asteroid 433 Eros, scaled to a length of 1.6. The adjacency lists must be long enough for the
# polynomials, also at the surface, where they are one-sided. A radius of 2 spacings results in
# about 50 neighbours inside and 25 on the surface.
const asteroid = joinpath(@__DIR__, "..", "..", "data", "eros.off")

function place(context, h)
    domain = read_surface!(Domain(context; dim = 3), asteroid)
    placement = Placement(domain; adjacency_radius = 2)
    set_spacing!(placement, h)
    run!(placement)
    return placement
end

# ---------------------------------------------------------------- stencils ----------------------
# The degree on the surface is lower by one. A list of radius 2 contains little more than three
# layers of nodes there, and a polynomial of degree 3 can vanish on three layers.
degree_at(tag) = tag == 0 ? 3 : 2

# Return the exponents (a, b, c) of the monomials x^a y^b z^c up to a degree, and the Laplacian of a
# monomial at 0.
function exponents(degree)
    return [(total - b - c, b, c) for total in 0:degree for b in 0:total for c in 0:(total - b)]
end
laplacian_at_0(powers) = sum(powers) == 2 && maximum(powers) == 2 ? 2.0 : 0.0

# The stencils of the owned nodes. `centre[i]` is the weight of node i in its own stencil, and
# `weights` has a weight for each entry of the adjacency lists.
struct Stencils
    lists::CompressedRows{Int64}
    centre::Vector{Float64}
    weights::Vector{Float64}
end

# Evaluates the monomials at the nodes: one row per node, one column per monomial.
function polynomials(x, powers)
    return [x[1, k]^a * x[2, k]^b * x[3, k]^c for k in 1:size(x, 2), (a, b, c) in powers]
end

# Computes the weights w of a stencil whose first node is at 0. P holds the monomials at the nodes,
# b their Laplacians at 0. Of the solutions of P' w = b, w is the one with the least sum of (w /
# s)^2. With the QR factorization S P = Q R, where S is the diagonal matrix of s, it is S Q (R' \
# b).
function weights_at_0(x::Matrix{Float64}, powers)
    n, terms = size(x, 2), length(powers)
    n > terms || error("$(n - 1) neighbours are too few for $terms polynomials: raise the option ",
                       "adjacency_radius, or lower the degree")
    s = [exp(-0.5 * (x[1, k]^2 + x[2, k]^2 + x[3, k]^2)) for k in 1:n]
    factors = qr(s .* polynomials(x, powers))
    return s .* (Matrix(factors.Q) * (factors.R' \ laplacian_at_0.(powers)))
end

# Returns the positions of node i and of its list, relative to node i and in units of its spacing.
# Rounding errors do not depend on the spacing then.
function seen_from(i, list, points, d)
    nodes = [i; list]
    return [(points[row, k] - points[row, i]) / d for row in 1:3, k in nodes]
end

# Computes the stencils, and their largest error on the polynomials for which they must be exact.
function laplacian_stencils(points, spacing, tags, lists)
    stencils = Stencils(lists, zeros(length(lists)), zeros(length(lists.entries)))
    largest_error = 0.0
    for i in eachindex(lists)
        powers = exponents(degree_at(tags[i]))
        x = seen_from(i, lists[i], points, spacing[i])
        w = weights_at_0(x, powers)
        errors = polynomials(x, powers)' * w .- laplacian_at_0.(powers)
        largest_error = max(largest_error, maximum(abs, errors))
        stencils.centre[i] = w[1] / spacing[i]^2
        stencils.weights[lists.offsets[i]:(lists.offsets[i + 1] - 1)] = w[2:end] ./ spacing[i]^2
    end
    return stencils, largest_error
end

# Computes the Laplacian at the owned nodes of a function that is given at nodes and ghosts.
function laplacian!(values, stencils, u)
    offsets, neighbours = stencils.lists.offsets, stencils.lists.entries
    for i in eachindex(values)
        s = stencils.centre[i] * u[i]
        for k in offsets[i]:(offsets[i + 1] - 1)
            s += stencils.weights[k] * u[neighbours[k]]
        end
        values[i] = s
    end
    return values
end

# ---------------------------------------------------------------- over the ranks ----------------
over_ranks(op, value, comm) = MPI.Allreduce(value, op, comm)
over_ranks(op, value, ::Nothing) = value

# Returns the dot product of two fields over the nodes of all ranks. The first n values are those at
# the owned nodes; values at ghosts may follow. Collective.
function dot_over_ranks(v, w, n, comm)
    s = 0.0
    for i in 1:n
        s += v[i] * w[i]
    end
    return over_ranks(+, s, comm)
end

# ---------------------------------------------------------------- Poisson's equation ------------
# Solves Laplacian u = f at the inner nodes, starting from the values of u. Values on the surface do
# not change, because the residual is set to zero there. The matrix is not symmetric, so the method
# is BiCGSTAB (H. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631-644), with rows divided by
# their diagonal. Collective.
function solve_poisson!(u, f, inner, stencils, placement, comm; tolerance = 1e-12, most = 2000)
    n = length(inner)
    scale = [inner[i] ? 1 / stencils.centre[i] : 0.0 for i in 1:n]
    apply!(out, v) = (laplacian!(out, stencils, update_ghosts!(placement, v)); out .*= scale)
    dot(v, w) = dot_over_ranks(v, w, n, comm)

    r = scale .* f[1:n] .- apply!(zeros(n), u)
    shadow, Ap, As = copy(r), zeros(n), zeros(n)
    p, s = zero(u), zero(u)
    rho, alpha, omega = 1.0, 1.0, 1.0
    goal = tolerance^2 * dot(r, r)
    for _ in 1:most
        rho_before, rho = rho, dot(shadow, r)
        beta = rho / rho_before * alpha / omega
        for i in 1:n
            p[i] = r[i] + beta * (p[i] - omega * Ap[i])
        end
        apply!(Ap, p)
        alpha = rho / dot(shadow, Ap)
        for i in 1:n
            s[i] = r[i] - alpha * Ap[i]
        end
        apply!(As, s)
        omega = dot(As, s) / dot(As, As)
        for i in 1:n
            u[i] += alpha * p[i] + omega * s[i]
            r[i] = s[i] - omega * As[i]
        end
        dot(r, r) <= goal && return update_ghosts!(placement, u)
    end
    error("BiCGSTAB did not converge in $most steps")
end

# ---------------------------------------------------------------- one spacing -------------------
# Returns the root mean square of the errors over the chosen nodes of all ranks. Collective.
function mean_error(errors, chosen, comm)
    square = over_ranks(+, sum(abs2, errors[chosen]), comm)
    return sqrt(square / over_ranks(+, count(chosen), comm))
end

function solve(context, comm, h, folder)
    placement = place(context, h)
    own, others = nodes(placement), ghosts(placement)
    points = [own.points others.points]          # owned nodes, then ghosts
    n, inner = length(own.ids), own.tags .== 0
    stencils, largest_error = laplacian_stencils(points, own.spacing, own.tags,
                                                 adjacency(placement))
    exact, f = at_points(u_exact, points), at_points(f_exact, points)
    laplacian_errors = laplacian!(zeros(n), stencils, exact) .- f[1:n]

    # Values on the surface are given. The solver starts from zero inside.
    u = [own.tags .!= 0; falses(length(others.ids))] .* exact
    solve_poisson!(u, f, inner, stencils, placement, comm)
    errors = u .- exact
    isempty(folder) || write_piece(folder, comm, points, tetrahedra(placement), u, abs.(errors))
    close(placement)
    return (nodes = over_ranks(+, n, comm), on_polynomials = over_ranks(max, largest_error, comm),
            inside = mean_error(laplacian_errors, inner, comm),
            on_surface = mean_error(laplacian_errors, .!inner, comm),
            mean = mean_error(errors[1:n], inner, comm),
            largest = over_ranks(max, maximum(abs, errors[1:n]), comm))
end

# ---------------------------------------------------------------- pictures ----------------------
my_rank(comm) = MPI.Comm_rank(comm)
my_rank(::Nothing) = 0

# Writes nodes, ghosts, tetrahedra and fields of this rank in VTK's legacy format. Local.
function write_piece(folder, comm, points, corners, u, errors)
    path = joinpath(folder, "asteroid_stencils_" * lpad(my_rank(comm), 3, '0') * ".vtk")
    open(path, "w") do file
        n, m = size(points, 2), size(corners, 2)
        println(file, "# vtk DataFile Version 3.0\nasteroid_stencils\nASCII\n",
                "DATASET UNSTRUCTURED_GRID\nPOINTS $n double")
        foreach(i -> @printf(file, "%.9g %.9g %.9g\n", points[:, i]...), 1:n)
        println(file, "CELLS $m $(5m)")
        foreach(k -> println(file, "4 ", join(corners[:, k] .- 1, " ")), 1:m)
        println(file, "CELL_TYPES $m\n", repeat("10\n", m), "POINT_DATA $n")
        for (name, values) in (("solution", u), ("error", errors))
            println(file, "SCALARS $name double\nLOOKUP_TABLE default")
            foreach(value -> @printf(file, "%.9g\n", value), values)
        end
    end
end

# ---------------------------------------------------------------- several spacings --------------
function main(comm, folder)
    BLAS.set_num_threads(1)
    context = comm === nothing ? Context() : Context(comm)
    spacings = [0.08, 0.06, 0.045]
    results = [solve(context, comm, h, h == last(spacings) ? folder : "") for h in spacings]
    close(context)
    my_rank(comm) == 0 || return

    println("                Laplacian, rms error     solution, error")
    println("    h   nodes   inside   on surface      rms       largest")
    for (h, r) in zip(spacings, results)
        @printf("%6.3f %6d   %.2e   %.2e      %.2e   %.2e\n", h, r.nodes, r.inside, r.on_surface,
                r.mean, r.largest)
    end
    order(error) = log(error(results[1]) / error(results[end])) / log(spacings[1] / spacings[end])
    @printf("largest error on polynomials: %.1e, expected at most 1e-10\n",
            maximum(r.on_polynomials for r in results))
    @printf("order of the Laplacian inside: %.2f, expected at least 1.7\n", order(r -> r.inside))
    @printf("order of the Laplacian on the surface: %.2f, expected at least 0.8\n",
            order(r -> r.on_surface))
    @printf("order of the solution: %.2f, expected at least 1.7\n", order(r -> r.mean))
end

with_mpi && MPI.Init()
main(with_mpi ? MPI.COMM_WORLD : nothing, isempty(ARGS) ? "" : ARGS[1])
with_mpi && MPI.Finalize()
