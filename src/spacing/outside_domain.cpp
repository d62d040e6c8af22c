// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/outside_domain.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {
namespace {

// Returns whether the coordinates are in the range of longitudes and latitudes.
template <int Dim>
bool may_be_degrees(const Box<Dim>& box) {
  return box.low[0] >= -180 && box.high[0] <= 360 && box.low[1] >= -91 && box.high[1] <= 91;
}

template <int Dim>
std::string guess(const Box<Dim>& given, const Box<Dim>& domain) {
  if (may_be_degrees<Dim>(given) && !may_be_degrees<Dim>(domain))
    return "they look like longitude and latitude in degrees, and the domain does not: project "
           "them as the domain is";
  if (may_be_degrees<Dim>(domain) && !may_be_degrees<Dim>(given))
    return "are they in its unit? The domain looks like longitude and latitude in degrees";
  return "are they in its unit?";
}

}  // namespace

template <int Dim>
MessageText extent_text(const Box<Dim>& box, const Box<Dim>& within) {
  Box<Dim> shown = box;
  for (int k = 0; k < Dim; ++k) {
    if (!std::isfinite(box.low[k])) shown.low[k] = within.low[k];
    if (!std::isfinite(box.high[k])) shown.high[k] = within.high[k];
  }
  return "from " + rounded_point_text<Dim>(shown.low) + " to " +
         rounded_point_text<Dim>(shown.high);
}

template <int Dim>
void require_meeting_boxes(const std::string& what, const Box<Dim>& given, const Box<Dim>& domain) {
  const double gap = std::sqrt(squared_gap<Dim>(given, domain));
  if (gap == 0) return;
  throw Error(ErrorKind::spacing,
              what + ": they lie outside of the domain, " + extent_text<Dim>(given, domain) +
                  ", at least " + rounded_text(gap) + " from it; the domain reaches " +
                  extent_text<Dim>(domain, domain) + ": " + guess<Dim>(given, domain));
}

template MessageText extent_text<2>(const Box<2>&, const Box<2>&);
template MessageText extent_text<3>(const Box<3>&, const Box<3>&);
template void require_meeting_boxes<2>(const std::string&, const Box<2>&, const Box<2>&);
template void require_meeting_boxes<3>(const std::string&, const Box<3>&, const Box<3>&);

}  // namespace pnpbs
