// SPDX-License-Identifier: BSD-3-Clause
// Messages between pairs of ranks that travel at the same time. Only in builds with MPI.
//
// A call of MPI that fails on one rank must not leave another rank waiting. A message that cannot
// be sent is replaced by an empty one, so that its receiver gets one message in any case and sees
// by the length that it is not the right one. A receive that cannot be posted is posted once more,
// so that the sender is not kept waiting.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace pnpbs {

class MpiMessages {
 public:
  // Allocates memory for so many messages on their way.
  void reserve(std::uint64_t messages);

  // Post one message, of at least one byte. The memory must have been reserved, and the buffer must
  // stay until wait(). Neither throws; wait() reports a failure. Local.
  void receive(void* to, int bytes, int from, int tag, MPI_Comm comm);
  void send(const void* bytes, int n, int to, int tag, MPI_Comm comm);

  // Waits until no message is on its way. Throws Error(ErrorKind::mpi) if any of them failed.
  // Local.
  void wait();

  bool none() const { return requests_.empty(); }

 private:
  // What wait() reports: the first call that failed.
  struct Failure {
    const char* call = nullptr;
    int code = 0, rank = -1;         // the rank at the other end, -1 if there is no single one
    int expected = 0, received = 0;  // bytes, of a message that arrived with another length
  };
  void note(const Failure& failure);
  void complete_rest();
  void check_lengths();

  std::vector<MPI_Request> requests_;
  std::vector<MPI_Status> statuses_;
  struct Receive {
    int rank, bytes;  // bytes: -1 of a message that is sent
  };
  std::vector<Receive> receives_;  // one for each request
  Failure failure_;
};

}  // namespace pnpbs
