// SPDX-License-Identifier: BSD-3-Clause
// A set of concurrent point-to-point messages. Compiled only in builds with MPI.
//
// A call of MPI that fails on one rank must not leave another rank waiting. A message that cannot
// be sent is replaced by an empty one, so that its receiver gets a message and detects the failure
// by its length. A receive that cannot be posted is posted a second time, so that the sender does
// not wait.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace pnpbs {

// Pending messages of one rank.
class MpiMessages {
 public:
  // Allocates memory for this number of pending messages.
  void reserve(std::uint64_t messages);

  // Post one message of at least one byte. The memory must have been reserved, and the buffer must
  // stay valid until wait(). Neither function throws; wait() reports failures. Local.
  void receive(void* to, int bytes, int from, int tag, MPI_Comm comm);
  void send(const void* bytes, int n, int to, int tag, MPI_Comm comm);

  // Waits until all messages have ended. Throws Error(ErrorKind::mpi) if one of them failed. Local.
  void wait();

  bool none() const { return requests_.empty(); }

 private:
  // The first call that failed, which wait() reports.
  struct Failure {
    const char* call = nullptr;
    int code = 0, rank = -1;         // rank at the other end, or -1
    int expected = 0, received = 0;  // bytes, if a message has another length
  };
  void note(const Failure& failure);
  void complete_rest();
  void check_lengths();

  std::vector<MPI_Request> requests_;
  std::vector<MPI_Status> statuses_;
  struct Receive {
    int rank, bytes;  // bytes: -1 for a message that is sent
  };
  std::vector<Receive> receives_;  // one per request
  Failure failure_;
};

}  // namespace pnpbs
