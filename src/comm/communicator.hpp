// SPDX-License-Identifier: BSD-3-Clause
// Communication between the processes that place nodes together. A serial communicator has one
// process and calls no MPI function.
//
// Failure protocol. No rank waits for a rank that has failed. Every collective operation except
// exchange() begins with the same kind of reduction, in which each rank also contributes whether it
// has failed. A rank that throws between two operations leaves its work and enters this reduction
// in agree_on_failure. All other ranks, whatever operation they have reached, then throw the same
// failure as an AgreedError. An AgreedError is already known to all ranks and is not reported
// again. Exchanges between neighbours have no such reduction: the ranks must have agreed before
// that all of them take part.
//
// The same holds if a call of MPI fails. The exchange is completed on all ranks, so that none waits
// for a message, and the ranks that lack a message throw. The tags of messages change whenever
// ranks agree on a failure, so a message left over from before is never received in a later
// exchange. Ranks may wait forever if MPI fails in a collective operation other than a reduction,
// or if it stops sending messages at all.
#pragma once

#include <chrono>
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

// An error that all ranks throw.
class AgreedError : public Error {
 public:
  using Error::Error;
};

// A message together with its destination rank, or its source rank once received.
struct Message {
  int rank;
  Bytes bytes;
};

// A persistent exchange between neighbours: messages of fixed sizes from and to fixed buffers,
// repeated any number of times. The buffers must not be touched between start() and wait(). The
// destructor waits for pending messages.
class PersistentExchange {
 public:
  virtual ~PersistentExchange() = default;
  // Posts the messages. All neighbours must start the exchange. Several exchanges may be pending if
  // all ranks start them in the same order. Neither throws nor allocates memory.
  virtual void start() noexcept = 0;
  // Waits for the messages of this rank. Local: other ranks need not wait. Throws
  // Error(ErrorKind::mpi) after all messages have ended if one of them failed.
  virtual void wait() = 0;
};

// A group of ranks and the operations between them. Operations are collective unless they are
// declared local, and if one rank throws, all ranks throw.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Returns the number of ranks of this communicator on this node, which share its cores.
  virtual int ranks_on_node() const = 0;
  // Returns the seconds that this rank has spent in communication so far. The reference stays valid
  // as long as the communicator. Local.
  const double& seconds_waited() const { return seconds_waited_; }

  // Reductions of integers and maxima only, so that no result depends on the order of the ranks.
  std::uint64_t allreduce_sum(std::uint64_t value) const;  // modulo 2^64
  FixedPointSum allreduce_sum(const FixedPointSum& sum) const;
  double allreduce_max(double value) const;
  void allreduce_sum(std::vector<std::int64_t>& values) const;  // entry by entry
  // Sums the entries of both vectors over all ranks in one reduction.
  void allreduce_sum(std::vector<std::int64_t>& values, std::vector<FixedPointSum>& sums) const;
  // Returns the sum over the ranks before this one, modulo 2^64.
  std::int64_t exclusive_scan(std::int64_t value) const;
  // Returns true if all ranks pass the same value.
  bool same_on_all(std::uint64_t value) const;
  // Replaces `bytes` on all ranks by those of rank `root`; the sizes need not agree before.
  void broadcast(Bytes& bytes, int root) const;
  // Returns the bytes of all ranks, concatenated by rank.
  Bytes allgather(const Bytes& mine) const;
  // Sends each message to its rank, which may be this one, and returns the received messages sorted
  // by rank. A rank sends at most one message to each other rank, and may omit empty ones.
  // Receivers need not know their senders. Apart from the reductions, the cost grows with the
  // number of messages of a rank and not with the number of ranks.
  virtual std::vector<Message> sparse_all_to_all(const std::vector<Message>& outgoing) const = 0;

  // Allocates memory for this number of messages to and from neighbours in an exchange. More
  // messages than ranks require it. Local.
  virtual void reserve_messages(std::size_t) const {}
  // Sends outgoing[k] to rank neighbours[k] and returns the messages of the neighbours in the same
  // order. Neighbours must name each other in calls at the same time. A rank may be named several
  // times, and may be this one: of the messages from one rank, the first to arrive is the first
  // that was sent. Messages may be empty. Collective, without a reduction at the beginning: the
  // ranks agree on failures once the sizes are known. `failure` is the failure of this rank's
  // preceding work, or null. Afterwards only MPI can fail, and only the ranks that lack a message
  // throw.
  virtual std::vector<Bytes> exchange(const std::vector<int>& neighbours,
                                      const std::vector<Bytes>& outgoing,
                                      std::exception_ptr failure) const = 0;
  // Creates a persistent exchange. incoming[k] must have the size of the message from
  // neighbours[k]. The buffers must outlive the exchange. Local.
  virtual std::unique_ptr<PersistentExchange> persistent_exchange(
      const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
      std::vector<Bytes>& incoming) const = 0;

  // Opens an existing file, to which all ranks write parts. `name` stands for the file in error
  // messages. Throws Error(ErrorKind::file) on all ranks.
  virtual std::unique_ptr<SharedWriter> open_file(const std::string& path,
                                                  const std::string& name) const = 0;

 protected:
  // The operand of all reductions of single values. `failed` is combined by maximum, `sum` by sum,
  // `max` by maximum.
  struct Reduction {
    std::int64_t failed = 0;  // size - rank of a failed rank, or 0
    Int128 sum;
    double max = -std::numeric_limits<double>::infinity();
  };
  virtual Reduction reduce(const Reduction& mine) const = 0;
  virtual void sum_entries(std::vector<std::int64_t>& values) const = 0;
  virtual std::int64_t scan(std::int64_t value) const = 0;
  virtual void broadcast_bytes(char* bytes, std::size_t n, int root) const = 0;
  // The following two operations allocate nothing while ranks wait for each other: the caller has
  // resized `all`.
  virtual void allgather_sizes(std::uint64_t mine, std::vector<std::uint64_t>& all) const = 0;
  virtual void allgather_bytes(const Bytes& mine, const std::vector<int>& sizes,
                               const std::vector<int>& offsets, Bytes& all) const = 0;
  // Throws if `size` bytes are too many for allgather_bytes(). Otherwise returns the size as an
  // int.
  virtual int message_length(std::uint64_t size) const = 0;
  // Adds the time until the end of its scope to the seconds in communication. Not to be nested.
  class WaitTimer {
   public:
    explicit WaitTimer(const Communicator& comm) : comm_(comm) {}
    WaitTimer(const WaitTimer&) = delete;
    WaitTimer& operator=(const WaitTimer&) = delete;
    ~WaitTimer() {
      comm_.seconds_waited_ += std::chrono::duration<double>(Clock::now() - start_).count();
    }

   private:
    using Clock = std::chrono::steady_clock;
    const Communicator& comm_;
    const Clock::time_point start_ = Clock::now();
  };
  // Returns the number of failures that the ranks have agreed on, which is the same on all ranks.
  std::uint32_t agreed_failures() const { return agreed_failures_; }

 private:
  friend void agree_on_failure(const Communicator& comm, std::exception_ptr failure);
  Reduction reduce_or_fail(Reduction mine, std::exception_ptr failure = nullptr) const;

  mutable std::uint32_t agreed_failures_ = 0;
  mutable double seconds_waited_ = 0;
};

// Returns a communicator of one process.
std::shared_ptr<Communicator> serial_communicator();

// Returns a duplicate of the MPI communicator with this Fortran handle. Collective. Throws
// Error(ErrorKind::mpi) or, in builds without MPI, Error(ErrorKind::unsupported).
std::shared_ptr<Communicator> mpi_communicator(std::int32_t fortran_handle);

// Throws Error(ErrorKind::mpi) unless `library` is the version text (MPI_Get_library_version) of
// the MPI library that PNPBS calls. Handles of one MPI library are invalid in another.
void require_our_mpi(const std::string& library);

// Throws on all ranks if a rank has a failure: an AgreedError with the message of the lowest failed
// rank and its number. Collective.
void agree_on_failure(const Communicator& comm, std::exception_ptr failure);

// Runs local work unless an earlier part has failed. An exception is stored in `failure` until the
// ranks agree on it, since other ranks wait for messages meanwhile.
template <class Work>
void attempt(std::exception_ptr& failure, const Work& work) {
  if (failure) return;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
}

// Runs local work even after a failure, because other ranks wait for it. An exception is stored in
// `failure` unless one is stored already.
template <class Work>
void run_and_keep(std::exception_ptr& failure, const Work& work) {
  try {
    work();
  } catch (...) {
    if (!failure) failure = std::current_exception();
  }
}

// Runs local work and returns its exception, or null. An AgreedError is rethrown because all ranks
// throw it.
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

// Runs work on every rank. If it throws on one rank, all ranks throw. Collective.
template <class Work>
void collective_try(const Communicator& comm, const Work& work) {
  if (comm.size() == 1) return work();
  agree_on_failure(comm, failure_of(work));
}

}  // namespace pnpbs
