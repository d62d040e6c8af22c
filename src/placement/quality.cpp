// SPDX-License-Identifier: BSD-3-Clause
// What a placement tells of its elements, and whether its nodes follow d.
#include <algorithm>
#include <charconv>

#include "base/point_text.hpp"
#include "level/expected_nodes.hpp"
#include "level/found_nodes.hpp"
#include "level/volume/loose_pieces.hpp"
#include "placement/placement_of.hpp"
#include "spacing/beside_domain.hpp"

namespace pnpbs {

namespace {

// With a point in every locale.
std::string text_of(double value, std::chars_format format, int digits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, format, digits);
  return {text, end.ptr};
}
std::string two_decimals(double value) { return text_of(value, std::chars_format::fixed, 2); }
std::string three_digits(double value) { return text_of(value, std::chars_format::general, 3); }

std::string warning_of(const EdgeBand& band) {
  const double mean = band.ratio.mean;
  return "the nodes do not follow the spacing where it is " + three_digits(band.from) + " to " +
         three_digits(band.to) + ": over " + std::to_string(band.ratio.edges) +
         " edges, the mean length is " + two_decimals(mean) + " of it, with too " +
         (mean > 1 ? "few" : "many") +
         " nodes; limit the growth of the spacing (option growth_limit), or allow more steps "
         "(option steps)";
}

}  // namespace

// By the edges at the end of a run; if so there is a warning.
bool Placement::spacing_missed() {
  const EdgeBand* worst = worst_missed_band(state_.edge_bands);
  if (worst) state_.warnings.push_back(warning_of(*worst));
  return worst != nullptr;
}

// Where the last run's tetrahedra do not follow the surfaces.
void Placement::warn_of_surface_fit() {
  const SurfaceFit& fit = state_.surface_fit;
  const std::string what_helps =
      std::string("make it smaller there") +
      (options_.integer("resolve") == 0 ? ", or try the option resolve" : "");
  if (fit.missing_faces > 0)
    state_.warnings.push_back("the boundary of the tetrahedra does not follow the surface at " +
                              std::to_string(fit.missing_faces) +
                              " triangles (statistic missing_faces), one of them at " +
                              rounded_point_text<3>(fit.missing_at) +
                              "; the spacing does not resolve the shape: " + what_helps);
}

// Corners and feature edges that the elements do not have.
template <>
void PlacementOf<3>::warn_of_features_left_out() {
  const FoundNodes<3> features = features_left_out(*level_);
  if (features.count > 0)
    state_.warnings.push_back(
        "left out: " + std::to_string(features.count) +
        " nodes of corners and sharp edges, one of them at " + rounded_point_text<3>(features.at) +
        ": the body is thinner than the spacing there, and no tetrahedra held on to "
        "them; make the spacing smaller there to keep them");
}

// Nodes in corners and on curves, and nothing between them, are no picture of any spacing.
template <>
void PlacementOf<3>::warn_of_coarse_spacing() {
  constexpr double kCoarse = 0.5, kRight = 0.25;  // of the longest side
  const Box<3>& bounds = domain_->bounds();
  double side = 0;
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, bounds.high[k] - bounds.low[k]);
  const double d = spacing_variation(*level_).min;
  if (d > kCoarse * side)
    state_.warnings.push_back("the spacing is " + three_digits(d) +
                              " or more, the longest side of the domain " + three_digits(side) +
                              ": corners, edges and curved surfaces alone decide where nodes are; "
                              "nodes follow a spacing of " +
                              three_digits(kRight * side) + " or less");
}

// Nodes that are farther than d from where the spacing is given: those between a curved boundary
// and a mesh whose edges cut its corners are not. Collective.
template <int Dim>
void PlacementOf<Dim>::warn_of_partial_extent() {
  constexpr std::int64_t kBatch = 1 << 14;  // bounds the memory for the points
  const std::optional<GivenExtent<Dim>> extent = spacing_->extent();
  if (!extent) return;
  const Nodes<Dim>& nodes = level_->nodes;
  FoundNodes<Dim> beyond;
  agreed(*comm_, [&] {
    std::vector<Point<Dim>> x;
    std::vector<double> distance;
    for (std::int64_t begin = 0; begin < nodes.count; begin += kBatch) {
      const std::int64_t n = std::min(kBatch, nodes.count - begin);
      x.resize(static_cast<std::size_t>(n));
      distance.resize(x.size());
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] = nodes.position(begin + static_cast<std::int64_t>(k));
      spacing_->distance_to_extent(n, x.data(), distance.data());
      for (std::size_t k = 0; k < x.size(); ++k) {
        const std::int64_t i = begin + static_cast<std::int64_t>(k);
        if (nodes.owned(i)) beyond.add(distance[k] > nodes.d(i), nodes.id(i), x[k]);
      }
    }
  });
  beyond = over_ranks(*comm_, beyond);
  const std::uint64_t all = comm_->allreduce_sum(static_cast<std::uint64_t>(results_.count()));
  if (beyond.count == 0) return;
  const Box<Dim>& bounds = domain_->bounds();
  const std::string name = extent->name;
  state_.warnings.push_back(
      "the " + name + " of the spacing covers only a part of the domain: of " +
      std::to_string(all) + " nodes, " + std::to_string(beyond.count) +
      " are farther than d from it, one of them at " + rounded_point_text<Dim>(beyond.at) +
      "; there " + extent->beyond + ". The " + name + " reaches " +
      extent_text<Dim>(extent->box, bounds) + ", the domain " + extent_text<Dim>(bounds, bounds));
}

template void PlacementOf<2>::warn_of_partial_extent();
template void PlacementOf<3>::warn_of_partial_extent();

}  // namespace pnpbs
