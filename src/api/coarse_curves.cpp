// SPDX-License-Identifier: BSD-3-Clause
// C interface: changes of the curves of a domain in the plane or on a sphere that were given
// before: corners, loose points, simplification, tags of the outline.
#include <vector>

#include "api/domain_calls.hpp"
#include "api/spacing_callback.hpp"
#include "spacing/files/field_file.hpp"
#include "spacing/sphere_spacing.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

void simplify_by(PlaneDomain& plane, const LocalSpacing<2>& spacing, const SimplifyRule& rule,
                 int64_t* vertices, int64_t* curves) {
  const LeftOut left_out = plane.simplify(local_evaluator(spacing, 0), rule);
  if (vertices) *vertices = left_out.vertices;
  if (curves) *curves = left_out.curves;
}

}  // namespace

pnpbs_status pnpbs_domain_set_corner_angle(pnpbs_domain domain, double corner_angle) {
  return change_plane(domain, [&](PlaneDomain& plane) { plane.set_corner_angle(corner_angle); });
}

pnpbs_status pnpbs_domain_set_snap(pnpbs_domain domain, double length) {
  return change_domain(domain, [&](DomainObject& object) {
    visit_dimension(object, [&](auto& changed) { changed.set_snap(length); });
  });
}

pnpbs_status pnpbs_domain_simplify(pnpbs_domain domain, pnpbs_spacing_fn spacing, void* user,
                                   double tolerance, double smallest, int64_t* vertices,
                                   int64_t* curves) {
  return change_domain(domain, [&](DomainObject& object) {
    const SimplifyRule rule{tolerance, smallest};
    const auto along = spacing_on_sphere(sphere_of(object), [&](double) {
      return std::make_shared<CallbackSpacing<3>>(spacing_from<3>(spacing, user));
    });
    if (along)
      simplify_by(*object.plane, *along, rule, vertices, curves);
    else
      simplify_by(plane_of(object), spacing_from<2>(spacing, user), rule, vertices, curves);
  });
}

pnpbs_status pnpbs_domain_simplify_by_file(pnpbs_domain domain, const char* path, const char* field,
                                           double tolerance, double smallest, int64_t* vertices,
                                           int64_t* curves) {
  return change_domain(domain, [&](DomainObject& object) {
    require_pointer(path, "path");
    const std::string name = field ? field : "";
    const SimplifyRule rule{tolerance, smallest};
    std::shared_ptr<const LocalSpacing<2>> spacing;
    if (const Embedding<2> in = sphere_of(object); in.is_sphere()) {
      spacing = spacing_from_field(read_field<SphereField>(path, name), in.chart());
      simplify_by(*object.plane, *spacing, rule, vertices, curves);
    } else {
      PlaneDomain& plane = plane_of(object);
      auto values = read_field<GivenField<2>>(path, name);
      plane.check();
      spacing = spacing_from_field(std::move(values), plane.bounds());
      simplify_by(plane, *spacing, rule, vertices, curves);
    }
  });
}

pnpbs_status pnpbs_domain_tag_outline(pnpbs_domain domain, pnpbs_level_set_fn level_set, void* user,
                                      int32_t tag, int64_t* count) {
  return change_domain(domain, [&](DomainObject& object) {
    if (!level_set) throw Error(ErrorKind::argument, "argument level_set is NULL");
    const Embedding<2> embedding = sphere_of(object);
    PlaneDomain& plane = embedding.is_sphere() ? *object.plane : plane_of(object);
    const auto function = [&](std::int64_t n, const Point<2>* x, double* values) {
      std::vector<double> coordinates;
      for (std::int64_t i = 0; i < n; ++i) {
        const Point<3> point = embedding.in_space(x[i]);
        coordinates.insert(coordinates.end(), point.begin(),
                           point.begin() + embedding.coordinates());
      }
      const HostArithmetic arithmetic;
      if (const int32_t answer =
              level_set(n, embedding.coordinates(), coordinates.data(), values, user);
          answer != 0)
        throw Error(ErrorKind::callback,
                    "the callback returned " + std::to_string(answer) + "; it must return 0");
    };
    const std::int64_t tagged = plane.tag_outline(function, tag);
    if (count) *count = tagged;
  });
}
