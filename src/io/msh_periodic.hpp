// SPDX-License-Identifier: BSD-3-Clause
// The section $Periodic of Gmsh's files: the copies of nodes beside the cell of a periodic domain
// and their partners in the cell, those with the same periods between them in one link. Gmsh links
// entities of the dimension of facets: for the nodes of flat sides with tags of their own those of
// the facets, and for other links two without elements, since elements cross the sides of the cell.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/msh_data.hpp"
#include "io/msh_groups.hpp"

namespace pnpbs::io {

class MshPeriodic {
 public:
  // Reads the copies. The numbers of entities begin after those of `groups`. Collective.
  MshPeriodic(const NodeSource& nodes, const MshGroups& groups, SharedFile& file);

  // Returns the entities of the links, with the box.
  std::vector<MshGroup> entities(const TagGroup& box) const;
  // Appends the section in the format 2 or 4, or nothing without links. Collective.
  void append(int format, SharedFile& file) const;

 private:
  struct Pair {
    std::int32_t tag;  // index of the link
    std::int64_t number, partner;
  };
  struct Link {
    std::array<std::int32_t, 3> image;
    std::int64_t pairs = 0;
    std::array<std::int64_t, 2> entities{};  // of the copies and of their partners
    bool has_facets = false;
  };

  int dimension_;  // of the entities
  std::array<double, 3> periods_;
  std::vector<Link> links_;  // those with pairs, in the order of their images
  RowsByTag<Pair> pairs_;
};

}  // namespace pnpbs::io
