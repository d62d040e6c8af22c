# SPDX-License-Identifier: BSD-3-Clause
# Finds the shared library and its functions by name. The search happens when it is first needed, so
# that a precompiled image never contains a path.
using Libdl

const PACKAGE = Base.UUID("c5532396-b5c1-415c-b7a9-3fa63870194d")
# The version of the interface that this package is written for. While the major version is 0, a new
# minor version may change it.
const INTERFACE = (0, 2)
const opened = Ref{Ptr{Cvoid}}(C_NULL)
const opened_path = Ref("")

# Returns the path in LocalPreferences.toml, which exists from Julia 1.6 on.
function preferred_library()
    isdefined(Base, :get_preferences) || return nothing
    return get(Base.get_preferences(PACKAGE), "library", nothing)
end

# Returns the library of an installed package, which is in <prefix>/share/pnpbs/julia/PNPBS.jl,
# while the library is in <prefix>/lib.
function installed_beside()
    prefix = normpath(@__DIR__, "..", "..", "..", "..", "..")
    folders = [joinpath(prefix, "lib"), joinpath(prefix, "lib64"),
               joinpath(prefix, "lib", "$(Sys.ARCH)-linux-gnu")]
    names = joinpath.(folders, "libpnpbs.$(Libdl.dlext)")
    found = findfirst(isfile, names)
    return found === nothing ? nothing : best_level(names[found], processor_flags())
end

# If glibc's loader searches for a library, it takes the best one in folders for the levels of
# x86-64 processors. It does not do this if it gets a path. The features of each level are those of
# the x86-64 psABI by the names that Linux uses. The best level is first.
const V2_FLAGS = ["cx16", "lahf_lm", "popcnt", "pni", "sse4_1", "sse4_2", "ssse3"]
const V3_FLAGS = [V2_FLAGS; ["abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "xsave"]]
const V4_FLAGS = [V3_FLAGS; ["avx512bw", "avx512cd", "avx512dq", "avx512f", "avx512vl"]]
const LEVELS = ["x86-64-v4" => V4_FLAGS, "x86-64-v3" => V3_FLAGS, "x86-64-v2" => V2_FLAGS]

# Returns the features of the first processor, or none if the system does not report them.
function processor_flags(cpuinfo = "/proc/cpuinfo")
    isfile(cpuinfo) || return String[]
    for line in eachline(cpuinfo)
        startswith(line, "flags") && return String.(split(split(line, ':')[2]))
    end
    return String[]
end

# Returns the folder of the library for all processors. The libraries for other levels are in
# subfolders of it.
function common_folder(path)
    folder = dirname(path)
    return basename(dirname(folder)) == "glibc-hwcaps" ? dirname(dirname(folder)) : folder
end

# Returns the best library in the subfolders that a processor with these features can run, or this
# one.
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
    # This is the name that programs are linked with. The name without a number exists only in
    # installations for development.
    return Sys.islinux() ? "libpnpbs.so.0" : "libpnpbs"
end

# Throws if the library has another interface than this package, which would lead to a crash.
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

# GCC's OpenMP reads the wait policy of threads when it is loaded. By default threads spin for a
# millisecond, so that a run takes many times as long on a busy machine. The environment that child
# processes inherit does not change.
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
