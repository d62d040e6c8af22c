// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/nodal_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "base/execution.hpp"
#include "base/point_text.hpp"
#include "comm/records.hpp"
#include "comm/same_points.hpp"

namespace pnpbs {

namespace {

// Number of boxes by which a rank describes its patch. More boxes mean fewer messages in vain.
constexpr std::size_t kBoxesPerRank = 64;

template <int Dim>
struct OwnedBox {
  Box<Dim> box;
  std::int64_t rank;
};

template <int Dim>
struct OwnerQuestion {
  Point<Dim> x;
  std::int64_t index;  // index of the point on rank `asker`
  std::int32_t asker, asked;
};

template <class Answer>
struct Reply {
  Answer answer;
  std::int64_t index;
  std::int64_t asker;
};

template <int Dim>
double squared_distance_to_far_corner(const Box<Dim>& box, const Point<Dim>& x) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) {
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

template <class Searched>
NodalSearch<Searched>::NodalSearch(std::shared_ptr<const Communicator> comm, Searched patch)
    : comm_(std::move(comm)),
      patch_(std::move(patch)),
      simplices_(gather_boxes(patch_.simplices_cover(kBoxesPerRank))),
      borders_(gather_boxes(patch_.border_cover(kBoxesPerRank))) {}

template <class Searched>
typename NodalSearch<Searched>::Directory NodalSearch<Searched>::gather_boxes(
    const std::vector<Box<kIn>>& mine) const {
  Bytes bytes;
  for (const Box<kIn>& box : mine) pack(bytes, OwnedBox<kIn>{box, comm_->rank()});
  Directory directory;
  for_records<OwnedBox<kIn>>(comm_->allgather(bytes), [&](const OwnedBox<kIn>& entry) {
    directory.boxes.push_back(entry.box);
    directory.ranks.push_back(static_cast<std::int32_t>(entry.rank));
  });
  directory.tree = BoxTree<kIn>(directory.boxes);
  return directory;
}

template <class Searched>
std::vector<std::int32_t> NodalSearch<Searched>::ranks_holding(const Point<kIn>& x) const {
  std::vector<std::int32_t> ranks;
  simplices_.tree.for_holding(
      x, [&](std::int32_t b) { ranks.push_back(simplices_.ranks[static_cast<std::size_t>(b)]); });
  sort_once(ranks);
  return ranks;
}

// Returns the ranks that may have the border facet nearest to x. A facet is no nearer than its box,
// and each box has a facet that is no farther than the box's farthest corner.
template <class Searched>
std::vector<std::int32_t> NodalSearch<Searched>::ranks_nearest(const Point<kIn>& x) const {
  constexpr double kRounding = 1 + 1e-6;
  double bound = std::numeric_limits<double>::infinity();
  std::vector<std::int32_t> near;
  borders_.tree.for_near(
      x, [&] { return bound; },
      [&](std::int32_t b) {
        const Box<kIn>& box = borders_.boxes[static_cast<std::size_t>(b)];
        bound = std::min(bound, kRounding * squared_distance_to_far_corner<kIn>(box, x));
        near.push_back(b);
      });
  std::vector<std::int32_t> ranks;
  for (const std::int32_t b : near)
    if (squared_gap_to(borders_.boxes[static_cast<std::size_t>(b)], x) <= bound)
      ranks.push_back(borders_.ranks[static_cast<std::size_t>(b)]);
  sort_once(ranks);
  return ranks;
}

// Searches for all points without an answer on the ranks that ranks_for(x) returns. `same`: all
// ranks pass the same points.
template <class Searched>
template <class Ranks>
void NodalSearch<Searched>::look(std::int64_t n, const Point<kIn>* x, bool same,
                                 const Ranks& ranks_for, Find how,
                                 std::vector<Answer>& answers) const {
  const std::int32_t me = comm_->rank();
  std::vector<OwnerQuestion<kIn>> questions;
  for (std::int64_t i = 0; i < n; ++i) {
    if (answers[static_cast<std::size_t>(i)].found()) continue;
    for (const std::int32_t rank : ranks_for(x[i]))
      if (!same || rank == me) questions.push_back({x[i], i, me, rank});
  }
  if (!same)
    questions = redistribute<OwnerQuestion<kIn>>(
        *comm_, questions, [](const OwnerQuestion<kIn>& q) { return static_cast<int>(q.asked); });

  std::vector<Reply<Answer>> replies(questions.size());
  for_each("pnpbs::NodalSearch::look", static_cast<std::int64_t>(questions.size()),
           [&](std::int64_t k) {
             const OwnerQuestion<kIn>& question = questions[static_cast<std::size_t>(k)];
             Reply<Answer>& reply = replies[static_cast<std::size_t>(k)];
             reply.index = question.index;
             reply.asker = question.asker;
             (patch_.*how)(question.x, reply.answer);
             reply.answer.rank = comm_->rank();
           });
  std::erase_if(replies, [](const Reply<Answer>& reply) { return !reply.answer.found(); });

  const auto take = [&](const Reply<Answer>& reply) {
    Answer& best = answers[static_cast<std::size_t>(reply.index)];
    if (reply.answer < best) best = reply.answer;
  };
  if (!same) {
    replies = redistribute<Reply<Answer>>(
        *comm_, replies, [](const Reply<Answer>& r) { return static_cast<int>(r.asker); });
    for (const Reply<Answer>& reply : replies) take(reply);
  } else {
    Bytes bytes;
    for (const Reply<Answer>& reply : replies) pack(bytes, reply);
    for_records<Reply<Answer>>(comm_->allgather(bytes), take);
  }
}

template <class Searched>
// Returns the number of points without an answer on all ranks. Collective.
std::int64_t NodalSearch<Searched>::open_on_all(const std::vector<Answer>& answers) const {
  const auto open = std::count_if(answers.begin(), answers.end(),
                                  [](const Answer& answer) { return !answer.found(); });
  return static_cast<std::int64_t>(comm_->allreduce_sum(static_cast<std::uint64_t>(open)));
}

template <class Searched>
auto NodalSearch<Searched>::find(std::int64_t n, const Point<kIn>* x) const -> std::vector<Answer> {
  const bool same = same_points<kIn>(*comm_, n, x);
  std::vector<Answer> answers(static_cast<std::size_t>(n));
  look(
      n, x, same, [this](const Point<kIn>& p) { return ranks_holding(p); }, &Searched::interpolate,
      answers);
  if (open_on_all(answers) > 0)
    look(
        n, x, same, [this](const Point<kIn>& p) { return ranks_nearest(p); }, &Searched::extend,
        answers);
  for (std::int64_t i = 0; i < n; ++i)
    if (!answers[static_cast<std::size_t>(i)].found())
      throw Error(ErrorKind::internal, "the values at nodes say nothing about " + point_text(x[i]));
  return answers;
}

template class NodalSearch<NodalPatch<2>>;
template class NodalSearch<NodalPatch<3>>;
template class NodalSearch<SpherePatch>;

}  // namespace pnpbs
