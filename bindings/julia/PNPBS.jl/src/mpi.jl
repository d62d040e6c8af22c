# SPDX-License-Identifier: BSD-3-Clause
# Contexts on communicators of MPI.jl. Nothing here needs MPI.jl to be loaded: an extension hands its
# module over where Julia has extensions (1.9 and later); elsewhere it is looked for when needed.

const MPI_PACKAGE = Base.PkgId(Base.UUID("da04e1cc-30fd-572f-bb4f-1f8673147195"), "MPI")

# A C int is the Fortran handle itself (MPICH). Anything else (a pointer in Open MPI, an unsigned
# integer in MPItrampoline) MPI converts; all are passed as integers of a pointer's size are.
fortran_handle(MPI::Module, value::Cint) = value

function fortran_handle(MPI::Module, value)
    library = isdefined(MPI, :API) ? MPI.API.libmpi : MPI.libmpi
    convert_handle = Libdl.dlsym(Libdl.dlopen(library), :MPI_Comm_c2f)
    return ccall(convert_handle, Cint, (UInt,), UInt(value))
end

# Open contexts that MPI.Finalize must end, in the order in which they were made: the same one on
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

# MPI.Comm's value means something only while MPI runs; otherwise the library says what is wrong.
function context_on(MPI::Module, comm; options...)
    running = MPI.Initialized() && !MPI.Finalized()
    handle = running ? fortran_handle(MPI, comm.val) : Int32(0)
    context = Context(handle; library = MPI.Get_library_version())
    close_with_mpi(MPI, context)
    return set!(context; options...)
end

# Before Julia 1.9, and where a later one has not loaded the extension. The extension's method is
# the more specific one.
Context(comm; options...) = context_on(mpi_of(comm), comm; options...)

# MPI.jl, if it is loaded and `comm` is its own.
function mpi_of(comm)
    MPI = get(Base.loaded_modules, MPI_PACKAGE, nothing)
    MPI !== nothing && comm isa MPI.Comm || throw(ArgumentError(
        "a communicator of MPI.jl or a Fortran handle was expected, not a $(typeof(comm))"))
    return MPI
end

# ---------------------------------------------------------------- ghosts ------------------------
"""
    update_ghosts!(values, pattern, comm = nothing; tag = 0) -> values

Gives the ghosts the values that their owners have. `values` is a vector with an entry for each node
of this rank and each ghost behind them, or an array whose last index is that; `pattern` is what
[`exchange_pattern`](@ref) returned; `comm` is the communicator of MPI.jl on which the context was
made, and the messages have this `tag` on it. On one process there are no ghosts, and `comm` may be
`nothing`. Collective.

    pattern = exchange_pattern(placement)
    u = zeros(node_count(placement) + ghost_count(placement))
    ...
    update_ghosts!(u, pattern, MPI.COMM_WORLD)
"""
function update_ghosts!(values::AbstractArray, pattern, comm = nothing; tag::Integer = 0)
    isempty(pattern.ranks) && return values
    MPI = mpi_of(comm)
    at(places) = selectdim(values, ndims(values), places)
    received = [Array{eltype(values)}(undef, size(at(places))) for places in pattern.receive]
    requests = MPI.Request[]
    for (k, rank) in enumerate(pattern.ranks)
        push!(requests, MPI.Irecv!(received[k], rank, tag, comm))
        push!(requests, MPI.Isend(Array(at(pattern.send[k])), rank, tag, comm))
    end
    wait_all(MPI, requests)
    for (places, from_there) in zip(pattern.receive, received)
        at(places) .= from_there
    end
    return values
end

# Renamed in MPI.jl 0.20.
wait_all(MPI::Module, requests) =
    isdefined(MPI, :Waitall) ? MPI.Waitall(requests) : MPI.Waitall!(requests)
