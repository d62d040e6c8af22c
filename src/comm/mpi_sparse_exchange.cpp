// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_config.hpp"

#if PNPBS_HAVE_MPI

#include "comm/mpi_calls.hpp"
#include "comm/mpi_sparse_exchange.hpp"

namespace pnpbs {

namespace {

// A message of one piece as it is; the size of a longer one, whose pieces follow. No other tags:
// a rank that is done already may send to one that still looks for messages.
constexpr int kWholeTag = 3, kLongTag = 4, kPieceTag = 5;

bool is_long(const Message& message) { return message.bytes.size() > mpi::kPiece; }

// Room for a message at the end of `incoming`; none if there is no memory.
char* room_for(std::vector<Message>& incoming, int rank, std::uint64_t size,
               std::exception_ptr& failure) {
  char* room = nullptr;
  attempt(failure, [&] {
    Bytes bytes(size);
    incoming.push_back({rank, std::move(bytes)});
    room = incoming.back().bytes.data();
  });
  return room;
}

// Is a message with this tag there?
bool arrived(MPI_Comm comm, int tag, MPI_Status& status) {
  int there = 0;
  mpi::check(MPI_Iprobe(MPI_ANY_SOURCE, tag, comm, &there, &status), "MPI_Iprobe");
  return there != 0;
}

}  // namespace

MpiSparseExchange::MpiSparseExchange(MPI_Comm comm, int rank, const std::vector<Message>& outgoing)
    : comm_(comm), rank_(rank), outgoing_(outgoing) {
  std::uint64_t pieces = 0, sizes = 0;
  for (const Message& message : outgoing) {
    if (!is_long(message)) continue;
    ++sizes;
    pieces += mpi::pieces(message.bytes.size());
  }
  sizes_.reserve(sizes);
  pieces_.reserve(pieces);
  announced_.reserve(outgoing.size());
}

void MpiSparseExchange::run(std::vector<Message>& incoming, char* dropped,
                            std::exception_ptr& failure) {
  send();
  MPI_Request barrier = MPI_REQUEST_NULL;
  for (int all_done = 0; !all_done;) {
    receive_whole(incoming, dropped, failure);
    receive_long(incoming, dropped, failure);
    if (barrier != MPI_REQUEST_NULL)
      mpi::check(MPI_Test(&barrier, &all_done, MPI_STATUS_IGNORE), "MPI_Test");
    else if (all_received())
      mpi::check(MPI_Ibarrier(comm_, &barrier), "MPI_Ibarrier");
  }
  mpi::check(MPI_Waitall(mpi::count(pieces_.size()), pieces_.data(), MPI_STATUSES_IGNORE),
             "MPI_Waitall");
}

void MpiSparseExchange::send() {
  for (const Message& message : outgoing_) {
    const Bytes& bytes = message.bytes;
    if (message.rank == rank_ || bytes.empty()) continue;
    if (!is_long(message)) {
      MPI_Issend(bytes.data(), mpi::count(bytes.size()), MPI_BYTE, message.rank, kWholeTag, comm_,
                 &announced_.emplace_back());
      continue;
    }
    sizes_.push_back(bytes.size());
    MPI_Issend(&sizes_.back(), 1, MPI_UINT64_T, message.rank, kLongTag, comm_,
               &announced_.emplace_back());
    mpi::for_pieces(bytes.size(), [&](std::uint64_t at, int length) {
      MPI_Isend(bytes.data() + at, length, MPI_BYTE, message.rank, kPieceTag, comm_,
                &pieces_.emplace_back());
    });
  }
}

bool MpiSparseExchange::all_received() {
  int received = 0;
  mpi::check(
      MPI_Testall(mpi::count(announced_.size()), announced_.data(), &received, MPI_STATUSES_IGNORE),
      "MPI_Testall");
  return received != 0;
}

void MpiSparseExchange::receive_whole(std::vector<Message>& incoming, char* dropped,
                                      std::exception_ptr& failure) {
  MPI_Status status;
  if (!arrived(comm_, kWholeTag, status)) return;
  int size = 0;
  mpi::check(MPI_Get_count(&status, MPI_BYTE, &size), "MPI_Get_count");
  const int from = status.MPI_SOURCE;
  char* room = room_for(incoming, from, static_cast<std::uint64_t>(size), failure);
  mpi::check(
      MPI_Recv(room ? room : dropped, size, MPI_BYTE, from, kWholeTag, comm_, MPI_STATUS_IGNORE),
      "MPI_Recv");
}

// Its sender has sent all pieces with the size.
void MpiSparseExchange::receive_long(std::vector<Message>& incoming, char* dropped,
                                     std::exception_ptr& failure) {
  MPI_Status status;
  if (!arrived(comm_, kLongTag, status)) return;
  std::uint64_t size = 0;
  const int from = status.MPI_SOURCE;
  mpi::check(MPI_Recv(&size, 1, MPI_UINT64_T, from, kLongTag, comm_, MPI_STATUS_IGNORE),
             "MPI_Recv");
  char* room = room_for(incoming, from, size, failure);
  mpi::for_pieces(size, [&](std::uint64_t at, int length) {
    mpi::check(MPI_Recv(room ? room + at : dropped, length, MPI_BYTE, from, kPieceTag, comm_,
                        MPI_STATUS_IGNORE),
               "MPI_Recv");
  });
}

}  // namespace pnpbs

#endif
