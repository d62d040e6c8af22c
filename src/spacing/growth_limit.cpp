// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/growth_limit.hpp"

#include <limits>
#include <utility>

#include "base/execution.hpp"
#include "comm/records.hpp"
#include "comm/same_points.hpp"

namespace pnpbs {

namespace {

template <int Dim>
struct Question {
  Point<Dim> x;
  std::int64_t index;  // index of the point on rank `asker`
  std::int32_t asker;
};

struct Answer {
  double limit;
  std::int64_t index;
  std::int64_t asker;
};

}  // namespace

template <int Dim>
GrowthLimit<Dim>::GrowthLimit(std::shared_ptr<const Communicator> comm,
                              std::unique_ptr<const LineOfSight<Dim>> ways, const Spacing<Dim>& raw,
                              const GrowthRule<Dim>& rule, const NodeLimit& limit, const Beat& beat)
    : comm_(std::move(comm)), rule_(rule), ways_(std::move(ways)) {
  const SpacingEvaluator<Dim> checked = [&](std::int64_t n, const Point<Dim>* x, double* d) {
    beat();
    evaluate_spacing<Dim>(raw, ways_->measure(), n, x, d);
  };
  collective_try(*comm_, [&] { find_labels(checked, raw.spacing_hints(), limit, beat); });
}

// Alternates between computing the limit and refining the leaves by it. The first leaves follow the
// unlimited d and have one source each, which is too coarse beside a jump, and misses fine d in a
// corner of a leaf. Leaves that follow the limited d do not.
template <int Dim>
void GrowthLimit<Dim>::find_labels(const SpacingEvaluator<Dim>& raw, const SpacingHints<Dim>& known,
                                   const NodeLimit& limit, const Beat& beat) {
  constexpr int kMaxPasses = 6;
  const SpacingEvaluator<Dim> limited = [&](std::int64_t n, const Point<Dim>* x, double* d) {
    beat();
    for_each("pnpbs::GrowthLimit::fit", n,
             [&](std::int64_t i) { d[i] = labels_.limit_at(*ways_, x[i]); });
  };
  std::vector<Point<Dim>> places;
  for (const GrowthSource<Dim>& value : known.in_domain) places.push_back(value.x);
  GrowthLeaves<Dim> leaves(*comm_, *ways_, rule_, limit, std::move(places));
  leaves.refine(raw, known.values);
  labels_ = {*comm_, *ways_, leaves.own(), rule_, beat};
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    bool changed = leaves.fit(limited);
    if constexpr (Dim == 3) changed = leaves.find_dips(raw, limited) || changed;
    if (!changed) break;
    leaves.look_into_new(raw);
    labels_ = {*comm_, *ways_, leaves.own(), rule_, beat};
  }
}

template <int Dim>
std::vector<double> GrowthLimit<Dim>::limits(std::int64_t n, const Point<Dim>* x) const {
  std::vector<double> limits(static_cast<std::size_t>(n));
  for_each("pnpbs::GrowthLimit::limits", n, [&](std::int64_t i) {
    limits[static_cast<std::size_t>(i)] = labels_.limit_at(*ways_, x[i]);
  });
  return limits;
}

template <int Dim>
void GrowthLimit<Dim>::gather_limits(std::int64_t n, const Point<Dim>* x,
                                     std::vector<double>& limits) const {
  const TreePart<Dim>& tree = labels_.tree();
  Bytes mine;
  for (std::int64_t i = 0; i < n; ++i)
    if (tree.owns(tree.leaf_at(x[i])))
      pack(mine, Answer{limits[static_cast<std::size_t>(i)], i, comm_->rank()});
  for_records<Answer>(comm_->allgather(mine), [&](const Answer& answer) {
    limits[static_cast<std::size_t>(answer.index)] = answer.limit;
  });
}

template <int Dim>
void GrowthLimit<Dim>::query_owners(std::int64_t n, const Point<Dim>* x,
                                    std::vector<double>& limits) const {
  const TreePart<Dim>& tree = labels_.tree();
  std::vector<Question<Dim>> questions;
  for (std::int64_t i = 0; i < n; ++i)
    if (!tree.owns(tree.leaf_at(x[i]))) questions.push_back({x[i], i, comm_->rank()});
  questions = redistribute<Question<Dim>>(
      *comm_, questions, [&](const Question<Dim>& q) { return tree.rank_with(q.x); });
  std::vector<Answer> answers(questions.size());
  for_each("pnpbs::GrowthLimit::answer", std::ssize(questions), [&](std::int64_t k) {
    const Question<Dim>& question = questions[static_cast<std::size_t>(k)];
    answers[static_cast<std::size_t>(k)] = {labels_.limit_at(*ways_, question.x), question.index,
                                            question.asker};
  });
  answers = redistribute<Answer>(*comm_, answers,
                                 [](const Answer& a) { return static_cast<int>(a.asker); });
  for (const Answer& answer : answers)
    limits[static_cast<std::size_t>(answer.index)] = answer.limit;
}

template <int Dim>
void GrowthLimit<Dim>::limit(std::int64_t n, const Point<Dim>* x, double* d) const {
  std::vector<double> limited = limits(n, x);
  if (comm_->size() > 1) {
    if (same_points<Dim>(*comm_, n, x))
      gather_limits(n, x, limited);
    else
      query_owners(n, x, limited);
  }
  // NaN fails this comparison and is kept, so that it is reported.
  for (std::int64_t i = 0; i < n; ++i)
    if (d[i] > limited[static_cast<std::size_t>(i)]) d[i] = limited[static_cast<std::size_t>(i)];
}

template class GrowthLimit<2>;
template class GrowthLimit<3>;

}  // namespace pnpbs
