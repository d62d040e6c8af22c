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

}  // namespace

PictureLook look_of(const Arguments& arguments, int dimension, pnpbs_domain domain,
                    pnpbs_context context) {
  using picture::ElementColour;
  if (dimension == 2)
    return {arguments.bubbles, arguments.colour.value_or(ElementColour::none), std::nullopt, 0};
  return {false, arguments.colour.value_or(ElementColour::quality),
          cut_plane_for(arguments.cut, domain, context),
          arguments.sphere ? arguments.sphere->radius : 0};
}

GatheredPicture::GatheredPicture(pnpbs_placement placement, pnpbs_domain domain,
                                 pnpbs_context context, const Ranks& ranks, const PictureLook& look)
    : look_(look) {
  if (look.cut) {
    body_ = gathered_body(placement, context, ranks);
    body_.sphere_radius = look.sphere_radius;
    return;
  }
  nodes_ = gathered_nodes(placement, context, ranks);
  ranks.agreed([&] {
    if (ranks.is_first()) nodes_.outline = outline_of(domain, context);
  });
}

picture::Drawing GatheredPicture::drawing() const {
  if (look_.cut) return picture::drawing_of(body_, *look_.cut, look_.colour);
  return picture::drawing_of(nodes_, {look_.bubbles, look_.colour});
}

}  // namespace pnpbs::tool
