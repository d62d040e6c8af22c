# SPDX-License-Identifier: BSD-3-Clause
#
# A finite element solver on the library's nodes, over the ranks of an MPI program. It solves
# -Laplace u = 0 in the ring 0.5 <= r <= 1 with u = log r on both circles; the solution is log r
# everywhere. The row of a node follows from the triangles of its Delaunay star alone, so every rank
# assembles the rows of its own nodes without a mesh file and without messages.
# examples/c/laplace_ring is the same program in C and explains the expected results.
#
#   julia laplace_ring.jl [FOLDER]                one process
#   mpiexec -n 4 julia laplace_ring.jl [FOLDER]   with MPI.jl in the environment
#
# If a folder is given, every rank writes its piece of the solution into it; the folder must exist.
using PNPBS
using Printf

# The program runs on all ranks if MPI.jl is in the environment. Otherwise `comm` is nothing and
# this process has all nodes.
const with_mpi = Base.find_package("MPI") !== nothing
if with_mpi
    import MPI
end

const inner_radius, outer_radius, d = 0.5, 1.0, 0.03
const INNER_CIRCLE, OUTER_CIRCLE = 1, 2

# The mesh of this rank. Arrays over `all` hold the owned nodes first, then the ghosts, which are
# nearby nodes that other ranks own.
struct Mesh{C}
    comm::C
    owned::Int
    xy::Matrix{Float64}      # (2, all), all = owned + ghosts
    tags::Vector{Int32}      # [all]
    corners::Matrix{Int64}   # (3, triangles)
end

# The matrix rows of the owned nodes. Row i has a diagonal entry and one entry for each node of the
# star of node i, at offsets[i] .. offsets[i + 1] - 1.
struct StarMatrix
    offsets::Vector{Int64}
    columns::Vector{Int64}
    diagonal::Vector{Float64}
    values::Vector{Float64}
end

known_solution(x, y) = log(hypot(x, y))
known_solution(xy::Matrix, i) = known_solution(xy[1, i], xy[2, i])

# ---------------------------------------------------------------- from the library --------------
function get_mesh(placement, comm)
    own, others = nodes(placement), ghosts(placement)
    return Mesh(comm, node_count(placement), [own.points others.points], [own.tags; others.tags],
                triangles(placement))
end

# Returns the cotangent of the angle at node a in the counter-clockwise triangle of nodes a, b, c.
function cotangent(xy, a, b, c)
    bx, by = xy[1, b] - xy[1, a], xy[2, b] - xy[2, a]
    cx, cy = xy[1, c] - xy[1, a], xy[2, c] - xy[2, a]
    return (bx * cx + by * cy) / (bx * cy - by * cx)
end

# Assembles the rows of the owned nodes from their Delaunay stars. For linear elements the integral
# of grad phi_i . grad phi_j over a triangle is -1/2 times the cotangent of the angle opposite to
# the edge ij, and every row sums to zero. Collective.
function assemble(placement, mesh)
    star = stars(placement)
    offsets, columns = star.neighbours.offsets, star.neighbours.entries
    a = StarMatrix(offsets, columns, zeros(mesh.owned), zeros(length(columns)))
    for i in 1:mesh.owned, k in offsets[i]:(offsets[i + 1] - 1)
        star.triangle.entries[k] || continue        # a gap outside the domain
        next = k + 1 < offsets[i + 1] ? k + 1 : offsets[i]
        at_next = cotangent(mesh.xy, columns[next], i, columns[k]) / 2
        at_k = cotangent(mesh.xy, columns[k], columns[next], i) / 2
        a.values[k] -= at_next
        a.values[next] -= at_k
        a.diagonal[i] += at_next + at_k
    end
    return a
end

# ---------------------------------------------------------------- the solver --------------------
over_ranks(op, part, comm) = MPI.Allreduce(part, op, comm)
over_ranks(op, part, ::Nothing) = part
sum_over_ranks(mesh, part) = over_ranks(+, part, mesh.comm)

function dot(mesh, x, y)
    part = 0.0
    for i in 1:mesh.owned
        part += x[i] * y[i]
    end
    return sum_over_ranks(mesh, part)
end

# Computes y = A x at the owned nodes. Updates the ghosts of x first. Collective.
function multiply!(y, a, x, mesh, placement)
    update_ghosts!(placement, x)
    for i in 1:mesh.owned
        s = a.diagonal[i] * x[i]
        for k in a.offsets[i]:(a.offsets[i + 1] - 1)
            s += a.values[k] * x[a.columns[k]]
        end
        y[i] = s
    end
    return y
end

# Solves A u = 0 at the inner nodes by conjugate gradients. Values of u on the boundary do not
# change, because the residual is set to zero there. Collective.
function solve!(u, a, mesh, placement)
    inner = mesh.tags[1:mesh.owned] .== 0
    q = zeros(mesh.owned)
    r = -inner .* multiply!(q, a, u, mesh, placement)
    p = zero(u)
    p[1:mesh.owned] = r
    rr = dot(mesh, r, r)
    enough = 1e-20 * rr
    while rr > enough
        multiply!(q, a, p, mesh, placement)
        alpha = rr / dot(mesh, p, q)
        for i in 1:mesh.owned
            u[i] += alpha * p[i]
            r[i] = inner[i] ? r[i] - alpha * q[i] : 0.0
        end
        rr_before, rr = rr, dot(mesh, r, r)
        for i in 1:mesh.owned
            p[i] = r[i] + rr / rr_before * p[i]
        end
    end
    return update_ghosts!(placement, u)
end

# ---------------------------------------------------------------- the results -------------------
function largest_error(mesh, u)
    part = maximum(abs(u[i] - known_solution(mesh.xy, i)) for i in 1:mesh.owned)
    return over_ranks(max, part, mesh.comm)
end

# Returns the root of the integral of (u - log r)^2, computed with the midpoints of the edges of
# each triangle. Collective.
function l2_error(mesh, u)
    part = 0.0
    for t in 1:size(mesh.corners, 2)
        a, b, c = mesh.corners[:, t]
        area = triangle_area(mesh.xy, a, b, c)
        for (i, j) in ((a, b), (b, c), (c, a))
            x, y = (mesh.xy[1, i] + mesh.xy[1, j]) / 2, (mesh.xy[2, i] + mesh.xy[2, j]) / 2
            part += area / 3 * ((u[i] + u[j]) / 2 - known_solution(x, y))^2
        end
    end
    return sqrt(sum_over_ranks(mesh, part))
end

triangle_area(xy, a, b, c) = ((xy[1, b] - xy[1, a]) * (xy[2, c] - xy[2, a]) -
                              (xy[2, b] - xy[2, a]) * (xy[1, c] - xy[1, a])) / 2

# Returns the integral of the normal derivative of u over the outer circle, which is the sum of A u
# over the nodes there. Collective.
function outer_flux(a, u, mesh, placement)
    q = multiply!(zeros(mesh.owned), a, u, mesh, placement)
    return sum_over_ranks(mesh, sum(q[mesh.tags[1:mesh.owned] .== OUTER_CIRCLE]))
end

function print_results(a, u, mesh, placement)
    area = pi * (outer_radius^2 - inner_radius^2)
    bound = d^2 / 6 / inner_radius^2
    n = sum_over_ranks(mesh, mesh.owned)
    n_triangles = sum_over_ranks(mesh, size(mesh.corners, 2))
    boundary = sum_over_ranks(mesh, count(!=(0), mesh.tags[1:mesh.owned]))
    flux = outer_flux(a, u, mesh, placement)
    largest, l2 = largest_error(mesh, u), l2_error(mesh, u)
    my_rank(mesh.comm) == 0 || return
    @printf("nodes: %d, expected about %.0f\n", n, 2 * area / sqrt(3) / d^2 + boundary / 2)
    @printf("triangles: %d, expected %d\n", n_triangles, 2n - boundary)
    @printf("flux through the outer circle: %.5f, expected about %.5f\n", flux, 2pi)
    @printf("largest error: %.8f, expected at most %.8f\n", largest, bound)
    @printf("L2 error: %.8f, expected at most %.8f\n", l2, bound * sqrt(area))
end

my_rank(comm) = MPI.Comm_rank(comm)
my_rank(::Nothing) = 0

# Writes FOLDER/laplace_ring_<rank>.vtk for examples/draw_pieces.py or ParaView.
function write_piece(folder, mesh, u)
    n, m = size(mesh.xy, 2), size(mesh.corners, 2)
    errors = [abs(u[i] - known_solution(mesh.xy, i)) for i in 1:n]
    path = joinpath(folder, "laplace_ring_" * lpad(my_rank(mesh.comm), 3, '0') * ".vtk")
    open(path, "w") do file
        println(file, "# vtk DataFile Version 3.0\nlaplace_ring\nASCII\nDATASET UNSTRUCTURED_GRID")
        println(file, "POINTS $n double")
        foreach(i -> @printf(file, "%.9g %.9g 0\n", mesh.xy[1, i], mesh.xy[2, i]), 1:n)
        println(file, "CELLS $m $(4m)")
        foreach(t -> println(file, "3 ", join(mesh.corners[:, t] .- 1, " ")), 1:m)
        println(file, "CELL_TYPES $m\n", repeat("5\n", m), "POINT_DATA $n")
        for (name, values) in (("solution", u), ("error", errors))
            println(file, "SCALARS $name double\nLOOKUP_TABLE default")
            foreach(value -> @printf(file, "%.9g\n", value), values)
        end
    end
end

# ---------------------------------------------------------------- the program -------------------
function main(comm, folder)
    context = comm === nothing ? Context() : Context(comm)    # or any other communicator
    ring = Domain(context)
    add_arc!(ring, (0, 0), inner_radius; tag = INNER_CIRCLE)
    add_arc!(ring, (0, 0), outer_radius; tag = OUTER_CIRCLE)
    placement = Placement(ring)
    set_spacing!(placement, d)
    run!(placement)

    mesh = get_mesh(placement, comm)
    a = assemble(placement, mesh)
    u = [tag == 0 ? 0.0 : known_solution(mesh.xy, i) for (i, tag) in enumerate(mesh.tags)]
    solve!(u, a, mesh, placement)
    print_results(a, u, mesh, placement)
    folder === nothing || write_piece(folder, mesh, u)
    close(context)
end

with_mpi && MPI.Init()
main(with_mpi ? MPI.COMM_WORLD : nothing, isempty(ARGS) ? nothing : ARGS[1])
with_mpi && MPI.Finalize()
