// SPDX-License-Identifier: BSD-3-Clause
#include "check/conformity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/found_indices.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "check/flat_elements.hpp"
#include "check/surface_edges.hpp"
#include "level/volume/inner_facets.hpp"
#include "spacing/spacing_range.hpp"

namespace pnpbs {

namespace {

// Advice for a boundary of the tetrahedra that differs from that of the domain.
constexpr const char* kWaysOut =
    "make it smaller there, try the option resolve, or repair the body to a resolution of the "
    "spacing, which removes what is finer (pnpbs_domain_set_resurfaced, in the command --repair "
    "auto)";

bool in_no_element(const Level<2>& level, std::int64_t i) {
  bool none = true;
  level.stars.for_simplices(i, [&](const DelaunayStars::Corners&) { none = false; });
  return none;
}
bool in_no_element(const Level<3>& level, std::int64_t i) {
  if (level.geometry.kind() != GeometryKind::surface) return level.stars.size(i) == 0;
  bool none = true;
  level.stars.for_triangles(i, [&](const std::array<std::int32_t, 2>&) { none = false; });
  return none;
}

FoundNodes<2> unmatched_edges(const Results<2>&, std::vector<Point<2>>&) { return {}; }
FoundNodes<3> unmatched_edges(const Results<3>& results, std::vector<Point<3>>& places) {
  FoundNodes<3> found;
  if (results.kind() != GeometryKind::surface) return found;
  for_unmatched_edges(results, [&](const SurfaceEdge& edge) {
    found.add(1, edge.low, edge.at);
    places.push_back(edge.at);
  });
  return over_ranks(results.communicator(), found);
}

ElementMeasure measure_in(const Results<2>&) { return {}; }
ElementMeasure measure_in(const Results<3>& results) { return measure_if_far_off(results); }

BoundaryTopology topology_of(const Results<2>&, Conformity<2>&) { return {}; }
BoundaryTopology topology_of(const Results<3>& results, Conformity<3>& result) {
  return results.kind() == GeometryKind::surface ? BoundaryTopology{}
                                                 : boundary_topology(results, result.torn);
}

FoundNodes<2> flat_in(const Results<2>&, std::vector<Point<2>>&) { return {}; }
FoundNodes<3> flat_in(const Results<3>& results, std::vector<Point<3>>& places) {
  return results.kind() == GeometryKind::surface ? FoundNodes<3>{}
                                                 : flat_elements(results.level(), places);
}

MessageText text_of(const ElementMeasure& measure, const std::string& element) {
  const bool area = element == "triangle";
  return (area ? "the triangles have the area " : "the tetrahedra have the volume ") +
         rounded_text(measure.elements) + ", the domain " + rounded_text(measure.domain) +
         (area ? ", and no more than " + rounded_text(measure.between) + " can lie between them"
               : ", and the distance of the boundary faces from the surfaces explains a "
                 "difference of " +
                     rounded_text(measure.chord_error)) +
         ": the spacing does not resolve the shape: " + kWaysOut;
}

// Determines how well faces follow the inner surfaces.
void measure_inner(const Results<2>&, Conformity<2>&) {}
void measure_inner(const Results<3>& results, Conformity<3>& result) {
  if (results.kind() == GeometryKind::surface) return;
  result.regions = regions_far_off(results);
  result.inner_share = InnerFacets(results.level()).covered_share();
}

MessageText text_of(const std::vector<RegionMeasure>& regions) {
  const RegionMeasure& worst = *std::ranges::max_element(regions, {}, [](const RegionMeasure& of) {
    return of.measure.difference() / of.measure.domain;
  });
  return "the tetrahedra of region " + std::to_string(worst.tag) + " have the volume " +
         rounded_text(worst.measure.elements) + ", the region " +
         rounded_text(worst.measure.domain) +
         ", and the distance of faces from the surfaces explains a difference of " +
         rounded_text(worst.measure.chord_error) +
         (regions.size() > 1
              ? " (and " + std::to_string(regions.size() - 1) + " other regions are as far off)"
              : "") +
         ": tetrahedra cross the surfaces between regions, which the spacing does not resolve: "
         "make it smaller there";
}

const char* elements_of(const Results<2>&) { return "triangle"; }
const char* elements_of(const Results<3>& results) {
  return results.kind() == GeometryKind::surface ? "triangle" : "tetrahedron";
}

}  // namespace

template <int Dim>
Conformity<Dim> conformity_of(const Results<Dim>& results) {
  const Communicator& comm = results.communicator();
  const Level<Dim>& level = results.level();
  const Nodes<Dim>& nodes = level.nodes;
  Conformity<Dim> result;
  FoundNodes<Dim> isolated;
  collective_try(comm, [&] {
    const auto is_isolated = [&](std::int64_t i) {
      return nodes.owned(i) && in_no_element(level, i);
    };
    for (const std::int64_t i : indices_where("pnpbs::conformity", nodes.count, is_isolated)) {
      isolated.add(1, nodes.id(i), nodes.position(i));
      result.torn.push_back(nodes.position(i));
    }
  });
  result.nodes = results.global_count();
  result.isolated = over_ranks(comm, isolated);
  collective_try(comm, [&] {
    result.unmatched = unmatched_edges(results, result.torn);
    result.measure = measure_in(results);
    result.boundary = topology_of(results, result);
    result.flat = flat_in(results, result.torn);
    measure_inner(results, result);
  });
  return result;
}

template <int Dim>
bool crosses_inner_surfaces(const Results<Dim>& results) {
  Conformity<Dim> inner;
  measure_inner(results, inner);
  return !inner.divides();
}

template <int Dim>
ElementFaults Conformity<Dim>::element_faults() const {
  constexpr double kParts = 1000;
  ElementFaults faults;
  faults.no_elements = !any_elements();
  faults.pieces = std::abs(boundary.pieces - boundary.pieces_of_domain);
  faults.euler = std::abs(boundary.euler - boundary.euler_of_domain);
  if (measure.far_off())
    faults.lost_thousandths =
        static_cast<std::int64_t>(kParts * measure.difference() / measure.domain);
  faults.torn = isolated.count + unmatched.count + flat.count + boundary.torn.count;
  for (const RegionMeasure& of : regions)
    faults.crossed_thousandths += static_cast<std::int64_t>(
        kParts * std::min(1.0, of.measure.difference() / of.measure.domain));
  if (inner_share < kMinInnerShare)
    faults.crossed_thousandths += static_cast<std::int64_t>(kParts * (1 - inner_share));
  return faults;
}

template <int Dim>
MessageText text_of(const Conformity<Dim>& conformity, const Results<Dim>& results) {
  const Level<Dim>& level = results.level();
  const std::string element = elements_of(results);
  if (!conformity.any_elements()) {
    const SpacingRange d = spacing_range<Dim>(*level.comm, level.nodes);
    const double side = size_of<Dim>(level.geometry.bounds());
    return "no " + element + " at all, among " + std::to_string(conformity.nodes) + " nodes" +
           (d.empty() ? "" : " with a spacing of " + rounded_text(d.min) + " or more") +
           ": the longest side of the domain is " + rounded_text(side) +
           ", and the spacing does not resolve its shape: make it smaller";
  }
  if (conformity.isolated.count > 0)
    return "in no " + element + ": " + std::to_string(conformity.isolated.count) +
           " nodes, one of them at " + rounded_point_text<Dim>(conformity.isolated.at) +
           "; the spacing is too coarse for the shape: make it smaller there";
  if (conformity.unmatched.count > 0)
    return "the triangles do not join at " + std::to_string(conformity.unmatched.count) +
           " edges, one of them at " + rounded_point_text<Dim>(conformity.unmatched.at) +
           ", where the surface is rougher than the spacing resolves: use a smaller spacing "
           "there, or a larger feature_angle";
  if (conformity.flat.count > 0)
    return "of no volume: " + std::to_string(conformity.flat.count) +
           " tetrahedra, one of them at " + rounded_point_text<Dim>(conformity.flat.at) +
           ", where a wall or a bar is thinner than the spacing, and its nodes lie in one plane: "
           "make it smaller there";
  if (conformity.measure.far_off()) return text_of(conformity.measure, element);
  if (conformity.boundary.torn.count > 0)
    return "the boundary of the tetrahedra is torn at " +
           std::to_string(conformity.boundary.torn.count) + " nodes, one of them at " +
           rounded_point_text<3>(conformity.boundary.torn.at) +
           ": sheets of the surface are nearer to each other there, or rougher, than the spacing "
           "resolves: " +
           kWaysOut;
  if (conformity.boundary.euler != conformity.boundary.euler_of_domain)
    return "the boundary of the tetrahedra has the Euler characteristic " +
           std::to_string(conformity.boundary.euler) + ", the surfaces of the domain " +
           std::to_string(conformity.boundary.euler_of_domain) +
           ": the spacing is too coarse somewhere, so that a wall has a hole, a gap is bridged or "
           "a neck is cut: " +
           kWaysOut;
  if (conformity.boundary.pieces != conformity.boundary.pieces_of_domain)
    return "the boundary of the tetrahedra is of " + std::to_string(conformity.boundary.pieces) +
           " pieces, that of the domain of " +
           std::to_string(conformity.boundary.pieces_of_domain) +
           ": the spacing is too coarse somewhere: " + kWaysOut;
  if (!conformity.regions.empty()) return text_of(conformity.regions);
  if (!conformity.divides())
    return "faces of tetrahedra cover only " +
           std::to_string(std::lround(100 * conformity.inner_share)) +
           " percent of the inner surfaces: tetrahedra cross these; make the spacing smaller there";
  return "";
}

template struct Conformity<2>;
template struct Conformity<3>;
template Conformity<2> conformity_of(const Results<2>&);
template Conformity<3> conformity_of(const Results<3>&);
template bool crosses_inner_surfaces(const Results<2>&);
template bool crosses_inner_surfaces(const Results<3>&);
template MessageText text_of(const Conformity<2>&, const Results<2>&);
template MessageText text_of(const Conformity<3>&, const Results<3>&);

}  // namespace pnpbs
