// SPDX-License-Identifier: BSD-3-Clause
#include "tool/gathered_picture.hpp"

#include "tool/cut.hpp"
#include "tool/gathered_nodes.hpp"

namespace pnpbs::tool {
namespace {

std::vector<double> outline_of(pnpbs_domain domain, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_domain_get_segments(domain, 0, &count, nullptr, nullptr), context);
  std::vector<double> outline(4 * static_cast<std::size_t>(count));
  check(pnpbs_domain_get_segments(domain, count, &count, outline.data(), nullptr), context);
  return outline;
}

// From above the middle of what is around the point opposite to the one that is projected from:
// there the domain is.
picture::SphereView view_of(const Arguments& arguments) {
  const SphereWish& sphere = *arguments.sphere;
  if (!arguments.view) return {sphere.radius, false, {sphere.outside[0] + 180, -sphere.outside[1]}};
  return {sphere.radius, arguments.view->as_map, arguments.view->from};
}

}  // namespace

PictureLook look_of(const Arguments& arguments, int dimension, pnpbs_domain domain,
                    pnpbs_context context) {
  using picture::ElementColour;
  if (dimension == 2) return {arguments.bubbles, arguments.colour.value_or(ElementColour::none)};
  if (arguments.sphere)
    return {false, arguments.colour.value_or(ElementColour::none), {}, view_of(arguments)};
  return {false, arguments.colour.value_or(ElementColour::quality),
          cut_plane_for(arguments.cut, domain, context)};
}

GatheredPicture::GatheredPicture(pnpbs_placement placement, pnpbs_domain domain,
                                 pnpbs_context context, const Ranks& ranks, const PictureLook& look)
    : look_(look) {
  if (look.cut || look.sphere) {
    body_ = gathered_body(placement, context, ranks);
    return;
  }
  nodes_ = gathered_nodes(placement, context, ranks);
  ranks.agreed([&] {
    if (ranks.is_first()) nodes_.outline = outline_of(domain, context);
  });
}

picture::Drawing GatheredPicture::drawing() const {
  if (look_.sphere) return picture::drawing_of(body_, *look_.sphere, look_.colour);
  if (look_.cut) return picture::drawing_of(body_, *look_.cut, look_.colour);
  return picture::drawing_of(nodes_, {look_.bubbles, look_.colour});
}

}  // namespace pnpbs::tool
