# SPDX-License-Identifier: BSD-3-Clause
# Where the shared library is, and its functions by name. It is looked for when it is first needed,
# so that an image made by precompilation never remembers a path.
using Libdl

const PACKAGE = Base.UUID("c5532396-b5c1-415c-b7a9-3fa63870194d")
# The interface this package is written for. While the major version is 0, a new minor one may
# change it.
const INTERFACE = (0, 2)
const opened = Ref{Ptr{Cvoid}}(C_NULL)
const opened_path = Ref("")

# LocalPreferences.toml, from Julia 1.6 on.
function preferred_library()
    isdefined(Base, :get_preferences) || return nothing
    return get(Base.get_preferences(PACKAGE), "library", nothing)
end

# An installed package lies in <prefix>/share/pnpbs/julia/PNPBS.jl, the library in <prefix>/lib.
function installed_beside()
    prefix = normpath(@__DIR__, "..", "..", "..", "..", "..")
    folders = [joinpath(prefix, "lib"), joinpath(prefix, "lib64"),
               joinpath(prefix, "lib", "$(Sys.ARCH)-linux-gnu")]
    names = joinpath.(folders, "libpnpbs.$(Libdl.dlext)")
    found = findfirst(isfile, names)
    return found === nothing ? nothing : best_level(names[found], processor_flags())
end

# Where it searches for a library, glibc's loader takes the best in folders for the levels of x86-64
# processors. It does not where it is given a path. Features by the x86-64 psABI, in the names that
# Linux has for them; the best level first.
const V2_FLAGS = ["cx16", "lahf_lm", "popcnt", "pni", "sse4_1", "sse4_2", "ssse3"]
const V3_FLAGS = [V2_FLAGS; ["abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "xsave"]]
const V4_FLAGS = [V3_FLAGS; ["avx512bw", "avx512cd", "avx512dq", "avx512f", "avx512vl"]]
const LEVELS = ["x86-64-v4" => V4_FLAGS, "x86-64-v3" => V3_FLAGS, "x86-64-v2" => V2_FLAGS]

# Of the first processor, none if the system does not tell.
function processor_flags(cpuinfo = "/proc/cpuinfo")
    isfile(cpuinfo) || return String[]
    for line in eachline(cpuinfo)
        startswith(line, "flags") && return String.(split(split(line, ':')[2]))
    end
    return String[]
end

# Of the library for all processors: others of ours lie beside it.
function common_folder(path)
    folder = dirname(path)
    return basename(dirname(folder)) == "glibc-hwcaps" ? dirname(dirname(folder)) : folder
end

# The best library beside this one that a processor with these features can run, or this one.
function best_level(path, flags)
    for (level, needed) in LEVELS
        other = joinpath(dirname(path), "glibc-hwcaps", level, "libpnpbs.so.0")
        issubset(needed, flags) && isfile(other) && return other
    end
    return path
end

"""
    LibPNPBS.library_path() -> String

Returns the path or name of the library that is or would be opened: the environment variable
`PNPBS_LIBRARY`, or the preference `library`, or the library that this package was installed with
(the one for this processor, if there are several), or the one that the system finds as `libpnpbs`.
"""
function library_path()
    isempty(opened_path[]) || return opened_path[]
    for candidate in (get(ENV, "PNPBS_LIBRARY", nothing), preferred_library(), installed_beside())
        (candidate === nothing || isempty(candidate)) || return String(candidate)
    end
    # By the name its users are linked with: the one without a number comes with development only.
    return Sys.islinux() ? "libpnpbs.so.0" : "libpnpbs"
end

# Two different interfaces must not meet: what would come of it is a crash.
function require_interface(major, minor, path)
    (major, minor) == INTERFACE ||
        error("$path is PNPBS $major.$minor, but this package is for $(join(INTERFACE, '.')); ",
              "use the package of the same version")
    return nothing
end

function require_version(library, path)
    major, minor = Ref{Int32}(), Ref{Int32}()
    ccall(dlsym(library, :pnpbs_version), Int32, (Ptr{Int32}, Ptr{Int32}, Ptr{Int32}), major, minor,
          C_NULL)
    return require_interface(major[], minor[], path)
end

# GCC's OpenMP reads how threads wait when it is loaded. By default they spin for a millisecond, and
# where other programs keep the machine busy, a run takes many times as long. What processes of the
# caller find in their environment stays.
function with_threads_that_sleep(work)
    any(name -> haskey(ENV, name), ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")) && return work()
    return withenv(work, "GOMP_SPINCOUNT" => "1000")
end

function open_library()
    path = library_path()
    library = try
        with_threads_that_sleep(() -> dlopen(path, RTLD_LAZY | RTLD_LOCAL))
    catch e
        error("cannot open the PNPBS library \"$path\": $(sprint(showerror, e))\n",
              "Set the environment variable PNPBS_LIBRARY (or the preference `library` of PNPBS) ",
              "to the path of libpnpbs.$(Libdl.dlext), or put its folder into the loader's ",
              "search path.")
    end
    require_version(library, path)
    opened_path[] = path
    opened[] = library
    return library
end

symbol(name::Symbol) = dlsym(opened[] == C_NULL ? open_library() : opened[], name)
