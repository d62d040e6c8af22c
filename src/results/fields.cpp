// SPDX-License-Identifier: BSD-3-Clause
// Fields of values that a solver has at nodes: their ghost updates, and sums over all ranks.
#include <algorithm>
#include <exception>
#include <mutex>

#include "base/error.hpp"
#include "base/exact_sum.hpp"
#include "base/execution.hpp"
#include "base/kokkos_runtime.hpp"
#include "base/mixed_hash.hpp"
#include "results/nodal_results.hpp"

namespace pnpbs {

namespace {

void require_components(std::int64_t components) {
  if (components < 1)
    throw Error(ErrorKind::argument,
                "argument components = " + std::to_string(components) + "; expected at least 1");
}

void require_values(const double* values, std::int64_t n, const char* argument) {
  if (n > 0 && !values)
    throw Error(ErrorKind::argument, std::string("argument ") + argument + " is NULL");
}

// Runs this rank's part of a collective call and checks that `number` is the same on all ranks. One
// reduction serves both the check and the agreement on failures.
template <class Work>
void agreed_with_same(const Communicator& comm, std::int64_t number, const char* argument,
                      const Work& work) {
  if (const std::exception_ptr failure = failure_of(work)) agree_on_failure(comm, failure);
  const std::uint64_t mine = mixed(static_cast<std::uint64_t>(number));
  if (comm.allreduce_sum(mine) != mine * static_cast<std::uint64_t>(comm.size()))
    throw Error(ErrorKind::argument, std::string("argument ") + argument + " = " +
                                         std::to_string(number) +
                                         " here; all ranks must give the same");
}

// Sums one component of a field, or of the products of two fields if y is not null. Writes the
// entries of an ExactSum.
void sum_component(std::int64_t n, std::int64_t components, const double* x, const double* y,
                   std::int64_t* entries) {
  constexpr std::int64_t kChunk = 1 << 13;
  static_assert(kChunk <= ExactProducts::kMaxTerms);
  ExactSum sum;
  std::mutex adding;
  for_each("pnpbs::sum_component", (n + kChunk - 1) / kChunk, [&](std::int64_t chunk) {
    ExactProducts products;
    const std::int64_t end = std::min(n, (chunk + 1) * kChunk);
    for (std::int64_t i = chunk * kChunk; i < end; ++i)
      products.add(x[i * components], y ? y[i * components] : 1);
    const std::lock_guard<std::mutex> lock(adding);
    products.add_to(sum);
  });
  sum.carry();
  std::copy(sum.entries().begin(), sum.entries().end(), entries);
}

}  // namespace

// After the ranks have agreed, nothing can fail before the messages are posted.
void NodalResults::begin_ghost_update(std::int64_t n, std::int64_t components,
                                      const double* values) {
  agreed_with_same(*comm_, components, "components", [&] {
    const auto pattern = exchange_pattern();
    if (ghost_update_.under_way())
      throw Error(ErrorKind::state, "an update of ghosts is under way: end it before the next");
    require_components(components);
    require_result_indices(n);
    require_values(values, n, "values");
    ghost_update_.pack(*comm_, pattern, components, values);
  });
  ghost_update_.start();
}

void NodalResults::end_ghost_update(std::int64_t n, std::int64_t components, double* values) {
  if (!ghost_update_.under_way())
    throw Error(ErrorKind::state, "no update of ghosts is under way: begin one first");
  ghost_update_.wait();
  if (exchange_stamp_ != stamp() || !ghost_update_.follows(exchange_pattern_)) {
    ghost_update_.drop();
    throw Error(ErrorKind::state,
                "nodes have moved or changed their ranks since the update of ghosts began: its "
                "values are dropped");
  }
  if (components != ghost_update_.components())
    throw Error(ErrorKind::argument, "argument components = " + std::to_string(components) +
                                         "; the update began with " +
                                         std::to_string(ghost_update_.components()));
  require_result_indices(n);
  require_values(values, n, "values");
  ghost_update_.unpack(values);
}

// After the ranks have agreed, nothing can fail before the messages are received.
void NodalResults::add_from_ghosts(std::int64_t n, std::int64_t components, double* values) {
  agreed_with_same(*comm_, components, "components", [&] {
    const auto pattern = exchange_pattern();
    require_components(components);
    require_result_indices(n);
    require_values(values, n, "values");
    ghost_sum_.pack(*comm_, pattern, components, values);
  });
  ghost_sum_.exchange();
  ghost_sum_.add(count(), values);
}

void NodalResults::require_result_indices(std::int64_t n) const {
  const std::int64_t places = held();
  if (n != places)
    throw Error(ErrorKind::argument, "argument n = " + std::to_string(n) + "; this rank has " +
                                         std::to_string(count()) + " nodes and " +
                                         std::to_string(places - count()) +
                                         " ghosts: give values for each of them");
}

void NodalResults::require_owned(std::int64_t n) const {
  if (n < count())
    throw Error(ErrorKind::argument, "argument n = " + std::to_string(n) + "; this rank has " +
                                         std::to_string(count()) +
                                         " nodes: give values for each of them");
}

void NodalResults::sum(std::int64_t n, std::int64_t components, const double* values,
                       double* sums) {
  agreed_with_same(*comm_, components, "components", [&] {
    require_components(components);
    require_owned(n);
    require_values(values, n, "values");
    require_values(sums, components, "sums");
    gather_terms(components, values, nullptr);
  });
  finish_sums(sums);
}

void NodalResults::dot(std::int64_t n, std::int64_t components, const double* x, const double* y,
                       double* products) {
  agreed_with_same(*comm_, components, "components", [&] {
    require_components(components);
    require_owned(n);
    require_values(x, n, "x");
    require_values(y, n, "y");
    require_values(products, components, "products");
    gather_terms(components, x, y);
  });
  finish_sums(products);
}

void NodalResults::gather_terms(std::int64_t components, const double* x, const double* y) {
  prepare_order();
  sum_entries_.resize(static_cast<std::size_t>(components) * ExactSum::kEntries);
  for (std::int64_t c = 0; c < components; ++c)
    sum_component(count(), components, x + c, y ? y + c : nullptr,
                  sum_entries_.data() + c * ExactSum::kEntries);
}

void NodalResults::finish_sums(double* sums) {
  comm_->allreduce_sum(sum_entries_);
  ExactSum sum;
  for (auto next = sum_entries_.begin(); next != sum_entries_.end(); next += ExactSum::kEntries) {
    std::copy_n(next, ExactSum::kEntries, sum.entries().begin());
    *sums++ = sum.value();
  }
}

}  // namespace pnpbs
