// SPDX-License-Identifier: BSD-3-Clause
// Physical groups of Gmsh's files: the facets of each tag, the elements of each tagged region and
// the remaining elements; or, without elements, the nodes of each tag.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/node_source.hpp"
#include "io/sink.hpp"

namespace pnpbs::io {

// A physical group and the entity with the same number.
struct MshGroup {
  int dimension;
  std::int64_t number;  // positive
  std::string name;
  TagGroup rows;
};

// Returns the groups of facets or, without elements, of nodes. Gmsh requires positive numbers, so
// other tags get free ones.
std::vector<MshGroup> tagged_groups(const Contents& all, const std::vector<TagGroup>& tags);
// Returns the groups of elements in tagged regions.
std::vector<MshGroup> region_groups(const Contents& all, std::vector<TagGroup> tags);
// Returns the group of the elements outside these regions. It has the name of the domain if there
// is exactly one.
MshGroup inside_group(const Contents& all, const std::vector<MshGroup>& regions);
// Returns the group of this tag, or nullptr. The groups must be sorted by tag.
const MshGroup* group_of(const std::vector<MshGroup>& groups, std::int32_t tag);

// All groups of a file.
struct MshGroups {
  std::vector<MshGroup> tagged;   // of facets or nodes, sorted by tag
  std::vector<MshGroup> regions;  // sorted by tag
  MshGroup inside;                // its rows are the elements without region

  const MshGroup* of(std::int32_t tag) const { return group_of(tagged, tag); }
};

// Returns the groups of the nodes. Collective.
MshGroups msh_groups(const NodeSource& nodes);

// Returns the section $PhysicalNames.
std::string physical_names(const std::vector<const MshGroup*>& groups);

// Writes an entity: its bounding box, or the position of a point, and its physical group. Bounding
// entities are not listed. `head` has its number and, for a part of an entity, what precedes the
// box.
void write_entity(const std::string& head, const MshGroup& group, bool is_physical, Sink& sink);

}  // namespace pnpbs::io
