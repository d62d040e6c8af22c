// SPDX-License-Identifier: BSD-3-Clause
#include "tool/own_elements.hpp"

namespace pnpbs::tool {
namespace {

// Calls get(capacity, count, corners), a function of the library, first for the count and then for
// the corners.
template <std::size_t Size, class Get>
std::vector<Corners<Size>> asked_twice(pnpbs_context context, const Get& get) {
  std::int64_t count = 0;
  check(get(0, &count, nullptr), context);
  std::vector<Corners<Size>> corners(static_cast<std::size_t>(count));
  check(get(count, &count, corners.empty() ? nullptr : corners[0].data()), context);
  return corners;
}

}  // namespace

std::vector<Corners<3>> own_triangles(pnpbs_placement placement, pnpbs_context context) {
  return asked_twice<3>(context,
                        [&](std::int64_t capacity, std::int64_t* count, std::int64_t* corners) {
                          return pnpbs_placement_get_triangles(placement, capacity, count, corners);
                        });
}

std::vector<Corners<4>> own_tetrahedra(pnpbs_placement placement, pnpbs_context context) {
  return asked_twice<4>(
      context, [&](std::int64_t capacity, std::int64_t* count, std::int64_t* corners) {
        return pnpbs_placement_get_tetrahedra(placement, capacity, count, corners);
      });
}

std::vector<Corners<3>> own_boundary(pnpbs_placement placement, pnpbs_context context) {
  return asked_twice<3>(
      context, [&](std::int64_t capacity, std::int64_t* count, std::int64_t* corners) {
        return pnpbs_placement_get_boundary_triangles(placement, capacity, count, corners, nullptr);
      });
}

std::vector<std::int64_t> ghost_ids(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_placement_ghost_count(placement, &count), context);
  std::vector<std::int64_t> ids(static_cast<std::size_t>(count));
  check(
      pnpbs_placement_get_ghosts(placement, count, nullptr, ids.data(), nullptr, nullptr, nullptr),
      context);
  return ids;
}

}  // namespace pnpbs::tool
