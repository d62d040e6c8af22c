# SPDX-License-Identifier: BSD-3-Clause
# Tests of the package itself: names, tables, and the choice of the library.

# Returns the output of a program in a new process, because this process has loaded its library.
function in_another_process(program; library = "")
    command = `$(Base.julia_cmd()) --compiled-modules=no --startup-file=no -e $program`
    output = IOBuffer()
    withenv("PNPBS_LIBRARY" => library, "JULIA_LOAD_PATH" => join(LOAD_PATH, ":")) do
        run(pipeline(ignorestatus(command), stdout = output, stderr = output))
    end
    return String(take!(output))
end

@testset "names" begin
    documented = Base.Docs.meta(PNPBS)
    undocumented = [name for name in names(PNPBS)
                    if !haskey(documented, Base.Docs.Binding(PNPBS, name))]
    @test isempty(undocumented)
    @test isempty(detect_ambiguities(PNPBS))
    raw = PNPBS.LibPNPBS
    is_call(name) = startswith(string(name), "pnpbs_") && getfield(raw, name) isa Function
    functions = filter(is_call, names(raw, all = true))
    @test length(functions) >= 70
    @test all(name -> raw.symbol(name) != C_NULL, functions)
    # Pkg of this Julia version can read the project file.
    folder = dirname(@__DIR__)
    named = in_another_process("using Pkg; Pkg.activate(\"$folder\"); print(Pkg.project().name)")
    @test endswith(named, "PNPBS")
end

@testset "tables" begin
    @test library_version() == v"0.2.0"
    @test occursin("version: 0.2.0", build_info())
    @test mpi_library() isa String
    steps = only(filter(row -> row.name == "steps", option_table()))
    @test steps.type == "integer" && parse(Int, steps.default) > 0 && !isempty(steps.help)
    method = only(filter(row -> row.name == "method", option_table()))
    @test (method.type, method.default, method.range) == ("choice", "default", "default | paper")
    @test occursin("scheme", method.help)
    hash = only(filter(row -> row.name == "hash", statistic_table()))
    @test hash.type == "string" && occursin(" ", hash.help)
    @test Set(row.type for row in statistic_table()) == Set(["integer", "real", "string"])
    formats = Dict(row.name => row for row in format_table())
    @test formats["vtu"].binary && formats["vtu"].elements
    @test !formats["msh"].binary && formats["msh"].elements && occursin("Gmsh", formats["msh"].help)
    @test !formats["csv"].binary && !formats["csv"].elements
end

@testset "options" begin
    Context(steps = 7) do context
        placement = Placement(square_domain(context))
        set_spacing!(placement, 0.1)
        @test run!(placement) === :not_converged
        @test statistic(placement, "steps") <= 7
        @test set!(placement; steps = 9, method = :paper, rest_length = 1.05) === placement
        @test set!(context; method = :paper) === context
        @test fails(() -> set!(placement; stepz = 9), :error_key, "steps")
        @test fails(() -> set!(placement; steps = -1), :error_argument, "steps", "-1")
        @test fails(() -> set!(placement; method = "papers"), :error_argument, "paper")
        @test fails(() -> set!(context; stepz = 9), :error_key, "steps")
        @test fails(() -> Placement(placement.domain; steps = "many"), :error_argument, "many")
        @test length(context.children) == 2
    end
end

@testset "errors are readable" begin
    text = sprint(showerror, PNPBSError(:error_spacing, "d is 0"))
    @test text == "PNPBSError (error_spacing): d is 0"
    @test PNPBS.status_name(-5) === :error_spacing
    @test PNPBS.status_name(0) === :ok && PNPBS.status_name(2) === :stopped
    @test PNPBS.status_name(-99) === Symbol("status_-99")
end

@testset "the library's path" begin
    @test isfile(PNPBS.LibPNPBS.library_path())
    missing_library = in_another_process("using PNPBS; build_info()", library = "/none/libpnpbs.so")
    @test occursin("cannot open the PNPBS library \"/none/libpnpbs.so\"", missing_library)
    @test occursin("Set the environment variable PNPBS_LIBRARY", missing_library)
    chosen = in_another_process("using PNPBS; print(PNPBS.LibPNPBS.library_path())",
                                library = "/a.so")
    @test chosen == "/a.so"
    @test PNPBS.LibPNPBS.require_interface(0, 2, "x.so") === nothing
    e = thrown(() -> PNPBS.LibPNPBS.require_interface(0, 3, "x.so"))
    @test e.msg == "x.so is PNPBS 0.3, but this package is for 0.2; " *
                   "use the package of the same version"
end

@testset "the library for this processor" begin
    lib = PNPBS.LibPNPBS
    mktempdir() do folder
        common = joinpath(folder, "libpnpbs.so")
        level(name) = joinpath(folder, "glibc-hwcaps", name, "libpnpbs.so.0")
        @test lib.best_level(common, lib.V4_FLAGS) == common
        for name in ("x86-64-v3", "x86-64-v4")
            mkpath(dirname(level(name)))
            write(level(name), "")
            @test lib.common_folder(level(name)) == folder
        end
        @test lib.common_folder(common) == folder
        @test lib.best_level(common, lib.V4_FLAGS) == level("x86-64-v4")
        @test lib.best_level(common, lib.V3_FLAGS) == level("x86-64-v3")
        @test lib.best_level(common, filter(!=("avx2"), lib.V4_FLAGS)) == common
        @test lib.best_level(common, String[]) == common
        cpuinfo = joinpath(folder, "cpuinfo")
        write(cpuinfo, "processor\t: 0\nflags\t\t: fpu avx2\n\nflags\t\t: other\n")
        @test lib.processor_flags(cpuinfo) == ["fpu", "avx2"]
        @test lib.processor_flags(joinpath(folder, "none")) == String[]
    end
end

@testset "threads soon sleep while they wait" begin
    # The setting that GCC's OpenMP sees, and the environment after loading.
    spins(variables...) = withenv("OMP_WAIT_POLICY" => nothing, "GOMP_SPINCOUNT" => nothing,
                                  variables...) do
        in_another_process("""
            using PNPBS
            told = PNPBS.LibPNPBS.with_threads_that_sleep(() -> get(ENV, "GOMP_SPINCOUNT", "-"))
            build_info()
            print(told, " ", get(ENV, "GOMP_SPINCOUNT", "-"))""",
                           library = PNPBS.LibPNPBS.library_path())
    end
    @test spins() == "1000 -"
    @test spins("GOMP_SPINCOUNT" => "7") == "7 7"
    @test spins("OMP_WAIT_POLICY" => "active") == "- -"
end

@testset "the end" begin
    @test PNPBS.discard_unfinished_files() === nothing
    after = in_another_process("""
        using PNPBS
        PNPBS.shutdown()
        Context() do context
            p = Placement(add_polyline!(Domain(context), [0 1 1; 0 0 1]))
            set_spacing!(p, 0.1)
            println(run!(p))
            PNPBS.shutdown()
            run!(p)
        end"""; library = PNPBS.LibPNPBS.library_path())
    @test startswith(after, r"ok|not_converged") && occursin("(error_kokkos)", after)
end

@testset "compressed rows" begin
    rows = CompressedRows([1, 3, 3, 4], [10, 20, 30])
    @test length(rows) == 3 && size(rows) == (3,)
    @test rows[1] == [10, 20] && isempty(rows[2]) && rows[3] == [30]
    @test [sum(row) for row in rows] == [30, 0, 30]
    @test collect(rows) isa Vector{eltype(rows)}
    @test_throws BoundsError rows[4]
    @test parent(rows[1]) === rows.entries
end
