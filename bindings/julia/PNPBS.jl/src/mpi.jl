# SPDX-License-Identifier: BSD-3-Clause
# Contexts on communicators of MPI.jl. Nothing here needs MPI.jl to be loaded. If Julia has
# extensions (1.9 and later), one passes the module MPI. In earlier versions it is looked up when
# needed.

const MPI_PACKAGE = Base.PkgId(Base.UUID("da04e1cc-30fd-572f-bb4f-1f8673147195"), "MPI")

# Returns the Fortran handle of a communicator. MPI.jl 0.20.19 and later have this conversion. In
# earlier ones a C int is the Fortran handle itself (MPICH). MPI converts other values (a pointer in
# Open MPI, an unsigned integer in MPItrampoline). All of them are passed like integers of a
# pointer's size.
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

# The open contexts that MPI.Finalize must end, in the order of their creation, which is the same on
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

# The value of an MPI.Comm is valid only while MPI runs. Otherwise the library reports the error.
function context_on(MPI::Module, comm; options...)
    running = MPI.Initialized() && !MPI.Finalized()
    handle = running ? fortran_handle(MPI, comm.val) : Int32(0)
    context = Context(handle; library = MPI.Get_library_version())
    close_with_mpi(MPI, context)
    return set!(context; options...)
end

# This method is for Julia before 1.9, and for a later one that has not loaded the extension, whose
# method is more specific.
Context(comm; options...) = context_on(mpi_of(comm), comm; options...)

# Returns MPI.jl if it is loaded and `comm` belongs to it.
function mpi_of(comm)
    MPI = get(Base.loaded_modules, MPI_PACKAGE, nothing)
    MPI !== nothing && comm isa MPI.Comm || throw(ArgumentError(
        "a communicator of MPI.jl or a Fortran handle was expected, not a $(typeof(comm))"))
    return MPI
end
