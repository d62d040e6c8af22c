// SPDX-License-Identifier: BSD-3-Clause
// Values of d that are given on a part of space: whether the domain is there at all. Mostly it is
// elsewhere because one of them is in another unit, or in degrees.
#pragma once

#include <string>

#include "base/message_text.hpp"
#include "base/types.hpp"

namespace pnpbs {

// Throws Error(ErrorKind::spacing) with both extents unless the boxes meet. `what` has the values,
// in the plural: "argument coordinates".
template <int Dim>
void require_meeting_boxes(const std::string& what, const Box<Dim>& given, const Box<Dim>& domain);

// "from (0, 0) to (1, 2)"; where the box has no end, it ends with `within`.
template <int Dim>
MessageText extent_text(const Box<Dim>& box, const Box<Dim>& within);

}  // namespace pnpbs
