// SPDX-License-Identifier: BSD-3-Clause
// C interface: bodies at a distance from others.
#include "api/domain_calls.hpp"
#include "api/spacing_callback.hpp"
#include "api/sphere_points.hpp"
#include "shape/offset_body.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

template <int Dim>
LocalSpacingEvaluator<Dim> evaluator_of(pnpbs_spacing_fn callback, void* user) {
  const auto spacing =
      std::make_shared<const CallbackSpacing<Dim>>(spacing_from<Dim>(callback, user));
  return LocalSpacingEvaluator<Dim>([spacing](std::int64_t n, const Point<Dim>* x, double* d) {
    local_evaluator<Dim>(*spacing, 0)(n, x, d);
  });
}

}  // namespace

pnpbs_status pnpbs_domain_add_offset(pnpbs_domain domain, pnpbs_domain body, double low,
                                     double high, pnpbs_spacing_fn spacing, void* user,
                                     double resolution, int32_t tag) {
  return change_domain(domain, [&](DomainObject& object) {
    require_no_sphere(sphere_of(object), "domain", "bodies have offsets");
    const std::shared_ptr<DomainObject> of =
        body_with(*object.context, object.plane != nullptr, body);
    const auto add = [&]<int Dim>(Domain<Dim>& to, Domain<Dim>& from) {
      from.check();
      Offset<Dim> offset{low, high, {}, resolution, tag};
      if (spacing) offset.spacing = evaluator_of<Dim>(spacing, user);
      add_offset(to, from, offset);
    };
    if (object.plane)
      add.template operator()<2>(*object.plane, *of->plane);
    else
      add.template operator()<3>(*object.volume, *of->volume);
  });
}
