// SPDX-License-Identifier: BSD-3-Clause
// C interface: the shape of a domain, namely distances and a spacing that follows the shape.
#include "api/shape.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "api/domain_calls.hpp"
#include "api/placement_calls.hpp"
#include "api/sphere_points.hpp"
#include "base/started_execution.hpp"
#include "domain/given_values.hpp"
#include "spacing/sphere_spacing.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

void require_not_negative(double value, const char* argument) {
  if (!(value >= 0) || !std::isfinite(value))
    throw Error(ErrorKind::argument, std::string("argument ") + argument + " = " +
                                         number_text(value) +
                                         ": expected a positive number, or 0 to leave it out");
}

ShapeRequirements demands_from(double nodes_per_turn, double nodes_across, double nodes_per_edge) {
  require_not_negative(nodes_per_turn, "nodes_per_turn");
  require_not_negative(nodes_across, "nodes_across");
  require_not_negative(nodes_per_edge, "nodes_per_edge");
  return {nodes_per_turn, nodes_across, nodes_per_edge};
}

ShapeLimits limits_from(double growth, double min, double max) {
  require_not_negative(growth, "growth");
  require_not_negative(min, "min_spacing");
  require_not_negative(max, "max_spacing");
  if (max > 0 && min > max)
    throw Error(ErrorKind::argument, "argument min_spacing = " + number_text(min) +
                                         " is above max_spacing = " + number_text(max));
  ShapeLimits limits{ShapeLimits().growth, min, max};
  if (growth > 0) limits.growth = growth;
  return limits;
}

template <int Dim>
const Point<Dim>* points_from(const double* coordinates) {
  return reinterpret_cast<const Point<Dim>*>(coordinates);
}

void require_shape(const PlaneDomain& domain) {
  if (domain.is_whole_sphere() && domain.curves().empty())
    throw Error(
        ErrorKind::argument,
        "argument domain is a whole sphere without curves: there is nothing to measure distances "
        "from");
}
void require_shape(const VolumeDomain&) {}

// Calls ask(shapes) with the shape queries of a domain, which is checked first. Checking may call
// curve callbacks, so from inside a callback the first query must have been made before.
template <class Ask>
pnpbs_status query_shape(pnpbs_domain domain, const Ask& ask) {
  return guarded(domain, [&](DomainObject& object) {
    const auto ask_in = [&]<int Dim>(auto& checked, std::shared_ptr<DomainShapes<Dim>>& shapes) {
      if (!shapes) {
        const Computing computing(*object.context);
        checked.check();
        require_shape(checked);
        shapes = std::make_shared<DomainShapes<Dim>>(checked);
      }
      ask(*shapes);
      return PNPBS_OK;
    };
    if (sphere_of(object).is_sphere())
      return ask_in.template operator()<3>(*object.plane, object.volume_shapes);
    return object.plane ? ask_in.template operator()<2>(*object.plane, object.plane_shapes)
                        : ask_in.template operator()<3>(*object.volume, object.volume_shapes);
  });
}

template <int Dim>
void require_tag_in(const ShapeIndex<Dim>& index, std::int32_t tag) {
  if (tag == 0 || index.has_tag(tag)) return;
  std::string known;
  const std::vector<std::int32_t> tags = index.tags();
  constexpr std::size_t kMany = 20;
  for (std::size_t k = 0; k < std::min(tags.size(), kMany); ++k)
    known += (k > 0 ? ", " : "") + std::to_string(tags[k]);
  throw Error(ErrorKind::argument, "argument tag = " + std::to_string(tag) +
                                       ": nothing in the domain has it (tags: " + known +
                                       (tags.size() > kMany ? ", ...)" : ")"));
}

}  // namespace

pnpbs_status pnpbs_domain_distance(pnpbs_domain domain, int32_t tag, int64_t n,
                                   const double* coordinates, double* distances) {
  return query_shape(domain, [&]<int Dim>(DomainShapes<Dim>& shapes) {
    require_count(n, "n");
    if (n > 0) require_pointer(coordinates, "coordinates");
    if (n > 0) require_pointer(distances, "distances");
    given_values::require_points<Dim>("argument coordinates", n, coordinates);
    const ShapeIndex<Dim>& index = shapes.index();
    require_tag_in(index, tag);
    const Point<Dim>* const x = points_from<Dim>(coordinates);
    for_each_if_started("pnpbs_domain_distance", n,
                        [&](std::int64_t i) { distances[i] = shapes.distance(tag, x[i]); });
  });
}

pnpbs_status pnpbs_domain_regions_at(pnpbs_domain domain, int64_t n, const double* coordinates,
                                     int32_t columns, int32_t* tags) {
  return guarded(domain, [&](DomainObject& object) {
    require_count(n, "n");
    if (n > 0) require_pointer(coordinates, "coordinates");
    if (n > 0) require_pointer(tags, "tags");
    given_values::require_count("columns", columns, 1);
    visit_dimension(object, [&]<class Given>(Given& given) {
      constexpr int Dim = std::is_same_v<Given, PlaneDomain> ? 2 : 3;
      if (!given.is_checked()) {
        const Computing computing(*object.context);
        given.check();
      }
      if (!given.regions())
        throw Error(ErrorKind::argument,
                    "argument domain: no region has a tag; pnpbs_domain_add_region (--region) and "
                    "pnpbs_domain_set_fragment (--fragment) give tags");
      std::vector<double> charted;
      const double* const placed = placed_coordinates(given.embedding(), n, coordinates, charted);
      given_values::require_points<Dim>("argument coordinates", n, placed);
      const Point<Dim>* const x = points_from<Dim>(placed);
      for_each_if_started("pnpbs_domain_regions_at", n, [&](std::int64_t i) {
        given.regions()->tags_at(x[i], columns, tags + columns * i);
      });
    });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_shape_spacing(pnpbs_domain domain, double nodes_per_turn,
                                        double nodes_across, double nodes_per_edge, double growth,
                                        int64_t n, const double* coordinates, double* d) {
  return query_shape(domain, [&]<int Dim>(DomainShapes<Dim>& shapes) {
    require_count(n, "n");
    if (n > 0) require_pointer(coordinates, "coordinates");
    if (n > 0) require_pointer(d, "d");
    given_values::require_points<Dim>("argument coordinates", n, coordinates);
    shapes
        .spacing(demands_from(nodes_per_turn, nodes_across, nodes_per_edge),
                 limits_from(growth, 0, 0))
        .evaluate(n, points_from<Dim>(coordinates), d);
  });
}

pnpbs_status pnpbs_placement_set_spacing_from_shape(pnpbs_placement placement,
                                                    double nodes_per_turn, double nodes_across,
                                                    double nodes_per_edge, double growth,
                                                    double min_spacing, double max_spacing) {
  return collective(placement, [&](Placement& p) {
    const ShapeRequirements demands = demands_from(nodes_per_turn, nodes_across, nodes_per_edge);
    const ShapeLimits limits = limits_from(growth, min_spacing, max_spacing);
    visit_dimension(p, [&]<int Dim>(PlacementImpl<Dim>& in) {
      std::shared_ptr<const Spacing<Dim>> spacing;
      collective_try(p.communicator(), [&] {
        in.domain().check();
        require_shape(in.domain());
        spacing = spacing_on_sphere(in.domain().embedding(), [&](double) {
          DomainShapes<3> shapes(in.domain());
          return std::make_shared<ShapeSpacing<3>>(shapes.spacing(demands, limits));
        });
        if (!spacing)
          spacing = std::make_shared<ShapeSpacing<Dim>>(ShapeIndex<Dim>(shape_of(in.domain())),
                                                        demands, limits);
      });
      in.set_spacing(std::move(spacing));
    });
    return PNPBS_OK;
  });
}
