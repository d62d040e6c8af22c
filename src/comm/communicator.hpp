// SPDX-License-Identifier: BSD-3-Clause
// The processes that place nodes together. Serial: one process, no MPI call ever.
//
// Nobody waits for a rank that has failed. Every operation here but exchange() begins with a
// reduction of one and the same form, in which each rank tells whether it has failed. A rank that
// throws between two of them leaves for the end of the work it is in, where agree_on_failure has it
// take part in that reduction; the others, wherever they are, then throw its failure, too. What all
// ranks throw is an AgreedError, and is not told again. Exchanges between neighbours have no such
// beginning: the ranks must have agreed before that all of them take part.
//
// The same holds where a call of MPI fails. The exchange is completed on all ranks, so that none
// waits for a message, and the ranks that lack one throw. The tags of messages change whenever
// ranks agree on a failure: a message that was left over then is never taken for one of a later
// exchange. If MPI fails in a collective operation but a reduction, or sends nothing at all any
// more, ranks may wait for ever.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/fixed_point.hpp"
#include "comm/shared_writer.hpp"

namespace pnpbs {

using Bytes = std::vector<char>;

// A failure that all ranks throw.
class AgreedError : public Error {
 public:
  using Error::Error;
};

// A message and the rank it goes to, or comes from.
struct Message {
  int rank;
  Bytes bytes;
};

// An exchange between neighbours that can be done again and again: messages of known sizes from
// and to buffers that stay where they are. Between start() and wait() these belong to it. Its
// destructor waits for messages that are on their way.
class PersistentExchange {
 public:
  virtual ~PersistentExchange() = default;
  // Posts the messages. All neighbours start; several exchanges may be under way at a time, and
  // ranks start them in the same order. Does not throw and allocates no memory.
  virtual void start() noexcept = 0;
  // Waits for this rank's messages. Local: other ranks need not wait. Throws Error(ErrorKind::mpi)
  // if one of them failed, when all have ended.
  virtual void wait() = 0;
};

class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Ranks of this communicator on this node: they share its cores.
  virtual int ranks_on_node() const = 0;

  // Collective; integers and maxima only, so that no result depends on the order of ranks.
  std::uint64_t allreduce_sum(std::uint64_t value) const;  // modulo 2^64
  FixedPointSum allreduce_sum(const FixedPointSum& sum) const;
  double allreduce_max(double value) const;
  void allreduce_sum(std::vector<std::int64_t>& values) const;  // entry by entry
  // Both at once, entry by entry.
  void allreduce_sum(std::vector<std::int64_t>& values, std::vector<FixedPointSum>& sums) const;
  // Of the ranks before this one, modulo 2^64.
  std::int64_t exclusive_scan(std::int64_t value) const;
  bool same_on_all(std::uint64_t value) const;
  void broadcast(Bytes& bytes, int root) const;
  // What every rank gives, one after the other by rank.
  Bytes allgather(const Bytes& mine) const;
  // Brings each message to its rank, this one included; returns what has come, by rank. At most one
  // to each; empty ones may be left out. Nobody need know who sends to it, and the cost grows with
  // the messages of a rank, not with the ranks (but for the reductions). Throws on all ranks.
  virtual std::vector<Message> sparse_all_to_all(const std::vector<Message>& outgoing) const = 0;

  // Sends outgoing[k] to rank neighbours[k] and returns what they sent. Every rank named must name
  // us in its own call at the same time. Messages may be empty. Collective, without a reduction at
  // its beginning: the ranks agree once they know the sizes, also on `failure`, that of this rank's
  // work before, if there is one. After that only MPI can fail: on a rank that lacks a message.
  virtual std::vector<Bytes> exchange(const std::vector<int>& neighbours,
                                      const std::vector<Bytes>& outgoing,
                                      std::exception_ptr failure) const = 0;
  // An exchange for messages whose sizes both sides know: incoming[k] has the size of what comes.
  // The buffers must outlive it. Local.
  virtual std::unique_ptr<PersistentExchange> persistent_exchange(
      const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
      std::vector<Bytes>& incoming) const = 0;

  // Opens an existing file for all ranks to write parts of. Collective; agreed. `name` stands for
  // the file in messages.
  virtual std::unique_ptr<SharedWriter> open_file(const std::string& path,
                                                  const std::string& name) const = 0;

 protected:
  // What all reductions of single values are made of.
  struct Reduction {
    std::int64_t failed = 0;  // size - rank of a rank that has failed; the largest counts
    Int128 sum;
    double max = -std::numeric_limits<double>::infinity();
  };
  virtual Reduction reduce(const Reduction& mine) const = 0;
  virtual void sum_entries(std::vector<std::int64_t>& values) const = 0;
  virtual std::int64_t scan(std::int64_t value) const = 0;
  virtual void broadcast_bytes(char* bytes, std::size_t n, int root) const = 0;
  // These find all their memory before ranks wait for each other: `all` has its size.
  virtual void allgather_sizes(std::uint64_t mine, std::vector<std::uint64_t>& all) const = 0;
  virtual void allgather_bytes(const Bytes& mine, const std::vector<int>& sizes,
                               const std::vector<int>& offsets, Bytes& all) const = 0;
  // Throws if that many bytes are too many for allgather_bytes().
  virtual int message_length(std::uint64_t size) const = 0;
  // Failures that the ranks have agreed on so far, the same on all of them.
  std::uint32_t agreed_failures() const { return agreed_failures_; }

 private:
  friend void agree_on_failure(const Communicator& comm, std::exception_ptr failure);
  Reduction reduce_or_fail(Reduction mine, std::exception_ptr failure = nullptr) const;

  mutable std::uint32_t agreed_failures_ = 0;
};

std::shared_ptr<Communicator> serial_communicator();

// A duplicate of the communicator with this Fortran handle. Collective. Throws
// Error(ErrorKind::mpi or ::unsupported).
std::shared_ptr<Communicator> mpi_communicator(std::int32_t fortran_handle);

// Throws Error(ErrorKind::mpi) unless this is what MPI_Get_library_version tells of the MPI that
// we call: handles of one library mean nothing to another.
void require_our_mpi(const std::string& library);

// Collective: if any rank failed, all ranks throw the failure of the lowest one, named.
void agree_on_failure(const Communicator& comm, std::exception_ptr failure);

// Runs a piece of this rank's work unless one before it has failed. Its failure waits in `failure`
// until the ranks agree on it, as others wait for messages meanwhile.
template <class Work>
void attempt(std::exception_ptr& failure, const Work& work) {
  if (failure) return;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
}

// Runs a piece of this rank's work in any case, because other ranks wait for it, and keeps its
// failure unless there is one already.
template <class Work>
void run_and_keep(std::exception_ptr& failure, const Work& work) {
  try {
    work();
  } catch (...) {
    if (!failure) failure = std::current_exception();
  }
}

// What a piece of this rank's work throws, null if nothing; but what the ranks have agreed on
// already goes on its way.
template <class Work>
std::exception_ptr failure_of(const Work& work) {
  try {
    work();
  } catch (const AgreedError&) {
    throw;
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

// Runs a piece of work on every rank; if it throws on one, it throws on all.
template <class Work>
void collective_try(const Communicator& comm, const Work& work) {
  if (comm.size() == 1) return work();
  agree_on_failure(comm, failure_of(work));
}

}  // namespace pnpbs
