// SPDX-License-Identifier: BSD-3-Clause
// Tests messages to ranks that do not expect them. Each arrives once, complete and in its own
// exchange, for any pattern and with failures in between, and nothing else is sent. Also tests
// exclusive sums over ranks.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <numeric>
#include <string>
#include <vector>

#include "base/mixed_hash.hpp"
#include "comm/rank_span.hpp"
#include "comm/records.hpp"
#include "message_counts.hpp"
#include "rank_checks.hpp"

namespace {

constexpr std::size_t kNoLimit = SIZE_MAX;
// Size in bytes from which requests fail, as on a machine without memory.
std::size_t refused_from = kNoLimit;

}  // namespace

// Not inline, because the compiler would otherwise see malloc and delete and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = size < refused_from ? std::malloc(size > 0 ? size : 1) : nullptr;
  if (!memory) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using pnpbs::Bytes;
using pnpbs::Message;
using rank_checks::comm;
using rank_checks::expect;

constexpr std::uint64_t kPiece = 1 << 18;  // as in comm/mpi_calls.hpp

enum Pattern { kNobody, kFew, kAll, kSelf, kOneToAll, kAllToOne, kLong, kPatterns };

std::uint64_t number(std::uint64_t round, int from, int to) {
  return pnpbs::mixed(pnpbs::mixed(round) ^
                      (static_cast<std::uint64_t>(from) << 20 | static_cast<std::uint64_t>(to)));
}

// Returns the length of each message, 0 for none. Every rank can compute it for all others.
std::uint64_t length(std::uint64_t round, int from, int to) {
  const std::uint64_t random = number(round, from, to);
  const std::uint64_t some = 1 + random % 3000;
  const int special = static_cast<int>(pnpbs::mixed(round) % static_cast<unsigned>(comm->size()));
  switch (static_cast<Pattern>(round % kPatterns)) {
    case kNobody:
      return 0;
    case kFew:
      return random % 4 == 0 ? some : 0;
    case kAll:
      return some;
    case kSelf:
      return from == to ? some : 0;
    case kOneToAll:
      return from == special ? some : 0;
    case kAllToOne:
      return to == special ? some : 0;
    case kLong:
      return random % 3 == 0 ? kPiece * (random % 4) + random % 2 * (some - 1) : 0;
    default:
      return 0;
  }
}

Bytes content(std::uint64_t round, int from, int to) {
  Bytes bytes(length(round, from, to));
  std::uint64_t state = number(round, from, to);
  for (char& byte : bytes) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    byte = static_cast<char>(state >> 56);
  }
  return bytes;
}

bool same(const std::vector<Message>& a, const std::vector<Message>& b) {
  bool all = a.size() == b.size();
  for (std::size_t k = 0; all && k < a.size(); ++k)
    all = a[k].rank == b[k].rank && a[k].bytes == b[k].bytes;
  return all;
}

// A round of exchanges on this rank: its messages, in an order that depends on the round, and the
// messages that it expects.
struct Round {
  std::vector<Message> outgoing, expected;
  std::int64_t announced = 0;

  explicit Round(std::uint64_t round) {
    const int me = comm->rank(), size = comm->size();
    for (int k = 0; k < size; ++k) {
      const int to = (k + me + static_cast<int>(round % 5)) % size;
      Bytes bytes = content(round, me, to);
      announced += to != me && !bytes.empty();
      // Empty messages to other ranks may be passed and are not delivered. An empty message to the
      // own rank is delivered, so none is passed.
      if (!bytes.empty() || (to != me && round % 2)) outgoing.push_back({to, std::move(bytes)});
    }
    for (int from = 0; from < size; ++from) {
      Bytes bytes = content(round, from, me);
      if (!bytes.empty()) expected.push_back({from, std::move(bytes)});
    }
  }
};

// ------------------------------------------------------------------ messages -------------------

void check_rounds() {
  for (std::uint64_t n = 0; n < 20 * kPatterns; ++n) {
    const Round round(n);
    const message_counts::Counts before = message_counts::counts;
    const std::vector<Message> incoming = comm->sparse_all_to_all(round.outgoing);
    const message_counts::Counts& after = message_counts::counts;
    const std::string what = "round " + std::to_string(n);
    expect(same(incoming, round.expected), what + ": what has come");
    expect(after.announced_messages() - before.announced_messages() == round.announced,
           what + ": one message to each rank that gets any");
    if (comm->size() > 1) expect(after.barriers - before.barriers == 1, what + ": one barrier");
  }
  expect(message_counts::counts.longest <= 32, "no table of all ranks");
}

// Checks that consecutive exchanges do not mix, even if some ranks are late and other kinds of
// exchanges lie between.
void check_mixing() {
  constexpr std::uint64_t kRounds = 300;
  std::vector<Round> rounds;
  for (std::uint64_t n = 0; n < kRounds; ++n) rounds.emplace_back(n % kPatterns == kLong ? 1 : n);
  std::vector<std::vector<Message>> incoming;
  for (std::uint64_t n = 0; n < kRounds; ++n) {
    if (number(n, comm->rank(), 0) % 16 == 0) usleep(number(n, comm->rank(), 1) % 1000);
    incoming.push_back(comm->sparse_all_to_all(rounds[n].outgoing));
  }
  for (std::uint64_t n = 0; n < kRounds; ++n)
    expect(same(incoming[n], rounds[n].expected), "no message of another exchange");

  std::vector<int> others(static_cast<std::size_t>(comm->size()));
  std::iota(others.begin(), others.end(), 0);
  others.erase(others.begin() + comm->rank());
  for (std::uint64_t n = 0; n < 50; ++n) {
    std::vector<Bytes> outgoing;
    for (const int to : others) outgoing.push_back(content(2, comm->rank(), to));
    const std::vector<Bytes> direct = comm->exchange(others, outgoing, nullptr);
    for (std::size_t k = 0; k < direct.size(); ++k)
      expect(direct[k] == content(2, others[k], comm->rank()), "exchange among neighbours");
    expect(same(comm->sparse_all_to_all(rounds[n].outgoing), rounds[n].expected),
           "between exchanges among neighbours");
  }
}

void check_records() {
  std::vector<std::int64_t> records;
  for (std::int64_t k = 0; k < 5000; ++k) records.push_back(5000 * comm->rank() + k);
  const auto owner = [&](std::int64_t record) {
    return static_cast<int>(pnpbs::mixed(static_cast<std::uint64_t>(record)) %
                            static_cast<unsigned>(comm->size()));
  };
  std::vector<std::int64_t> expected;  // in the order of ranks, and of the records of each rank
  for (std::int64_t record = 0; record < 5000 * comm->size(); ++record)
    if (owner(record) == comm->rank()) expected.push_back(record);
  expect(pnpbs::redistribute(*comm, records, owner) == expected, "records come to their owners");
}

// ------------------------------------------------------------------ failures -------------------

// Expects that all ranks throw the error of one.
template <class Work>
void expect_failure(int bad, pnpbs::ErrorKind kind, const std::string& part, const Work& work) {
  std::string told;
  try {
    pnpbs::collective_try(*comm, work);
  } catch (const pnpbs::Error& error) {
    refused_from = kNoLimit;
    told = error.what();
    expect(error.kind() == kind, part + ": kind of the error");
  } catch (const std::bad_alloc&) {
    refused_from = kNoLimit;
    told = part;
    expect(comm->size() == 1, "an error that ranks agree on");
  }
  refused_from = kNoLimit;
  // A rank without memory for the text reports only the lack of memory.
  const bool lacks = kind == pnpbs::ErrorKind::memory && comm->rank() == bad;
  const std::string begin = comm->size() > 1 && !(lacks && told.find("rank") != 0)
                                ? "rank " + std::to_string(bad) + ": "
                                : "";
  expect(told.find(begin) == 0 && told.find(part) != std::string::npos,
         "wanted \"" + begin + part + "\", got \"" + told + "\"");
}

void check_failures() {
  for (int bad = 0; bad < comm->size(); ++bad) {
    const Round round(kAll + kPatterns * static_cast<std::uint64_t>(bad));
    expect_failure(bad, pnpbs::ErrorKind::state, "in between", [&] {
      comm->sparse_all_to_all(round.outgoing);
      if (comm->rank() == bad) throw pnpbs::Error(pnpbs::ErrorKind::state, "in between");
      comm->sparse_all_to_all(round.outgoing);
      comm->sparse_all_to_all(round.outgoing);
    });
    expect(same(comm->sparse_all_to_all(round.outgoing), round.expected), "the next exchange");
  }
}

// Checks a rank without memory for incoming messages, complete or in pieces. Their senders must not
// wait forever.
void check_no_memory() {
  for (const std::uint64_t size : {std::uint64_t{20000}, 3 * kPiece + 7})
    for (int bad = 0; bad < comm->size() && comm->size() > 1; ++bad) {
      std::vector<Message> outgoing;
      for (int to = 0; to < comm->size(); ++to)
        if (to != comm->rank()) outgoing.push_back({to, Bytes(size, 'x')});
      expect_failure(bad, pnpbs::ErrorKind::memory, "memory", [&] {
        refused_from = comm->rank() == bad ? size : kNoLimit;
        comm->sparse_all_to_all(outgoing);
      });
      refused_from = kNoLimit;
      expect(comm->sparse_all_to_all(outgoing).size() == outgoing.size(), "with memory again");
    }
}

// Checks exchanges with neighbours if one rank, every other rank or all ranks have no memory. An
// exchange that was prepared before needs none. An exchange that needs memory fails on all ranks.
void check_neighbours_without_memory() {
  std::vector<int> others(static_cast<std::size_t>(comm->size()));
  std::iota(others.begin(), others.end(), 0);
  others.erase(others.begin() + comm->rank());
  if (others.empty()) return;
  const auto filled = [](int from, std::uint64_t pieces) {
    return Bytes(pieces * kPiece - 5, static_cast<char>('a' + from));
  };
  for (const int pattern : {0, 1, 2}) {
    const std::string what = "pattern " + std::to_string(pattern);
    // The number of pieces increases, so that memory of an earlier exchange is not sufficient.
    const std::uint64_t pieces = 3 + 2 * static_cast<std::uint64_t>(pattern);
    const bool bad = (pattern == 0 && comm->rank() == comm->size() / 2) ||
                     (pattern == 1 && comm->rank() % 2 == 0) || pattern == 2;
    const std::vector<Bytes> outgoing(others.size(), filled(comm->rank(), pieces));
    std::vector<Bytes> known(others.size(), Bytes(outgoing[0].size()));
    const auto exchange = comm->persistent_exchange(others, outgoing, known);
    bool told = false;
    refused_from = bad ? 1 : kNoLimit;
    exchange->start();
    exchange->wait();
    try {
      comm->exchange(others, outgoing, nullptr);
    } catch (const pnpbs::AgreedError& error) {
      told = error.kind() == pnpbs::ErrorKind::memory;
    }
    refused_from = kNoLimit;
    expect(told, what + ": a lack of memory");
    const std::vector<Bytes> incoming = comm->exchange(others, outgoing, nullptr);
    for (std::size_t k = 0; k < others.size(); ++k) {
      expect(known[k] == filled(others[k], pieces), what + ": a message of known size");
      expect(incoming[k] == filled(others[k], pieces), what + ": a message with memory again");
    }
  }
}

// ------------------------------------------------------------------ gathering ------------------

// Checks that all ranks throw if one has no memory for the contributions of the others.
void check_gathering() {
  for (int bad = 0; bad < comm->size() && comm->size() > 1; ++bad)
    for (const std::size_t limit : {std::size_t{1}, std::size_t{20000}}) {
      const Bytes mine(20000, static_cast<char>(comm->rank()));
      expect_failure(bad, pnpbs::ErrorKind::memory, "memory", [&] {
        refused_from = comm->rank() == bad ? limit : kNoLimit;
        comm->allgather(mine);
      });
      refused_from = kNoLimit;
      expect(comm->allgather(mine).size() == mine.size() * static_cast<std::size_t>(comm->size()),
             "what all give");
    }
}

// ------------------------------------------------------------------ sums over ranks ------------

void check_sums() {
  const auto value = [](int rank) { return std::int64_t{1000000007} * rank * rank - 5; };
  std::int64_t before = 0;
  for (int r = 0; r < comm->rank(); ++r) before += value(r);
  expect(comm->exclusive_scan(value(comm->rank())) == before, "sum of the ranks before");
}

void check_spans() {
  const auto count = [](int rank) {
    return std::size_t{7919} * static_cast<std::size_t>(rank % 3);
  };
  const pnpbs::RankSpan span = pnpbs::span_of(*comm, count(comm->rank()));
  std::int64_t first = 0, total = 0;
  for (int r = 0; r < comm->size(); ++r) {
    if (r < comm->rank()) first += static_cast<std::int64_t>(count(r));
    total += static_cast<std::int64_t>(count(r));
  }
  expect(span.first == first && span.total == total &&
             span.count == static_cast<std::int64_t>(count(comm->rank())),
         "span of the rank");
}

void check_all() {
  message_counts::counts = {};
  check_rounds();
  check_mixing();
  check_records();
  check_failures();
  check_no_memory();
  check_neighbours_without_memory();
  check_gathering();
  check_sums();
  check_spans();
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_all); }
