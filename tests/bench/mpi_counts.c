/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpi_counts.h"

#include <mpi.h>
#include <time.h>

struct mpi_counts mpi_counts;

static double seconds_on_a_core(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Performs the call, adds its processor time, and returns its status. */
#define TIMED(call)                                    \
  const double started = seconds_on_a_core();          \
  const int status = call;                             \
  mpi_counts.seconds += seconds_on_a_core() - started; \
  return status

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
  TIMED(PMPI_Isend(data, count, type, to, tag, comm, request));
}

int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  message(count, type);
  TIMED(PMPI_Issend(data, count, type, to, tag, comm, request));
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  collective(0);
  TIMED(PMPI_Ibarrier(comm, request));
}

int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
  collective(bytes_of(count, type));
  TIMED(PMPI_Allreduce(in, out, count, type, op, comm));
}

int MPI_Exscan(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  collective(bytes_of(count, type));
  TIMED(PMPI_Exscan(in, out, count, type, op, comm));
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  collective(bytes_of(count, type));
  TIMED(PMPI_Bcast(data, count, type, root, comm));
}

int MPI_Allgather(const void* in, int n_in, MPI_Datatype type_in, void* out, int n_out,
                  MPI_Datatype type_out, MPI_Comm comm) {
  int size = 0;
  PMPI_Comm_size(comm, &size);
  collective(size * bytes_of(n_out, type_out));
  TIMED(PMPI_Allgather(in, n_in, type_in, out, n_out, type_out, comm));
}

int MPI_Allgatherv(const void* in, int n_in, MPI_Datatype type_in, void* out, const int* n_out,
                   const int* places, MPI_Datatype type_out, MPI_Comm comm) {
  int size = 0;
  PMPI_Comm_size(comm, &size);
  collective(bytes_of(places[size - 1] + n_out[size - 1], type_out));
  TIMED(PMPI_Allgatherv(in, n_in, type_in, out, n_out, places, type_out, comm));
}

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
  TIMED(PMPI_Waitall(count, requests, statuses));
}

int MPI_Test(MPI_Request* request, int* done, MPI_Status* status_of) {
  TIMED(PMPI_Test(request, done, status_of));
}

int MPI_Testall(int count, MPI_Request* requests, int* done, MPI_Status* statuses) {
  TIMED(PMPI_Testall(count, requests, done, statuses));
}

int MPI_Iprobe(int from, int tag, MPI_Comm comm, int* there, MPI_Status* status_of) {
  TIMED(PMPI_Iprobe(from, tag, comm, there, status_of));
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
             MPI_Status* status_of) {
  TIMED(PMPI_Recv(data, count, type, from, tag, comm, status_of));
}

int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request* request) {
  TIMED(PMPI_Irecv(data, count, type, from, tag, comm, request));
}
