// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/copies_of_cell.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "domain/domain_size.hpp"
#include "domain/images_near_cell.hpp"
#include "geometry/volume/triangles.hpp"
#include "geometry/volume/welding.hpp"
#include "geometry/volume/winding_number.hpp"
#include "surfaces/surface_edges.hpp"

namespace pnpbs {

namespace {

// Distance within which points of opposite sides are the same point. [size of the cell]
constexpr double kSameOnSides = 1e-9;

// The surface of a box, divided at the periods, so that the triangles of its sides are images of
// each other.
class SidesOfBox {
 public:
  SidesOfBox(const PeriodicCell<3>& cell, const Image<3>& copies,
             const std::array<std::int32_t, 6>& tags, const std::array<bool, 3>& flat)
      : cell_(cell), copies_(copies) {
    surface_.name = "the periodic cell";
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t high = 0; high < 2; ++high)
        add_side(axis, high != 0,
                 cell.periodic(static_cast<int>(axis)) ? 1 : tags[2 * axis + high]);
    inner_.role = SurfaceRole::inner;
    inner_.name = "the flat sides of the periodic cell";
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::int32_t part = 1; flat[axis] && part < parts(axis); ++part)
        add_section(inner_, axis, part, true, tags[2 * axis]);
  }
  // Returns the surface of the box, and the flat sides of the copies inside, if there are any.
  std::vector<SurfaceSource> take() {
    std::vector<SurfaceSource> surfaces{std::move(surface_)};
    if (!inner_.triangles.empty()) surfaces.push_back(std::move(inner_));
    return surfaces;
  }

 private:
  std::int32_t parts(std::size_t axis) const { return 2 * copies_[axis] + 1; }
  double coordinate(std::size_t axis, std::int32_t part) const {
    if (!cell_.periodic(static_cast<int>(axis)))
      return part == 0 ? cell_.box().low[axis] : cell_.box().high[axis];
    return cell_.box().low[axis] + (part - copies_[axis]) * cell_.period(static_cast<int>(axis));
  }

  void add_side(std::size_t axis, bool high, std::int32_t tag) {
    add_section(surface_, axis, high ? parts(axis) : 0, high, tag);
  }

  // Adds the section of the box across the axis below this part of it, seen from above or below.
  void add_section(SurfaceSource& surface, std::size_t axis, std::int32_t part, bool above,
                   std::int32_t tag) const {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto vertex = [&](std::int32_t i, std::int32_t j) {
      Point<3> x;
      x[axis] = coordinate(axis, part);
      x[u] = coordinate(u, i);
      x[v] = coordinate(v, j);
      surface.vertices.push_back(x);
      return static_cast<std::int32_t>(surface.vertices.size()) - 1;
    };
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      surface.triangles.push_back(above ? std::array{a, b, c} : std::array{a, c, b});
      surface.tags.push_back(tag);
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
  SurfaceSource surface_, inner_;
};

// Triangles that are connected by edges form a part if they are closed. Any other triangle is a
// part of its own.
class PartsOfSurfaces {
 public:
  explicit PartsOfSurfaces(const std::vector<SurfaceSource>& surfaces)
      : surface_(join_surfaces(surfaces)) {
    weld();
    const SurfaceEdges edges(surface_);
    UnionFind<std::int32_t> groups = connected_triangles(surface_, edges);
    const auto count = static_cast<std::int32_t>(surface_.triangles.size());
    std::vector<char> open(index(count));  // per root
    for (std::size_t e = 0; e < edges.count(); ++e) {
      if (edges.sides(e).size() != 1) continue;
      const std::int32_t t = edges.sides(e)[0].triangle;
      open[index(groups.root(t))] = 1;
      rim_.push_back({edges.ends(e), {vertex(edges.ends(e)[0]), vertex(edges.ends(e)[1])}, t});
    }
    for (std::int32_t t = 0; t < count; ++t) {
      const std::int32_t root = groups.root(t);
      const bool closed = open[index(root)] == 0;
      if (root == t || !closed) {
        part_.push_back(parts_.size());
        parts_.push_back({empty_box<3>(), closed, surface_.corners(t)[0], {}});
        corners_.emplace_back();
      } else {
        part_.push_back(part_[index(root)]);
      }
      parts_[part_.back()].box = joined(parts_[part_.back()].box, surface_.box(t));
      if (closed) corners_[part_.back()].push_back(surface_.corners(t));
    }
    for (std::size_t p = 0; p < parts_.size(); ++p)
      parts_[p].encloses = [winding = WindingNumber(std::move(corners_[p]))](const Point<3>& x) {
        return std::fabs(winding(x)) > 0.5;
      };
  }

  // Throws Error(ErrorKind::domain) if a surface ends on a periodic side of the cell and none goes
  // on from there at the opposite side.
  void require_continued(const PeriodicCell<3>& cell) const {
    const double same = kSameOnSides * size_of(cell.box());
    std::vector<Box<3>> boxes;
    for (const RimEdge& edge : rim_)
      boxes.push_back(
          widened(joined(Box<3>{edge.ends[0], edge.ends[0]}, {edge.ends[1], edge.ends[1]}), same));
    const BoxTree<3> tree(std::move(boxes));
    const auto ends_at = [&](const Point<3>& x) {
      bool found = false;
      tree.for_holding(x, [&](std::int32_t e) {
        const auto& [a, b] = rim_[index(e)].ends;
        const Point<3> along = difference(b, a), to = difference(x, a);
        found = found || length(cross(along, to)) <= same * length(along);
      });
      return found;
    };
    for (const RimEdge& edge : rim_)
      for (std::size_t k = 0; k < 3; ++k) {
        if (!cell.periodic(static_cast<int>(k))) continue;
        for (const double sign : {1.0, -1.0}) {
          const double side = sign > 0 ? cell.box().low[k] : cell.box().high[k];
          const auto& [a, b] = edge.ends;
          if (std::fabs(a[k] - side) > same || std::fabs(b[k] - side) > same) continue;
          for (const Point<3>& x : {a, halfway(a, b), b}) {
            Point<3> opposite = x;
            opposite[k] += sign * cell.period(static_cast<int>(k));
            if (ends_at(opposite)) continue;
            reject_domain(surface_.triangle_name(edge.triangle) +
                          " ends on a side of the periodic domain at " + point_text(x) +
                          ", and no surface goes on from " + point_text(opposite) +
                          " at the opposite side: let surfaces end at the same points of both "
                          "sides");
          }
        }
      }
  }

  // Returns the points at which sharp edges may cross the periodic sides of the cell: where
  // triangles with different normals end there. Nodes on an edge repeat with the periods only if
  // they are placed between such points.
  std::vector<Point<3>> creases_at_sides(const PeriodicCell<3>& cell, double feature_angle) const {
    const double same = kSameOnSides * size_of(cell.box());
    const double cosine = std::cos(feature_angle * std::numbers::pi / 180);
    std::map<std::int32_t, std::vector<Point<3>>> normals;  // of the triangles at vertices
    for (const RimEdge& edge : rim_)
      for (const std::int32_t v : edge.vertices)
        for (int k = 0; k < 3; ++k)
          if (cell.periodic(k) && std::min(std::fabs(vertex(v)[k] - cell.box().low[k]),
                                           std::fabs(vertex(v)[k] - cell.box().high[k])) <= same)
            normals[v];
    for (std::size_t t = 0; t < surface_.triangles.size() && !normals.empty(); ++t)
      for (const std::int32_t v : surface_.triangles[t].vertices)
        if (const auto at = normals.find(v); at != normals.end())
          at->second.push_back(
              unit_vector(area_normal(surface_.corners(static_cast<std::int32_t>(t)))));
    std::vector<Point<3>> points;
    for (const auto& at : normals) {
      const std::vector<Point<3>>& around = at.second;
      const auto is_other = [&](const Point<3>& n) {
        return std::fabs(dot(n, around[0])) < cosine;
      };
      if (std::ranges::any_of(around, is_other)) points.push_back(vertex(at.first));
    }
    return points;
  }

  // Returns the part of each triangle. The triangles of all surfaces are numbered consecutively.
  const std::vector<std::size_t>& of_triangles() const { return part_; }
  std::vector<ConnectedPart<3>> take() { return std::move(parts_); }

 private:
  // An edge of a single triangle.
  struct RimEdge {
    std::array<std::int32_t, 2> vertices;
    std::array<Point<3>, 2> ends;
    std::int32_t triangle;
  };

  const Point<3>& vertex(std::int32_t v) const { return surface_.vertices[index(v)]; }

  void weld() {
    Box<3> box = empty_box<3>();
    for (const Point<3>& x : surface_.vertices) include(box, x);
    const std::vector<std::int32_t> joined =
        weld_points(surface_.vertices, kSameVertex * size_of(box));
    for (SurfaceTriangle& triangle : surface_.triangles)
      for (std::int32_t& v : triangle.vertices) v = joined[index(v)];
  }

  Triangulation surface_;
  std::vector<std::size_t> part_;
  std::vector<ConnectedPart<3>> parts_;
  std::vector<std::vector<FacetCorners<3>>> corners_;  // of the triangles of each part
  std::vector<RimEdge> rim_;
};

// The triangles of a surface that have an image in a copy of the cell, and whether they stand for
// theirs in the cell.
struct SurfaceInCopy {
  SurfaceSource surface;
  std::vector<char> in_cell;
};

SurfaceInCopy surface_in_copy(const SurfaceSource& surface, const std::size_t* part,
                              const ImagesNearCell<3>& images, const Image<3>& image) {
  SurfaceInCopy in{surface, {}};
  SurfaceSource& copy = in.surface;
  copy.vertices.clear();
  copy.triangles.clear();
  copy.tags.clear();
  std::vector<std::int32_t> vertex(surface.vertices.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!images.has(part[t], image)) continue;
    std::array<std::int32_t, 3> corners = surface.triangles[t];
    for (std::int32_t& v : corners) {
      std::int32_t& of_copy = vertex[index(v)];
      if (of_copy < 0) {
        of_copy = static_cast<std::int32_t>(copy.vertices.size());
        copy.vertices.push_back(images.moved(image, surface.vertices[index(v)]));
        copy.vertex_numbers.push_back(v);
      }
      v = of_copy;
    }
    copy.triangles.push_back(corners);
    copy.triangle_numbers.push_back(static_cast<std::int32_t>(t));
    copy.tags.push_back(surface.tags[t]);
    in.in_cell.push_back(images.is_home(part[t], image));
  }
  return in;
}

// Adds nodes at points, each once on the torus, where no node is given yet.
void add_nodes(const PeriodicCell<3>& cell, const std::vector<Point<3>>& points, std::int32_t tag,
               std::vector<FixedNode<3>>& nodes) {
  const double same = kSameOnSides * size_of(cell.box());
  const auto is_at = [&](const Point<3>& a, const Point<3>& b) {
    for (int k = 0; k < 3; ++k) {
      double gap = std::fabs(a[k] - b[k]);
      if (cell.periodic(k)) gap -= cell.period(k) * std::round(gap / cell.period(k));
      if (std::fabs(gap) > same) return false;
    }
    return true;
  };
  for (const Point<3>& x : points)
    if (std::ranges::none_of(nodes,
                             [&](const FixedNode<3>& node) { return is_at(node.position, x); }))
      nodes.push_back({x, tag, "a node on a periodic side"});
}

// Returns the points of the periodic sides where two walls meet. Walls meet along a periodic axis
// only if it is the only one.
std::vector<Point<3>> corners_of_walls(const PeriodicCell<3>& cell) {
  if (cell.periodic(0) + cell.periodic(1) + cell.periodic(2) != 1) return {};
  std::vector<Point<3>> corners;
  for (int corner = 0; corner < 8; ++corner) {
    Point<3> x = cell.box().low;
    for (int k = 0; k < 3; ++k)
      if (!cell.periodic(k) && (corner >> k & 1) != 0) x[k] = cell.box().high[k];
    corners.push_back(x);
  }
  return corners;
}

}  // namespace

CopiesOfSurfaces copies_of_cell(const PeriodicCell<3>& cell, double reach, bool divides,
                                const std::array<std::int32_t, 6>& side_tags,
                                const std::array<bool, 3>& flat,
                                const std::vector<SurfaceSource>& surfaces,
                                const std::vector<RegionPoint<3>>& region_points,
                                const std::vector<FixedNode<3>>& fixed_nodes) {
  PartsOfSurfaces parts(surfaces);
  parts.require_continued(cell);
  const ImagesNearCell<3> images(cell, reach, !region_points.empty(), divides, parts.take());
  CopiesOfSurfaces all;
  all.touch = divides && images.any_open();
  all.surfaces = SidesOfBox(cell, images.copies(), side_tags, flat).take();
  for (const SurfaceSource& sides : all.surfaces)
    all.in_cell.resize(all.in_cell.size() + sides.triangles.size(), 0);
  images.for_copies([&](const Image<3>& image) {
    const std::size_t* part = parts.of_triangles().data();
    for (const SurfaceSource& surface : surfaces) {
      SurfaceInCopy copy = surface_in_copy(surface, part, images, image);
      part += surface.triangles.size();
      if (copy.in_cell.empty()) continue;
      all.surfaces.push_back(std::move(copy.surface));
      all.in_cell.insert(all.in_cell.end(), copy.in_cell.begin(), copy.in_cell.end());
    }
  });
  all.region_points = images.images_of(region_points);
  std::vector<FixedNode<3>> nodes = fixed_nodes;
  double feature_angle = kFeatureAngle;
  for (const SurfaceSource& surface : surfaces)
    feature_angle = std::min(feature_angle, surface.feature_angle);
  add_nodes(cell, corners_of_walls(cell), *std::ranges::max_element(side_tags), nodes);
  add_nodes(cell, parts.creases_at_sides(cell, feature_angle), 1, nodes);
  all.fixed_nodes = images.images_of(nodes);
  return all;
}

}  // namespace pnpbs
