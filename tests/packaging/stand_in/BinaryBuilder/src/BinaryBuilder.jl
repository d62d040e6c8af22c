# SPDX-License-Identifier: BSD-3-Clause
# Stand-in for Yggdrasil's BinaryBuilder: prints the arguments of a recipe, one line each.
module BinaryBuilder

export ArchiveSource, Dependency, LibraryProduct, build_tarballs, libc, nbits, supported_platforms

struct Platform
    os::String
    bits::Int
    libc::Union{String, Nothing}
end
Base.Sys.islinux(p::Platform) = p.os == "linux"
nbits(p::Platform) = p.bits
libc(p::Platform) = p.libc
supported_platforms() = [Platform("linux", 64, "glibc"), Platform("linux", 32, "glibc"),
                         Platform("linux", 64, "musl"), Platform("macos", 64, nothing)]

struct ArchiveSource
    url::String
    sha256::String
end

struct Dependency
    name::String
    compat::String
end
Dependency(package; compat="", platforms=nothing) = Dependency(package.name, compat)

struct LibraryProduct
    name::String
    variable::Symbol
end

function build_tarballs(arguments, name::String, version::VersionNumber,
                        sources::Vector{ArchiveSource}, script::String,
                        platforms::Vector{Platform}, products::Vector{LibraryProduct},
                        dependencies::Vector{Dependency}; augment_platform_block::String,
                        julia_compat::String, preferred_gcc_version::VersionNumber)
    println("name: ", name)
    println("version: ", version)
    for source in sources
        println("source: ", source.url, " ", source.sha256)
    end
    for p in platforms
        println("platform: ", p.os, " ", p.bits, " ", p.libc)
    end
    for product in products
        println("product: ", product.name)
    end
    for dependency in dependencies
        println("dependency: ", dependency.name)
    end
    # Every installed package runs this code, so it must at least parse.
    Meta.parse("begin\n" * augment_platform_block * "\nend")
end

end
