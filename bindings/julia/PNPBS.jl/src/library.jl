# SPDX-License-Identifier: BSD-3-Clause
# Search for the shared library, and lookup of its functions. The search runs when a function is
# first needed, so a precompiled image never contains a path.
using Libdl

const PACKAGE = Base.UUID("c5532396-b5c1-415c-b7a9-3fa63870194d")
# The interface version that this package requires. While the major version is 0, a new minor
# version may change the interface.
const INTERFACE = (0, 2)
const opened = Ref{Ptr{Cvoid}}(C_NULL)
const opened_path = Ref("")

# Returns the preference in LocalPreferences.toml, which exists from Julia 1.6 on.
function preferred_library()
    isdefined(Base, :get_preferences) || return nothing
    return get(Base.get_preferences(PACKAGE), "library", nothing)
end

# Returns the library that was installed with the package. The package lies in
# <prefix>/share/pnpbs/julia/PNPBS.jl, the library in <prefix>/lib.
function installed_beside()
    prefix = normpath(@__DIR__, "..", "..", "..", "..", "..")
    folders = [joinpath(prefix, "lib"), joinpath(prefix, "lib64"),
               joinpath(prefix, "lib", "$(Sys.ARCH)-linux-gnu")]
    names = joinpath.(folders, "libpnpbs.$(Libdl.dlext)")
    found = findfirst(isfile, names)
    return found === nothing ? nothing : best_level(names[found], processor_flags())
end

# When the loader of glibc searches its folders for a library, it prefers subfolders for newer
# x86-64 processors. It does not do so for a path, so this file repeats the selection. The features
# of the levels are those of the x86-64 psABI, in Linux's names, with the best level first.
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

# Returns the folder of the library for all processors. The other libraries of PNPBS are in the same
# folder.
function common_folder(path)
    folder = dirname(path)
    return basename(dirname(folder)) == "glibc-hwcaps" ? dirname(dirname(folder)) : folder
end

# Returns the best library next to `path` that a processor with these features can run, or `path`.
function best_level(path, flags)
    for (level, needed) in LEVELS
        other = joinpath(dirname(path), "glibc-hwcaps", level, "libpnpbs.so.0")
        issubset(needed, flags) && isfile(other) && return other
    end
    return path
end

"""
    LibPNPBS.library_path() -> String

Returns the path or name of the library that is or will be opened. This is the value of the
environment variable `PNPBS_LIBRARY` if it is set, or that of the preference `library`. Otherwise it
is the library that was installed with this package, in the variant for this processor if there are
several, or the library that the system finds as `libpnpbs`. Local.
"""
function library_path()
    isempty(opened_path[]) || return opened_path[]
    for candidate in (get(ENV, "PNPBS_LIBRARY", nothing), preferred_library(), installed_beside())
        (candidate === nothing || isempty(candidate)) || return String(candidate)
    end
    # The name without a number exists only with development files, so the linked name is used.
    return Sys.islinux() ? "libpnpbs.so.0" : "libpnpbs"
end

# Throws for another interface version, with which calls could crash.
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

# Runs `work` with a setting that makes waiting OpenMP threads of GCC sleep early, unless the
# environment defines how they wait. GCC's OpenMP reads the setting when it is loaded. By default
# threads spin for a millisecond, which slows a run down several times if other programs use the
# cores. The environment is restored afterwards, so child processes do not inherit the setting.
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
