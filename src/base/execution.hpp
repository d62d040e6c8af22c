// SPDX-License-Identifier: BSD-3-Clause
// Where kernels run: the host's threads through Kokkos. The one place that knows which Kokkos
// versions there are (4.5 to 5.x have the same calls for what we use).
#pragma once

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <cstdint>
#include <exception>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>

#include "base/fixed_point.hpp"

namespace pnpbs {

using Exec = Kokkos::DefaultHostExecutionSpace;

template <class T>
using View = Kokkos::View<T*, Kokkos::HostSpace>;

// The first exception among the bodies of a parallel region. None may leave the region, which would
// end the process: the first one waits here until all bodies are done.
class FirstException {
 public:
  template <class Body>
  void catch_in(const Body& body) {
    try {
      body();
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!first_) first_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
};

// Runs body(i) for 0 <= i < n; a body may throw (a list that finds no memory). Bodies must not
// depend on each other: that, and reductions over integers and maxima only, make results the same
// for any number of threads.
template <class Body>
void for_each(const char* label, std::int64_t n, const Body& body) {
  FirstException failure;
  Kokkos::parallel_for(label, Kokkos::RangePolicy<Exec, Kokkos::IndexType<std::int64_t>>(0, n),
                       [&](std::int64_t i) { failure.catch_in([&] { body(i); }); });
  failure.rethrow();
}

// The largest of body(i), or `floor` if there is none.
template <class Body>
double max_of(const char* label, std::int64_t n, double floor, const Body& body) {
  double result = floor;
  FirstException failure;
  Kokkos::parallel_reduce(
      label, Kokkos::RangePolicy<Exec, Kokkos::IndexType<std::int64_t>>(0, n),
      [&](std::int64_t i, double& max) {
        failure.catch_in([&] {
          const double value = body(i);
          if (value > max) max = value;
        });
      },
      Kokkos::Max<double>(result));
  failure.rethrow();
  return result > floor ? result : floor;
}

// Sum of the integers body(i), modulo 2^64.
template <class Body>
std::uint64_t sum_of(const char* label, std::int64_t n, const Body& body) {
  std::uint64_t result = 0;
  FirstException failure;
  Kokkos::parallel_reduce(
      label, Kokkos::RangePolicy<Exec, Kokkos::IndexType<std::int64_t>>(0, n),
      [&](std::int64_t i, std::uint64_t& sum) {
        failure.catch_in([&] { sum += static_cast<std::uint64_t>(body(i)); });
      },
      result);
  failure.rethrow();
  return result;
}

// Integers that body(i, sums) adds to for 0 <= i < n; in any order they come out the same. `none`
// are the sums of nothing; add(sums) joins two.
template <class Sums, class Body>
Sums sums_over(const char* label, std::int64_t n, const Sums& none, const Body& body) {
  constexpr std::int64_t kChunk = 4096;
  Sums all = none;
  std::mutex adding;
  for_each(label, (n + kChunk - 1) / kChunk, [&](std::int64_t chunk) {
    Sums part = none;
    const std::int64_t end = std::min(n, (chunk + 1) * kChunk);
    for (std::int64_t i = chunk * kChunk; i < end; ++i) body(i, part);
    const std::lock_guard<std::mutex> lock(adding);
    all.add(part);
  });
  return all;
}

// Sum of the doubles body(i), in fixed point.
template <class Body>
FixedPointSum fixed_point_sum_of(const char* label, std::int64_t n, const Body& body) {
  return sums_over(label, n, FixedPointSum(),
                   [&](std::int64_t i, FixedPointSum& sum) { sum.add(body(i)); });
}

template <class T>
View<T> make_view(const std::string& label, std::int64_t n) {
  try {
    return View<T>(Kokkos::view_alloc(Kokkos::WithoutInitializing, label),
                   static_cast<std::size_t>(n));
  } catch (const std::runtime_error&) {  // what Kokkos makes of a lack of memory
    throw std::bad_alloc();
  }
}

// Makes room for n entries and keeps the first `kept`.
template <class T>
void grow(View<T>& view, std::int64_t n, std::int64_t kept) {
  if (static_cast<std::int64_t>(view.extent(0)) >= n) return;
  View<T> larger = make_view<T>(view.label(), n);
  const View<T> old = view;
  for_each("pnpbs::grow", kept, [=](std::int64_t i) { larger(i) = old(i); });
  view = larger;
}

}  // namespace pnpbs
