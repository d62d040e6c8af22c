// SPDX-License-Identifier: BSD-3-Clause
// Of the rounds of a run, which counts, and whether there is another one.
#include <utility>

#include "run/finished_round.hpp"
#include "run_kernel_suite.hpp"

namespace {

using pnpbs::Outcome;

struct Rounds {
  pnpbs::BestRound<3> best;

  // One that ends so: is there another one?
  bool end(Outcome outcome, std::int64_t small_angles) {
    const bool more = best.asks_for_another(outcome, small_angles);
    if (more) best.offer({nullptr, {}, {}, outcome, small_angles});
    return more;
  }
};

START_TEST(one_counts_that_leaves_half_of_the_small_angles) {
  Rounds rounds;
  ck_assert(rounds.end(Outcome::converged, 8));
  ck_assert(rounds.end(Outcome::converged, 5));      // in vain
  ck_assert(rounds.end(Outcome::not_converged, 4));  // counts
  ck_assert(!rounds.end(Outcome::converged, 3));     // in vain, too: that was enough
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

// They go on until one conforms, and none that does not takes its place.
START_TEST(torn_ones_count_only_where_none_is_whole) {
  Rounds rounds;
  for (int round = 0; round < 5; ++round) ck_assert(rounds.end(Outcome::not_conforming, 0));
  ck_assert(!rounds.best.any_kept());
  ck_assert(rounds.best.last_counts());
  ck_assert(rounds.end(Outcome::converged, 9));
  ck_assert(rounds.end(Outcome::not_conforming, 0));
  ck_assert(!rounds.end(Outcome::not_conforming, 0));
  ck_assert(!rounds.best.last_counts());
  ck_assert_int_eq(rounds.best.take().small_angles, 9);
}
END_TEST

}  // namespace

TEST_SUITE(test_best_round) {
  return run_kernel_suite("best_round", {one_counts_that_leaves_half_of_the_small_angles,
                                         without_small_angles_there_is_no_other,
                                         torn_ones_count_only_where_none_is_whole});
}
