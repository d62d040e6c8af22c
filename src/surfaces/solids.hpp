// SPDX-License-Identifier: BSD-3-Clause
// The solids that surfaces describe, and which of them contain each of the regions into which the
// surfaces divide space once they are split where they meet.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "surfaces/arrangement.hpp"
#include "surfaces/nesting.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// The tag of the elements in a region that lies in several solids.
enum class OverlapRule {
  last,   // that of the solid given last
  first,  // that of the solid given first
  own     // one for each combination of solids, after those of the solids
};

// The solids of a triangulation before it is split. Each closed group of a source, which are its
// triangles with one tag, is a solid: it contains the points around which it winds. The closed
// components of the other triangles of a source form one solid together. Its remaining triangles
// enclose a further solid. Triangles with the role inner belong to none, and of several triangles
// of a group with the same vertices only the first does.
class Solids {
 public:
  // Edges with an odd number of triangles of a group make it open.
  explicit Solids(const Triangulation& given);

  std::int32_t count() const { return static_cast<std::int32_t>(names_.size()); }
  // Returns a name for messages, such as "box 0" or "surface 0 'lower'".
  const std::string& name(std::int32_t solid) const {
    return names_[static_cast<std::size_t>(solid)];
  }

  // Returns the name that its group has in the file, or an empty string.
  const std::string& group_name(std::int32_t solid) const {
    return group_names_[static_cast<std::size_t>(solid)];
  }

  // Returns the solids that contain each region, in increasing order. `pieces` is the triangulation
  // of the regions. `parts` lists the parts of the given triangles with the piece that they lie on,
  // several where these lie on each other. They have the vertices of the piece in the order of the
  // given triangle. Throws Error(ErrorKind::domain) if the triangles of a solid do not separate its
  // inside from its outside.
  std::vector<std::vector<std::int32_t>> around(const Triangulation& pieces,
                                                const std::vector<CoveredTriangle>& parts,
                                                const SurfaceRegions& regions) const;

  // Returns 1 for each piece on which solids end or overlap themselves, and on which nothing else
  // lies, else 0. If the same solids contain both of its sides, parts of a solid overlap there.
  std::vector<char> ends_of_solids(const Triangulation& pieces,
                                   const std::vector<CoveredTriangle>& parts) const;

 private:
  enum class Kind : char {
    wound_around,  // contains the points around which its triangles wind
    enclosing      // contains what its triangles separate from the outside
  };

  // The solid of a triangle, and whether its orientation is the opposite of the neighbours'.
  struct Membership {
    std::int32_t solid = -1;
    bool turned = false;
  };

  struct Passage;

  void add_source(const Triangulation& given, const std::vector<std::int32_t>& triangles);
  std::vector<Passage> passages_through(const Triangulation& pieces,
                                        const std::vector<CoveredTriangle>& parts) const;
  void add_solid(const Triangulation& given, const std::vector<std::int32_t>& triangles, Kind kind,
                 std::string name, std::string group_name);
  const Membership& membership(const SurfaceTriangle& triangle) const {
    return of_[static_cast<std::size_t>(triangle.source)]
              [static_cast<std::size_t>(triangle.number)];
  }

  std::vector<std::string> names_, group_names_;
  std::vector<Kind> kinds_;
  std::vector<std::vector<Membership>> of_;  // per source and number of a triangle
};

// The tags of regions by the solids that contain them.
struct SolidTags {
  std::vector<std::int32_t> of_regions;            // 0 in no solid
  std::map<std::int32_t, std::int32_t> of_solids;  // those that contain a region: 1, 2, ...
};

SolidTags tags_by_solids(const std::vector<std::vector<std::int32_t>>& around, OverlapRule rule);

}  // namespace pnpbs
