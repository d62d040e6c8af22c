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
  picture::PictureStyle style{};
  // At most one of them is set, for a body or a sphere. Neither is set for a domain in the plane.
  std::optional<picture::CutPlane> cut{};
  std::optional<picture::SphereView> sphere{};
};

// Returns the appearance that the arguments request. `unit` is the unit of length, or empty. Local.
// Throws BadInput.
PictureLook look_of(const Arguments& arguments, int dimension, const std::string& unit,
                    pnpbs_domain domain, pnpbs_context context);

class GatheredPicture {
 public:
  // Gathers the nodes and elements. Collective.
  GatheredPicture(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                  const Ranks& ranks, const PictureLook& look);

  // Returns the drawing, on the first rank only. This object must outlive it. Local.
  picture::Drawing drawing() const;

 private:
  PictureLook look_;
  picture::NodeSet nodes_;
  picture::Body body_;
};

}  // namespace pnpbs::tool
