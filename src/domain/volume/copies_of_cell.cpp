// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/copies_of_cell.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

Image<3> opposite(const Image<3>& image) { return {-image[0], -image[1], -image[2]}; }

Box<3> box_of(const std::vector<Point<3>>& points) {
  Box<3> box{points[0], points[0]};
  for (const Point<3>& x : points) box = joined(box, {x, x});
  return box;
}

// The surface of a box, divided at the periods, so that the triangles of its sides are images of
// each other.
class SidesOfBox {
 public:
  SidesOfBox(const PeriodicCell<3>& cell, const Image<3>& copies,
             const std::array<std::int32_t, 6>& tags)
      : cell_(cell), copies_(copies) {
    surface_.name = "the periodic cell";
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t high = 0; high < 2; ++high)
        add_side(axis, high != 0,
                 cell.periodic(static_cast<int>(axis)) ? 1 : tags[2 * axis + high]);
  }
  SurfaceSource take() { return std::move(surface_); }

 private:
  std::int32_t parts(std::size_t axis) const { return 2 * copies_[axis] + 1; }
  double coordinate(std::size_t axis, std::int32_t part) const {
    if (!cell_.periodic(static_cast<int>(axis)))
      return part == 0 ? cell_.box().low[axis] : cell_.box().high[axis];
    return cell_.box().low[axis] + (part - copies_[axis]) * cell_.period(static_cast<int>(axis));
  }

  void add_side(std::size_t axis, bool high, std::int32_t tag) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto vertex = [&](std::int32_t i, std::int32_t j) {
      Point<3> x;
      x[axis] = coordinate(axis, high ? parts(axis) : 0);
      x[u] = coordinate(u, i);
      x[v] = coordinate(v, j);
      surface_.vertices.push_back(x);
      return static_cast<std::int32_t>(surface_.vertices.size()) - 1;
    };
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      surface_.triangles.push_back(high ? std::array{a, b, c} : std::array{a, c, b});
      surface_.tags.push_back(tag);
    };
    for (std::int32_t i = 0; i < parts(u); ++i)
      for (std::int32_t j = 0; j < parts(v); ++j) {
        const std::int32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                           d = vertex(i, j + 1);
        add(a, b, c);
        add(a, c, d);
      }
  }

  const PeriodicCell<3>& cell_;
  const Image<3>& copies_;
  SurfaceSource surface_;
};

}  // namespace

CopiesOfSurfaces copies_of_cell(const PeriodicCell<3>& cell, const Image<3>& copies,
                                const std::array<std::int32_t, 6>& side_tags,
                                const std::vector<SurfaceSource>& surfaces,
                                const std::vector<RegionPoint<3>>& region_points,
                                const std::vector<FixedNode<3>>& fixed_nodes) {
  CopiesOfSurfaces all;
  all.surfaces.push_back(SidesOfBox(cell, copies, side_tags).take());
  all.in_cell.push_back(0);
  const Box<3> outer = box_of(all.surfaces[0].vertices);
  const auto crosses_outer = [&](const Box<3>& box) {
    for (std::size_t k = 0; k < 3; ++k)
      if (cell.periodic(static_cast<int>(k)) &&
          (box.low[k] <= outer.low[k] || box.high[k] >= outer.high[k]))
        return true;
    return false;
  };
  for (std::int32_t z = -copies[2]; z <= copies[2]; ++z)
    for (std::int32_t y = -copies[1]; y <= copies[1]; ++y)
      for (std::int32_t x = -copies[0]; x <= copies[0]; ++x) {
        const Image<3> image{x, y, z};
        const auto moved = [&](const Point<3>& at) {
          return cell.seen_from(opposite(image), cell.rounded(at));
        };
        for (const SurfaceSource& surface : surfaces) {
          SurfaceSource copy = surface;
          for (Point<3>& vertex : copy.vertices) vertex = moved(vertex);
          if (crosses_outer(box_of(copy.vertices))) continue;
          all.surfaces.push_back(std::move(copy));
          all.in_cell.push_back(image == Image<3>{});
        }
        // The surfaces around a point in an outermost copy may be left out.
        bool outermost = false;
        for (std::size_t k = 0; k < 3; ++k)
          outermost = outermost || (copies[k] > 0 && std::abs(image[k]) == copies[k]);
        for (RegionPoint<3> point : region_points) {
          if (outermost) break;
          point.point = moved(cell.in_cell(cell.rounded(point.point)));
          all.region_points.push_back(std::move(point));
        }
        for (FixedNode<3> node : fixed_nodes) {
          node.position = moved(cell.in_cell(cell.rounded(node.position)));
          all.fixed_nodes.push_back(std::move(node));
        }
      }
  return all;
}

}  // namespace pnpbs
