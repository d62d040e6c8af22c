// SPDX-License-Identifier: BSD-3-Clause
// Domains of the C interface.
#include <string_view>

#include "api/guard.hpp"
#include "domain/plane/poly_reader.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

// A change of the domain's description.
template <class Change>
pnpbs_status change_domain(pnpbs_domain domain, const Change& change) {
  return guarded(domain, [&](Domain& object) {
    const Computing computing(*object.context);
    change(*object.plane);
    return PNPBS_OK;
  });
}

// A question that needs the checked domain. Checking may ask curve callbacks, so from inside a
// callback it must have been done before.
template <class Question>
pnpbs_status ask_domain(pnpbs_domain domain, const Question& question) {
  return guarded(domain, [&](Domain& object) {
    if (!object.plane->is_checked()) {
      const Computing computing(*object.context);
      object.plane->check();
    }
    return question(*object.plane);
  });
}

CurveRole role_from(int32_t role) {
  if (role == PNPBS_BOUNDARY) return CurveRole::boundary;
  if (role == PNPBS_INNER) return CurveRole::inner;
  throw Error(ErrorKind::argument, "role is " + std::to_string(role) +
                                       ", expected PNPBS_BOUNDARY (0) or PNPBS_INNER (1)");
}

Point<2> point_from(const double* x) { return {x[0], x[1]}; }

}  // namespace

pnpbs_status pnpbs_domain_create(pnpbs_context context, int32_t dim, pnpbs_domain* domain) {
  return guarded(context, [&](Context& owner) {
    require_pointer(domain, "domain");
    *domain = nullptr;
    require_not_in_callback(owner);
    if (dim == 3)
      throw Error(ErrorKind::unsupported,
                  "argument dim = 3: this version places nodes in the "
                  "plane only; use 2");
    if (dim != 2)
      throw Error(ErrorKind::argument, "argument dim = " + std::to_string(dim) + " must be 2");
    auto object = std::make_shared<Domain>();
    object->context = require(context);
    *domain = domains().add(std::move(object));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_destroy(pnpbs_domain* domain) {
  if (!domain || !*domain) return PNPBS_OK;
  return guarded(*domain, [&](Domain& object) {
    require_not_in_callback(*object.context);
    domains().remove(*domain);
    *domain = nullptr;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_add_polyline(pnpbs_domain domain, int32_t role, int32_t closed, int64_t n,
                                       const double* coordinates, const int32_t* tags,
                                       double corner_angle) {
  return change_domain(domain, [&](PlaneDomain& plane) {
    require_count(n, "n");
    require_pointer(coordinates, "coordinates");
    plane.add_polyline(role_from(role), closed != 0, n, coordinates, tags, corner_angle);
  });
}

pnpbs_status pnpbs_domain_add_arc(pnpbs_domain domain, int32_t role, const double* centre,
                                  double radius, double begin, double end, int32_t tag) {
  return change_domain(domain, [&](PlaneDomain& plane) {
    require_pointer(centre, "centre");
    plane.add_arc(role_from(role), point_from(centre), radius, begin, end, tag);
  });
}

pnpbs_status pnpbs_domain_add_curve(pnpbs_domain domain, int32_t role, pnpbs_curve_fn curve,
                                    void* user, double begin, double end, int32_t tag) {
  return change_domain(domain, [&](PlaneDomain& plane) {
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
  return change_domain(domain, [&](PlaneDomain& plane) {
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

pnpbs_status pnpbs_domain_add_hole(pnpbs_domain domain, const double* point) {
  return change_domain(domain, [&](PlaneDomain& plane) {
    require_pointer(point, "point");
    plane.add_hole(point_from(point));
  });
}

pnpbs_status pnpbs_domain_add_fixed_nodes(pnpbs_domain domain, int64_t n, const double* coordinates,
                                          const int32_t* tags) {
  return change_domain(domain, [&](PlaneDomain& plane) {
    require_count(n, "n");
    if (n > 0) require_pointer(coordinates, "coordinates");
    plane.add_fixed_nodes(n, coordinates, tags);
  });
}

pnpbs_status pnpbs_domain_read_poly(pnpbs_domain domain, const char* path) {
  return change_domain(domain, [&](PlaneDomain& plane) {
    require_pointer(path, "path");
    read_poly_file(plane, path);
  });
}

pnpbs_status pnpbs_domain_parse_poly(pnpbs_domain domain, const char* text, int64_t length,
                                     const char* name) {
  return change_domain(domain, [&](PlaneDomain& plane) {
    require_pointer(text, "text");
    require_count(length, "length");
    parse_poly(plane, std::string_view(text, static_cast<std::size_t>(length)),
               name ? name : "text");
  });
}

pnpbs_status pnpbs_domain_check(pnpbs_domain domain) {
  return ask_domain(domain, [](PlaneDomain&) { return PNPBS_OK; });
}

pnpbs_status pnpbs_domain_bounds(pnpbs_domain domain, double* low, double* high) {
  return ask_domain(domain, [&](PlaneDomain& plane) {
    require_pointer(low, "low");
    require_pointer(high, "high");
    for (int k = 0; k < 2; ++k) {
      low[k] = plane.bounds().low[k];
      high[k] = plane.bounds().high[k];
    }
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_measure(pnpbs_domain domain, double* measure) {
  return ask_domain(domain, [&](PlaneDomain& plane) {
    require_pointer(measure, "measure");
    *measure = plane.area();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_get_segments(pnpbs_domain domain, int64_t capacity, int64_t* count,
                                       double* segments, int32_t* tags) {
  return ask_domain(domain, [&](PlaneDomain& plane) {
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
    std::size_t s = 0;
    for (const BoundaryCurve& curve : plane.curves())
      for (std::size_t p = 0; p + 1 < curve.points.size(); ++p, ++s) {
        if (tags) tags[s] = curve.tag;
        for (std::size_t k = 0; segments && k < 2; ++k) {
          segments[4 * s + k] = curve.points[p][k];
          segments[4 * s + 2 + k] = curve.points[p + 1][k];
        }
      }
    return PNPBS_OK;
  });
}
