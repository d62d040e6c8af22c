// SPDX-License-Identifier: BSD-3-Clause
// Tests that stars that reach beyond the ghosts cause requests only to ranks that own nodes nearby.
// In a long strip with far too few nodes, each rank has two neighbours for any number of ranks.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "comm/records.hpp"
#include "message_counts.hpp"
#include "pnpbs/pnpbs_mpi.h"
#include "rank_checks.hpp"

namespace {

using rank_checks::comm;
using rank_checks::expect;

constexpr double kLength = 16, kSpacing = 0.02;
// Distance of the given nodes. The circumcircles are at most twice as wide.
constexpr double kGap = 0.25;

pnpbs_context context;

void require(pnpbs_status status, const char* what) {
  expect(status >= 0, std::string(what) + ": " + pnpbs_last_error(context));
}

pnpbs_placement sparse_strip() {
  const double corners[] = {0, 0, kLength, 0, kLength, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  require(pnpbs_domain_create(context, 2, &domain), "domain");
  require(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, nullptr, 0), "strip");
  require(pnpbs_placement_create(context, domain, &placement), "placement");
  pnpbs_domain_destroy(&domain);
  require(pnpbs_placement_set_spacing_constant(placement, kSpacing), "spacing");
  std::vector<double> given;
  for (double x = kGap; x < kLength - 0.5 * kGap && comm->rank() == 0; x += kGap)
    for (double y = kGap; y < 0.9; y += kGap) given.insert(given.end(), {x + 0.01 * y, y});
  require(pnpbs_placement_set_nodes(placement, static_cast<std::int64_t>(given.size() / 2),
                                    given.data(), nullptr),
          "nodes");
  require(pnpbs_placement_initialise(placement), "initialise");
  return placement;
}

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

// Returns the interval along the strip of the nodes of each rank.
std::vector<Interval> intervals_of_ranks(pnpbs_placement placement) {
  std::int64_t count = 0;
  require(pnpbs_placement_count(placement, &count), "count");
  std::vector<double> x(static_cast<std::size_t>(2 * count));
  require(pnpbs_placement_get_nodes(placement, count, x.data(), nullptr, nullptr, nullptr),
          "nodes");
  Interval own;
  for (std::size_t k = 0; k < x.size(); k += 2) {
    own.low = std::min(own.low, x[k]);
    own.high = std::max(own.high, x[k]);
  }
  pnpbs::Bytes bytes;
  pnpbs::pack(bytes, own);
  std::vector<Interval> all;
  pnpbs::for_records<Interval>(comm->allgather(bytes),
                               [&](const Interval& interval) { all.push_back(interval); });
  return all;
}

void check_questions() {
  require(pnpbs_context_create_mpi(rank_checks::group, &context), "context");
  pnpbs_placement placement = sparse_strip();
  const std::vector<Interval> all = intervals_of_ranks(placement);
  const Interval own = all[static_cast<std::size_t>(comm->rank())];
  message_counts::counts = {};
  std::int64_t entries = 0;
  require(pnpbs_placement_star_size(placement, &entries), "stars");
  const message_counts::Counts sent = message_counts::counts;

  // Distance within which a rank may receive requests: the circumcircles of a star, and a leaf or
  // two between the nodes and the border of a part.
  constexpr double kWay = 4 * kGap;
  std::int64_t near = 0;
  for (int r = 0; r < comm->size(); ++r) {
    const Interval& other = all[static_cast<std::size_t>(r)];
    const bool touched = other.low <= own.high + kWay && own.low <= other.high + kWay;
    near += touched && r != comm->rank();
    expect(touched || sent.announced.count(r) == 0,
           "rank " + std::to_string(r) + " is asked, far away");
  }
  expect(sent.announced_messages() <= near * sent.barriers, "one message at a time to each");
  // The parts of the strip follow each other along its length, so with eight ranks some are far
  // away.
  expect(comm->size() < 8 || near < comm->size() - 1, "some ranks are far away");
  const auto asked = static_cast<std::uint64_t>(sent.announced_messages());
  expect(comm->size() == 1 || comm->allreduce_sum(asked) > 0, "there are questions");
  require(pnpbs_placement_check(placement), "the triangulation is right");
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_questions); }
