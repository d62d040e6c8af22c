// SPDX-License-Identifier: BSD-3-Clause
// A sparse exchange of messages whose receivers do not know the senders, by the algorithm NBX (T.
// Hoefler, C. Siebert, A. Lumsdaine, "Scalable communication protocols for dynamic sparse data
// exchange", PPoPP 2010). A rank whose messages have all been received enters a barrier and
// continues to receive until all ranks have entered it. Compiled only in builds with MPI.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <exception>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/mpi_messages.hpp"

namespace pnpbs {

// One sparse exchange.
class MpiSparseExchange {
 public:
  // Number of message tags that an exchange uses.
  static constexpr int kTags = 3;

  // Allocates the memory for sending. `outgoing` must outlive this object; a message of the rank to
  // itself is skipped. Uses the tags `first_tag` to `first_tag` + kTags - 1.
  MpiSparseExchange(MPI_Comm comm, int rank, int first_tag, const std::vector<Message>& outgoing);

  // Runs the exchange and appends the received messages in any order. Collective. A message without
  // memory for it is received into `dropped`, which has kPiece bytes, because its sender must not
  // wait. This failure and those of MPI calls are stored in `failure`, and the exchange continues.
  // The caller must ensure that no rank begins another exchange before all ranks have ended this
  // one.
  void run(std::vector<Message>& incoming, char* dropped, std::exception_ptr& failure);

 private:
  // Tags of a message of one piece, of the size of a longer message, and of its pieces. No other
  // exchange may use these tags, since a rank that has finished may send to one that still probes
  // for messages.
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
  std::vector<std::uint64_t> sizes_;    // sizes of the long messages, while they are sent
  std::vector<MPI_Request> announced_;  // complete when their receipt has begun
  MpiMessages pieces_;                  // pieces of long messages, being sent
  MpiMessages piece_;                   // the piece that is being received
  bool entered_ = false;                // the barrier has been entered
  MPI_Request barrier_ = MPI_REQUEST_NULL;
};

}  // namespace pnpbs
