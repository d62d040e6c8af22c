// SPDX-License-Identifier: BSD-3-Clause
// The picture of a placement, gathered on the first rank.
#pragma once

#include <optional>

#include "picture/picture.hpp"
#include "tool/arguments.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

struct PictureLook {
  bool bubbles = false;
  picture::ElementColour colour = picture::ElementColour::none;
  // One of them of what is in space; neither: the domain is in the plane.
  std::optional<picture::CutPlane> cut{};
  std::optional<picture::SphereView> sphere{};
};

// What the user wants. Local. Throws BadInput.
PictureLook look_of(const Arguments& arguments, int dimension, pnpbs_domain domain,
                    pnpbs_context context);

class GatheredPicture {
 public:
  // Collective.
  GatheredPicture(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                  const Ranks& ranks, const PictureLook& look);

  // Local, on the first rank; this object must outlive it.
  picture::Drawing drawing() const;

 private:
  PictureLook look_;
  picture::NodeSet nodes_;
  picture::Body body_;
};

}  // namespace pnpbs::tool
