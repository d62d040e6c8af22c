// SPDX-License-Identifier: BSD-3-Clause
// A spacing whose growth is limited: d grows by at most g per unit of length on the way through
// the domain. d_limited(x) = min over y of (d(y) + g |x - y|), found once on the background tree.
// In the open the way is straight; around corners it is measured from leaf to leaf, up to 8 % too
// long. One y counts for a leaf, and those of the leaves it touches: beside a line of sources d is
// up to a third too large for it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "domain/plane/boundary.hpp"
#include "domain/plane/plane_domain.hpp"
#include "spacing/domain_map.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

class GrowthLimitedSpacing : public Spacing<2> {
 public:
  using Beat = std::function<void()>;
  // Calls beat() again and again while it is made; what that throws ends it.
  GrowthLimitedSpacing(
      const PlaneDomain& domain, std::shared_ptr<const Spacing<2>> raw, double growth,
      const NodeLimit& limit, const Beat& beat = [] {});
  void evaluate(std::int64_t n, const Point<2>* x, double* d) const override;

 private:
  // A point that limits d in the leaves around it: d there is at most this.
  struct Source {
    Point<2> x;
    double d;
  };

  void look_at_new_tree(const std::vector<Source>& sources, const Beat& beat);
  void fit_tree(const PlaneDomain& domain, const NodeLimit& limit, const Beat& beat);
  void link_leaves();
  double limit_by(const Source& source, const Point<2>& x) const;
  bool allows_less(const Source& source, std::int32_t leaf) const;  // in its middle
  bool offer(std::int32_t leaf, const Source& source);
  bool open_way(const Point<2>& a, const Point<2>& b) const;
  std::vector<Source> samples_of_leaves(double measure) const;
  void relax(const Beat& beat);
  double limit_at(const Point<2>& x) const;
  Point<2> centre(std::int32_t leaf) const {
    return map_.tree().cell_centre(map_.tree().leaf_cell(leaf));
  }

  std::shared_ptr<const Spacing<2>> raw_;
  double growth_;
  Boundary boundary_;  // at the unlimited spacing
  DomainMap<2> map_;
  std::vector<Source> source_;
  std::vector<double> at_centre_;               // limited d at the middle of each leaf
  std::vector<std::int32_t> offset_, next_to_;  // leaves that touch
};

}  // namespace pnpbs
