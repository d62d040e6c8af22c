// SPDX-License-Identifier: BSD-3-Clause
// The processes that place nodes together. Serial: one process, no MPI call ever.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "parallel/rank_file.hpp"

namespace pnpbs {

using Bytes = std::vector<char>;

class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Ranks of this communicator on this node: they share its cores.
  virtual int ranks_on_node() const = 0;

  // Collective; integers and maxima only, so that no result depends on the order of ranks.
  virtual std::uint64_t sum(std::uint64_t value) const = 0;  // modulo 2^64
  virtual double largest(double value) const = 0;
  virtual void sum(std::vector<std::int64_t>& values) const = 0;  // entry by entry
  virtual void broadcast(Bytes& bytes, int root) const = 0;
  // What every rank gives, by rank, on every rank.
  virtual std::vector<Bytes> gather(const Bytes& bytes) const = 0;

  // Sends outgoing[k] to rank neighbours[k] and returns what they sent. Every rank named must name
  // us in its own call at the same time. Messages may be empty.
  virtual std::vector<Bytes> exchange(const std::vector<int>& neighbours,
                                      const std::vector<Bytes>& outgoing) const = 0;
  // The same for messages whose sizes both sides know: incoming[k] has the size of what comes.
  virtual void exchange_known(const std::vector<int>& neighbours,
                              const std::vector<Bytes>& outgoing,
                              std::vector<Bytes>& incoming) const = 0;

  // Opens an existing file for all ranks to write parts of. Collective; agreed. `name` stands for
  // the file in messages.
  virtual std::unique_ptr<RankFile> open_file(const std::string& path,
                                              const std::string& name) const = 0;
};

std::shared_ptr<Communicator> serial_communicator();

// A duplicate of the communicator with this Fortran handle. Collective. Throws
// Error(PNPBS_ERROR_MPI or _UNSUPPORTED).
std::shared_ptr<Communicator> mpi_communicator(std::int32_t fortran_handle);

// Collective: if any rank failed, all ranks throw the failure of the lowest one, named.
void agree_on_failure(const Communicator& comm, std::exception_ptr failure);

// Runs a local piece of work on every rank; if it throws on one, it throws on all. The work must
// not communicate.
template <class Work>
void agreed(const Communicator& comm, const Work& work) {
  if (comm.size() == 1) return work();
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  agree_on_failure(comm, failure);
}

}  // namespace pnpbs
