// SPDX-License-Identifier: BSD-3-Clause
// Curves that are given finer than nodes should follow them, through the C interface.
#include "api/domain_calls.hpp"
#include "api/spacing_callback.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

pnpbs_status pnpbs_domain_set_corner_angle(pnpbs_domain domain, double corner_angle) {
  return change_plane(domain, [&](PlaneDomain& plane) { plane.set_corner_angle(corner_angle); });
}

pnpbs_status pnpbs_domain_simplify(pnpbs_domain domain, pnpbs_spacing_fn spacing, void* user,
                                   double tolerance, double smallest, int64_t* vertices,
                                   int64_t* curves) {
  return change_plane(domain, [&](PlaneDomain& plane) {
    const CallbackSpacing<2> given = spacing_from<2>(spacing, user);
    const SpacingEvaluator<2> checked = [&](std::int64_t n, const Point<2>* x, double* d) {
      evaluate_spacing<2>(given, 0, n, x, d);
    };
    const LeftOut left_out = plane.simplify(checked, {tolerance, smallest});
    if (vertices) *vertices = left_out.vertices;
    if (curves) *curves = left_out.curves;
  });
}
