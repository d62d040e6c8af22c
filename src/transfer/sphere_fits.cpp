// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/sphere_fits.hpp"

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

StereographicChart opposite_chart(const StereographicChart& chart) {
  const auto [x, y, z] = chart.projection_centre();
  return {chart.radius(), {-x, -y, -z}};
}

std::vector<PatchNode<2>> charted(const StereographicChart& chart,
                                  const std::vector<PatchNode<3>>& nodes) {
  std::vector<PatchNode<2>> charted;
  charted.reserve(nodes.size());
  for (const PatchNode<3>& node : nodes)
    charted.push_back({chart.in_chart(node.x), node.id, node.value});
  return charted;
}

}  // namespace

SphereFits::InChart::InChart(const StereographicChart& in, Results<2>& results,
                             const std::vector<PatchNode<3>>& nodes, std::int64_t components,
                             const std::vector<double>& values)
    : chart(in), fits(results, charted(in, nodes), components, values) {}

SphereFits::SphereFits(Results<2>& results, const std::vector<PatchNode<3>>& nodes,
                       std::int64_t components, const std::vector<double>& values)
    : charts_{InChart(results.embedding().chart(), results, nodes, components, values),
              InChart(opposite_chart(results.embedding().chart()), results, nodes, components,
                      values)} {
  const Point<3> from = results.embedding().chart().projection_centre();
  for (const PatchNode<3>& node : nodes) chart_at_.push_back(dot(node.x, from) > 0 ? 1 : 0);
  std::uint64_t without = 0;
  const std::int64_t owned = results.count();
  for (std::int64_t p = 0; p < owned; ++p) without += !has(static_cast<std::int32_t>(p));
  nodes_without_ = static_cast<std::int64_t>(results.communicator().allreduce_sum(without));
}

double SphereFits::rise(std::int32_t place, std::int64_t component, const Point<3>& x) const {
  const InChart& in = at(place);
  return in.fits.rise(place, component, in.chart.in_chart(x));
}

}  // namespace pnpbs
