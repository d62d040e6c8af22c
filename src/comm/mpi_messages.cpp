// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_config.hpp"

#if PNPBS_HAVE_MPI

#include <string>
#include <utility>

#include "comm/mpi_calls.hpp"
#include "comm/mpi_messages.hpp"

namespace pnpbs {

void MpiMessages::reserve(std::uint64_t messages) {
  requests_.reserve(messages);
  statuses_.resize(requests_.capacity());
  receives_.reserve(requests_.capacity());
}

void MpiMessages::note(const Failure& failure) {
  if (!failure_.call) failure_ = failure;
}

// If a call fails but returns a request, the request is waited for, because its message may still
// arrive.
void MpiMessages::receive(void* to, int bytes, int from, int tag, MPI_Comm comm) {
  receives_.push_back({from, bytes});
  MPI_Request& request = requests_.emplace_back(MPI_REQUEST_NULL);
  const int code = MPI_Irecv(to, bytes, MPI_BYTE, from, tag, comm, &request);
  if (code == MPI_SUCCESS) return;
  note({"MPI_Irecv", code, from});
  if (request == MPI_REQUEST_NULL) MPI_Irecv(to, bytes, MPI_BYTE, from, tag, comm, &request);
}

void MpiMessages::send(const void* bytes, int n, int to, int tag, MPI_Comm comm) {
  receives_.push_back({to, -1});
  MPI_Request& request = requests_.emplace_back(MPI_REQUEST_NULL);
  const int code = MPI_Isend(bytes, n, MPI_BYTE, to, tag, comm, &request);
  if (code == MPI_SUCCESS) return;
  note({"MPI_Isend", code, to});
  if (request == MPI_REQUEST_NULL) MPI_Isend(nullptr, 0, MPI_BYTE, to, tag, comm, &request);
}

void MpiMessages::wait() {
  const int code =
      MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), statuses_.data());
  if (code == MPI_SUCCESS) {
    check_lengths();
  } else {
    note({"MPI_Waitall", code});
    complete_rest();
  }
  requests_.clear();
  receives_.clear();
  const Failure failure = std::exchange(failure_, {});
  if (!failure.call) return;
  if (failure.code != MPI_SUCCESS) mpi::check(failure.code, failure.call);
  throw Error(ErrorKind::mpi, "a message of rank " + std::to_string(failure.rank) + " has " +
                                  std::to_string(failure.received) + " bytes instead of " +
                                  std::to_string(failure.expected) +
                                  ": that rank could not send it");
}

// MPI_Waitall may return at the first failure. Each further call completes at least one message.
void MpiMessages::complete_rest() {
  for (std::size_t calls = 0; calls <= requests_.size(); ++calls)
    if (MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE) ==
        MPI_SUCCESS)
      return;
}

void MpiMessages::check_lengths() {
  for (std::size_t k = 0; k < requests_.size(); ++k) {
    const auto [rank, bytes] = receives_[k];
    if (bytes < 0) continue;
    int received = 0;
    const int code = MPI_Get_count(&statuses_[k], MPI_BYTE, &received);
    if (code != MPI_SUCCESS)
      note({"MPI_Get_count", code, rank});
    else if (received != bytes)
      note({"MPI_Irecv", MPI_SUCCESS, rank, bytes, received});
  }
}

}  // namespace pnpbs

#endif
