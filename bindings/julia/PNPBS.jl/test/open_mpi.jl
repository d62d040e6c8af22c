# SPDX-License-Identifier: BSD-3-Clause
# The few functions of Open MPI that the tests need, by their names in the library. Programs use
# MPI.jl instead.
module OpenMPI

using Libdl

const libmpi = "libmpi.so.40"
const library = Ref{Ptr{Cvoid}}(C_NULL)

# Open MPI loads modules of its own that want its symbols.
__init__() = (library[] = dlopen(libmpi, RTLD_LAZY | RTLD_GLOBAL))

mpi(name) = dlsym(library[], name)
world() = mpi(:ompi_mpi_comm_world)
null() = mpi(:ompi_mpi_comm_null)
int64() = mpi(:ompi_mpi_int64_t)

init() = @ccall $(mpi(:MPI_Init))(C_NULL::Ptr{Cvoid}, C_NULL::Ptr{Cvoid})::Cint
finalize() = @ccall $(mpi(:MPI_Finalize))()::Cint
abort() = @ccall $(mpi(:MPI_Abort))(world()::Ptr{Cvoid}, 1::Cint)::Cint

function flag(name)
    answer = Ref{Cint}(0)
    @ccall $(mpi(name))(answer::Ptr{Cint})::Cint
    return answer[] != 0
end

function number(name, comm)
    answer = Ref{Cint}(0)
    @ccall $(mpi(name))(comm::Ptr{Cvoid}, answer::Ptr{Cint})::Cint
    return Int(answer[])
end

rank() = number(:MPI_Comm_rank, world())
size() = number(:MPI_Comm_size, world())
fortran_handle(comm) = @ccall $(mpi(:MPI_Comm_c2f))(comm::Ptr{Cvoid})::Cint

function version()
    text, length = zeros(UInt8, 8192), Ref{Cint}(0)
    @ccall $(mpi(:MPI_Get_library_version))(text::Ptr{UInt8}, length::Ptr{Cint})::Cint
    return String(text[1:length[]])
end

# Sends `values` to a rank and receives `count` from it.
function exchange(values::Vector{Int64}, rank, count)
    received = zeros(Int64, count)
    @ccall $(mpi(:MPI_Sendrecv))(
        values::Ptr{Int64}, length(values)::Cint, int64()::Ptr{Cvoid}, rank::Cint, 0::Cint,
        received::Ptr{Int64}, count::Cint, int64()::Ptr{Cvoid}, rank::Cint, 0::Cint,
        world()::Ptr{Cvoid}, C_NULL::Ptr{Cvoid})::Cint
    return received
end

function sum_over_ranks(value::Int64)
    total = Ref{Int64}(0)
    @ccall $(mpi(:MPI_Allreduce))(Ref(value)::Ptr{Int64}, total::Ptr{Int64}, 1::Cint,
                                  int64()::Ptr{Cvoid}, mpi(:ompi_mpi_op_sum)::Ptr{Cvoid},
                                  world()::Ptr{Cvoid})::Cint
    return total[]
end

end
