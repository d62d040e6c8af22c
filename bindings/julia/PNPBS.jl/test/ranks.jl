# SPDX-License-Identifier: BSD-3-Clause
# Tests over the ranks of MPI_COMM_WORLD, through its Fortran handle. mpirun starts this program.
using PNPBS
using SparseArrays
using Test

include("support.jl")
include("mesh_checks.jl")
include("open_mpi.jl")

OpenMPI.init()
const rank, ranks = OpenMPI.rank(), OpenMPI.size()
const world = OpenMPI.fortran_handle(OpenMPI.world())

@testset "the nodes are those of one process" begin
    context = Context(world; library = OpenMPI.version())
    placement = placed_square(context)
    alone = Context(context -> statistic(placed_square(context), "hash"))
    @test statistic(placement, "hash") == alone
    @test check_results(placement) === :ok
    @test OpenMPI.sum_over_ranks(Int64(node_count(placement))) == statistic(placement, "nodes")

    # Each triangle occurs once over all ranks.
    placed = nodes(placement)
    b = OpenMPI.sum_over_ranks(Int64(count(!=(0), placed.tags)))
    n = statistic(placement, "nodes")
    @test OpenMPI.sum_over_ranks(Int64(size(triangles(placement), 2))) == 2n - b - 2
    close(context)
end

@testset "ghosts and the exchange" begin
    context = Context(world)
    placement = placed_square(context)
    own, others = nodes(placement), ghosts(placement)
    n, g = node_count(placement), ghost_count(placement)
    @test size(others.points) == (2, g) && (g > 0) == (ranks > 1)
    @test all(others.owners .!= rank) && isempty(intersect(own.ids, others.ids))
    @test others.spacing ≈ graded(others.points)
    lists = adjacency(placement)
    @test length(lists) == n && maximum(lists.entries) <= n + g
    ids = [own.ids; others.ids]
    points = [own.points others.points]
    @test all(issorted(ids[list]) for list in lists)
    @test all(hypot((points[:, i] - points[:, j])...) < 0.2 for i in 1:n for j in lists[i])

    # Ids and contiguous numbers that are sent by the pattern equal those of the ghosts.
    pattern = exchange_pattern(placement)
    numbers = numbering(placement)
    @test numbers.count == n
    mine = collect(numbers.first .+ (0:(n - 1)))
    for (k, other) in enumerate(pattern.ranks)
        places = pattern.receive[k]
        @test all(others.owners[places .- n] .== other)
        @test OpenMPI.exchange(own.ids[pattern.send[k]], other, length(places)) == ids[places]
        @test OpenMPI.exchange(mine[pattern.send[k]], other, length(places)) ==
              numbers.ghosts[places .- n]
    end
    close(context)
end

# The matrix has the rows of this rank and columns for its nodes and ghosts.
@testset "sparse matrices and arrays of earlier results" begin
    context = Context(world)
    placement = placed_square(context)
    own, others, lists = nodes(placement), ghosts(placement), adjacency(placement)
    n, g = node_count(placement), ghost_count(placement)
    A = sparse(lists, fill(0.5, length(lists.entries)); columns = n + g)
    x = [own.points[1, :]; others.points[1, :]]
    @test size(A) == (n, n + g)
    @test A * x ≈ [sum(x[list]) / 2 for list in lists]
    ranks > 1 && @test_throws ArgumentError sparse(lists)

    again = ghosts!(placement, others)
    @test again == ghosts(placement) && all(values(again) .=== values(others))
    @test adjacency!(placement, lists) === lists && lists == adjacency(placement)

    # The picture has the edges from nodes of this rank, also those to ghosts.
    _, (along_x, _) = PNPBS.picture(placement, :adjacency)
    @test length(along_x) == 3 * count(i < j for i in eachindex(lists) for j in lists[i])
    close(context)
end

# Ghosts receive the values of their owners, and sums have the bits of one process.
@testset "fields" begin
    context = Context(world)
    placement = placed_square(context)
    own, others = nodes(placement), ghosts(placement)
    n, g = node_count(placement), ghost_count(placement)
    @test update_ghosts!(placement, [own.spacing; zeros(g)]) == [own.spacing; others.spacing]
    @test update_ghosts!(placement, [own.points zeros(2, g)]) == [own.points others.points]
    wide = fill(-1.0, 4, n + g)
    wide[2:3, 1:n] = own.points
    @test update_ghosts!(placement, view(wide, 2:3, :)) == [own.points others.points]
    @test all(wide[[1, 4], :] .== -1)

    values = [own.points zeros(2, g)]
    begin_update_ghosts(placement, values)
    @test fails(() -> begin_update_ghosts(placement, values), :error_state, "under way")
    values[:, 1:n] .= 0
    @test end_update_ghosts!(placement, values) == [zero(own.points) others.points]
    @test fails(() -> end_update_ghosts!(placement, values), :error_state, "under way")
    e = thrown(() -> update_ghosts!(placement, zeros(n + g + (rank == 0))))
    @test e isa PNPBSError && e.status === :error_argument && occursin("argument n", e.message)

    sums(placement) = (sum_over_nodes(placement, nodes(placement).spacing),
                       sum_over_nodes(placement, nodes(placement).points),
                       dot_over_nodes(placement, nodes(placement).spacing, nodes(placement).ids),
                       dot_over_nodes(placement, nodes(placement).points, nodes(placement).points))
    @test sums(placement) == Context(context -> sums(placed_square(context)))
    @test sum_over_nodes(placement, ones(n)) === Float64(statistic(placement, "nodes"))
    @test fails(() -> dot_over_nodes(placement, zeros(2, n), zeros(n)), :error_argument, "n = -1")
    close(context)
end

function placed_box(context)
    box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
    return initialise!(set_spacing!(Placement(box), 0.2))
end

# Returns, by id, sums over the elements around each node of this rank, in their order.
function rows_by_id(placement)
    own, others = nodes(placement), ghosts(placement)
    points, ids = [own.points others.points], [own.ids; others.ids]
    rows = Dict(id => 0.0 for id in own.ids)
    for corners in eachcol(incident_elements(placement)), corner in corners
        length(own.ids) < corner && continue
        sides = points[:, corners[2:end]] .- points[:, corners[1]]
        rows[ids[corner]] += sum(sides .^ 2) * sides[1] / 3
    end
    return rows
end

@testset "assembly" begin
    context = Context(world)
    for placed in (placed_square, placed_box)
        placement = placed(context)
        alone = Context(context -> rows_by_id(placed(context)))
        @test all(alone[id] === row for (id, row) in rows_by_id(placement))

        elements = incident_elements(placement)
        @test size(elements, 1) == ndims(placement) + 1
        @test incident_elements!(placement, elements) === elements
        n, g = node_count(placement), ghost_count(placement)
        around, sums = zeros(n + g), zeros(2, n + g)
        for corners in eachcol(elements), corner in corners
            around[corner] += 1
            corners[1] <= n && (sums[:, corner] += [1, 2])
        end
        at_ghosts = sums[:, (n + 1):end]
        @test add_from_ghosts!(placement, sums) === sums
        @test sums == [[around[1:n]'; 2 * around[1:n]'] at_ghosts]
        @test vec(add_from_ghosts!(placement, view(ones(3, n + g), 2, :)))[(n + 1):end] == ones(g)
        e = thrown(() -> add_from_ghosts!(placement, zeros(n + g + (rank == 0))))
        @test e isa PNPBSError && e.status === :error_argument && occursin("argument n", e.message)
    end
    close(context)
end

# Returns the ids of the nodes that this rank shares with another one, in the order of numbers.
shared_with(mesh, other) =
    mesh.ids[[node for (node, sharing) in zip(mesh.shared_nodes, mesh.sharing_ranks)
              if other in sharing]]

@testset "distributed meshes" begin
    context = Context(world)
    total(value) = OpenMPI.reduce_over_ranks(value, +, OpenMPI.world())
    for placed in (placed_square, placed_box)
        placement = placed(context)
        alone = Context(context -> DistributedMesh(placed(context)))
        for layers in 0:2
            mesh = DistributedMesh(placement; ghost_layers = layers)
            check_mesh(mesh, rank)
            @test total(sum(measures(mesh)[1:mesh.owned_elements])) ≈ 1
            # Each entity has one owner over all ranks.
            @test total(mesh.owned_nodes) == mesh.all_nodes == alone.all_nodes
            @test total(mesh.owned_elements) == mesh.all_elements == alone.all_elements
            @test total(count(==(rank), mesh.facet_owners)) == size(alone.facets, 2)
            @test mesh.first_node == numbering(placement).first
            numbers = collect(mesh.first_element .+ (0:(mesh.owned_elements - 1)))
            @test total(sum(numbers)) == sum(0:(mesh.all_elements - 1))
            # With a layer, the mesh has all elements at the nodes of this rank.
            elements_here = size(mesh.elements, 2)
            at_nodes_here = count(corners -> any(corners .<= mesh.owned_nodes),
                                  eachcol(mesh.elements))
            layers == 0 && @test elements_here == mesh.owned_elements
            layers > 0 && @test at_nodes_here == size(incident_elements(placement), 2)
            layers > 0 && ranks > 1 && @test elements_here > mesh.owned_elements
            for other in setdiff(0:(ranks - 1), rank)
                ids = shared_with(mesh, other)
                @test OpenMPI.exchange(ids, other, length(ids)) == ids
            end
        end
        @test fails(() -> DistributedMesh(placement; ghost_layers = -1), :error_argument,
                    "ghost_layers = -1")
        e = thrown(() -> DistributedMesh(placement; ghost_layers = rank == 0))
        @test ranks == 1 || e isa PNPBSError && occursin("all ranks must give the same", e.message)
    end
    close(context)
end

@testset "fields on other nodes" begin
    context = Context(world)
    placement = placed_square(context)
    linear(x) = [1 .+ 2 .* x[1:1, :] .- x[2:2, :]; fill(0.5, 1, size(x, 2))]
    moved(placement) = begin
        points = nodes(placement).points
        curved = Transfer(placement, sin.(points[1, :]))
        straight = Transfer(placement, linear(points))
        quadratic(x) = x[1, :] .^ 2 .- 2 .* x[1, :] .* x[2, :] .+ 3
        bent = Transfer(placement, quadratic(points); order = 2)
        @test linear_nodes(bent) == 0 && linear_nodes(curved) == -1
        set_spacing!(placement, 0.06)
        run!(placement)
        points = nodes(placement).points
        @test at_nodes(bent, placement) ≈ quadratic(points)
        @test_throws ArgumentError Transfer(placement, points; order = 3)
        @test at_nodes(straight, placement) ≈ linear(points)
        @test at_nodes(straight, placement; conserve = true) ≈ linear(points)
        @test at_points(straight, [0.3 0.5; 0.3 1.0]) ≈ linear([0.3 0.5; 0.3 1.0])
        @test maximum(abs, at_nodes(curved, placement) - sin.(points[1, :])) < 0.01
        @test fails(() -> at_points(straight, zeros(3, 1)), :error_argument, "n = -1")
        total = sum_over_nodes(placement, at_nodes(curved, placement; conserve = true))
        @test occursin("2", string(straight))
        close(straight)
        @test !isopen(straight) && fails(() -> at_nodes(straight, placement), :error_handle)
        total
    end
    @test moved(placement) == Context(context -> moved(placed_square(context)))
    values = zeros(node_count(placement))
    rank == 0 && (values[1] = NaN)
    e = thrown(() -> Transfer(placement, values))
    @test e isa PNPBSError && occursin("component 0 at node", e.message)
    close(context)
end

@testset "what fails on one rank fails on all" begin
    context = Context(world)
    placement = Placement(square_domain(context); steps = 20)
    last_rank = ranks - 1
    # The function is called on every rank and throws on the last one.
    set_spacing!(placement) do x
        rank == last_rank && error("not today")
        fill(0.05, size(x, 2))
    end
    e = thrown(() -> run!(placement))
    if rank == last_rank
        @test e == ErrorException("not today")
    else
        @test e isa PNPBSError && e.status === :error_callback
        @test occursin("rank $last_rank", e.message)
    end
    set_spacing!(placement, 0.05)
    given = rank == last_rank ? [1, 2] : [10 + rank]
    e = thrown(() -> set_nodes!(placement, reshape([0.5, 0.5 + rank / 10], 2, 1); ids = given))
    @test rank == last_rank ? e isa DimensionMismatch :
          e isa PNPBSError && e.status === :error_argument
    e = thrown(() -> set_spacing!(placement, rank == last_rank ? -1 : 0.05))
    @test e isa PNPBSError && e.status === :error_spacing && occursin("-1", e.message)
    @test run!(placement) in (:ok, :not_converged)

    # The monitor of one rank stops all ranks.
    set_nodes!(placement, zeros(2, 0))
    set!(placement; steps = 100)
    set_monitor!((_...) -> rank == last_rank, placement)
    @test run!(placement) === :stopped
    close(context)
end

@testset "do over ranks" begin
    kept = Ref{Any}()
    # If f returns on every rank, the context is closed. If f throws, it is not closed, because the
    # other ranks may not close theirs.
    Context(context -> (kept[] = context), world)
    @test !isopen(kept[])
    @test_throws ErrorException Context(context -> (kept[] = context; error("x")), world)
    @test isopen(kept[])
    close(kept[])
end

@testset "no communicator" begin
    @test fails(() -> Context(OpenMPI.fortran_handle(OpenMPI.null())), :error_mpi)
    @test fails(() -> Context(world; library = "Another MPI 1.0"), :error_mpi, "Another MPI 1.0")
end

const forgotten = Context(world)
OpenMPI.finalize()

@testset "after MPI has ended" begin
    @test fails(() -> Context(world), :error_mpi, "finali")
    close(forgotten)
    @test !isopen(forgotten)
    @test Context(context -> node_count(placed_square(context))) > 0
end
