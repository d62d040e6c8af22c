// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/self_intersections.hpp"

#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "domain/volume/triangle_contacts.hpp"

namespace pnpbs {

BoxTree<3> tree_of(const Triangulation& surface) {
  std::vector<Box<3>> boxes(surface.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    boxes[t] = surface.box(static_cast<std::int32_t>(t));
  return BoxTree<3>(std::move(boxes));
}

void reject_crossings(const Triangulation& surface, const BoxTree<3>& tree) {
  const auto count = static_cast<std::int32_t>(surface.triangles.size());
  std::int64_t pairs = 0;
  std::pair<std::int32_t, std::int32_t> first;
  for (std::int32_t t = 0; t < count; ++t) {
    const FacetCorners<3> corners = surface.corners(t);
    tree.for_meeting(surface.box(t), [&](std::int32_t other) {
      if (other <= t) return;
      if (!triangles_meet(corners, surface.triangles[t].vertices, surface.corners(other),
                          surface.triangles[other].vertices))
        return;
      if (pairs++ == 0 || std::pair(t, other) < first) first = {t, other};
    });
  }
  if (pairs == 0) return;
  const auto& [t, other] = first;
  const Contact contact = contact_of(surface.corners(t), surface.corners(other));
  const char* const how = contact.kind == Contact::Kind::cross   ? " cross at "
                          : contact.kind == Contact::Kind::touch ? " touch at "
                                                                 : " lie on each other at ";
  std::string message = surface.triangle_name(t) + " and " + surface.triangle_name(other) + how +
                        point_text(contact.place);
  if (pairs > 1) message += "; there are " + std::to_string(pairs) + " such pairs";
  throw Error(ErrorKind::domain, message);
}

}  // namespace pnpbs
