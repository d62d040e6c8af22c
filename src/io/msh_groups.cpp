// SPDX-License-Identifier: BSD-3-Clause
#include "io/msh_groups.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs::io {

namespace {

constexpr std::size_t kLongestName = 127;  // limit of Gmsh

// Returns the name in quotation marks, without characters that Gmsh cannot read.
std::string quoted_name(const std::string& name) {
  std::string text = name.substr(0, kLongestName);
  for (char& c : text) {
    if (c == '"') c = '\'';
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return '"' + text + '"';
}

// Returns the name of the tag of facets. For nodes without elements, a name of the tag in any
// dimension is used as well.
std::string name_of(const Contents& all, std::int32_t tag) {
  if (tag == 0) return "inner";
  std::vector<int> dimensions{all.dimension - 1};
  if (!all.with_elements) dimensions.insert(dimensions.end(), {0, 1, 2, 3});
  for (const int dimension : dimensions)
    if (const std::string* name = all.names ? all.names->find({dimension, tag}) : nullptr)
      return *name;
  return name_of_tag(tag);
}

std::string name_of_region(const Contents& all, std::int32_t tag) {
  const std::string* name = all.names ? all.names->find({all.dimension, tag}) : nullptr;
  return name ? *name : "region_" + std::to_string(tag);
}

bool has_number(const std::vector<MshGroup>& groups, std::int64_t number) {
  return std::ranges::find(groups, number, &MshGroup::number) != groups.end();
}

// Returns groups with positive numbers. `name_of` maps a tag to a name.
template <class NameOf>
std::vector<MshGroup> numbered_groups(int dimension, const std::vector<TagGroup>& tags,
                                      const NameOf& name_of) {
  std::vector<MshGroup> groups;
  std::int64_t free = 1;
  for (const TagGroup& tag : tags) free = std::max<std::int64_t>(free, tag.tag + std::int64_t{1});
  for (const TagGroup& tag : tags)
    groups.push_back({dimension, tag.tag > 0 ? tag.tag : free++, name_of(tag.tag), tag});
  return groups;
}

void write_numbers(const std::array<double, 3>& numbers, Sink& sink) {
  for (const double number : numbers) {
    sink.text(" ");
    sink.number(number);
  }
}

}  // namespace

std::vector<MshGroup> tagged_groups(const Contents& all, const std::vector<TagGroup>& tags) {
  return numbered_groups(all.with_elements ? all.dimension - 1 : 0, tags,
                         [&](std::int32_t tag) { return name_of(all, tag); });
}

std::vector<MshGroup> region_groups(const Contents& all, std::vector<TagGroup> tags) {
  std::erase_if(tags, [](const TagGroup& group) { return group.tag == 0; });
  return numbered_groups(all.dimension, tags,
                         [&](std::int32_t tag) { return name_of_region(all, tag); });
}

MshGroup inside_group(const Contents& all, const std::vector<MshGroup>& regions) {
  MshGroup inside{all.dimension, 1, "domain", {}};
  std::int64_t named = 0;
  if (all.names)
    for (const auto& [group, name] : all.names->all()) {
      if (group.dimension != all.dimension || group.tag < 1 || group_of(regions, group.tag))
        continue;
      if (named++ == 0) {
        inside.number = group.tag;
        inside.name = name;
      }
    }
  if (named > 1) inside = {all.dimension, 1, "domain", {}};
  while (has_number(regions, inside.number)) ++inside.number;
  return inside;
}

const MshGroup* group_of(const std::vector<MshGroup>& groups, std::int32_t tag) {
  const auto found = std::ranges::lower_bound(groups, tag, {},
                                              [](const MshGroup& group) { return group.rows.tag; });
  return found == groups.end() || found->rows.tag != tag ? nullptr : &*found;
}

MshGroups msh_groups(const NodeSource& nodes) {
  const Contents& all = nodes.contents();
  MshGroups groups;
  groups.tagged =
      tagged_groups(all, all.with_elements ? nodes.facet_groups() : nodes.node_groups());
  const std::vector<TagGroup> regions = nodes.region_groups();
  groups.regions = region_groups(all, regions);
  groups.inside = inside_group(all, groups.regions);
  groups.inside.rows.count = all.elements;
  for (const MshGroup& region : groups.regions) groups.inside.rows.count -= region.rows.count;
  return groups;
}

std::string physical_names(const std::vector<const MshGroup*>& groups) {
  std::string text = "$PhysicalNames\n" + std::to_string(groups.size()) + "\n";
  for (const MshGroup* group : groups)
    text += std::to_string(group->dimension) + " " + std::to_string(group->number) + " " +
            quoted_name(group->name) + "\n";
  return text + "$EndPhysicalNames\n";
}

void write_entity(const std::string& head, const MshGroup& group, bool is_physical, Sink& sink) {
  sink.text(head);
  write_numbers(group.rows.low, sink);
  if (group.dimension > 0) write_numbers(group.rows.high, sink);
  sink.text(is_physical ? " 1 " : " 0");
  if (is_physical) sink.number(group.number);
  sink.text(group.dimension > 0 ? " 0\n" : "\n");
}

}  // namespace pnpbs::io
