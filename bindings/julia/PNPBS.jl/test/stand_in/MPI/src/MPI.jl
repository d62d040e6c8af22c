# SPDX-License-Identifier: BSD-3-Clause
"""
A stand-in for MPI.jl where none can be installed: what PNPBS and its examples use of it, under the
same names, on Open MPI. It is for tests of how they meet MPI.jl, and for nothing else.
"""
module MPI

include("../../../open_mpi.jl")

module API
const libmpi = "libmpi.so.40"
end

mutable struct Comm
    val::Ptr{Cvoid}
end

const COMM_WORLD = Comm(C_NULL)
const COMM_NULL = Comm(C_NULL)
const finalize_hooks = Any[]

__init__() = (COMM_WORLD.val = OpenMPI.world(); COMM_NULL.val = OpenMPI.null())

Init() = OpenMPI.init()
Initialized() = OpenMPI.flag(:MPI_Initialized)
Finalized() = OpenMPI.flag(:MPI_Finalized)
Comm_rank(comm) = OpenMPI.number(:MPI_Comm_rank, comm.val)
Comm_size(comm) = OpenMPI.number(:MPI_Comm_size, comm.val)
Get_library_version() = OpenMPI.version()

# A reduction of one number, and messages, in the forms without keywords that MPI.jl 0.15 to 0.20
# have.
Allreduce(value, op, comm) = OpenMPI.reduce_over_ranks(value, op, comm.val)

add_finalize_hook!(f) = push!(finalize_hooks, f)

function Finalize()
    while !isempty(finalize_hooks)
        pop!(finalize_hooks)()
    end
    return OpenMPI.finalize()
end

end
