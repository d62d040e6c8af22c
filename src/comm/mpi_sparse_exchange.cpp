// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_config.hpp"

#if PNPBS_HAVE_MPI

#include "comm/mpi_calls.hpp"
#include "comm/mpi_sparse_exchange.hpp"

namespace pnpbs {

namespace {

// Number of failed MPI calls after which an exchange is aborted.
constexpr int kMostFailures = 100;

bool is_long(const Message& message) { return message.bytes.size() > mpi::kPiece; }

// Appends an empty message to `incoming` and returns its buffer, or nullptr if memory is lacking.
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

}  // namespace

MpiSparseExchange::MpiSparseExchange(MPI_Comm comm, int rank, int first_tag,
                                     const std::vector<Message>& outgoing)
    : comm_(comm), rank_(rank), first_tag_(first_tag), outgoing_(outgoing) {
  std::uint64_t pieces = 0, sizes = 0;
  for (const Message& message : outgoing) {
    if (!is_long(message)) continue;
    ++sizes;
    pieces += mpi::pieces(message.bytes.size());
  }
  sizes_.reserve(sizes);
  pieces_.reserve(pieces);
  piece_.reserve(1);
  announced_.reserve(outgoing.size());
}

void MpiSparseExchange::run(std::vector<Message>& incoming, char* dropped,
                            std::exception_ptr& failure) {
  send(failure);
  int failures = 0;
  for (bool all_done = false; !all_done;) {
    const std::exception_ptr now = failure_of([&] {
      receive_whole(incoming, dropped, failure);
      receive_long(incoming, dropped, failure);
      all_done = all_entered_barrier();
    });
    if (!now) continue;
    if (!failure) failure = now;
    if (++failures == kMostFailures) std::rethrow_exception(failure);
  }
  run_and_keep(failure, [&] { pieces_.wait(); });
}

// Starts a synchronous send. Returns false if the message could not be started; no rank waits for
// it then.
bool MpiSparseExchange::announce(const void* bytes, int n, MPI_Datatype type, int to, int tag,
                                 std::exception_ptr& failure) {
  MPI_Request& request = announced_.emplace_back(MPI_REQUEST_NULL);
  run_and_keep(failure, [&] {
    mpi::check(MPI_Issend(bytes, n, type, to, tag, comm_, &request), "MPI_Issend");
  });
  return request != MPI_REQUEST_NULL;
}

void MpiSparseExchange::send(std::exception_ptr& failure) {
  for (const Message& message : outgoing_) {
    const Bytes& bytes = message.bytes;
    if (message.rank == rank_ || bytes.empty()) continue;
    if (!is_long(message)) {
      announce(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, message.rank, whole_tag(),
               failure);
      continue;
    }
    sizes_.push_back(bytes.size());
    if (!announce(&sizes_.back(), 1, MPI_UINT64_T, message.rank, long_tag(), failure)) continue;
    mpi::for_pieces(bytes.size(), [&](std::uint64_t at, int length) {
      pieces_.send(bytes.data() + at, length, message.rank, piece_tag(), comm_);
    });
  }
}

// Enters the barrier once all messages of this rank have been received. Returns true when all ranks
// have entered it.
bool MpiSparseExchange::all_entered_barrier() {
  int all = 0;
  if (entered_) {
    mpi::check(MPI_Test(&barrier_, &all, MPI_STATUS_IGNORE), "MPI_Test");
  } else if (all_received()) {
    const int code = MPI_Ibarrier(comm_, &barrier_);
    entered_ = code == MPI_SUCCESS || barrier_ != MPI_REQUEST_NULL;
    mpi::check(code, "MPI_Ibarrier");
  }
  return all != 0;
}

bool MpiSparseExchange::arrived(int tag, MPI_Status& status) const {
  int there = 0;
  mpi::check(MPI_Iprobe(MPI_ANY_SOURCE, tag, comm_, &there, &status), "MPI_Iprobe");
  return there != 0;
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
  if (!arrived(whole_tag(), status)) return;
  int size = 0;
  mpi::check(MPI_Get_count(&status, MPI_BYTE, &size), "MPI_Get_count");
  const int from = status.MPI_SOURCE;
  char* room = room_for(incoming, from, static_cast<std::uint64_t>(size), failure);
  mpi::check(
      MPI_Recv(room ? room : dropped, size, MPI_BYTE, from, whole_tag(), comm_, MPI_STATUS_IGNORE),
      "MPI_Recv");
}

// The sender has posted all pieces together with the size.
void MpiSparseExchange::receive_long(std::vector<Message>& incoming, char* dropped,
                                     std::exception_ptr& failure) {
  MPI_Status status;
  if (!arrived(long_tag(), status)) return;
  std::uint64_t size = 0;
  const int from = status.MPI_SOURCE;
  mpi::check(MPI_Recv(&size, 1, MPI_UINT64_T, from, long_tag(), comm_, MPI_STATUS_IGNORE),
             "MPI_Recv");
  char* room = room_for(incoming, from, size, failure);
  mpi::for_pieces(size, [&](std::uint64_t at, int length) {
    piece_.receive(room ? room + at : dropped, length, from, piece_tag(), comm_);
    run_and_keep(failure, [&] { piece_.wait(); });
  });
}

}  // namespace pnpbs

#endif
