// SPDX-License-Identifier: BSD-3-Clause
// The limit of the growth of a spacing: d grows by at most g per unit of length on the way through
// the domain. d_limited(x) = min over y of (d(y) + g |x - y|), found once on a background tree, of
// which each rank holds its part. In the open the way is straight; around corners it is measured
// from leaf to leaf, up to 8 % too long. One y counts for a leaf, and those of the leaves it
// touches: in the plane, beside a line of sources d is up to a third too large for it; in space,
// where leaves are looked into as densely as nodes lie, a fifth. The same to the bit on any number
// of ranks.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "domain/node_limit.hpp"
#include "spacing/growth_labels.hpp"
#include "spacing/growth_leaves.hpp"
#include "spacing/line_of_sight.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

template <int Dim>
class GrowthLimit {
 public:
  using Beat = std::function<void()>;
  // For the spacing `raw`, which is evaluated here alone. ways: of the domain, its boundary at the
  // unlimited spacing.
  // Calls beat() again and again while it is made; what that throws on one rank ends it on all.
  // Collective.
  GrowthLimit(
      std::shared_ptr<const Communicator> comm, std::unique_ptr<const LineOfSight<Dim>> ways,
      const Spacing<Dim>& raw, const GrowthRule<Dim>& rule, const NodeLimit& limit,
      const Beat& beat = [] {});

  // Lowers d[n], what the spacing is at x[n], to the limit where it is larger. Collective: all
  // ranks ask at the same time, as many points as each wants. Of points in its own leaves a rank
  // asks nobody; where all ask the same points, nobody is asked of any.
  void limit(std::int64_t n, const Point<Dim>* x, double* d) const;

  // Of the tree, on this rank: own ones, and copies of those that touch them.
  std::int64_t leaves_held() const { return labels_.tree().count(); }

 private:
  void find_labels(const SpacingEvaluator<Dim>& raw, const SpacingHints<Dim>& known,
                   const NodeLimit& limit, const Beat& beat);
  std::vector<double> limits(std::int64_t n, const Point<Dim>* x) const;
  void take_answers_of_all(std::int64_t n, const Point<Dim>* x, std::vector<double>& limits) const;
  void ask_owners(std::int64_t n, const Point<Dim>* x, std::vector<double>& limits) const;

  std::shared_ptr<const Communicator> comm_;
  GrowthRule<Dim> rule_;
  std::unique_ptr<const LineOfSight<Dim>> ways_;
  GrowthLabels<Dim> labels_;
};

extern template class GrowthLimit<2>;
extern template class GrowthLimit<3>;

}  // namespace pnpbs
