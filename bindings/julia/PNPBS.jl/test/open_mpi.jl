# SPDX-License-Identifier: BSD-3-Clause
# The functions of Open MPI that the tests need, called by their names in the library. Programs use
# MPI.jl instead.
module OpenMPI

using Libdl

const libmpi = "libmpi.so.40"
const library = Ref{Ptr{Cvoid}}(C_NULL)

# Open MPI loads modules that need its symbols, so these must be global.
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

# Sends `values` to a rank and receives `count` values from it.
function exchange(values::Vector{Int64}, rank, count)
    received = zeros(Int64, count)
    @ccall $(mpi(:MPI_Sendrecv))(
        values::Ptr{Int64}, length(values)::Cint, int64()::Ptr{Cvoid}, rank::Cint, 0::Cint,
        received::Ptr{Int64}, count::Cint, int64()::Ptr{Cvoid}, rank::Cint, 0::Cint,
        world()::Ptr{Cvoid}, C_NULL::Ptr{Cvoid})::Cint
    return received
end

# Return the MPI datatype of a number type, and the MPI operation of a function.
datatype(::Type{Int64}) = int64()
datatype(::Type{Float64}) = mpi(:ompi_mpi_double)
operation(::typeof(+)) = mpi(:ompi_mpi_op_sum)
operation(::typeof(max)) = mpi(:ompi_mpi_op_max)
operation(::typeof(min)) = mpi(:ompi_mpi_op_min)

function reduce_over_ranks(value::T, op, comm) where {T}
    result = Ref(value)
    @ccall $(mpi(:MPI_Allreduce))(Ref(value)::Ptr{T}, result::Ptr{T}, 1::Cint,
                                  datatype(T)::Ptr{Cvoid}, operation(op)::Ptr{Cvoid},
                                  comm::Ptr{Cvoid})::Cint
    return result[]
end

sum_over_ranks(value::Int64) = reduce_over_ranks(value, +, world())

end
