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
#include "comm/mpi_messages.hpp"

namespace pnpbs {

class MpiSparseExchange {
 public:
  // The tags of its messages.
  static constexpr int kTags = 3;

  // Allocates the memory that sending takes. The messages stay the caller's; a rank's own is left
  // out. Tags: `first_tag` and those after it.
  MpiSparseExchange(MPI_Comm comm, int rank, int first_tag, const std::vector<Message>& outgoing);

  // Collective. Appends what has come, in any order. Everything is received even without memory for
  // it, because its sender must not wait: then it goes to `dropped`, of one piece, and the failure
  // is kept. So is the failure of a call of MPI, and the exchange goes on. No rank may begin
  // another one before all have ended this: the caller sees to that.
  void run(std::vector<Message>& incoming, char* dropped, std::exception_ptr& failure);

 private:
  // A message of one piece as it is; the size of a longer one, whose pieces follow. No other tags:
  // a rank that is done already may send to one that still looks for messages.
  int whole_tag() const { return first_tag_; }
  int long_tag() const { return first_tag_ + 1; }
  int piece_tag() const { return first_tag_ + 2; }

  void send(std::exception_ptr& failure);
  bool announce(const void* bytes, int n, MPI_Datatype type, int to, int tag,
                std::exception_ptr& failure);
  bool all_entered_barrier();
  bool arrived(int tag, MPI_Status& status) const;
  bool all_received();
  void receive_whole(std::vector<Message>& incoming, char* dropped, std::exception_ptr& failure);
  void receive_long(std::vector<Message>& incoming, char* dropped, std::exception_ptr& failure);

  MPI_Comm comm_;
  int rank_, first_tag_;
  const std::vector<Message>& outgoing_;
  std::vector<std::uint64_t> sizes_;    // of the long messages, on their way
  std::vector<MPI_Request> announced_;  // are done when they are being received
  MpiMessages pieces_;                  // of long messages
  MpiMessages piece_;                   // one that is being received
  bool entered_ = false;                // the barrier
  MPI_Request barrier_ = MPI_REQUEST_NULL;
};

}  // namespace pnpbs
