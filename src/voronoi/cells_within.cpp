// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/cells_within.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/exact_sum.hpp"
#include "base/execution.hpp"
#include "base/point_text.hpp"
#include "voronoi/cell_in_body.hpp"

namespace pnpbs {

namespace {

// Beyond this, so much of the body is seen from no node that the volumes would mean little.
constexpr double kFarthestFactor = 1.25;

// Of what a node sees, in units of d: a corner of 30 degrees, half a spacing off its sides.
constexpr double kReach = 2;

// Over all ranks, exact: whatever rank has which cell.
double sum_of(const Communicator& comm, const std::vector<double>& volumes,
              const std::vector<char>& at_boundary, bool wall) {
  ExactSum sum;
  for (std::size_t n = 0; n < volumes.size(); ++n)
    if ((at_boundary[n] != 0) == wall) sum.add(volumes[n]);
  sum.carry();
  std::vector<std::int64_t> entries(sum.entries().begin(), sum.entries().end());
  comm.allreduce_sum(entries);
  std::ranges::copy(entries, sum.entries().begin());
  return sum.value();
}

template <int Dim>
double volume_in_body(const CellInBody<Dim>& cell, const ElementSites<Dim>& all,
                      const ElementsOfSites<Dim>& at_nodes, std::int64_t node, double d) {
  std::vector<std::int32_t> sites;
  for (const auto& entry : at_nodes.at(node)) {
    const auto of = all.of(all.elements[static_cast<std::size_t>(entry.element)]);
    sites.insert(sites.end(), of.begin(), of.end());
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  std::vector<Point<Dim>> x;
  for (const std::int32_t site : sites)
    if (site != node) x.push_back(all.x[static_cast<std::size_t>(site)]);
  return cell.volume(all.x[static_cast<std::size_t>(node)], kReach * d, x);
}

void require_near_one(double factor) {
  if (factor <= kFarthestFactor && factor >= 1 / kFarthestFactor) return;
  throw Error(ErrorKind::domain,
              "argument body: the cells of the nodes at its wall have " + rounded_text(1 / factor) +
                  " of the volume that is left for them there: the nodes do not fill this body, or "
                  "d is too large for its thin parts");
}

}  // namespace

template <int Dim>
void extend_to_wall(const Communicator& comm, const ElementSites<Dim>& all,
                    const ElementsOfSites<Dim>& at_nodes, const Domain<Dim>& body,
                    std::span<const double> d, VoronoiCells& cells) {
  const SignedDistance<Dim> within(body);
  const CellInBody<Dim> cell(within);
  agreed(comm, [&] {
    for_each("pnpbs::voronoi::wall", std::ssize(cells.volumes), [&](std::int64_t node) {
      const std::size_t n = static_cast<std::size_t>(node);
      if (!within.inside(all.x[n]))
        throw Error(ErrorKind::domain, "argument body: the node " + std::to_string(all.ids[n]) +
                                           " at " + point_text(all.x[n]) +
                                           " lies on its wall or outside: place nodes in what "
                                           "pnpbs_domain_add_offset makes of it");
      if (at_nodes.at(node).empty()) cells.at_boundary[n] = 1;  // no element has it
      if (cells.at_boundary[n] != 0)
        cells.volumes[n] = volume_in_body(cell, all, at_nodes, node, d[n]);
    });
  });
  const double inner = sum_of(comm, cells.volumes, cells.at_boundary, false),
               wall = sum_of(comm, cells.volumes, cells.at_boundary, true);
  const double factor = (measure_of(body) - inner) / wall;
  require_near_one(factor);
  for (std::size_t n = 0; n < cells.volumes.size(); ++n)
    if (cells.at_boundary[n] != 0) cells.volumes[n] *= factor;
}

template void extend_to_wall(const Communicator&, const ElementSites<2>&, const ElementsOfSites<2>&,
                             const PlaneDomain&, std::span<const double>, VoronoiCells&);
template void extend_to_wall(const Communicator&, const ElementSites<3>&, const ElementsOfSites<3>&,
                             const VolumeDomain&, std::span<const double>, VoronoiCells&);

}  // namespace pnpbs
