// SPDX-License-Identifier: BSD-3-Clause
// Messages to ranks that do not expect them, without a word to all the others (NBX of Hoefler,
// Siebert, Lumsdaine, "Scalable communication protocols for dynamic sparse data exchange", PPoPP
// 2010): a rank whose messages have all been received enters a barrier and goes on receiving until
// all have entered. Only in builds with MPI.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <exception>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

class MpiSparseExchange {
 public:
  // Finds the memory that sending takes. The messages stay the caller's; a rank's own is left out.
  MpiSparseExchange(MPI_Comm comm, int rank, const std::vector<Message>& outgoing);

  // Collective. Appends what has come, in any order. Everything is received even without memory for
  // it, because its sender must not wait: then it goes to `dropped`, of one piece, and the failure
  // is kept. No rank may begin another one before all have ended this: the caller sees to that.
  void run(std::vector<Message>& incoming, char* dropped, std::exception_ptr& failure);

 private:
  void send();
  bool all_received();
  void receive_whole(std::vector<Message>& incoming, char* dropped, std::exception_ptr& failure);
  void receive_long(std::vector<Message>& incoming, char* dropped, std::exception_ptr& failure);

  MPI_Comm comm_;
  int rank_;
  const std::vector<Message>& outgoing_;
  std::vector<std::uint64_t> sizes_;    // of the long messages, on their way
  std::vector<MPI_Request> announced_;  // are done when they are being received
  std::vector<MPI_Request> pieces_;     // of long messages
};

}  // namespace pnpbs
