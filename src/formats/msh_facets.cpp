// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/space_vectors.hpp"
#include "base/union_find.hpp"
#include "formats/msh_mesh.hpp"
#include "formats/polygons.hpp"

namespace pnpbs {
namespace {

// Sides of elements. Two elements touch if they share a side.

constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

// Corners of the sides of each shape, as indices of corners of the element. -1: the side is a
// triangle or an edge.
using Sides = std::vector<std::array<int, 4>>;

const Sides& sides_of(MshShape shape) {
  static const std::map<MshShape, Sides> sides{
      {MshShape::triangle, {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}}},
      {MshShape::quadrangle, {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}}},
      {MshShape::tetrahedron, {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}},
      {MshShape::hexahedron,
       {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {MshShape::prism, {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
      {MshShape::pyramid,
       {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}};
  return sides.at(shape);
}

// Nodes of a side. kNone: the side has fewer than four corners.
using Key = std::array<std::int32_t, 4>;

Key key_of(Key corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// Returns the number of corners.
std::int32_t count_of(const Key& corners) {
  return static_cast<std::int32_t>(std::find(corners.begin(), corners.end(), kNone) -
                                   corners.begin());
}

// Calls visit(shape, corners, region) for each element of this dimension.
template <class Visit>
void for_cells(const MshMesh& mesh, int dimension, const Visit& visit) {
  for (std::size_t shape = 0; shape < kMshShapes; ++shape) {
    if (kMshDimensions[shape] != dimension) continue;
    const auto corners = static_cast<std::size_t>(kMshCorners[shape]);
    const MshCells& cells = mesh.cells[shape];
    for (std::size_t e = 0; e < cells.count(); ++e)
      visit(static_cast<MshShape>(shape), std::span(cells.corners).subspan(corners * e, corners),
            static_cast<std::size_t>(cells.regions[e]));
  }
}

// A side of elements that fill the domain.
struct Face {
  Key key, corners;
  std::int32_t region;  // tag of the region of the first element
  int elements = 1;
  bool divides = false;  // between elements of different regions
  bool given = false;    // also given as an element of its own
};

// Returns the sides of all elements of this dimension, once each and sorted by key.
std::vector<Face> faces_of_cells(const MshMesh& mesh, int dimension) {
  const std::vector<std::int32_t> tags = tags_of_regions(mesh, dimension);
  std::vector<Face> all;
  for_cells(mesh, dimension,
            [&](MshShape shape, std::span<const std::int32_t> corners, std::size_t region) {
              for (const std::array<int, 4>& side : sides_of(shape)) {
                Key face{kNone, kNone, kNone, kNone};
                for (std::size_t k = 0; k < 4; ++k)
                  if (side[k] >= 0) face[k] = corners[static_cast<std::size_t>(side[k])];
                all.push_back({key_of(face), face, tags[region]});
              }
            });
  std::stable_sort(all.begin(), all.end(),
                   [](const Face& a, const Face& b) { return a.key < b.key; });
  std::vector<Face> faces;
  for (const Face& face : all) {
    if (faces.empty() || faces.back().key != face.key) {
      faces.push_back(face);
      continue;
    }
    ++faces.back().elements;
    if (faces.back().region != face.region) faces.back().divides = true;
  }
  return faces;
}

std::string nodes_text(const MshMesh& mesh, const Key& corners) {
  std::string text;
  for (std::int32_t k = 0; k < count_of(corners); ++k)
    text += (k > 0 ? ", " : "") +
            std::to_string(
                mesh.node_tags[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])]);
  return text;
}

// Returns, for each region of this dimension, whether it bounds the domain, from the number of
// entities that it bounds. Returns `unknown` if no region bounds exactly one entity.
std::vector<MshSides> sides_of_regions(const MshMesh& mesh, int dimension) {
  const bool told = std::ranges::any_of(mesh.regions, [&](const MshRegion& region) {
    return region.dimension == dimension && region.bounds == 1;
  });
  std::vector<MshSides> sides;
  for (const MshRegion& region : mesh.regions)
    sides.push_back(!told                ? MshSides::unknown
                    : region.bounds == 1 ? MshSides::one_inside
                                         : MshSides::both_inside);
  return sides;
}

const char* what_is_missing(int dimension) {
  return dimension == 2 ? "holds no lines, triangles or quadrangles, expected a domain or its "
                          "boundary"
                        : "holds no triangles, quadrangles or elements of volumes, expected a body "
                          "or its surface";
}

}  // namespace

std::vector<MshFacet> facets_of(const MshMesh& mesh, int dimension) {
  std::vector<Face> faces = faces_of_cells(mesh, dimension);
  for (const Face& face : faces)
    if (face.elements > 2)
      throw Error(ErrorKind::file, mesh.name + ": " + std::to_string(face.elements) +
                                       " elements share the nodes " +
                                       nodes_text(mesh, face.corners) + ", expected two at most");
  const std::vector<std::int32_t> tags = tags_of_regions(mesh, dimension - 1);
  const std::vector<MshSides> by_region = sides_of_regions(mesh, dimension - 1);
  std::vector<MshFacet> facets;
  for_cells(mesh, dimension - 1,
            [&](MshShape, std::span<const std::int32_t> corners, std::size_t region) {
              Key all{kNone, kNone, kNone, kNone};
              std::copy(corners.begin(), corners.end(), all.begin());
              MshSides sides = by_region[region];
              if (!faces.empty()) {
                const Key key = key_of(all);
                const auto face = std::ranges::lower_bound(faces, key, {}, &Face::key);
                const bool found = face != faces.end() && face->key == key;
                if (found) face->given = true;
                sides = found && face->elements == 1 ? MshSides::one_inside : MshSides::both_inside;
              }
              facets.push_back({all, count_of(all), tags[region], sides});
            });
  const std::int32_t other = free_tag(mesh);
  for (const Face& face : faces)
    if (!face.given && (face.elements == 1 || face.divides))
      facets.push_back({face.corners, count_of(face.corners), other,
                        face.divides ? MshSides::both_inside : MshSides::one_inside});
  if (facets.empty()) throw Error(ErrorKind::file, mesh.name + ": " + what_is_missing(dimension));
  return facets;
}

namespace {

// The nodes of the mesh that a surface uses, with new numbers in the surface.
class UsedNodes {
 public:
  explicit UsedNodes(const MshMesh& mesh) : mesh_(mesh), number_(mesh.nodes.size(), -1) {}

  std::int32_t number_in(SurfaceTriangles& surface, std::int32_t node) {
    std::int32_t& number = number_[static_cast<std::size_t>(node)];
    if (number < 0) {
      number = static_cast<std::int32_t>(surface.vertices.size());
      surface.vertices.push_back(mesh_.nodes[static_cast<std::size_t>(node)]);
    }
    return number;
  }

 private:
  const MshMesh& mesh_;
  std::vector<std::int32_t> number_;
};

}  // namespace

SurfaceTriangles triangles_of(const MshMesh& mesh, const std::vector<MshFacet>& facets,
                              MshSides sides) {
  SurfaceTriangles surface;
  UsedNodes used(mesh);
  std::vector<std::int32_t> corners;
  for (const MshFacet& facet : facets) {
    if (facet.sides != sides) continue;
    corners.clear();
    for (const std::int32_t node : facet.nodes()) corners.push_back(used.number_in(surface, node));
    if (const auto problem = add_polygon(surface, corners, facet.tag); !problem.empty())
      throw Error(ErrorKind::file, mesh.name + ": " + problem);
  }
  return surface;
}

namespace {

// A line element.
struct MshLine {
  std::array<std::int32_t, 2> ends;  // indices of nodes of the mesh
  std::int32_t tag;
  bool inner;
};

// The curves that lines form. A curve ends where the number of lines that meet is not two, at a
// stop, or where the tag or side changes.
class CurveFinder {
 public:
  CurveFinder(const std::vector<MshLine>& lines, const std::vector<MshPoint>& stops)
      : lines_(lines), used_(lines.size(), 0) {
    for (const MshPoint& stop : stops) stops_.insert(stop.node);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const std::int32_t end : lines[i].ends) at_[end].push_back(i);
  }

  std::vector<MshCurve> find() {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (const int k : {0, 1})
        if (!used_[i] && ends_at(lines_[i].ends[static_cast<std::size_t>(k)]))
          walk(i, lines_[i].ends[static_cast<std::size_t>(k)]);
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (!used_[i]) walk(i, lines_[i].ends[0]);
    return std::move(curves_);
  }

 private:
  bool ends_at(std::int32_t node) const {
    const std::vector<std::size_t>& lines = at_.at(node);
    if (lines.size() != 2 || stops_.contains(node)) return true;
    const MshLine &a = lines_[lines[0]], &b = lines_[lines[1]];
    return a.tag != b.tag || a.inner != b.inner;
  }

  void walk(std::size_t line, std::int32_t begin) {
    MshCurve curve{{begin}, false, lines_[line].tag, lines_[line].inner};
    for (std::int32_t node = begin;;) {
      used_[line] = 1;
      const auto& ends = lines_[line].ends;
      node = ends[0] == node ? ends[1] : ends[0];
      if (node == begin) {
        curve.closed = true;
        break;
      }
      curve.nodes.push_back(node);
      if (ends_at(node)) break;
      const std::vector<std::size_t>& here = at_.at(node);
      line = here[0] == line ? here[1] : here[0];
    }
    curves_.push_back(std::move(curve));
  }

  const std::vector<MshLine>& lines_;
  std::vector<char> used_;
  std::set<std::int32_t> stops_;
  std::map<std::int32_t, std::vector<std::size_t>> at_;  // lines at each node
  std::vector<MshCurve> curves_;
};

void require_plane(const MshMesh& mesh) {
  if (mesh.dimension() != 2)
    throw Error(ErrorKind::file, mesh.name +
                                     ": holds a mesh in space, expected one in a plane of "
                                     "constant z");
}

// Marks lines with unknown sides as inner lines if they belong to open chains, which cannot bound a
// domain.
void find_open_chains(const std::vector<MshFacet>& facets, std::vector<MshLine>& lines) {
  std::map<std::int32_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (facets[i].sides == MshSides::unknown)
      for (const std::int32_t end : lines[i].ends) at[end].push_back(i);
  std::vector<std::int32_t> ends;
  for (const auto& [node, here] : at)
    if (here.size() == 1) ends.push_back(node);
  while (!ends.empty()) {
    const std::int32_t node = ends.back();
    ends.pop_back();
    if (at[node].size() != 1) continue;
    const std::size_t line = at[node].front();
    lines[line].inner = true;
    for (const std::int32_t end : lines[line].ends) {
      std::erase(at[end], line);
      if (at[end].size() == 1) ends.push_back(end);
    }
  }
}

std::int32_t group_of(const MshMesh& mesh, std::int32_t region) {
  return mesh.regions[static_cast<std::size_t>(region)].group;
}

}  // namespace

std::vector<MshCurve> curves_of_plane(const MshMesh& mesh, const std::vector<MshPoint>& points) {
  require_plane(mesh);
  const std::vector<MshFacet> facets = facets_of(mesh, 2);
  std::vector<MshLine> lines;
  for (const MshFacet& facet : facets)
    lines.push_back(
        {{facet.corners[0], facet.corners[1]}, facet.tag, facet.sides == MshSides::both_inside});
  find_open_chains(facets, lines);
  return CurveFinder(lines, points).find();
}

std::vector<MshCurve> curves_in_groups(const MshMesh& mesh) {
  const MshCells& cells = mesh.of(MshShape::line);
  std::vector<MshLine> lines;
  for (std::size_t e = 0; e < cells.count(); ++e)
    if (const std::int32_t group = group_of(mesh, cells.regions[e]))
      lines.push_back({{cells.corners[2 * e], cells.corners[2 * e + 1]}, group, true});
  return CurveFinder(lines, {}).find();
}

std::vector<MshPoint> points_in_groups(const MshMesh& mesh) {
  const MshCells& cells = mesh.of(MshShape::point);
  std::vector<MshPoint> points;
  for (std::size_t e = 0; e < cells.count(); ++e)
    if (const std::int32_t group = group_of(mesh, cells.regions[e]))
      points.push_back({cells.corners[e], group});
  return points;
}

namespace {

// An element that fills the domain.
struct Element {
  Point<3> middle;
  double size;  // proportional to its area or volume
  std::int32_t group;
};

// A side of an element.
struct Side {
  Key key;
  std::int64_t element;
};

// The parts of a mesh: connected sets of elements in one physical group that no facet of the mesh
// divides.
class Parts {
 public:
  Parts(const MshMesh& mesh, int dimension) : mesh_(mesh), dimension_(dimension) {
    for_cells(mesh, dimension,
              [&](MshShape shape, std::span<const std::int32_t> corners, std::size_t region) {
                add(shape, corners, mesh.regions[region].group);
              });
  }

  bool has_several_groups() const {
    std::set<std::int32_t> groups;
    for (const MshRegion& region : mesh_.regions)
      if (region.dimension == dimension_) groups.insert(region.group);
    return groups.size() > 1;
  }

  std::vector<MshRegionPoint> points() {
    UnionFind<std::int64_t> part(elements_.size());
    join_across_sides(part);
    // Take the midpoint of the largest element, so that the point is far from the sides of the
    // part.
    std::vector<std::int64_t> largest(elements_.size(), -1);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      std::int64_t& best =
          largest[static_cast<std::size_t>(part.root(static_cast<std::int64_t>(e)))];
      if (best < 0 || elements_[e].size > elements_[static_cast<std::size_t>(best)].size)
        best = static_cast<std::int64_t>(e);
    }
    std::vector<MshRegionPoint> points;
    for (const std::int64_t e : largest) {
      if (e < 0) continue;
      const Element& element = elements_[static_cast<std::size_t>(e)];
      if (element.group != 0 && element.size > 0)
        points.push_back({element.middle, element.group, name_of(element.group)});
    }
    return points;
  }

 private:
  void add(MshShape shape, std::span<const std::int32_t> corners, std::int32_t group) {
    Element element{{}, 0, group};
    for (const std::int32_t node : corners)
      for (std::size_t k = 0; k < 3; ++k)
        element.middle[k] += position(node)[k] / static_cast<double>(corners.size());
    for (const std::array<int, 4>& side : sides_of(shape)) {
      Key nodes{kNone, kNone, kNone, kNone};
      for (std::size_t k = 0; k < 4; ++k)
        if (side[k] >= 0) nodes[k] = corners[static_cast<std::size_t>(side[k])];
      element.size += size_over(nodes, element.middle);
      sides_.push_back({key_of(nodes), std::ssize(elements_)});
    }
    elements_.push_back(element);
  }

  const Point<3>& position(std::int32_t node) const {
    return mesh_.nodes[static_cast<std::size_t>(node)];
  }

  // Returns the size of the triangle or pyramid between the side and the midpoint, up to a factor.
  double size_over(const Key& side, const Point<3>& middle) const {
    const Point<3> a = difference(position(side[0]), middle),
                   b = difference(position(side[1]), middle);
    const Point<3> normal = cross(a, b);
    if (dimension_ == 2) return std::abs(normal[2]);
    double size = 0;
    for (std::int32_t k = 2; k < count_of(side); ++k)
      size += std::abs(
          dot(cross(a, difference(position(side[static_cast<std::size_t>(k) - 1]), middle)),
              difference(position(side[static_cast<std::size_t>(k)]), middle)));
    return size;
  }

  // Joins elements of one group across common sides, except where the side is a facet of the mesh.
  void join_across_sides(UnionFind<std::int64_t>& part) {
    std::set<Key> facets;
    for_cells(mesh_, dimension_ - 1,
              [&](MshShape, std::span<const std::int32_t> corners, std::size_t) {
                Key all{kNone, kNone, kNone, kNone};
                std::copy(corners.begin(), corners.end(), all.begin());
                facets.insert(key_of(all));
              });
    std::stable_sort(sides_.begin(), sides_.end(),
                     [](const Side& a, const Side& b) { return a.key < b.key; });
    for (std::size_t s = 1; s < sides_.size(); ++s) {
      const std::int64_t one = sides_[s - 1].element, other = sides_[s].element;
      if (sides_[s - 1].key == sides_[s].key && group_of(one) == group_of(other) &&
          !facets.contains(sides_[s].key))
        part.join(one, other);
    }
  }

  std::int32_t group_of(std::int64_t element) const {
    return elements_[static_cast<std::size_t>(element)].group;
  }

  std::string name_of(std::int32_t group) const {
    const std::string* name = mesh_.names.find({dimension_, group});
    return "the group " + (name ? "'" + *name + "'" : std::to_string(group));
  }

  const MshMesh& mesh_;
  int dimension_;
  std::vector<Element> elements_;
  std::vector<Side> sides_;
};

}  // namespace

std::vector<MshRegionPoint> region_points_of(const MshMesh& mesh, int dimension) {
  Parts parts(mesh, dimension);
  if (!parts.has_several_groups()) return {};
  return parts.points();
}

}  // namespace pnpbs
