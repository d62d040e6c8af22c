// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the part of space on which d is given meets the domain. If it does not, one of
// them is usually in another unit or in degrees.
#pragma once

#include <string>

#include "base/message_text.hpp"
#include "base/types.hpp"

namespace pnpbs {

// Throws Error(ErrorKind::spacing), which states both extents, unless the boxes meet. `what` is the
// plural subject of the message, such as "argument coordinates".
template <int Dim>
void require_meeting_boxes(const std::string& what, const Box<Dim>& given, const Box<Dim>& domain);

// Returns the text "from (0, 0) to (1, 2)". Infinite sides of the box are replaced by those of
// `within`.
template <int Dim>
MessageText extent_text(const Box<Dim>& box, const Box<Dim>& within);

}  // namespace pnpbs
