// SPDX-License-Identifier: BSD-3-Clause
// Tests of which round of a run is used, and whether another round follows.
#include <utility>

#include "run/finished_round.hpp"
#include "run_kernel_suite.hpp"

namespace {

using pnpbs::Outcome;

struct Rounds {
  pnpbs::BestRound<3> best;

  // Ends a round with these results, and returns whether another one follows.
  bool end(Outcome outcome, std::int64_t small_angles, const pnpbs::ElementFaults& faults = {}) {
    pnpbs::FinishedRound<3> round{nullptr, {}, {}, outcome, faults, small_angles};
    const bool more = best.needs_another(round);
    if (more) best.offer(std::move(round));
    return more;
  }
  bool end_with(const pnpbs::ElementFaults& faults) {
    return end(Outcome::not_conforming, 0, faults);
  }
};

START_TEST(one_counts_that_leaves_half_of_the_small_angles) {
  Rounds rounds;
  ck_assert(rounds.end(Outcome::converged, 8));
  ck_assert(rounds.end(Outcome::converged, 5));      // no improvement
  ck_assert(rounds.end(Outcome::not_converged, 4));  // an improvement
  ck_assert(!rounds.end(Outcome::converged, 3));     // no improvement again: the rounds end
  ck_assert(!rounds.best.last_counts());
  ck_assert_int_eq(rounds.best.take().small_angles, 4);
}
END_TEST

START_TEST(without_small_angles_there_is_no_other) {
  Rounds rounds;
  ck_assert(rounds.end(Outcome::converged, 1));
  ck_assert(!rounds.end(Outcome::spacing_missed, 0));
  ck_assert(rounds.best.last_counts());
  ck_assert(!Rounds().end(Outcome::converged, 0));
}
END_TEST

// Rounds continue until one conforms. After that, rounds that do not conform are not used.
START_TEST(torn_ones_count_only_where_none_is_whole) {
  Rounds rounds;
  for (std::int64_t torn = 5; torn > 0; --torn) ck_assert(rounds.end_with({.torn = torn}));
  ck_assert(!rounds.best.any_conforms());
  ck_assert(rounds.end(Outcome::converged, 9));
  ck_assert(rounds.best.any_conforms());
  ck_assert(rounds.end_with({.torn = 1}));
  ck_assert(!rounds.end_with({.torn = 1}));
  ck_assert(!rounds.best.last_counts());
  ck_assert_int_eq(rounds.best.take().small_angles, 9);
}
END_TEST

// The best round by the order of the faults is used if none conforms. Rounds end after three
// without improvement.
START_TEST(of_torn_ones_the_best_counts) {
  const pnpbs::ElementFaults in_order[] = {
      {.torn = 100},         {.lost_thousandths = 1},          {.euler = 2},
      {.pieces = 1},         {.pieces = 1, .torn = 1},         {.pieces = 2},
      {.no_elements = true}, {.no_elements = true, .euler = 1}};
  for (std::size_t k = 0; k + 1 < std::size(in_order); ++k)
    ck_assert(in_order[k] < in_order[k + 1]);
  Rounds rounds;
  ck_assert(rounds.end_with({.euler = 2, .torn = 1}));
  ck_assert(rounds.end_with({.lost_thousandths = 7, .torn = 50}));  // better
  ck_assert(rounds.end_with({.euler = 2}));
  ck_assert(rounds.end_with({.lost_thousandths = 8}));
  ck_assert(!rounds.end_with({.lost_thousandths = 7, .torn = 50}));
  ck_assert(!rounds.best.last_counts());
  ck_assert_int_eq(rounds.best.take().faults.torn, 50);
}
END_TEST

}  // namespace

TEST_SUITE(test_best_round) {
  return run_kernel_suite(
      "best_round",
      {one_counts_that_leaves_half_of_the_small_angles, without_small_angles_there_is_no_other,
       torn_ones_count_only_where_none_is_whole, of_torn_ones_the_best_counts});
}
