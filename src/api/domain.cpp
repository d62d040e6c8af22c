// SPDX-License-Identifier: BSD-3-Clause
// C interface: domains.
#include <algorithm>
#include <string_view>

#include "api/domain_calls.hpp"
#include "api/sphere_points.hpp"
#include "domain/from_files.hpp"
#include "domain/plane/plane_domain.hpp"
#include "formats/surface_triangles.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

// Runs a query that needs the checked domain, and checks it first if necessary. Checking may call
// curve callbacks, so a query from inside a callback fails if the domain has not been checked
// before.
template <class Question>
pnpbs_status query_domain(pnpbs_domain domain, const Question& question) {
  return guarded(domain, [&](DomainObject& object) {
    return visit_dimension(object, [&](auto& checked) {
      if (!checked.is_checked()) {
        const Computing computing(*object.context);
        checked.check();
      }
      return question(checked);
    });
  });
}

double whole_measure(const PlaneDomain& domain) {
  return domain.embedding().is_sphere() ? area_on_sphere(domain) : domain.area();
}
double whole_measure(const VolumeDomain& domain) { return domain.measure(); }

// Returns a point of the interface in the plane or in the chart of the sphere.
Point<2> point_from(const PlaneDomain& domain, const double* x) {
  if (const Embedding<2>& in = domain.embedding(); in.is_sphere())
    return in.chart().in_chart(require_direction("point", x));
  return {x[0], x[1]};
}
// Writes a point with the coordinates of the interface: two in the plane, three on a sphere.
// Returns the end of the output.
double* copy_place(const Embedding<2>& embedding, const Point<2>& u, double* x) {
  return std::copy_n(embedding.in_space(u).begin(), embedding.coordinates(), x);
}
Point<2> plane_point_from(const double* x) { return {x[0], x[1]}; }
Point<3> space_point_from(const double* x) { return {x[0], x[1], x[2]}; }

}  // namespace

pnpbs_status pnpbs_domain_create(pnpbs_context context, int32_t dim, pnpbs_domain* domain) {
  return guarded(context, [&](Context& owner) {
    require_pointer(domain, "domain");
    *domain = nullptr;
    require_not_in_callback(owner);
    if (dim != 2 && dim != 3)
      throw Error(ErrorKind::argument, "argument dim = " + std::to_string(dim) + " must be 2 or 3");
    auto object = std::make_shared<DomainObject>();
    object->context = require(context);
    if (dim == 2)
      object->plane = std::make_shared<PlaneDomain>();
    else
      object->volume = std::make_shared<VolumeDomain>();
    *domain = domains().add(std::move(object));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_destroy(pnpbs_domain* domain) { return destroy(domain, domains); }

pnpbs_status pnpbs_domain_dimension(pnpbs_domain domain, int32_t* dim) {
  return guarded(domain, [&](DomainObject& object) {
    require_pointer(dim, "dim");
    *dim = object.plane && !sphere_of(object).is_sphere() ? 2 : 3;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_add_polyline(pnpbs_domain domain, int32_t role, int32_t closed, int64_t n,
                                       const double* coordinates, const int32_t* tags,
                                       double corner_angle) {
  return change_domain(domain, [&](DomainObject& object) {
    require_count(n, "n");
    require_pointer(coordinates, "coordinates");
    const CurveRole as = role_from(role);
    if (sphere_of(object).is_sphere()) {
      object.plane->add_great_circles(
          as, closed != 0, require_directions("coordinates", n, coordinates), tags, corner_angle);
      return;
    }
    if (object.plane) {
      object.plane->add_polyline(as, closed != 0, n, coordinates, tags, corner_angle);
      return;
    }
    if (as != CurveRole::inner)
      throw Error(
          ErrorKind::argument,
          "argument role = 0: curves do not bound a domain in space; PNPBS_INNER (1) is for "
          "curves inside that nodes follow");
    object.volume->add_polyline(closed != 0, n, coordinates, tags);
  });
}

pnpbs_status pnpbs_domain_add_surface(pnpbs_domain domain, int32_t role, int64_t vertices,
                                      const double* coordinates, int64_t triangles,
                                      const int64_t* corners, const int32_t* tags,
                                      double feature_angle) {
  return change_volume(domain, [&](VolumeDomain& volume) {
    require_count(vertices, "vertices");
    require_count(triangles, "triangles");
    if (vertices > 0) require_pointer(coordinates, "coordinates");
    if (triangles > 0) require_pointer(corners, "corners");
    volume.add_surface(surface_role_from(role), vertices, coordinates, triangles, corners, tags,
                       feature_angle);
  });
}

pnpbs_status pnpbs_domain_read_surface(pnpbs_domain domain, int32_t role, const char* path,
                                       double feature_angle) {
  return change_volume(domain, [&](VolumeDomain& volume) {
    require_pointer(path, "path");
    const SurfaceRole as = surface_role_from(role);
    volume.add_surface(as, read_surface(path), feature_angle);
  });
}

pnpbs_status pnpbs_domain_set_periodic(pnpbs_domain domain, const double* low, const double* high,
                                       const int32_t* periodic, const int32_t* tags) {
  return change_domain(domain, [&](DomainObject& object) {
    require_pointer(low, "low");
    require_pointer(high, "high");
    require_pointer(periodic, "periodic");
    visit_dimension(object, [&]<class Domain>(Domain& changed) {
      constexpr int kDim = std::is_same_v<Domain, PlaneDomain> ? 2 : 3;
      Box<kDim> box;
      std::array<bool, kDim> axes, flat;
      for (std::size_t k = 0; k < kDim; ++k) {
        box.low[k] = low[k];
        box.high[k] = high[k];
        axes[k] = periodic[k] != 0;
        flat[k] = periodic[k] == PNPBS_FLAT;
      }
      changed.set_periodic(box, axes, flat, tags);
    });
  });
}

pnpbs_status pnpbs_domain_add_box(pnpbs_domain domain, const double* low, const double* high,
                                  int32_t tag) {
  return pnpbs_domain_add_box_surface(domain, PNPBS_BOUNDARY, low, high, tag);
}

pnpbs_status pnpbs_domain_add_ball(pnpbs_domain domain, const double* centre, double radius,
                                   int32_t tag) {
  return pnpbs_domain_add_ball_surface(domain, PNPBS_BOUNDARY, centre, radius, tag);
}

pnpbs_status pnpbs_domain_add_cylinder(pnpbs_domain domain, const double* begin, const double* end,
                                       double radius, int32_t tag) {
  return pnpbs_domain_add_cylinder_surface(domain, PNPBS_BOUNDARY, begin, end, radius, tag);
}

pnpbs_status pnpbs_domain_add_box_surface(pnpbs_domain domain, int32_t role, const double* low,
                                          const double* high, int32_t tag) {
  return change_volume(domain, [&](VolumeDomain& volume) {
    require_pointer(low, "low");
    require_pointer(high, "high");
    volume.add_box(space_point_from(low), space_point_from(high), tag, surface_role_from(role));
  });
}

pnpbs_status pnpbs_domain_add_ball_surface(pnpbs_domain domain, int32_t role, const double* centre,
                                           double radius, int32_t tag) {
  return change_volume(domain, [&](VolumeDomain& volume) {
    require_pointer(centre, "centre");
    volume.add_ball(space_point_from(centre), radius, tag, surface_role_from(role));
  });
}

pnpbs_status pnpbs_domain_add_cylinder_surface(pnpbs_domain domain, int32_t role,
                                               const double* begin, const double* end,
                                               double radius, int32_t tag) {
  return change_volume(domain, [&](VolumeDomain& volume) {
    require_pointer(begin, "begin");
    require_pointer(end, "end");
    volume.add_cylinder(space_point_from(begin), space_point_from(end), radius, tag,
                        surface_role_from(role));
  });
}

pnpbs_status pnpbs_domain_add_level_set(pnpbs_domain domain, pnpbs_level_set_fn level_set,
                                        void* user, const double* low, const double* high,
                                        double resolution, int32_t tag) {
  return change_volume(domain, [&](VolumeDomain& volume) {
    if (!level_set) throw Error(ErrorKind::argument, "argument level_set is NULL");
    require_pointer(low, "low");
    require_pointer(high, "high");
    const LevelSetFunction f = [level_set, user](std::int64_t n, const Point<3>* x,
                                                 double* values) {
      const int32_t answer = [&] {
        const HostArithmetic arithmetic;
        return level_set(n, 3, x->data(), values, user);
      }();
      if (answer != 0)
        throw Error(ErrorKind::callback, "the level set callback returned " +
                                             std::to_string(answer) + "; it must return 0");
    };
    volume.add_level_set(f, {space_point_from(low), space_point_from(high)}, resolution, tag);
  });
}

pnpbs_status pnpbs_domain_add_arc(pnpbs_domain domain, int32_t role, const double* centre,
                                  double radius, double begin, double end, int32_t tag) {
  return change_plane(domain, [&](PlaneDomain& plane) {
    require_pointer(centre, "centre");
    plane.add_arc(role_from(role), plane_point_from(centre), radius, begin, end, tag);
  });
}

pnpbs_status pnpbs_domain_add_curve(pnpbs_domain domain, int32_t role, pnpbs_curve_fn curve,
                                    void* user, double begin, double end, int32_t tag) {
  return change_plane(domain, [&](PlaneDomain& plane) {
    if (!curve) throw Error(ErrorKind::argument, "argument curve is NULL");
    const CurveFunction function = [curve, user](std::int64_t n, const double* t,
                                                 Point<2>* coordinates) {
      const int32_t answer = [&] {
        const HostArithmetic arithmetic;
        return curve(n, 2, t, n > 0 ? coordinates->data() : nullptr, user);
      }();
      if (answer != 0)
        throw Error(ErrorKind::callback,
                    "the curve callback returned " + std::to_string(answer) + "; it must return 0");
    };
    plane.add_curve(role_from(role), function, begin, end, tag);
  });
}

pnpbs_status pnpbs_domain_add_pslg(pnpbs_domain domain, int64_t vertices, const double* coordinates,
                                   const int32_t* vertex_tags, int64_t segments,
                                   const int64_t* segment_ends, const int32_t* segment_tags,
                                   int64_t holes, const double* hole_points) {
  return change_plane(domain, [&](PlaneDomain& plane) {
    require_count(vertices, "vertices");
    require_count(segments, "segments");
    require_count(holes, "holes");
    if (vertices > 0) require_pointer(coordinates, "coordinates");
    if (segments > 0) require_pointer(segment_ends, "segment_ends");
    if (holes > 0) require_pointer(hole_points, "hole_points");
    plane.add_pslg(vertices, coordinates, vertex_tags, segments, segment_ends, segment_tags, holes,
                   hole_points);
  });
}

pnpbs_status pnpbs_domain_set_repair(pnpbs_domain domain, double resolution) {
  return change_volume(domain, [&](VolumeDomain& volume) { volume.set_repair(resolution); });
}

pnpbs_status pnpbs_domain_set_resurfaced(pnpbs_domain domain, double resolution) {
  return change_volume(domain, [&](VolumeDomain& volume) { volume.set_repair(resolution, true); });
}

pnpbs_status pnpbs_domain_set_fragment(pnpbs_domain domain, int32_t overlap) {
  return change_domain(domain, [&](DomainObject& object) {
    const auto set = [&](OverlapRule rule) {
      visit_dimension(object, [&](auto& changed) { changed.set_fragment(rule); });
    };
    switch (overlap) {
      case PNPBS_OVERLAP_LAST:
        return set(OverlapRule::last);
      case PNPBS_OVERLAP_FIRST:
        return set(OverlapRule::first);
      case PNPBS_OVERLAP_OWN:
        return set(OverlapRule::own);
      default:
        throw Error(ErrorKind::argument,
                    "overlap is " + std::to_string(overlap) +
                        ", expected PNPBS_OVERLAP_LAST, PNPBS_OVERLAP_FIRST or PNPBS_OVERLAP_OWN");
    }
  });
}

pnpbs_status pnpbs_domain_set_filled(pnpbs_domain domain, int32_t filled) {
  return change_volume(domain, [&](VolumeDomain& volume) { volume.set_filled(filled != 0); });
}

pnpbs_status pnpbs_domain_add_hole(pnpbs_domain domain, const double* point) {
  return change_domain(domain, [&](DomainObject& object) {
    require_pointer(point, "point");
    if (object.plane)
      object.plane->add_hole(point_from(*object.plane, point));
    else
      object.volume->add_hole(space_point_from(point));
  });
}

pnpbs_status pnpbs_domain_add_region(pnpbs_domain domain, const double* point, int32_t tag) {
  return change_domain(domain, [&](DomainObject& object) {
    require_pointer(point, "point");
    if (object.plane)
      object.plane->add_region(point_from(*object.plane, point), tag);
    else
      object.volume->add_region(space_point_from(point), tag);
  });
}

pnpbs_status pnpbs_domain_add_fixed_nodes(pnpbs_domain domain, int64_t n, const double* coordinates,
                                          const int32_t* tags) {
  return change_domain(domain, [&](DomainObject& object) {
    require_count(n, "n");
    if (n > 0) require_pointer(coordinates, "coordinates");
    std::vector<double> charted;
    coordinates = placed_coordinates(sphere_of(object), n, coordinates, charted);
    visit_dimension(object, [&](auto& d) { d.add_fixed_nodes(n, coordinates, tags); });
  });
}

pnpbs_status pnpbs_domain_read_poly(pnpbs_domain domain, const char* path) {
  return change_plane(domain, [&](PlaneDomain& plane) {
    require_pointer(path, "path");
    add_poly(plane, read_poly(path));
  });
}

pnpbs_status pnpbs_domain_parse_poly(pnpbs_domain domain, const char* text, int64_t length,
                                     const char* name) {
  return change_plane(domain, [&](PlaneDomain& plane) {
    require_pointer(text, "text");
    require_count(length, "length");
    const std::string_view bytes(text, static_cast<std::size_t>(length));
    add_poly(plane, parse_poly(bytes, name ? name : "text"));
  });
}

pnpbs_status pnpbs_domain_check(pnpbs_domain domain) {
  return query_domain(domain, [](const auto&) { return PNPBS_OK; });
}

pnpbs_status pnpbs_domain_bounds(pnpbs_domain domain, double* low, double* high) {
  return query_domain(domain, [&](const auto& checked) {
    require_pointer(low, "low");
    require_pointer(high, "high");
    const auto& box = checked.cell().any() ? checked.cell().box() : checked.bounds();
    std::copy(box.low.begin(), box.low.end(), low);
    std::copy(box.high.begin(), box.high.end(), high);
    if (const double radius = checked.embedding().radius(); radius > 0) {
      std::fill_n(low, 3, -radius);
      std::fill_n(high, 3, radius);
    }
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_measure(pnpbs_domain domain, double* measure) {
  return query_domain(domain, [&](const auto& checked) {
    require_pointer(measure, "measure");
    *measure = whole_measure(checked);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_get_segments(pnpbs_domain domain, int64_t capacity, int64_t* count,
                                       double* segments, int32_t* tags) {
  return guarded(domain, [&](DomainObject& object) {
    const Embedding<2> embedding = sphere_of(object);
    PlaneDomain& plane = embedding.is_sphere() ? *object.plane : plane_of(object);
    if (!plane.is_checked()) {
      const Computing computing(*object.context);
      plane.check();
    }
    require_pointer(count, "count");
    require_count(capacity, "capacity");
    int64_t needed = 0;
    for (const BoundaryCurve& curve : plane.curves())
      needed += static_cast<int64_t>(curve.points.size()) - 1;
    *count = needed;
    if (capacity == 0 && !segments && !tags) return PNPBS_OK;
    if (capacity < needed)
      throw Error(ErrorKind::capacity, "argument capacity = " + std::to_string(capacity) + "; " +
                                           std::to_string(needed) + " are needed");
    for (const BoundaryCurve& curve : plane.curves())
      for (std::size_t p = 0; p + 1 < curve.points.size(); ++p) {
        if (tags) *tags++ = curve.tag;
        for (const Point<2>& end : {curve.points[p], curve.points[p + 1]})
          if (segments) segments = copy_place(embedding, end, segments);
      }
    return PNPBS_OK;
  });
}
