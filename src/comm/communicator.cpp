// SPDX-License-Identifier: BSD-3-Clause
// Code that all communicators share: reductions and the agreement on failures.
#include "comm/communicator.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <new>

namespace pnpbs {

namespace {

// The exchange of a rank with itself, or without neighbours.
class ExchangeWithItself : public PersistentExchange {
 public:
  ExchangeWithItself(const std::vector<Bytes>& outgoing, std::vector<Bytes>& incoming)
      : outgoing_(outgoing), incoming_(incoming) {}
  void start() noexcept override {
    for (std::size_t k = 0; k < incoming_.size(); ++k)
      std::copy(outgoing_[k].begin(), outgoing_[k].end(), incoming_[k].begin());
  }
  void wait() override {}

 private:
  const std::vector<Bytes>& outgoing_;
  std::vector<Bytes>& incoming_;
};

class SerialCommunicator : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int ranks_on_node() const override { return 1; }
  std::vector<Message> sparse_all_to_all(const std::vector<Message>& outgoing) const override {
    return outgoing;
  }
  std::vector<Bytes> exchange(const std::vector<int>&, const std::vector<Bytes>& outgoing,
                              std::exception_ptr failure) const override {
    if (failure) std::rethrow_exception(failure);
    return outgoing;
  }
  std::unique_ptr<PersistentExchange> persistent_exchange(
      const std::vector<int>&, const std::vector<Bytes>& outgoing,
      std::vector<Bytes>& incoming) const override {
    return std::make_unique<ExchangeWithItself>(outgoing, incoming);
  }
  std::unique_ptr<SharedWriter> open_file(const std::string& path,
                                          const std::string& name) const override {
    return open_alone(path, name);
  }

 protected:
  Reduction reduce(const Reduction& mine) const override { return mine; }
  void sum_entries(std::vector<std::int64_t>&) const override {}
  std::int64_t scan(std::int64_t) const override { return 0; }
  void broadcast_bytes(char*, std::size_t, int) const override {}
  void allgather_sizes(std::uint64_t, std::vector<std::uint64_t>&) const override {}
  void allgather_bytes(const Bytes&, const std::vector<int>&, const std::vector<int>&,
                       Bytes&) const override {}
  int message_length(std::uint64_t) const override { return 0; }
};

// Kind, reason and message of a failure in a record of fixed size, which can be broadcast without
// allocating memory.
struct FailureNote {
  ErrorKind kind = ErrorKind::internal;
  ErrorReason reason = ErrorReason::other;
  std::size_t points = 0;
  std::array<NamedPoint, 32> point{};
  std::array<char, 4096> text{};

  void set(ErrorKind of, const char* what) {
    kind = of;
    std::strncpy(text.data(), what, text.size() - 1);
  }
  // Points that do not fit into the record remain as text only.
  void set(const Error& error) {
    set(error.kind(), error.what());
    reason = error.reason();
    for (const NamedPoint& named : error.message().points())
      if (points < point.size() && named.end < text.size()) point[points++] = named;
  }
  MessageText message() const {
    return {text.data(), {point.begin(), point.begin() + static_cast<std::ptrdiff_t>(points)}};
  }
};

// Returns the record of an exception of any type.
FailureNote describe(std::exception_ptr failure) {
  FailureNote note;
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    note.set(error);
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

// The error of a rank that cannot allocate the message. It has the same kind as the error of the
// other ranks.
const AgreedError kNoRoomForText(ErrorKind::memory, kOutOfMemory);

}  // namespace

// The maximum of size - rank is that of the lowest failed rank.
Communicator::Reduction Communicator::reduce_or_fail(Reduction mine,
                                                     std::exception_ptr failure) const {
  if (failure) mine.failed = size() - rank();
  Reduction all;
  try {
    all = reduce(mine);
  } catch (...) {  // the other ranks wait in the reduction
    if (!failure) failure = std::current_exception();
    mine.failed = size() - rank();
    all = reduce(mine);
  }
  if (all.failed == 0) return all;
  ++agreed_failures_;
  const int failed = size() - static_cast<int>(all.failed);
  FailureNote note;
  if (rank() == failed) note = describe(failure);
  try {
    broadcast_bytes(reinterpret_cast<char*>(&note), sizeof note, failed);
  } catch (...) {  // all ranks throw now, this one without the text
    note = describe(std::current_exception());
  }
  try {
    throw AgreedError(note.kind, "rank " + std::to_string(failed) + ": " + note.message(),
                      note.reason);
  } catch (const std::bad_alloc&) {
    throw AgreedError(note.kind, kNoRoomForText);
  }
}

void agree_on_failure(const Communicator& comm, std::exception_ptr failure) {
  if (comm.size() > 1)
    comm.reduce_or_fail({}, failure);
  else if (failure)
    std::rethrow_exception(failure);
}

std::uint64_t Communicator::allreduce_sum(std::uint64_t value) const {
  Reduction mine;
  mine.sum.low = value;
  return reduce_or_fail(mine).sum.low;
}

FixedPointSum Communicator::allreduce_sum(const FixedPointSum& sum) const {
  Reduction mine;
  mine.sum = sum.units();
  FixedPointSum all;
  all.units() = reduce_or_fail(mine).sum;
  return all;
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

// Each sum is split into two parts of 32 bits and the upper word, so that the parts of 2^31 ranks
// can be added.
void Communicator::allreduce_sum(std::vector<std::int64_t>& values,
                                 std::vector<FixedPointSum>& sums) const {
  constexpr std::uint64_t kPart = 0xffffffffu;
  std::vector<std::int64_t> all = values;
  for (const FixedPointSum& sum : sums)
    for (const std::uint64_t part :
         {sum.units().low & kPart, sum.units().low >> 32, sum.units().high})
      all.push_back(static_cast<std::int64_t>(part));
  allreduce_sum(all);
  std::copy_n(all.begin(), values.size(), values.begin());
  auto part = all.cbegin() + std::ssize(values);
  for (FixedPointSum& sum : sums) {
    Int128::Value units = 0;
    for (const int shift : {0, 32, 64}) units += Int128::Value{*part++} << shift;
    sum.units() = Int128::of(units);
  }
}

std::int64_t Communicator::exclusive_scan(std::int64_t value) const {
  reduce_or_fail({});
  return scan(value);
}

// Both halves are integers below 2^32, which doubles represent exactly.
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
  collective_try(*this, [&] { bytes.resize(size); });
  broadcast_bytes(bytes.data(), bytes.size(), root);
}

Bytes Communicator::allgather(const Bytes& mine) const {
  if (size() == 1) {
    reduce_or_fail({});
    return mine;
  }
  std::vector<std::uint64_t> sizes;
  collective_try(*this, [&] { sizes.resize(static_cast<std::size_t>(size())); });
  allgather_sizes(mine.size(), sizes);
  Bytes all;
  std::vector<int> lengths, offsets;
  collective_try(*this, [&] {
    std::uint64_t offset = 0;
    for (const std::uint64_t size : sizes) {
      offsets.push_back(message_length(offset));
      lengths.push_back(message_length(size));
      offset += size;
    }
    message_length(offset);
    all.resize(offset);
  });
  allgather_bytes(mine, lengths, offsets, all);
  return all;
}

std::shared_ptr<Communicator> serial_communicator() {
  return std::make_shared<SerialCommunicator>();
}

}  // namespace pnpbs
