// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/self_intersections.hpp"

#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "base/domain_error.hpp"
#include "base/point_text.hpp"
#include "geometry/volume/triangle_contacts.hpp"

namespace pnpbs {

BoxTree<3> tree_of(const Triangulation& surface) {
  std::vector<Box<3>> boxes(surface.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    boxes[t] = surface.box(static_cast<std::int32_t>(t));
  return BoxTree<3>(std::move(boxes));
}

namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

MessageText text_of(const Triangulation& surface, const Pair& pair) {
  const auto [t, other] = pair;
  const Contact contact = contact_of(surface.corners(t), surface.corners(other));
  const char* const how = contact.kind == Contact::Kind::cross   ? " cross at "
                          : contact.kind == Contact::Kind::touch ? " touch at "
                                                                 : " lie on each other at ";
  return surface.triangle_name(t) + " and " + surface.triangle_name(other) + how +
         point_text(contact.place);
}

}  // namespace

void reject_crossings(const Triangulation& surface, const BoxTree<3>& tree) {
  constexpr std::size_t kListed = 20;
  const auto count = static_cast<std::int32_t>(surface.triangles.size());
  std::int64_t pairs = 0;
  std::set<Pair> first;
  for (std::int32_t t = 0; t < count; ++t) {
    const FacetCorners<3> corners = surface.corners(t);
    tree.for_meeting(surface.box(t), [&](std::int32_t other) {
      if (other <= t) return;
      if (!triangles_meet(corners, surface.triangles[t].vertices, surface.corners(other),
                          surface.triangles[other].vertices))
        return;
      ++pairs;
      first.emplace(t, other);
      if (first.size() > kListed) first.erase(std::prev(first.end()));
    });
  }
  if (pairs == 0) return;
  MessageText message;
  for (const Pair& pair : first) message += (message.empty() ? "" : "; ") + text_of(surface, pair);
  if (pairs > 1) message += "; there are " + std::to_string(pairs) + " such pairs";
  throw BrokenSurface(message);
}

}  // namespace pnpbs
