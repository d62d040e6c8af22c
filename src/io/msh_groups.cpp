// SPDX-License-Identifier: BSD-3-Clause
#include "io/msh_groups.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs::io {

namespace {

constexpr std::size_t kLongestName = 127;  // Gmsh's

// In quotation marks, as Gmsh can read it.
std::string quoted_name(const std::string& name) {
  std::string text = name.substr(0, kLongestName);
  for (char& c : text) {
    if (c == '"') c = '\'';
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return '"' + text + '"';
}

// That of facets with this tag or, for nodes alone, of whatever else has it.
std::string name_of(const Contents& all, std::int32_t tag) {
  if (tag == 0) return "inner";
  std::vector<int> dimensions{all.dimension - 1};
  if (!all.with_elements) dimensions.insert(dimensions.end(), {0, 1, 2, 3});
  for (const int dimension : dimensions)
    if (const std::string* name = all.names ? all.names->find({dimension, tag}) : nullptr)
      return *name;
  return name_of_tag(tag);
}

MshGroup inside_of(const Contents& all) {
  MshGroup inside{all.dimension, 1, "domain", {}};
  std::int64_t named = 0;
  if (all.names)
    for (const auto& [group, name] : all.names->all()) {
      if (group.dimension != all.dimension || group.tag < 1) continue;
      if (named++ == 0) {
        inside.number = group.tag;
        inside.name = name;
      }
    }
  return named > 1 ? MshGroup{all.dimension, 1, "domain", {}} : inside;
}

}  // namespace

const MshGroup* MshGroups::of(std::int32_t tag) const {
  const auto found = std::ranges::lower_bound(tagged, tag, {},
                                              [](const MshGroup& group) { return group.rows.tag; });
  return found == tagged.end() || found->rows.tag != tag ? nullptr : &*found;
}

MshGroups msh_groups(const NodeSource& nodes) {
  const Contents& all = nodes.contents();
  const int dimension = all.with_elements ? all.dimension - 1 : 0;
  MshGroups groups{{}, inside_of(all)};
  const std::vector<TagGroup> tags = all.with_elements ? nodes.facet_groups() : nodes.node_groups();
  std::int64_t free = 1;
  for (const TagGroup& tag : tags) free = std::max<std::int64_t>(free, tag.tag + std::int64_t{1});
  for (const TagGroup& tag : tags)
    groups.tagged.push_back(
        {dimension, tag.tag > 0 ? tag.tag : free++, name_of(all, tag.tag), tag});
  return groups;
}

void append_physical_names(const std::vector<const MshGroup*>& groups, SharedFile& file) {
  std::string text = "$PhysicalNames\n" + std::to_string(groups.size()) + "\n";
  for (const MshGroup* group : groups)
    text += std::to_string(group->dimension) + " " + std::to_string(group->number) + " " +
            quoted_name(group->name) + "\n";
  file.append_text(text + "$EndPhysicalNames\n");
}

}  // namespace pnpbs::io
