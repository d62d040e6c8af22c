// SPDX-License-Identifier: BSD-3-Clause
// The limit of the growth of a spacing: d grows by at most g per unit of length along paths through
// the domain, d_limited(x) = min over y of (d(y) + g |x - y|). The limit is computed once on a
// distributed background tree, and it has the same bits on any number of ranks. Straight paths are
// exact. Paths around corners of the boundary lead from leaf to leaf and are up to 8 % too long. A
// leaf stores one source and also uses those of touching leaves. Hence d may be up to a third too
// large beside a line of sources in the plane, and up to a fifth in space, where leaves are sampled
// as densely as nodes lie.
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

// The growth limit of one spacing. Each rank stores a part of it.
template <int Dim>
class GrowthLimit {
 public:
  using Beat = std::function<void()>;
  // Computes the limit of the spacing `raw`, which is not stored. `ways` has the boundary of the
  // domain, in the plane discretised by the unlimited spacing. Calls beat() repeatedly; if it
  // throws on one rank, all ranks throw.
  // Collective.
  GrowthLimit(
      std::shared_ptr<const Communicator> comm, std::unique_ptr<const LineOfSight<Dim>> ways,
      const Spacing<Dim>& raw, const GrowthRule<Dim>& rule, const NodeLimit& limit,
      const Beat& beat = [] {});

  // Lowers d[n], the spacing at x[n], to the limit where it is larger. Points in a rank's own
  // leaves require no messages. If all ranks pass the same points, each rank evaluates those in its
  // own leaves, and the results are gathered.
  // Collective. Each rank may pass a different number of points, including none.
  void limit(std::int64_t n, const Point<Dim>* x, double* d) const;

  // Returns the number of leaves stored on this rank: own leaves and copies of touching ones.
  std::int64_t leaves_held() const { return labels_.tree().count(); }

 private:
  void find_labels(const SpacingEvaluator<Dim>& raw, const SpacingHints<Dim>& known,
                   const NodeLimit& limit, const Beat& beat);
  std::vector<double> limits(std::int64_t n, const Point<Dim>* x) const;
  void gather_limits(std::int64_t n, const Point<Dim>* x, std::vector<double>& limits) const;
  void query_owners(std::int64_t n, const Point<Dim>* x, std::vector<double>& limits) const;

  std::shared_ptr<const Communicator> comm_;
  GrowthRule<Dim> rule_;
  std::unique_ptr<const LineOfSight<Dim>> ways_;
  GrowthLabels<Dim> labels_;
};

extern template class GrowthLimit<2>;
extern template class GrowthLimit<3>;

}  // namespace pnpbs
