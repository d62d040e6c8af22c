// SPDX-License-Identifier: BSD-3-Clause
// Physical groups of Gmsh's files: the facets of each tag, the elements of regions with each tag,
// and those of the rest of the inside; or, without elements, the nodes of each tag.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/node_source.hpp"
#include "io/sink.hpp"

namespace pnpbs::io {

struct MshGroup {
  int dimension;
  std::int64_t number;  // of the group, and of its entity: positive
  std::string name;
  TagGroup rows;
};

// Of facets, or of nodes without elements. Tags that are not positive, which Gmsh's groups must be,
// get numbers that are free.
std::vector<MshGroup> tagged_groups(const Contents& all, const std::vector<TagGroup>& tags);
// The same of elements in regions that have a tag.
std::vector<MshGroup> region_groups(const Contents& all, std::vector<TagGroup> tags);
// The inside without these regions: called as the domain's is, if that has one name.
MshGroup inside_group(const Contents& all, const std::vector<MshGroup>& regions);
// In groups by tag; nullptr if there is none.
const MshGroup* group_of(const std::vector<MshGroup>& groups, std::int32_t tag);

struct MshGroups {
  std::vector<MshGroup> tagged;   // of facets, or of nodes; by tag
  std::vector<MshGroup> regions;  // by tag
  MshGroup inside;                // its rows: elements without a region

  const MshGroup* of(std::int32_t tag) const { return group_of(tagged, tag); }
};

// Collective.
MshGroups msh_groups(const NodeSource& nodes);

// The section of the file.
std::string physical_names(const std::vector<const MshGroup*>& groups);

// Its box, of a point the place of that; its group; nothing of what bounds it. head: its number,
// and what stands before the box of a part of it.
void write_entity(const std::string& head, const MshGroup& group, bool is_physical, Sink& sink);

}  // namespace pnpbs::io
