// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/solids.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/union_find.hpp"
#include "surfaces/surface_edges.hpp"

namespace pnpbs {

namespace {

// Returns some triangles as a triangulation of their own, without positions of vertices.
Triangulation part_of(const Triangulation& given, const std::vector<std::int32_t>& triangles) {
  Triangulation part{given.sources, given.tag_names, {}, {}, {}};
  for (const std::int32_t t : triangles) part.triangles.push_back(given.triangles[index(t)]);
  return part;
}

bool is_closed_at(const SurfaceEdges& edges, std::size_t e) {
  return edges.sides(e).size() % 2 == 0;
}

bool is_closed(const SurfaceEdges& edges) {
  for (std::size_t e = 0; e < edges.count(); ++e)
    if (!is_closed_at(edges, e)) return false;
  return edges.count() > 0;
}

// Returns for each triangle whether its component, connected by edges, is closed.
std::vector<char> in_closed_component(const Triangulation& part, const SurfaceEdges& edges) {
  UnionFind<std::int32_t> components(part.triangles.size());
  for (std::size_t e = 0; e < edges.count(); ++e)
    for (const EdgeSide& side : edges.sides(e))
      components.join(edges.sides(e)[0].triangle, side.triangle);
  std::vector<char> closed(part.triangles.size(), 1);
  for (std::size_t e = 0; e < edges.count(); ++e)
    if (!is_closed_at(edges, e)) closed[index(components.root(edges.sides(e)[0].triangle))] = 0;
  for (std::size_t t = 0; t < closed.size(); ++t)
    closed[t] = closed[index(components.root(static_cast<std::int32_t>(t)))];
  return closed;
}

// Returns the name of the triangle's group in its file, or an empty string.
std::string group_name_of(const Triangulation& given, const SurfaceTriangle& triangle) {
  for (const auto& [tag, name] : given.tag_names[index(triangle.source)])
    if (tag == triangle.tag) return name;
  return "";
}

bool same_turn(const SurfaceTriangle& a, const SurfaceTriangle& b) {
  const auto at = std::find(b.vertices.begin(), b.vertices.end(), a.vertices[0]);
  return b.vertices[static_cast<std::size_t>(at - b.vertices.begin() + 1) % 3] == a.vertices[1];
}

}  // namespace

// ------------------------------------------------------------------ the solids -----------------

Solids::Solids(const Triangulation& given) {
  std::vector<std::vector<std::int32_t>> of_source(given.sources.size());
  std::set<std::tuple<std::int32_t, std::int32_t, std::array<std::int32_t, 3>>> met;
  of_.resize(given.sources.size());
  for (std::size_t t = 0; t < given.triangles.size(); ++t) {
    const SurfaceTriangle& triangle = given.triangles[t];
    std::vector<Membership>& of = of_[index(triangle.source)];
    of.resize(std::max(of.size(), index(triangle.number) + 1));
    if (triangle.inner && !triangle.by_place && !triangle.dividing) continue;
    std::array<std::int32_t, 3> corners = triangle.vertices;
    std::sort(corners.begin(), corners.end());
    if (met.emplace(triangle.source, triangle.tag, corners).second)
      of_source[index(triangle.source)].push_back(static_cast<std::int32_t>(t));
  }
  for (const std::vector<std::int32_t>& triangles : of_source) {
    std::map<std::int32_t, std::vector<std::int32_t>> groups;
    for (const std::int32_t t : triangles) groups[given.triangles[index(t)].tag].push_back(t);
    std::vector<std::int32_t> others;
    for (const auto& [tag, group] : groups) {
      if (groups.size() == 1 || !is_closed(SurfaceEdges(part_of(given, group)))) {
        others.insert(others.end(), group.begin(), group.end());
        continue;
      }
      const SurfaceTriangle& first = given.triangles[index(group[0])];
      const std::string& source = given.sources[index(first.source)];
      const std::string name = group_name_of(given, first);
      add_solid(given, group, Kind::wound_around,
                name.empty() ? source + ", tag " + std::to_string(tag) : source + " '" + name + "'",
                name);
    }
    std::sort(others.begin(), others.end());
    const Triangulation rest = part_of(given, others);
    const std::vector<char> closed = in_closed_component(rest, SurfaceEdges(rest));
    for (const Kind kind : {Kind::wound_around, Kind::enclosing}) {
      std::vector<std::int32_t> chosen;
      for (std::size_t k = 0; k < others.size(); ++k)
        if ((closed[k] != 0) == (kind == Kind::wound_around)) chosen.push_back(others[k]);
      if (chosen.empty()) continue;
      const SurfaceTriangle& first = given.triangles[index(chosen[0])];
      add_solid(given, chosen, kind, given.sources[index(first.source)],
                groups.size() == 1 ? group_name_of(given, first) : "");
    }
  }
}

void Solids::add_solid(const Triangulation& given, const std::vector<std::int32_t>& triangles,
                       Kind kind, std::string name, std::string group_name) {
  const auto solid = count();
  names_.push_back(std::move(name));
  group_names_.push_back(std::move(group_name));
  kinds_.push_back(kind);
  Triangulation part = part_of(given, triangles);
  if (kind == Kind::wound_around) {
    SurfaceEdges edges(part);
    std::vector<Warning> warnings;
    orient_surfaces(part, edges, OneSided::ignored, warnings);
  }
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const SurfaceTriangle& triangle = given.triangles[index(triangles[k])];
    of_[index(triangle.source)][index(triangle.number)] = {solid,
                                                           !same_turn(part.triangles[k], triangle)};
  }
}

// ------------------------------------------------------------------ the regions ----------------

namespace {

// How often solids wind around a region, by solid; those that do not are left out.
using Windings = std::map<std::int32_t, std::int32_t>;

void add_winding(Windings& windings, std::int32_t solid, std::int32_t by) {
  std::int32_t& winding = windings[solid];
  winding += by;
  if (winding == 0) windings.erase(solid);
}

// The way from the region in front of a triangle to the one behind it.
struct Passage {
  std::int32_t front, back;
  Windings gained;                  // by solids that wind around their inside
  std::vector<std::int32_t> walls;  // solids that enclose their inside
};

}  // namespace

std::vector<std::vector<std::int32_t>> Solids::around(const Triangulation& pieces,
                                                      const std::vector<CoveredTriangle>& parts,
                                                      const SurfaceRegions& regions) const {
  std::vector<Passage> passages(pieces.triangles.size());
  for (std::size_t t = 0; t < passages.size(); ++t) {
    passages[t].front = regions.front(static_cast<std::int32_t>(t));
    passages[t].back = regions.back(static_cast<std::int32_t>(t));
  }
  for (const auto& [t, part] : parts) {
    const auto& [solid, given_turned] = membership(part);
    if (solid < 0) continue;
    if (kinds_[index(solid)] == Kind::enclosing) {
      passages[index(t)].walls.push_back(solid);
      continue;
    }
    const bool turned = same_turn(part, pieces.triangles[index(t)]) == given_turned;
    add_winding(passages[index(t)].gained, solid, turned ? -1 : 1);
  }
  std::erase_if(passages, [](const Passage& passage) { return passage.front == passage.back; });

  std::vector<std::vector<std::size_t>> leaving(index(regions.count()));
  for (std::size_t p = 0; p < passages.size(); ++p) {
    leaving[index(passages[p].front)].push_back(p);
    leaving[index(passages[p].back)].push_back(p);
  }
  // Returns flags of the regions reached from the unbounded one. A region is reached through a
  // passage from another one, if enter(other, passage, region) is true.
  const auto search = [&](const auto& enter) {
    std::vector<char> reached(leaving.size(), 0);
    std::vector<std::int32_t> front{0};
    reached[0] = 1;
    for (std::size_t k = 0; k < front.size(); ++k)
      for (const std::size_t p : leaving[index(front[k])]) {
        const std::int32_t next =
            passages[p].front == front[k] ? passages[p].back : passages[p].front;
        if (reached[index(next)] != 0 || !enter(front[k], passages[p], next)) continue;
        reached[index(next)] = 1;
        front.push_back(next);
      }
    return reached;
  };

  std::vector<Windings> windings(leaving.size());
  search([&](std::int32_t from, const Passage& passage, std::int32_t next) {
    windings[index(next)] = windings[index(from)];
    for (const auto& [solid, gain] : passage.gained)
      add_winding(windings[index(next)], solid, next == passage.back ? gain : -gain);
    return true;
  });
  for (const Passage& passage : passages) {
    Windings difference = windings[index(passage.front)];
    for (const auto& [solid, gain] : passage.gained) add_winding(difference, solid, gain);
    for (const auto& [solid, winding] : windings[index(passage.back)])
      add_winding(difference, solid, -winding);
    if (!difference.empty())
      throw BrokenSurface("the triangles of " + name(difference.begin()->first) +
                          " do not separate its inside from its outside");
  }
  std::vector<std::vector<std::int32_t>> around(leaving.size());
  for (std::size_t region = 0; region < around.size(); ++region)
    for (const auto& [solid, winding] : windings[region]) around[region].push_back(solid);
  for (std::int32_t solid = 0; solid < count(); ++solid) {
    if (kinds_[index(solid)] != Kind::enclosing) continue;
    const std::vector<char> outside =
        search([&](std::int32_t, const Passage& passage, std::int32_t) {
          return std::ranges::find(passage.walls, solid) == passage.walls.end();
        });
    for (std::size_t region = 0; region < around.size(); ++region)
      if (outside[region] == 0) around[region].push_back(solid);
  }
  for (std::vector<std::int32_t>& solids : around) std::sort(solids.begin(), solids.end());
  return around;
}

SolidTags tags_by_solids(const std::vector<std::vector<std::int32_t>>& around, OverlapRule rule) {
  SolidTags tags;
  for (const std::vector<std::int32_t>& solids : around)
    for (const std::int32_t solid : solids) tags.of_solids.emplace(solid, 0);
  std::int32_t count = 0;
  for (auto& [solid, tag] : tags.of_solids) tag = ++count;
  std::map<std::vector<std::int32_t>, std::int32_t> overlaps;
  for (const std::vector<std::int32_t>& solids : around) {
    if (solids.empty()) {
      tags.of_regions.push_back(0);
    } else if (rule == OverlapRule::own && solids.size() > 1) {
      const auto next = count + 1 + static_cast<std::int32_t>(overlaps.size());
      tags.of_regions.push_back(overlaps.try_emplace(solids, next).first->second);
    } else {
      const std::int32_t solid = rule == OverlapRule::first ? solids.front() : solids.back();
      tags.of_regions.push_back(tags.of_solids.at(solid));
    }
  }
  return tags;
}

}  // namespace pnpbs
