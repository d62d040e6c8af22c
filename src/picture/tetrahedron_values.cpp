// SPDX-License-Identifier: BSD-3-Clause
#include "picture/tetrahedron_values.hpp"

#include <algorithm>

#include "picture/lettering.hpp"
#include "quality/volume/tetrahedron_quality.hpp"

namespace pnpbs::picture {
namespace {

using Spacing = std::array<double, 4>;

double edge_over_spacing(const TetrahedronCorners& corners, const Spacing& d) {
  double sum = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b)
      sum += distance<3>(corners[a], corners[b]) / (0.5 * (d[a] + d[b]));
  return sum / 6;
}

}  // namespace

TetrahedronValues::TetrahedronValues(const Body& body, ElementColour by) : body_(body), by_(by) {
  scale_ = scale_for(by, {body.tetrahedra.size(), [this](std::size_t t) { return at(t); }});
}

double TetrahedronValues::at(std::size_t tetrahedron) const {
  const TetrahedronCorners corners = body_.corners(tetrahedron);
  Spacing d;
  for (std::size_t k = 0; k < 4; ++k)
    d[k] = body_.spacing[static_cast<std::size_t>(body_.tetrahedra[tetrahedron][k])];
  switch (by_) {
    case ElementColour::quality:
      return std::clamp(tetrahedron_quality(corners), 0.0, 1.0);
    case ElementColour::edge:
      return edge_over_spacing(corners, d);
    case ElementColour::spacing:
      return (d[0] + d[1] + d[2] + d[3]) / 4;
    case ElementColour::none:
      break;
  }
  return 0;
}

std::string TetrahedronValues::title() const {
  return title_of(by_, "quality 3 r_in / R", "tetrahedra", scale_, body_.tetrahedra.size());
}

}  // namespace pnpbs::picture
