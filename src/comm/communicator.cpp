// SPDX-License-Identifier: BSD-3-Clause
// What all communicators have in common: agreement on failures.
#include "comm/communicator.hpp"

#include <array>
#include <cstring>
#include <new>
#include <numeric>

namespace pnpbs {

namespace {

// Nobody to talk to.
class NoExchange : public KnownExchange {
 public:
  void start() override {}
  void wait() override {}
};

class SerialCommunicator : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int ranks_on_node() const override { return 1; }
  std::vector<Message> sparse_all_to_all(const std::vector<Message>& outgoing) const override {
    return outgoing;
  }
  std::vector<Bytes> exchange(const std::vector<int>&, const std::vector<Bytes>&) const override {
    return {};
  }
  void exchange_known(const std::vector<int>&, const std::vector<Bytes>&,
                      std::vector<Bytes>&) const override {}
  std::unique_ptr<KnownExchange> known_exchange(const std::vector<int>&, const std::vector<Bytes>&,
                                                std::vector<Bytes>&) const override {
    return std::make_unique<NoExchange>();
  }
  std::unique_ptr<RankFile> open_file(const std::string& path,
                                      const std::string& name) const override {
    return open_alone(path, name);
  }

 protected:
  Reduction reduce(const Reduction& mine) const override { return mine; }
  void sum_entries(std::vector<std::int64_t>&) const override {}
  std::int64_t exclusive_scan(std::int64_t) const override { return 0; }
  void broadcast_bytes(char*, std::size_t, int) const override {}
  std::vector<std::uint64_t> allgather_sizes(std::uint64_t mine) const override { return {mine}; }
  void allgather_bytes(const Bytes& mine, const std::vector<std::uint64_t>&,
                       Bytes& all) const override {
    all = mine;
  }
};

// Kind and text of a failure, in a message of one size: telling of it needs no memory.
struct FailureNote {
  ErrorKind kind = ErrorKind::internal;
  std::array<char, 1020> text{};

  void set(ErrorKind of, const char* what) {
    kind = of;
    std::strncpy(text.data(), what, text.size() - 1);
  }
};

FailureNote describe(std::exception_ptr failure) {
  FailureNote note;
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    note.set(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    note.set(ErrorKind::memory, kOutOfMemory);
  } catch (const std::length_error&) {
    note.set(ErrorKind::memory, kArrayTooLong);
  } catch (const std::exception& error) {
    note.set(ErrorKind::internal, error.what());
  } catch (...) {
    note.set(ErrorKind::callback, kForeignException);
  }
  return note;
}

}  // namespace

// The lowest failed rank is the largest of size - rank.
Communicator::Reduction Communicator::reduce_or_fail(Reduction mine,
                                                     std::exception_ptr failure) const {
  if (failure) mine.failed = size() - rank();
  const Reduction all = reduce(mine);
  if (all.failed == 0) return all;
  const int failed = size() - static_cast<int>(all.failed);
  FailureNote note;
  if (rank() == failed) note = describe(failure);
  broadcast_bytes(reinterpret_cast<char*>(&note), sizeof note, failed);
  throw AgreedError(note.kind, "rank " + std::to_string(failed) + ": " + note.text.data());
}

void agree_on_failure(const Communicator& comm, std::exception_ptr failure) {
  if (comm.size() > 1)
    comm.reduce_or_fail({}, failure);
  else if (failure)
    std::rethrow_exception(failure);
}

std::uint64_t Communicator::allreduce_sum(std::uint64_t value) const {
  Reduction mine;
  mine.sum = value;
  return reduce_or_fail(mine).sum;
}

double Communicator::allreduce_max(double value) const {
  Reduction mine;
  mine.max = value;
  return reduce_or_fail(mine).max;
}

void Communicator::allreduce_sum(std::vector<std::int64_t>& values) const {
  reduce_or_fail({});
  sum_entries(values);
}

std::int64_t Communicator::sum_before(std::int64_t value) const {
  reduce_or_fail({});
  return exclusive_scan(value);
}

// With the integers below 2^32 that both halves are, doubles are exact.
bool Communicator::same_on_all(std::uint64_t value) const {
  for (const int shift : {0, 32}) {
    const double half = static_cast<double>((value >> shift) & 0xffffffffu);
    if (allreduce_max(half) != -allreduce_max(-half)) return false;
  }
  return true;
}

void Communicator::broadcast(Bytes& bytes, int root) const {
  reduce_or_fail({});
  std::uint64_t size = bytes.size();
  broadcast_bytes(reinterpret_cast<char*>(&size), sizeof size, root);
  agreed(*this, [&] { bytes.resize(size); });
  broadcast_bytes(bytes.data(), bytes.size(), root);
}

Bytes Communicator::allgather(const Bytes& mine) const {
  reduce_or_fail({});
  const std::vector<std::uint64_t> sizes = allgather_sizes(mine.size());
  Bytes all;
  agreed(*this, [&] { all.resize(std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0})); });
  allgather_bytes(mine, sizes, all);
  return all;
}

std::shared_ptr<Communicator> serial_communicator() {
  return std::make_shared<SerialCommunicator>();
}

}  // namespace pnpbs
