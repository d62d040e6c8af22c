// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/solids.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/union_find.hpp"
#include "geometry/region_graph.hpp"
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
std::vector<char> in_closed_component(const Triangulation& part) {
  const SurfaceEdges edges(part);
  UnionFind<std::int32_t> components = connected_triangles(part, edges);
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

}  // namespace

// ------------------------------------------------------------------ the solids -----------------

Solids::Solids(const Triangulation& given) {
  std::vector<std::vector<std::int32_t>> of_source(given.sources.size());
  std::vector<std::tuple<std::array<std::int32_t, 3>, std::int32_t, std::int32_t, std::int32_t>>
      candidates;  // corners, source and tag, and the index of the triangle
  of_.resize(given.sources.size());
  for (std::size_t t = 0; t < given.triangles.size(); ++t) {
    const SurfaceTriangle& triangle = given.triangles[t];
    std::vector<Membership>& of = of_[index(triangle.source)];
    of.resize(std::max(of.size(), index(triangle.number) + 1));
    if (triangle.inner && !triangle.by_place && !triangle.dividing) continue;
    std::array<std::int32_t, 3> corners = triangle.vertices;
    std::sort(corners.begin(), corners.end());
    candidates.emplace_back(corners, triangle.source, triangle.tag, static_cast<std::int32_t>(t));
  }
  std::sort(candidates.begin(), candidates.end());
  const auto group_of = [](const auto& it) {
    return std::tie(std::get<0>(it), std::get<1>(it), std::get<2>(it));
  };
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (i == 0 || group_of(candidates[i]) != group_of(candidates[i - 1]))
      of_source[index(std::get<1>(candidates[i]))].push_back(std::get<3>(candidates[i]));
  for (std::vector<std::int32_t>& triangles : of_source) std::ranges::sort(triangles);
  for (const std::vector<std::int32_t>& triangles : of_source) add_source(given, triangles);
}

// Adds the solids of one source, whose triangles these are.
void Solids::add_source(const Triangulation& given, const std::vector<std::int32_t>& triangles) {
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
  const std::vector<char> closed = in_closed_component(part_of(given, others));
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
    of_[index(triangle.source)][index(triangle.number)] = {
        solid, !same_turn(part.triangles[k].vertices, triangle.vertices)};
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

}  // namespace

// The change of what contains a point that goes through a triangle, from its front to its back.
struct Solids::Passage {
  Windings gained;                  // by solids that wind around their inside
  std::vector<std::int32_t> walls;  // solids that enclose their inside
};

std::vector<Solids::Passage> Solids::passages_through(
    const Triangulation& pieces, const std::vector<CoveredTriangle>& parts) const {
  std::vector<Passage> passages(pieces.triangles.size());
  for (const auto& [t, part] : parts) {
    const auto& [solid, given_turned] = membership(part);
    if (solid < 0) continue;
    Passage& passage = passages[index(t)];
    if (kinds_[index(solid)] == Kind::enclosing) {
      passage.walls.push_back(solid);
      continue;
    }
    const bool turned =
        same_turn(part.vertices, pieces.triangles[index(t)].vertices) == given_turned;
    add_winding(passage.gained, solid, turned ? -1 : 1);
  }
  return passages;
}

std::vector<char> Solids::ends_of_solids(const Triangulation& pieces,
                                         const std::vector<CoveredTriangle>& parts) const {
  std::vector<char> ends;
  for (const Passage& passage : passages_through(pieces, parts))
    ends.push_back(!passage.gained.empty() && passage.walls.empty());
  for (const auto& [t, part] : parts)
    if (membership(part).solid < 0) ends[index(t)] = 0;
  return ends;
}

std::vector<std::vector<std::int32_t>> Solids::around(const Triangulation& pieces,
                                                      const std::vector<CoveredTriangle>& parts,
                                                      const SurfaceRegions& regions) const {
  const std::vector<Passage> passages = passages_through(pieces, parts);
  std::vector<std::array<std::int32_t, 2>> sides;  // the regions in front and behind
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(passages.size()); ++t)
    sides.push_back({regions.front(t), regions.back(t)});
  const RegionGraph graph(index(regions.count()), sides);

  std::vector<Windings> windings(index(regions.count()));
  graph.reached([&](std::int32_t from, std::size_t t, std::int32_t next) {
    windings[index(next)] = windings[index(from)];
    for (const auto& [solid, gain] : passages[t].gained)
      add_winding(windings[index(next)], solid, next == sides[t][1] ? gain : -gain);
    return true;
  });
  for (std::size_t t = 0; t < passages.size(); ++t) {
    const auto& [front, back] = sides[t];
    if (front == back) continue;
    Windings difference = windings[index(front)];
    for (const auto& [solid, gain] : passages[t].gained) add_winding(difference, solid, gain);
    for (const auto& [solid, winding] : windings[index(back)])
      add_winding(difference, solid, -winding);
    if (!difference.empty())
      throw BrokenSurface("the triangles of " + name(difference.begin()->first) +
                          " do not separate its inside from its outside");
  }

  std::vector<std::vector<std::int32_t>> around(windings.size());
  for (std::size_t region = 0; region < around.size(); ++region)
    for (const auto& [solid, winding] : windings[region]) around[region].push_back(solid);
  for (std::int32_t solid = 0; solid < count(); ++solid) {
    if (kinds_[index(solid)] != Kind::enclosing) continue;
    const std::vector<char> outside = graph.reached([&](std::int32_t, std::size_t t, std::int32_t) {
      return std::ranges::find(passages[t].walls, solid) == passages[t].walls.end();
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
