# SPDX-License-Identifier: BSD-3-Clause
# Contexts on communicators of MPI.jl. This file does not load MPI.jl. From Julia 1.9 on, an
# extension passes its module; with earlier versions the module is looked up when it is needed.

const MPI_PACKAGE = Base.PkgId(Base.UUID("da04e1cc-30fd-572f-bb4f-1f8673147195"), "MPI")

# Returns the Fortran handle of a communicator. MPI.jl 0.20.19 and later have the conversion. For
# earlier versions, a C int is the Fortran handle itself (MPICH). Anything else, such as a pointer
# in Open MPI or an unsigned integer in MPItrampoline, is converted by the MPI library; all of them
# are passed as integers of the size of a pointer.
function fortran_handle(MPI::Module, value)
    api = isdefined(MPI, :API) ? MPI.API : MPI
    isdefined(api, :MPI_Comm_c2f) && return api.MPI_Comm_c2f(value)
    value isa Cint && return value
    return converted_by_library(api.libmpi, value)
end

function converted_by_library(library, value)
    convert_handle = Libdl.dlsym(Libdl.dlopen(library), :MPI_Comm_c2f)
    return ccall(convert_handle, Cint, (UInt,), UInt(value))
end

# Open contexts that MPI.Finalize must close, in the order of their creation, which is the same on
# all ranks.
const contexts_of_mpi = Context[]

function close_contexts_of_mpi()
    foreach(close, copy(contexts_of_mpi))
    empty!(contexts_of_mpi)
    return nothing
end

function close_with_mpi(MPI::Module, context)
    filter!(isopen, contexts_of_mpi)
    if isempty(contexts_of_mpi) && isdefined(MPI, :add_finalize_hook!)
        MPI.add_finalize_hook!(close_contexts_of_mpi)
    end
    push!(contexts_of_mpi, context)
    return nothing
end

# Creates a context on a communicator of MPI.jl. The communicator is valid only while MPI runs.
# Otherwise the handle is 0, and the library reports the error.
function context_on(MPI::Module, comm; options...)
    running = MPI.Initialized() && !MPI.Finalized()
    handle = running ? fortran_handle(MPI, comm.val) : Int32(0)
    context = Context(handle; library = MPI.Get_library_version())
    close_with_mpi(MPI, context)
    return set!(context; options...)
end

# Serves Julia before 1.9, and later versions without the extension, whose method is more specific.
Context(comm; options...) = context_on(mpi_of(comm), comm; options...)

# Returns the module MPI if it is loaded and `comm` is one of its communicators, or throws.
function mpi_of(comm)
    MPI = get(Base.loaded_modules, MPI_PACKAGE, nothing)
    MPI !== nothing && comm isa MPI.Comm || throw(ArgumentError(
        "a communicator of MPI.jl or a Fortran handle was expected, not a $(typeof(comm))"))
    return MPI
end
