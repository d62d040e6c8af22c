// SPDX-License-Identifier: BSD-3-Clause
// Physical groups of Gmsh's files: the facets of each tag, and the inside; or, without elements,
// the nodes of each tag.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/node_source.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

struct MshGroup {
  int dimension;
  std::int64_t number;  // of the group, and of its entity: positive
  std::string name;
  TagGroup rows;
};

struct MshGroups {
  std::vector<MshGroup> tagged;  // of facets, or of nodes; by tag
  MshGroup inside;

  const MshGroup* of(std::int32_t tag) const;  // nullptr if there is none
};

// Tags that are not positive, which Gmsh's groups must be, get numbers that are free. The inside is
// called as the domain's is, if that has one name. Collective.
MshGroups msh_groups(const NodeSource& nodes);

void append_physical_names(const std::vector<const MshGroup*>& groups, SharedFile& file);

}  // namespace pnpbs::io
