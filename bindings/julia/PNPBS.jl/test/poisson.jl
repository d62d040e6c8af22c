# SPDX-License-Identifier: BSD-3-Clause
# Poisson's equation with a known solution, by linear finite elements on distributed meshes of one
# rank: on the plain arrays, in Ferrite and in Gridap, with quadrature of second order. A second
# solve uses an adapted spacing. The problem is that of examples/c/petsc_poisson.
# usage as a program: julia poisson.jl [FILE D]; without arguments a square and a box are used
using LinearAlgebra
using PNPBS
using SparseArrays

# The installed packages of these. Julia 1.9 and later load the extensions automatically if the
# packages come from a project.
const GRID_PACKAGES = filter(name -> Base.find_package(name) !== nothing, ["Ferrite", "Gridap"])

has_extension(name) = isdefined(Base, :get_extension) &&
                      Base.get_extension(PNPBS, Symbol("PNPBS", name, "Ext")) !== nothing
load_extension(name) = has_extension(name) || include("../ext/PNPBS$(name)Ext.jl")

for name in GRID_PACKAGES
    @eval import $(Symbol(name))
    load_extension(name)
end

# The known solution u = 1 / (1 + r^2), where r is the distance from `centre` over `length`. The
# load is -Laplace u.
struct Peak
    centre::Vector{Float64}
    length::Float64
end

square_of_r(p, x) = sum((x[k] - p.centre[k])^2 for k in eachindex(p.centre)) / p.length^2
solution(p, x) = 1 / (1 + square_of_r(p, x))

function load_at(p, x)
    r2 = square_of_r(p, x)
    return (2 * length(p.centre) / (1 + r2)^2 - 8 * r2 / (1 + r2)^3) / p.length^2
end

# Returns barycentric coordinates of the quadrature points, one next to each corner, as columns.
function quadrature_points(corners)
    far = corners == 3 ? 1 / 6 : (5 - sqrt(5)) / 20
    return fill(far, corners, corners) + (1 - corners * far) * I
end

# Returns quadrature points of an element, its measure, and the gradients of its hat functions.
function of_element(mesh, e)
    x = mesh.coordinates[:, mesh.elements[:, e]]
    sides = x[:, 2:end] .- x[:, 1]
    measure = det(sides) / factorial(mesh.dim)
    inner = inv(sides)
    points = x * quadrature_points(size(x, 2))
    return points, measure, [-sum(inner, dims = 1); inner]
end

function error_in_arrays(mesh, p)
    n, corners = length(mesh.ids), mesh.dim + 1
    Q = quadrature_points(corners)
    rows, columns, values, right = Int[], Int[], Float64[], zeros(n)
    for e in axes(mesh.elements, 2)
        points, measure, gradients = of_element(mesh, e)
        at = mesh.elements[:, e]
        append!(rows, repeat(at, corners))
        append!(columns, repeat(at, inner = corners))
        append!(values, measure * gradients * gradients')
        right[at] += measure / corners * Q * [load_at(p, x) for x in eachcol(points)]
    end
    K = sparse(rows, columns, values, n, n)
    u = [solution(p, x) for x in eachcol(mesh.coordinates)]
    fixed = falses(n)
    fixed[mesh.facets[:, .!mesh.facet_inner]] .= true
    free = findall(.!fixed)
    u[free] = Symmetric(K[free, free]) \ (right[free] - K[free, fixed] * u[fixed])
    return sqrt(sum(axes(mesh.elements, 2)) do e
                    points, measure, = of_element(mesh, e)
                    exact = [solution(p, x) for x in eachcol(points)]
                    return measure / corners * sum(abs2, Q * u[mesh.elements[:, e]] - exact)
                end)
end

outer_labels(mesh) = ["tag_$tag" for tag in unique(mesh.facet_tags[.!mesh.facet_inner])]

function error_in_ferrite(mesh, p)
    grid = Ferrite.Grid(mesh)
    shape = mesh.dim == 2 ? Ferrite.RefTriangle : Ferrite.RefTetrahedron
    linear = Ferrite.Lagrange{shape,1}()
    values = Ferrite.CellValues(Ferrite.QuadratureRule{shape}(2), linear)
    unknowns = Ferrite.DofHandler(grid)
    Ferrite.add!(unknowns, :u, linear)
    Ferrite.close!(unknowns)
    fixed = Ferrite.ConstraintHandler(unknowns)
    for label in outer_labels(mesh)
        known = Ferrite.Dirichlet(:u, Ferrite.getfacetset(grid, label), x -> solution(p, x))
        Ferrite.add!(fixed, known)
    end
    Ferrite.close!(fixed)
    K, right = assembled_in_ferrite(unknowns, values, p)
    Ferrite.apply!(K, right, fixed)
    u = Symmetric(K) \ right
    return sqrt(sum_in_ferrite(unknowns, values) do cell, q, x
                    u_here = Ferrite.function_value(values, q, u[Ferrite.celldofs(cell)])
                    return (u_here - solution(p, x))^2
                end)
end

function assembled_in_ferrite(unknowns, values, p)
    K, right = Ferrite.allocate_matrix(unknowns), zeros(Ferrite.ndofs(unknowns))
    assembler, n = Ferrite.start_assemble(K, right), Ferrite.getnbasefunctions(values)
    for cell in Ferrite.CellIterator(unknowns)
        Ferrite.reinit!(values, cell)
        Ke, fe, x = zeros(n, n), zeros(n), Ferrite.getcoordinates(cell)
        for q in 1:Ferrite.getnquadpoints(values), i in 1:n
            dx = Ferrite.getdetJdV(values, q)
            load = load_at(p, Ferrite.spatial_coordinate(values, q, x))
            fe[i] += load * Ferrite.shape_value(values, q, i) * dx
            for j in 1:n
                Ke[i, j] += Ferrite.shape_gradient(values, q, i) ⋅
                            Ferrite.shape_gradient(values, q, j) * dx
            end
        end
        Ferrite.assemble!(assembler, Ferrite.celldofs(cell), Ke, fe)
    end
    return K, right
end

# Returns the integral of f.
function sum_in_ferrite(f, unknowns, values)
    total = 0.0
    for cell in Ferrite.CellIterator(unknowns)
        Ferrite.reinit!(values, cell)
        x = Ferrite.getcoordinates(cell)
        for q in 1:Ferrite.getnquadpoints(values)
            at = Ferrite.spatial_coordinate(values, q, x)
            total += f(cell, q, at) * Ferrite.getdetJdV(values, q)
        end
    end
    return total
end

function error_in_gridap(mesh, p)
    model = Gridap.Geometry.UnstructuredDiscreteModel(mesh)
    linear = Gridap.ReferenceFE(Gridap.lagrangian, Float64, 1)
    tests = Gridap.TestFESpace(model, linear; conformity = :H1, dirichlet_tags = outer_labels(mesh))
    trials = Gridap.TrialFESpace(tests, x -> solution(p, x))
    cells = Gridap.Triangulation(model)
    dx = Gridap.Measure(cells, quadrature_in_gridap(mesh.dim))
    gradients(u, v) = Gridap.:⋅(Gridap.∇(u), Gridap.∇(v))
    load(x) = load_at(p, x)
    problem = Gridap.AffineFEOperator((u, v) -> Gridap.:∫(gradients(u, v)) * dx,
                                      v -> Gridap.:∫(load * v) * dx, trials, tests)
    difference = Gridap.solve(problem) - (x -> solution(p, x))
    return sqrt(sum(Gridap.:∫(difference * difference) * dx))
end

# Returns the quadrature in the reference cell, whose first corner is the origin.
function quadrature_in_gridap(dim)
    points = [Gridap.Point(column[2:end]...) for column in eachcol(quadrature_points(dim + 1))]
    weights = fill(1 / factorial(dim + 1), dim + 1)
    return Gridap.ReferenceFEs.GenericQuadrature(points, weights)
end

# Returns errors(mesh, peak) on the domain with a constant and an adapted spacing, with the numbers
# of nodes. The adapted d is up to three times smaller where the load is large.
function before_and_after_adapting(errors, domain, d, p)
    placement = Placement(domain)
    run!(set_spacing!(placement, d))
    mesh = DistributedMesh(placement)
    before = (mesh.all_nodes, errors(mesh, p))
    placed = nodes(placement)
    loads = [abs(load_at(p, x)) for x in eachcol(placed.points)]
    run!(set_spacing!(placement, placed.spacing ./ max.(1, 3 .* sqrt.(loads ./ maximum(loads)))))
    mesh = DistributedMesh(placement)
    return before, (mesh.all_nodes, errors(mesh, p))
end

function square_with_hole(context)
    square = add_polyline!(Domain(context), [0 1 1 0; 0 0 1 1]; tags = 1)
    return add_arc!(square, (0.3, 0.35), 0.2; tag = 2)
end

function box_with_hollow(context)
    box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1); tag = 1)
    return add_ball!(box, (0.3, 0.35, 0.5), 0.2; tag = 2)
end

function domain_of_file(context, file)
    endswith(file, ".poly") && return read_poly!(Domain(context), file)
    return read_surface!(Domain(context; dim = 3), file)
end

const ERRORS = Dict("arrays" => error_in_arrays, "Ferrite" => error_in_ferrite,
                    "Gridap" => error_in_gridap)

function print_errors(domain, d, p)
    names = ["arrays"; GRID_PACKAGES]
    errors(mesh, p) = [@timed(ERRORS[name](mesh, p)) for name in names]
    for (count, found) in before_and_after_adapting(errors, domain, d, p), k in eachindex(names)
        println(count, " nodes, ", names[k], ": ", round(found[k].value, sigdigits = 9), ", ",
                round(found[k].time, digits = 1), " s")
    end
end

function print_errors_in_file(context, file, d)
    domain = domain_of_file(context, file)
    low, high = bounds(domain)
    print_errors(domain, d, Peak((low .+ high) ./ 2, 10 * d))
end

const SQUARE_PEAK, BOX_PEAK = Peak([0.7, 0.6], 0.1), Peak([0.7, 0.6, 0.5], 0.2)

if abspath(PROGRAM_FILE) == @__FILE__
    Context() do context
        if length(ARGS) == 2
            print_errors_in_file(context, ARGS[1], parse(Float64, ARGS[2]))
        else
            print_errors(square_with_hole(context), 0.03, SQUARE_PEAK)
            print_errors(box_with_hollow(context), 0.1, BOX_PEAK)
        end
    end
end
