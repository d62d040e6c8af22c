// SPDX-License-Identifier: BSD-3-Clause
// The processes that run this command together: one, or those started by an MPI launcher. An error
// on one of them ends all, with one message.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "pnpbs/pnpbs.h"

namespace pnpbs::tool {

class Ranks {
 public:
  // Starts MPI if a launcher started this process. Throws Failure.
  Ranks(int& argc, char**& argv);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }  // the rank that prints
  bool launched() const { return launched_; }

  // The functions below are collective.
  void create_context(pnpbs_context* context) const;
  bool any(bool mine) const;
  // Performs local work. If it throws on one rank, all ranks throw the same Failure. `work` must
  // not communicate.
  void collective_try(const std::function<void()>& work) const;
  // Performs work on the first rank only, and returns its text on all ranks.
  std::string from_first(const std::function<std::string()>& work) const;
  // Returns the values of all ranks on the first rank, in the order of ranks, and nothing on the
  // others.
  template <class Value>
  std::vector<Value> gather(std::vector<Value> mine) const {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (size_ == 1) return mine;
    const std::vector<int> counts = gathered_counts(mine.size());
    std::size_t total = 0;
    for (const int count : counts) total += static_cast<std::size_t>(count);
    std::vector<Value> all(total);
    allgather_bytes(mine.data(), mine.size(), sizeof(Value), counts, all.data());
    return all;
  }

  // Ends all ranks at once. For errors of one rank that the others do not expect.
  [[noreturn]] void abort(int code) const;

 private:
  std::vector<int> gathered_counts(std::size_t mine) const;  // on the first rank, else empty
  void allgather_bytes(const void* mine, std::size_t count, std::size_t size,
                       const std::vector<int>& counts, void* all) const;
  void agree_on_failure(std::exception_ptr failure) const;
  void broadcast(std::string& text, int root) const;

  bool launched_ = false;
  int rank_ = 0, size_ = 1;
};

}  // namespace pnpbs::tool
