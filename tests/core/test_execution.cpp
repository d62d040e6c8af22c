// SPDX-License-Identifier: BSD-3-Clause
// Parallel loops: exceptions thrown by a body reach the caller and do not end the process.
#include <cstdint>
#include <new>
#include <vector>

#include "base/execution.hpp"
#include "base/found_indices.hpp"
#include "run_kernel_suite.hpp"

namespace {

constexpr std::int64_t kBodies = 10000;

// Throws in a few bodies, at least one of which runs on the last thread.
std::int64_t throwing(std::int64_t i) {
  if (i % 3333 == 3332) throw std::bad_alloc();
  return i;
}

template <class Loop>
bool throws(const Loop& loop) {
  try {
    loop();
  } catch (const std::bad_alloc&) {
    return true;
  }
  return false;
}

START_TEST(exceptions_come_to_the_caller) {
  ck_assert(
      throws([] { pnpbs::for_each("for_each", kBodies, [](std::int64_t i) { throwing(i); }); }));
  ck_assert(throws([] {
    pnpbs::max_of("max_of", kBodies, 0.0,
                  [](std::int64_t i) { return static_cast<double>(throwing(i)); });
  }));
  ck_assert(throws([] { pnpbs::sum_of("sum_of", kBodies, throwing); }));
}
END_TEST

START_TEST(bodies_run_though_one_has_thrown) {
  std::vector<char> ran(kBodies, 0);
  ck_assert(throws([&] {
    pnpbs::for_each("for_each", kBodies, [&](std::int64_t i) {
      ran[static_cast<std::size_t>(i)] = 1;
      throwing(i);
    });
  }));
  for (const char one : ran) ck_assert_int_eq(one, 1);
}
END_TEST

START_TEST(indices_are_found_in_order) {
  const auto holds = [](std::int64_t i) { return i % 7 == 3 || i == 0 || i == kBodies - 1; };
  std::vector<std::int64_t> expected;
  for (std::int64_t i = 0; i < kBodies; ++i)
    if (holds(i)) expected.push_back(i);
  ck_assert(pnpbs::indices_where("indices_where", kBodies, holds) == expected);
  ck_assert(pnpbs::indices_where("indices_where", 0, holds).empty());
  ck_assert(throws([] {
    pnpbs::indices_where("indices_where", kBodies, [](std::int64_t i) { return throwing(i) > 0; });
  }));
}
END_TEST

}  // namespace

TEST_SUITE(test_execution) {
  return run_kernel_suite("execution",
                          {exceptions_come_to_the_caller, bodies_run_though_one_has_thrown,
                           indices_are_found_in_order});
}
