// SPDX-License-Identifier: BSD-3-Clause
// Counts the messages that a rank sends, by functions that replace those of the MPI library (its
// profiling interface) in the whole program. Only one file of a program may include this header,
// and the program must be linked with the objects of the library.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <map>

namespace message_counts {

struct Counts {
  std::map<int, std::int64_t> announced;  // messages of sparse exchanges, by destination
  std::int64_t messages = 0;              // all messages to single ranks
  std::int64_t bytes = 0;                 // of these messages
  std::int64_t barriers = 0;              // one in every sparse exchange
  std::int64_t longest = 0;  // bytes of the longest contribution to a collective call, in or out

  std::int64_t announced_messages() const {
    std::int64_t sum = 0;
    for (const auto& [rank, times] : announced) sum += times;
    return sum;
  }
};

inline Counts counts;

inline std::int64_t bytes_of(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return std::int64_t{count} * size;
}

inline void note_collective(int count, MPI_Datatype type) {
  counts.longest = std::max(counts.longest, bytes_of(count, type));
}

inline void note_message(int count, MPI_Datatype type) {
  ++counts.messages;
  counts.bytes += bytes_of(count, type);
}

inline int ranks_of(MPI_Comm comm) {
  int size = 0;
  PMPI_Comm_size(comm, &size);
  return size;
}

}  // namespace message_counts

extern "C" {

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  message_counts::note_message(count, type);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  message_counts::note_message(count, type);
  ++message_counts::counts.announced[to];
  return PMPI_Issend(data, count, type, to, tag, comm, request);
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  ++message_counts::counts.barriers;
  return PMPI_Ibarrier(comm, request);
}

int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
  message_counts::note_collective(count, type);
  return PMPI_Allreduce(in, out, count, type, op, comm);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  message_counts::note_collective(count, type);
  return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Allgather(const void* in, int n_in, MPI_Datatype type_in, void* out, int n_out,
                  MPI_Datatype type_out, MPI_Comm comm) {
  message_counts::note_collective(n_out * message_counts::ranks_of(comm), type_out);
  return PMPI_Allgather(in, n_in, type_in, out, n_out, type_out, comm);
}

int MPI_Allgatherv(const void* in, int n_in, MPI_Datatype type_in, void* out, const int* n_out,
                   const int* places, MPI_Datatype type_out, MPI_Comm comm) {
  const int last = message_counts::ranks_of(comm) - 1;
  message_counts::note_collective(places[last] + n_out[last], type_out);
  return PMPI_Allgatherv(in, n_in, type_in, out, n_out, places, type_out, comm);
}

int MPI_Alltoall(const void* in, int n_in, MPI_Datatype type_in, void* out, int n_out,
                 MPI_Datatype type_out, MPI_Comm comm) {
  message_counts::note_collective(n_out * message_counts::ranks_of(comm), type_out);
  return PMPI_Alltoall(in, n_in, type_in, out, n_out, type_out, comm);
}

}  // extern "C"
