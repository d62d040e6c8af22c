# SPDX-License-Identifier: BSD-3-Clause
"""
A stand-in for MPI.jl, for tests on machines without it. It defines the parts that PNPBS and its
examples use, with the same names, and calls Open MPI.
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

# A reduction of one number and messages, in the forms without keywords of MPI.jl 0.15 to 0.20.
Allreduce(value, op, comm) = OpenMPI.reduce_over_ranks(value, op, comm.val)

add_finalize_hook!(f) = push!(finalize_hooks, f)

function Finalize()
    while !isempty(finalize_hooks)
        pop!(finalize_hooks)()
    end
    return OpenMPI.finalize()
end

end
