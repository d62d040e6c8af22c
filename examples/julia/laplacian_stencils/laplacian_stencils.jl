# SPDX-License-Identifier: BSD-3-Clause
#
# A meshless Laplacian on the adjacency lists, and a solution of Poisson's equation with it, on any
# number of ranks. The stencil of a node has weights for the node and its adjacency list by RBF-FD.
# They yield the Laplacian of the interpolant by polyharmonic splines |x - x_j|^5 around these nodes
# plus polynomials up to a degree (N. Flyer, B. Fornberg, V. Bayona, G. Barnett, "On the role of
# polynomials in RBF-FD approximations: I. Interpolation and accuracy", J. Comput. Phys. 321 (2016)
# 21-38).
#
# Results to check: the formula is exact for polynomials of degree m, up to rounding, at every node.
# The Laplacian of a smooth function converges with order m - 1, which is 3 inside and 2 on the
# boundary. The solution of Poisson's equation converges with order 4, because the errors of the
# formula change sign from node to node and mostly cancel.
#
#   julia laplacian_stencils.jl [FOLDER]                one process
#   mpiexec -n 4 julia laplacian_stencils.jl [FOLDER]   with MPI.jl in the environment
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
# u is a dipole at the centre of the hole, which is harmonic, plus a wave. f is its Laplacian.
u_exact(x, y) = 0.3 * x / (x^2 + y^2) + sin(2y + 1)
f_exact(x, y) = -4 * sin(2y + 1)
at_points(f, points) = [f(points[1, i], points[2, i]) for i in 1:size(points, 2)]

# Places nodes in a rounded triangle with a hole of radius 1/2. The spacing is 0.4 h at the hole and
# h at a distance of 1 from it. The adjacency lists must be long enough for the polynomials, also at
# the boundary, where they are one-sided. A radius of 3 spacings results in at least 21 neighbours
# inside and 14 on the boundary.
function place(context, h)
    domain = Domain(context)
    add_curve!(domain, 0, 2pi) do t
        r = 1.5 .+ 0.2 .* cos.(3 .* t)
        [r .* cos.(t) r .* sin.(t)]'
    end
    add_arc!(domain, (0, 0), 0.5; tag = 2)
    placement = Placement(domain; adjacency_radius = 3)
    set_spacing!(placement) do x
        h .* (0.4 .+ 0.6 .* (hypot.(x[1, :], x[2, :]) .- 0.5))
    end
    run!(placement) === :ok || error("the bubbles did not come to rest")
    return placement
end

# ---------------------------------------------------------------- stencils ----------------------
# The degree on the boundary is lower by one. A list of radius 3 contains little more than four rows
# of nodes there, and a polynomial of degree 4 can vanish on four rows.
degree_at(tag) = tag == 0 ? 4 : 3

# Return the exponents (a, b) of the monomials x^a y^b up to a degree, and the Laplacian of a
# monomial at 0.
exponents(degree) = [(total - b, b) for total in 0:degree for b in 0:total]
laplacian_at_0((a, b)) = (a, b) in ((2, 0), (0, 2)) ? 2.0 : 0.0

# The stencils of the owned nodes. `centre[i]` is the weight of node i in its own stencil, and
# `weights` has a weight for each entry of the adjacency lists.
struct Stencils
    lists::CompressedRows{Int64}
    centre::Vector{Float64}
    weights::Vector{Float64}
end

# Computes the weights w of a stencil whose first node is at 0. They and the multipliers l solve
#   [ phi(|x_k - x_l|)  p_j(x_k) ] [ w ]   [ Laplacian of phi(|x - x_k|) at 0 ]
#   [ p_j(x_l)          0        ] [ l ] = [ Laplacian of p_j at 0            ]
# with phi(r) = r^5, whose Laplacian is 25 r^3.
function weights_at_0(x::Vector{Float64}, y::Vector{Float64}, powers)
    n, terms = length(x), length(powers)
    n > terms || error("$(n - 1) neighbours are too few for $terms polynomials: raise the option ",
                       "adjacency_radius, or lower the degree")
    matrix = zeros(n + terms, n + terms)
    right = zeros(n + terms)
    for k in 1:n
        for l in 1:n
            matrix[l, k] = sqrt((x[k] - x[l])^2 + (y[k] - y[l])^2)^5
        end
        right[k] = 25 * sqrt(x[k]^2 + y[k]^2)^3
        for (j, (a, b)) in enumerate(powers)
            matrix[k, n + j] = matrix[n + j, k] = x[k]^a * y[k]^b
        end
    end
    right[(n + 1):end] .= laplacian_at_0.(powers)
    return (matrix \ right)[1:n]
end

# Returns the positions of node i and of its list, relative to node i and in units of its spacing.
# Rounding errors do not depend on the spacing then.
function seen_from(i, list, points, d)
    nodes = [i; list]
    x = [(points[1, k] - points[1, i]) / d for k in nodes]
    y = [(points[2, k] - points[2, i]) / d for k in nodes]
    return x, y
end

# Computes the stencils, and their largest error on the polynomials for which they must be exact.
function laplacian_stencils(points, spacing, tags, lists)
    stencils = Stencils(lists, zeros(length(lists)), zeros(length(lists.entries)))
    largest_error = 0.0
    for i in eachindex(lists)
        powers = exponents(degree_at(tags[i]))
        x, y = seen_from(i, lists[i], points, spacing[i])
        w = weights_at_0(x, y, powers)
        for (a, b) in powers
            value = sum(w .* x .^ a .* y .^ b)
            largest_error = max(largest_error, abs(value - laplacian_at_0((a, b))))
        end
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
# Solves Laplacian u = f at the inner nodes, starting from the values of u. Values on the boundary
# do not change, because the residual is set to zero there. The matrix is not symmetric, so the
# method is BiCGSTAB (H. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631-644), with rows
# divided by their diagonal. Collective.
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

    # Values on the boundary are given. The solver starts from zero inside.
    u = [own.tags .!= 0; falses(length(others.ids))] .* exact
    solve_poisson!(u, f, inner, stencils, placement, comm)
    errors = u .- exact
    isempty(folder) || write_piece(folder, comm, points, triangles(placement), u, abs.(errors))
    close(placement)
    return (nodes = over_ranks(+, n, comm), on_polynomials = over_ranks(max, largest_error, comm),
            inside = mean_error(laplacian_errors, inner, comm),
            on_boundary = mean_error(laplacian_errors, .!inner, comm),
            mean = mean_error(errors[1:n], inner, comm),
            largest = over_ranks(max, maximum(abs, errors[1:n]), comm))
end

# ---------------------------------------------------------------- pictures ----------------------
my_rank(comm) = MPI.Comm_rank(comm)
my_rank(::Nothing) = 0

# Writes nodes, ghosts, triangles and fields of this rank in VTK's legacy format. Local.
function write_piece(folder, comm, points, corners, u, errors)
    path = joinpath(folder, "laplacian_stencils_" * lpad(my_rank(comm), 3, '0') * ".vtk")
    open(path, "w") do file
        n, m = size(points, 2), size(corners, 2)
        println(file, "# vtk DataFile Version 3.0\nlaplacian_stencils\nASCII\n",
                "DATASET UNSTRUCTURED_GRID\nPOINTS $n double")
        foreach(i -> @printf(file, "%.9g %.9g 0\n", points[1, i], points[2, i]), 1:n)
        println(file, "CELLS $m $(4m)")
        foreach(k -> println(file, "3 ", join(corners[:, k] .- 1, " ")), 1:m)
        println(file, "CELL_TYPES $m\n", repeat("5\n", m), "POINT_DATA $n")
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
    spacings = [0.1, 0.07, 0.05]
    results = [solve(context, comm, h, h == last(spacings) ? folder : "") for h in spacings]
    close(context)
    my_rank(comm) == 0 || return

    println("                Laplacian, rms error     solution, error")
    println("    h   nodes   inside   on boundary     rms       largest")
    for (h, r) in zip(spacings, results)
        @printf("%6.3f %6d   %.2e   %.2e      %.2e   %.2e\n", h, r.nodes, r.inside, r.on_boundary,
                r.mean, r.largest)
    end
    order(error) = log(error(results[1]) / error(results[end])) / log(spacings[1] / spacings[end])
    @printf("largest error on polynomials: %.1e, expected at most 1e-10\n",
            maximum(r.on_polynomials for r in results))
    @printf("order of the Laplacian inside: %.2f, expected at least 2.8\n", order(r -> r.inside))
    @printf("order of the Laplacian on the boundary: %.2f, expected at least 1.7\n",
            order(r -> r.on_boundary))
    @printf("order of the solution: %.2f, expected at least 3.5\n", order(r -> r.mean))
end

with_mpi && MPI.Init()
main(with_mpi ? MPI.COMM_WORLD : nothing, isempty(ARGS) ? "" : ARGS[1])
with_mpi && MPI.Finalize()
