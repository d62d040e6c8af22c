// SPDX-License-Identifier: BSD-3-Clause
// The values that pictures colour tetrahedra by.
#pragma once

#include <cstddef>
#include <string>

#include "picture/body.hpp"
#include "picture/element_colour.hpp"

namespace pnpbs::picture {

class TetrahedronValues {
 public:
  // body must outlive this; by: not none.
  TetrahedronValues(const Body& body, ElementColour by);

  double at(std::size_t tetrahedron) const;
  const ColourScale& scale() const { return scale_.colours; }
  std::string title() const;  // what the numbers are, and from where to where they go in the body

 private:
  const Body& body_;
  ElementColour by_;
  ValueScale scale_;
};

}  // namespace pnpbs::picture
