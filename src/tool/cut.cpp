// SPDX-License-Identifier: BSD-3-Clause
#include "tool/cut.hpp"

#include <algorithm>

#include "tool/exit.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

[[noreturn]] void refuse_cut(const std::string& text) {
  throw BadInput(
      "--cut: expected x=NUMBER, y=NUMBER, z=NUMBER or A,B,C,D for the plane A x + B y "
      "+ C z = D, found '" +
      text + "'");
}

std::string name_of(const Point<3>& normal, double offset) {
  std::string name;
  for (std::size_t k = 0; k < 3; ++k) {
    if (normal[k] == 0) continue;
    const bool negative = normal[k] < 0;
    if (negative || !name.empty())
      name +=
          std::string(name.empty() ? "" : " ") + (negative ? "-" : "+") + (name.empty() ? "" : " ");
    const double size = negative ? -normal[k] : normal[k];
    name += (size == 1 ? "" : short_number(size) + " ") + "xyz"[k];
  }
  return name + " = " + short_number(offset);
}

picture::CutPlane across_axis(const std::string& text, std::size_t equals) {
  std::string axis = text.substr(0, equals);
  std::erase(axis, ' ');
  const std::size_t number = std::string("xyz").find(axis);
  const auto place = numbers_between_commas(text.substr(equals + 1));
  if (axis.size() != 1 || number == std::string::npos || !place || place->size() != 1)
    refuse_cut(text);
  return picture::plane_across(static_cast<int>(number), place->front());
}

std::string extent_of(const Box<3>& box) {
  std::string words;
  for (std::size_t k = 0; k < 3; ++k)
    words += (k == 0   ? ""
              : k == 1 ? ", "
                       : " and ") +
             std::string(1, "xyz"[k]) + " from " + short_number(box.low[k]) + " to " +
             short_number(box.high[k]);
  return words;
}

}  // namespace

picture::CutPlane cut_plane_in(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos) return across_axis(text, equals);
  const auto numbers = numbers_between_commas(text);
  if (!numbers || numbers->size() != 4) refuse_cut(text);
  const Point<3> normal{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  if (normal == Point<3>{}) refuse_cut(text);
  return {normal, numbers->back(), name_of(normal, numbers->back())};
}

picture::CutPlane cut_plane_for(const std::string& text, pnpbs_domain domain,
                                pnpbs_context context) {
  Box<3> box{};
  check(pnpbs_domain_bounds(domain, box.low.data(), box.high.data()), context);
  if (text.empty()) return picture::middle_plane(box);
  const picture::CutPlane plane = cut_plane_in(text);
  if (!plane.meets(box))
    throw BadInput("--cut: the plane " + plane.name + " misses the body, which has " +
                   extent_of(box));
  return plane;
}

}  // namespace pnpbs::tool
