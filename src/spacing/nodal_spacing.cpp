// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/nodal_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "base/execution.hpp"
#include "base/mixed_hash.hpp"
#include "base/point_text.hpp"
#include "comm/records.hpp"

namespace pnpbs {

namespace {

// Boxes that each rank tells of what it holds: the more, the fewer ranks are asked in vain.
constexpr std::size_t kBoxesPerRank = 64;

struct OwnedBox {
  Box<2> box;
  std::int64_t rank;
};

struct Question {
  Point<2> x;
  std::int64_t index;  // among the points of the asker
  std::int32_t asker, asked;
};

struct Reply {
  PatchAnswer answer;
  std::int64_t index;
  std::int64_t asker;
};

double squared_distance_to_far_corner(const Box<2>& box, const Point<2>& x) {
  double sum = 0;
  for (int k = 0; k < 2; ++k) {
    const double far = std::max(std::fabs(x[k] - box.low[k]), std::fabs(x[k] - box.high[k]));
    sum += far * far;
  }
  return sum;
}

void sort_once(std::vector<std::int32_t>& ranks) {
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
}

}  // namespace

NodalSpacing::NodalSpacing(std::shared_ptr<const Communicator> comm, Patch patch)
    : comm_(std::move(comm)),
      patch_(std::move(patch)),
      triangles_(gather_boxes(patch_.triangles_cover(kBoxesPerRank))),
      rims_(gather_boxes(patch_.rim_cover(kBoxesPerRank))) {}

NodalSpacing::Directory NodalSpacing::gather_boxes(const std::vector<Box<2>>& mine) const {
  Bytes bytes;
  for (const Box<2>& box : mine) pack(bytes, OwnedBox{box, comm_->rank()});
  Directory directory;
  for_records<OwnedBox>({comm_->allgather(bytes)}, [&](const OwnedBox& entry) {
    directory.boxes.push_back(entry.box);
    directory.ranks.push_back(static_cast<std::int32_t>(entry.rank));
  });
  directory.tree = BoxTree<2>(directory.boxes);
  return directory;
}

std::vector<std::int32_t> NodalSpacing::ranks_holding(const Point<2>& x) const {
  std::vector<std::int32_t> ranks;
  triangles_.tree.for_holding(
      x, [&](std::int32_t b) { ranks.push_back(triangles_.ranks[static_cast<std::size_t>(b)]); });
  sort_once(ranks);
  return ranks;
}

// No rim edge is nearer than its box, and some edge in a box is no farther than the box's far
// corner.
std::vector<std::int32_t> NodalSpacing::ranks_nearest(const Point<2>& x) const {
  constexpr double kRounding = 1 + 1e-6;
  double bound = std::numeric_limits<double>::infinity();
  std::vector<std::int32_t> near;
  rims_.tree.for_near(
      x, [&] { return bound; },
      [&](std::int32_t b) {
        const Box<2>& box = rims_.boxes[static_cast<std::size_t>(b)];
        bound = std::min(bound, kRounding * squared_distance_to_far_corner(box, x));
        near.push_back(b);
      });
  std::vector<std::int32_t> ranks;
  for (const std::int32_t b : near)
    if (squared_gap_to(rims_.boxes[static_cast<std::size_t>(b)], x) <= bound)
      ranks.push_back(rims_.ranks[static_cast<std::size_t>(b)]);
  sort_once(ranks);
  return ranks;
}

bool NodalSpacing::same_points(std::int64_t n, const Point<2>* x) const {
  if (comm_->size() == 1) return true;
  std::uint64_t hash = mixed(static_cast<std::uint64_t>(n));
  for (std::int64_t i = 0; i < n; ++i)
    for (const double coordinate : x[i]) {
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = mixed(hash ^ bits);
    }
  return comm_->same_on_all(hash);
}

// Asks for all points without an answer.
template <class Ranks>
void NodalSpacing::look(std::int64_t n, const Point<2>* x, bool same, const Ranks& ranks_for,
                        Find find, std::vector<PatchAnswer>& answers) const {
  const std::int32_t me = comm_->rank();
  std::vector<Question> questions;
  for (std::int64_t i = 0; i < n; ++i) {
    if (answers[static_cast<std::size_t>(i)].found()) continue;
    for (const std::int32_t rank : ranks_for(x[i]))
      if (!same || rank == me) questions.push_back({x[i], i, me, rank});
  }
  if (!same)
    questions = redistribute<Question>(*comm_, questions,
                                       [](const Question& q) { return static_cast<int>(q.asked); });

  std::vector<Reply> replies(questions.size());
  for_each("pnpbs::NodalSpacing::look", static_cast<std::int64_t>(questions.size()),
           [&](std::int64_t k) {
             const Question& question = questions[static_cast<std::size_t>(k)];
             Reply& reply = replies[static_cast<std::size_t>(k)];
             reply.index = question.index;
             reply.asker = question.asker;
             (patch_.*find)(question.x, reply.answer);
           });
  std::erase_if(replies, [](const Reply& reply) { return !reply.answer.found(); });

  const auto take = [&](const Reply& reply) {
    PatchAnswer& best = answers[static_cast<std::size_t>(reply.index)];
    if (reply.answer < best) best = reply.answer;
  };
  if (!same) {
    replies = redistribute<Reply>(*comm_, replies,
                                  [](const Reply& r) { return static_cast<int>(r.asker); });
    for (const Reply& reply : replies) take(reply);
  } else {
    Bytes bytes;
    for (const Reply& reply : replies) pack(bytes, reply);
    for_records<Reply>({comm_->allgather(bytes)}, take);
  }
}

std::int64_t NodalSpacing::open_on_all(const std::vector<PatchAnswer>& answers) const {
  const auto open = std::count_if(answers.begin(), answers.end(),
                                  [](const PatchAnswer& answer) { return !answer.found(); });
  return static_cast<std::int64_t>(comm_->allreduce_sum(static_cast<std::uint64_t>(open)));
}

void NodalSpacing::evaluate(std::int64_t n, const Point<2>* x, double* d) const {
  const bool same = same_points(n, x);
  std::vector<PatchAnswer> answers(static_cast<std::size_t>(n));
  look(
      n, x, same, [this](const Point<2>& p) { return ranks_holding(p); }, &NodalPatch::interpolate,
      answers);
  if (open_on_all(answers) > 0)
    look(
        n, x, same, [this](const Point<2>& p) { return ranks_nearest(p); }, &NodalPatch::extend,
        answers);
  for (std::int64_t i = 0; i < n; ++i) {
    const PatchAnswer& answer = answers[static_cast<std::size_t>(i)];
    if (!answer.found())
      throw Error(ErrorKind::internal,
                  "the values at nodes say nothing about the spacing at " + point_text(x[i]));
    d[i] = answer.value;
  }
}

}  // namespace pnpbs
