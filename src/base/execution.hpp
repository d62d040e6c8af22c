// SPDX-License-Identifier: BSD-3-Clause
// Parallel loops and arrays on the threads of the host, through Kokkos. Only this header depends on
// the Kokkos version; versions 4.5 to 5.x have the same calls for all that is used here.
#pragma once

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "base/fixed_point.hpp"
#include "base/function_ref.hpp"

namespace pnpbs {

// A shared array of numbers or plain records in host memory. Copies refer to the same entries, and
// the last copy frees them. Unlike the destructor of a Kokkos::View, freeing neither throws nor
// allocates, so a lack of memory cannot end the process there.
template <class T>
class View {
  using Entry = std::remove_const_t<T>;
  static_assert(std::is_trivially_destructible_v<Entry>);

 public:
  View() = default;
  // Allocates n uninitialized entries, aligned to cache lines.
  explicit View(std::int64_t n) : entries_(allocated(n), Free{}), size_(n) {}
  // Creates a read-only view of the entries of another view.
  template <class U>
  requires(std::same_as<const U, T>) View(const View<U>& other)
      : entries_(other.entries_), size_(other.size_) {}  // NOLINT: implicit

  T& operator()(std::integral auto i) const { return entries_.get()[i]; }
  T* data() const { return entries_.get(); }
  std::size_t extent(int) const { return static_cast<std::size_t>(size_); }
  std::size_t size() const { return static_cast<std::size_t>(size_); }

 private:
  template <class U>
  friend class View;

  static constexpr std::align_val_t kAlignment{64};
  struct Free {
    void operator()(Entry* entries) const noexcept { ::operator delete(entries, kAlignment); }
  };
  static Entry* allocated(std::int64_t n) {
    constexpr std::int64_t kMost =
        std::numeric_limits<std::int64_t>::max() / static_cast<std::int64_t>(sizeof(Entry));
    if (n < 0 || n > kMost) throw std::bad_array_new_length();
    return static_cast<Entry*>(
        ::operator new(static_cast<std::size_t>(n) * sizeof(Entry), kAlignment));
  }

  std::shared_ptr<T> entries_;
  std::int64_t size_ = 0;
};

// Allocates an array of n uninitialized entries. `label` describes it to readers of the code and is
// not used.
template <class T>
View<T> make_view(const char* /*label*/, std::int64_t n) {
  return View<T>(n);
}

using Exec = Kokkos::DefaultHostExecutionSpace;

// Storage for the first exception thrown by the bodies of a parallel loop. An exception that leaves
// a parallel region ends the process, so it is stored here until all bodies have ended.
class FirstException {
 public:
  // Stores the current exception if it is the first one. Must be called in a catch block.
  void store() noexcept;
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
};

// Divides 0 <= i < n into one range of consecutive indices per thread and calls body(begin, end)
// for each range that is not empty, concurrently. The body must not throw. This is the only
// function that starts a Kokkos kernel, so that Kokkos' templates are compiled once. Throws
// Error(ErrorKind::state) in a forked process that lacks the threads (require_threads).
void for_each_range(const char* label, std::int64_t n,
                    FunctionRef<void(std::int64_t begin, std::int64_t end)> body);

// Calls body(i) for 0 <= i < n on all threads. If bodies throw, all other indices are still
// visited, and the first exception is rethrown at the end. Bodies must not depend on each other.
// Together with reductions that use only integers and maxima, this makes results independent of the
// number of threads.
template <class Body>
void for_each(const char* label, std::int64_t n, const Body& body) {
  FirstException failure;
  for_each_range(label, n, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      try {
        body(i);
      } catch (...) {
        failure.store();
      }
    }
  });
  failure.rethrow();
}

// Reduces over 0 <= i < n. Each range starts with a copy `part` of `none`, calls add(part, i) for
// its indices, and then join(part), one thread at a time. The result must not depend on the order
// of the ranges.
template <class Part, class Add, class Join>
void reduce(const char* label, std::int64_t n, const Part& none, const Add& add, const Join& join) {
  FirstException failure;
  std::mutex joining;
  for_each_range(label, n, [&](std::int64_t begin, std::int64_t end) {
    try {
      Part part = none;
      for (std::int64_t i = begin; i < end; ++i) add(part, i);
      const std::lock_guard<std::mutex> lock(joining);
      join(part);
    } catch (...) {
      failure.store();
    }
  });
  failure.rethrow();
}

// Returns the largest of body(i), or `floor` if no value is larger.
template <class Body>
double max_of(const char* label, std::int64_t n, double floor, const Body& body) {
  double result = floor;
  const auto take = [](double& max, double value) {
    if (value > max) max = value;
  };
  reduce(
      label, n, floor, [&](double& max, std::int64_t i) { take(max, body(i)); },
      [&](double max) { take(result, max); });
  return result;
}

// Returns the sum of the integers body(i), modulo 2^64.
template <class Body>
std::uint64_t sum_of(const char* label, std::int64_t n, const Body& body) {
  std::uint64_t result = 0;
  reduce(
      label, n, std::uint64_t{0},
      [&](std::uint64_t& sum, std::int64_t i) { sum += static_cast<std::uint64_t>(body(i)); },
      [&](std::uint64_t sum) { result += sum; });
  return result;
}

// Returns the sums to which body(i, sums) adds integers for 0 <= i < n. `none` holds empty sums,
// and sums.add(others) adds two partial results.
template <class Sums, class Body>
Sums sums_over(const char* label, std::int64_t n, const Sums& none, const Body& body) {
  Sums all = none;
  reduce(
      label, n, none, [&](Sums& sums, std::int64_t i) { body(i, sums); },
      [&](const Sums& sums) { all.add(sums); });
  return all;
}

// Returns the sum of the doubles body(i) in fixed point, which is the same for any number of
// threads.
template <class Body>
FixedPointSum fixed_point_sum_of(const char* label, std::int64_t n, const Body& body) {
  return sums_over(label, n, FixedPointSum(),
                   [&](std::int64_t i, FixedPointSum& sum) { sum.add(body(i)); });
}

// Enlarges the view to at least n entries and keeps the first `kept` of them.
template <class T>
void grow(View<T>& view, std::int64_t n, std::int64_t kept) {
  if (static_cast<std::int64_t>(view.extent(0)) >= n) return;
  const View<T> larger(n);
  const View<T> old = view;
  for_each("pnpbs::grow", kept, [=](std::int64_t i) { larger(i) = old(i); });
  view = larger;
}

}  // namespace pnpbs
