/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpi_counts.h"

#include <mpi.h>

struct mpi_counts mpi_counts;

static double bytes_of(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return (double)count * size;
}

static void message(int count, MPI_Datatype type) {
  mpi_counts.messages += 1;
  mpi_counts.sent += bytes_of(count, type);
}

static void collective(double bytes) {
  mpi_counts.collectives += 1;
  mpi_counts.gathered += bytes;
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  message(count, type);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  message(count, type);
  return PMPI_Issend(data, count, type, to, tag, comm, request);
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  collective(0);
  return PMPI_Ibarrier(comm, request);
}

int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
  collective(bytes_of(count, type));
  return PMPI_Allreduce(in, out, count, type, op, comm);
}

int MPI_Exscan(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  collective(bytes_of(count, type));
  return PMPI_Exscan(in, out, count, type, op, comm);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  collective(bytes_of(count, type));
  return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Allgather(const void* in, int n_in, MPI_Datatype type_in, void* out, int n_out,
                  MPI_Datatype type_out, MPI_Comm comm) {
  int size = 0;
  PMPI_Comm_size(comm, &size);
  collective(size * bytes_of(n_out, type_out));
  return PMPI_Allgather(in, n_in, type_in, out, n_out, type_out, comm);
}

int MPI_Allgatherv(const void* in, int n_in, MPI_Datatype type_in, void* out, const int* n_out,
                   const int* places, MPI_Datatype type_out, MPI_Comm comm) {
  int size = 0;
  PMPI_Comm_size(comm, &size);
  collective(bytes_of(places[size - 1] + n_out[size - 1], type_out));
  return PMPI_Allgatherv(in, n_in, type_in, out, n_out, places, type_out, comm);
}
