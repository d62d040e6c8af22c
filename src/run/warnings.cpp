// SPDX-License-Identifier: BSD-3-Clause
#include "run/warnings.hpp"

#include <algorithm>
#include <charconv>

#include "base/point_text.hpp"
#include "level/expected_nodes.hpp"
#include "level/found_nodes.hpp"
#include "level/volume/loose_pieces.hpp"
#include "sizing/limiting_growth.hpp"
#include "spacing/outside_domain.hpp"

namespace pnpbs {

namespace {

// Formats a number with a decimal point, whatever the locale is.
std::string two_decimals(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 2);
  return {text, end.ptr};
}

Warning warning_of(const EdgeBand& band) {
  const double mean = band.ratio.mean;
  const std::string from = rounded_text(band.from), to = rounded_text(band.to);
  return {WarningCode::spacing_missed,
          "the nodes do not follow the spacing where it is " +
              (from == to ? from : from + " to " + to) + ": over " +
              std::to_string(band.ratio.edges) + " edges, the mean length is " +
              two_decimals(mean) + " of it, with too " + (mean > 1 ? "few" : "many") +
              " nodes; limit the growth of the spacing (option growth_limit), or allow more steps "
              "(option steps)",
          static_cast<std::int64_t>(band.ratio.edges), mean};
}

// Warns of a spacing so coarse that nearly all nodes lie in corners and on curves, where they do
// not represent any spacing.
std::optional<Warning> warning_of_coarse_spacing(const Level<2>&, const PlaneDomain&) {
  return std::nullopt;
}
std::optional<Warning> warning_of_coarse_spacing(const Level<3>& level,
                                                 const VolumeDomain& domain) {
  constexpr double kCoarse = 0.5, kRight = 0.25;  // fractions of the longest side
  const Box<3>& bounds = domain.bounds();
  double side = 0;
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, bounds.high[k] - bounds.low[k]);
  const double d = spacing_variation(level).min;
  if (d <= kCoarse * side) return std::nullopt;
  return Warning(WarningCode::spacing_coarse,
                 "the spacing is " + rounded_text(d) + " or more, the longest side of the domain " +
                     rounded_text(side) +
                     ": nodes lie on corners, edges and curved surfaces only; use a spacing of " +
                     rounded_text(kRight * side) + " or less",
                 0, d);
}

// Returns a text such as ". The grid reaches from ... to ...".
template <int Dim>
MessageText reach_text(const GivenExtent<Dim>& extent, const Domain<Dim>& domain) {
  const std::string begin = std::string(". The ") + extent.name + " reaches ";
  if (domain.embedding().is_sphere())
    return extent.on_sphere.empty() ? std::string() : begin + extent.on_sphere;
  const Box<Dim>& bounds = domain.bounds();
  return begin + extent_text<Dim>(extent.box, bounds) + ", the domain " +
         extent_text<Dim>(bounds, bounds);
}

// Warns of nodes that are farther than d from the region in which the spacing is given. Nodes
// between a curved boundary and a mesh whose edges cut its corners are closer than that. Throws
// Error if all nodes of a sphere are that far away, where the comparison of boxes cannot detect it.
// All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
std::optional<Warning> warning_of_partial_extent(const Level<Dim>& level, const Domain<Dim>& domain,
                                                 const Spacing<Dim>& given) {
  constexpr std::int64_t kBatch = 1 << 14;  // limits the memory for the points
  const std::optional<GivenExtent<Dim>> extent = given.extent();
  if (!extent) return std::nullopt;
  const Communicator& comm = *level.comm;
  const Nodes<Dim>& nodes = level.nodes;
  FoundNodes<Dim> beyond;
  collective_try(comm, [&] {
    std::vector<Point<Dim>> x;
    std::vector<double> distance;
    for (std::int64_t begin = 0; begin < nodes.count; begin += kBatch) {
      const std::int64_t n = std::min(kBatch, nodes.count - begin);
      x.resize(static_cast<std::size_t>(n));
      distance.resize(x.size());
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] = nodes.position(begin + static_cast<std::int64_t>(k));
      given.distance_to_extent(n, x.data(), distance.data());
      for (std::size_t k = 0; k < x.size(); ++k) {
        const std::int64_t i = begin + static_cast<std::int64_t>(k);
        if (nodes.owned(i)) beyond.add(distance[k] > nodes.d(i), nodes.id(i), x[k]);
      }
    }
  });
  beyond = over_ranks(comm, beyond);
  const std::uint64_t all = comm.allreduce_sum(static_cast<std::uint64_t>(level.owned_count()));
  if (beyond.count == 0) return std::nullopt;
  const std::string name = extent->name;
  if (beyond.count == static_cast<std::int64_t>(all) && domain.embedding().is_sphere())
    throw AgreedError(ErrorKind::spacing, "the " + name +
                                              " of the spacing does not meet the domain: all " +
                                              std::to_string(all) +
                                              " nodes are farther than d from it, one of them at " +
                                              point_text(beyond.at) + reach_text(*extent, domain));
  return Warning(WarningCode::partial_extent,
                 "the " + name + " of the spacing covers only a part of the domain: of " +
                     std::to_string(all) + " nodes, " + std::to_string(beyond.count) +
                     " are farther than d from it, one of them at " +
                     rounded_point_text<Dim>(beyond.at) + "; there " + extent->beyond +
                     reach_text(*extent, domain),
                 beyond.count);
}

}  // namespace

std::optional<Warning> warning_of_missed_spacing(const std::vector<EdgeBand>& bands) {
  const EdgeBand* worst = worst_missed_band(bands);
  if (!worst) return std::nullopt;
  return warning_of(*worst);
}

std::optional<Warning> warning_of_surface_fit(const SurfaceFit& fit, const Options& options) {
  if (fit.faces_off <= 0) return std::nullopt;
  const std::string what_helps =
      std::string("make it smaller there") +
      (options.integer("resolve") == 0 ? ", or try the option resolve" : "");
  return Warning(WarningCode::boundary_not_followed,
                 "the boundary of the tetrahedra does not follow the surface at " +
                     std::to_string(fit.faces_off) +
                     " faces (statistic missing_faces), one of them at " +
                     rounded_point_text<3>(fit.off_at) +
                     "; the spacing does not resolve the shape: " + what_helps,
                 fit.faces_off);
}

std::optional<Warning> warning_of_features_left_out(const Level<2>&) { return std::nullopt; }
std::optional<Warning> warning_of_features_left_out(const Level<3>& level) {
  const FoundNodes<3> features = features_left_out(level);
  if (features.count <= 0) return std::nullopt;
  return Warning(WarningCode::features_left_out,
                 "left out: " + std::to_string(features.count) +
                     " nodes of corners and sharp edges, one of them at " +
                     rounded_point_text<3>(features.at) +
                     ": they are nearer to others than the spacing resolves; make the spacing "
                     "smaller there to keep them",
                 features.count);
}

template <int Dim>
std::vector<Warning> warnings_of_level(const Level<Dim>& level, const Domain<Dim>& domain,
                                       const Spacing<Dim>& given,
                                       const SteepestGrowth<Dim>& steepest,
                                       const Options& options) {
  std::vector<Warning> warnings = domain.warnings();
  warnings.insert(warnings.end(), level.geometry.warnings().begin(),
                  level.geometry.warnings().end());
  if (too_steep(steepest))
    warnings.push_back(warning_of_growth(steepest, level.settings.growth_limit));
  if (level.geometry.kind() == GeometryKind::surface && options.is_set("growth_limit") &&
      options.real("growth_limit") > 0)
    warnings.emplace_back(WarningCode::option_without_effect,
                          "the option growth_limit has no effect on surfaces alone");
  for (const auto& warning :
       {warning_of_partial_extent(level, domain, given), warning_of_coarse_spacing(level, domain)})
    if (warning) warnings.push_back(*warning);
  return warnings;
}

template std::vector<Warning> warnings_of_level(const Level<2>&, const PlaneDomain&,
                                                const Spacing<2>&, const SteepestGrowth<2>&,
                                                const Options&);
template std::vector<Warning> warnings_of_level(const Level<3>&, const VolumeDomain&,
                                                const Spacing<3>&, const SteepestGrowth<3>&,
                                                const Options&);

}  // namespace pnpbs
