// SPDX-License-Identifier: BSD-3-Clause
// Writer of partitioned meshes in Gmsh's format 4.1 as text, with the layout that Gmsh uses for
// them. Elements and facets of each tag form an entity and a physical group (io/msh.cpp). The part
// of an entity on each rank is an entity of its own, with the same number in all files. A node is
// in the part of its tag and owner. All ghost elements are in a ghost entity. Nodes and elements
// have their numbers in the mesh, from 1. Facets have the numbers after those of all elements, and
// only the owner of a facet writes it.
#include "io/msh_parts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "io/msh_groups.hpp"
#include "io/output_file.hpp"
#include "io/tag_groups.hpp"

namespace pnpbs::io {
namespace {

enum MshKind { kMshFacets, kMshElements };

// The part of an entity that one rank owns.
struct EntityPart {
  MshKind kind;
  std::size_t group;
  std::int32_t owner;

  auto operator<=>(const EntityPart&) const = default;
};

// Indices of nodes, facets or elements of this rank, by part.
using RowsByPart = std::map<EntityPart, std::vector<std::int32_t>>;

// The file of one rank.
class MshPart {
 public:
  // Finds groups and numbers of all ranks. Collective.
  MshPart(const Communicator& comm, const DistributedMesh& mesh) : comm_(comm), mesh_(mesh) {
    find_groups();
    collect_rows();
    number_facets();
  }

  // Writes the file. Local.
  void write(Sink& sink) const {
    sink.text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    sink.text(physical_names(pointers_to_groups()));
    write_entities(sink);
    write_parts(sink);
    write_nodes(sink);
    write_elements(sink);
    if (has_ghosts()) write_ghosts(sink);
  }

 private:
  int dimension_of(MshKind kind) const { return mesh_.corners - (kind == kMshFacets ? 2 : 1); }
  int corners_of(MshKind kind) const { return mesh_.corners - (kind == kMshFacets ? 1 : 0); }
  const std::vector<std::int32_t>& nodes_of(MshKind kind) const {
    return kind == kMshFacets ? mesh_.facet_corners : mesh_.element_corners;
  }
  const std::vector<std::int32_t>& tags_of(MshKind kind) const {
    return kind == kMshFacets ? mesh_.facet_tags : mesh_.element_tags;
  }
  const std::vector<std::int32_t>& owners_of(MshKind kind) const {
    return kind == kMshFacets ? mesh_.facet_owners : mesh_.element_owners;
  }
  // Returns the index of the first ghost element. Indices fit into 32 bits, see
  // require_fits_rank().
  std::int32_t first_ghost() const { return static_cast<std::int32_t>(mesh_.owned_elements); }
  std::int32_t ghosts() const {
    return static_cast<std::int32_t>(mesh_.element_numbers.size()) - first_ghost();
  }
  bool has_ghosts() const { return ghosts() > 0; }

  Point<3> position(std::int32_t node) const {
    const auto dimension = static_cast<std::size_t>(mesh_.dimension);
    Point<3> x{};
    for (std::size_t k = 0; k < dimension; ++k)
      x[k] = mesh_.x[dimension * static_cast<std::size_t>(node) + k];
    return x;
  }

  // ------------------------------------------------------------ groups
  // Finds the groups of all ranks. Collective.
  void find_groups() {
    groups_[kMshFacets] = tagged_groups(contents(mesh_.corners - 1), boxes_by_tag(kMshFacets));
    if (mesh_.kind == GeometryKind::surface) {
      groups_[kMshElements] = tagged_groups(contents(mesh_.corners), boxes_by_tag(kMshElements));
    } else {
      find_regions();
    }
    for (const MshKind kind : {kMshFacets, kMshElements}) {
      for (const MshGroup& group : groups_[kind]) taken_[kind].push_back(group.number);
      std::ranges::sort(taken_[kind]);
    }
  }

  // Finds the groups of elements with tags, and of the other elements if there are any.
  void find_regions() {
    const std::vector<TagGroup> tags = boxes_by_tag(kMshElements);
    std::vector<MshGroup>& groups = groups_[kMshElements];
    groups = region_groups(contents(mesh_.dimension), tags);
    MshGroup inside = inside_group(contents(mesh_.dimension), groups);
    const auto rest = std::ranges::find(tags, 0, &TagGroup::tag);
    if (rest != tags.end()) inside.rows = *rest;
    if (rest != tags.end() || tags.empty()) groups.push_back(inside);
    std::ranges::sort(groups, {}, [](const MshGroup& group) { return group.rows.tag; });
  }

  // Returns contents with elements of this dimension, for the functions that build groups.
  Contents contents(int dimension) const {
    Contents all;
    all.dimension = dimension;
    all.with_elements = true;
    all.names = &mesh_.names;
    return all;
  }

  std::vector<TagGroup> boxes_by_tag(MshKind kind) const {
    TagGroups own;
    const auto n = static_cast<std::size_t>(corners_of(kind));
    std::vector<Point<3>> corners(n);
    for (std::size_t row = 0; row < tags_of(kind).size(); ++row) {
      if (owners_of(kind)[row] != comm_.rank()) continue;
      for (std::size_t k = 0; k < n; ++k) corners[k] = position(nodes_of(kind)[n * row + k]);
      own.add(tags_of(kind)[row], corners);
    }
    return own.of_all(comm_);
  }

  std::vector<const MshGroup*> pointers_to_groups() const {
    std::vector<const MshGroup*> pointers;
    for (const MshKind kind : {kMshFacets, kMshElements})
      for (const MshGroup& group : groups_[kind]) pointers.push_back(&group);
    return pointers;
  }

  // ------------------------------------------------------------ rows by entity
  void collect_rows() {
    find_regions_of_nodes();
    for (std::size_t i = 0; i < mesh_.numbers.size(); ++i)
      node_rows_[part_of_node(i)].push_back(static_cast<std::int32_t>(i));
    for (const MshKind kind : {kMshFacets, kMshElements})
      for (std::size_t row = 0; row < tags_of(kind).size(); ++row)
        if (owners_of(kind)[row] == comm_.rank())
          rows_[part(kind, tags_of(kind)[row], comm_.rank())].push_back(
              static_cast<std::int32_t>(row));
    for (const RowsByPart* rows : {&node_rows_, &rows_})
      for (const auto& entry : *rows) parts_.push_back(entry.first);
    std::ranges::sort(parts_);
    parts_.erase(std::unique(parts_.begin(), parts_.end()), parts_.end());
  }

  // Returns the part of a row. `tag` must be that of a group.
  EntityPart part(MshKind kind, std::int32_t tag, std::int32_t owner) const {
    const std::vector<MshGroup>& groups = groups_[kind];
    return {kind, static_cast<std::size_t>(group_of(groups, tag) - groups.data()), owner};
  }

  // Assigns inner nodes to the region of one of their elements.
  void find_regions_of_nodes() {
    node_regions_.assign(mesh_.numbers.size(), 0);
    if (mesh_.kind == GeometryKind::surface) return;
    const auto n = static_cast<std::size_t>(mesh_.corners);
    for (std::size_t e = 0; e < mesh_.element_tags.size(); ++e)
      for (std::size_t k = n * e; k < n * (e + 1); ++k) {
        const auto node = static_cast<std::size_t>(mesh_.element_corners[k]);
        if (mesh_.tags[node] == 0) node_regions_[node] = mesh_.element_tags[e];
      }
  }

  // Returns the part of a node. A node whose tag no facet or element has belongs to the inside.
  EntityPart part_of_node(std::size_t i) const {
    const std::int32_t tag = mesh_.tags[i], owner = mesh_.owners[i];
    const std::int32_t tag_within = mesh_.kind == GeometryKind::surface ? tag : node_regions_[i];
    const bool within = group_of(groups_[kMshElements], tag_within) != nullptr;
    if (group_of(groups_[kMshFacets], tag) && !(within && mesh_.kind == GeometryKind::surface))
      return part(kMshFacets, tag, owner);
    return within ? part(kMshElements, tag_within, owner) : EntityPart{kMshElements, 0, owner};
  }

  void number_facets() {
    own_facets_ = std::ranges::count(mesh_.facet_owners, comm_.rank());
    first_facet_ = mesh_.all_elements + comm_.exclusive_scan(own_facets_);
  }

  // ------------------------------------------------------------ numbers of entities
  // Returns the free number of this index, counted from 0: a number from 1 that no group of this
  // kind has.
  std::int64_t free_number(MshKind kind, std::size_t index) const {
    std::int64_t number = static_cast<std::int64_t>(index) + 1;
    for (const std::int64_t taken : taken_[kind]) number += taken <= number;
    return number;
  }
  std::size_t ranks() const { return static_cast<std::size_t>(comm_.size()); }
  std::int64_t number_of(const EntityPart& part) const {
    return free_number(part.kind, part.group * ranks() + static_cast<std::size_t>(part.owner));
  }
  // Returns the number of the ghost entity, which comes after the parts of elements.
  std::int64_t ghost_entity() const {
    return free_number(kMshElements, groups_[kMshElements].size() * ranks() +
                                         static_cast<std::size_t>(comm_.rank()));
  }

  // ------------------------------------------------------------ sections
  // Writes the number of entities of each dimension.
  void write_counts(std::size_t of_facets, std::size_t of_elements, Sink& sink) const {
    for (int dimension = 0; dimension < 4; ++dimension) {
      sink.number(dimension == dimension_of(kMshFacets)     ? of_facets
                  : dimension == dimension_of(kMshElements) ? of_elements
                                                            : 0);
      sink.text(dimension < 3 ? " " : "\n");
    }
  }

  void write_entities(Sink& sink) const {
    sink.text("$Entities\n");
    write_counts(groups_[kMshFacets].size(), groups_[kMshElements].size(), sink);
    for (const MshGroup* group : pointers_to_groups())
      write_entity(std::to_string(group->number), *group, true, sink);
    sink.text("$EndEntities\n");
  }

  // Writes the parts on this rank, with the boxes of the whole entities.
  void write_parts(Sink& sink) const {
    const std::string partition = std::to_string(comm_.rank() + 1);
    sink.text("$PartitionedEntities\n" + std::to_string(comm_.size()) + "\n");
    if (has_ghosts())
      sink.text("1\n" + std::to_string(ghost_entity()) + " " + partition + "\n");
    else
      sink.text("0\n");
    const auto of_facets = static_cast<std::size_t>(std::ranges::count_if(
        parts_, [](const EntityPart& part) { return part.kind == kMshFacets; }));
    write_counts(of_facets, parts_.size() - of_facets, sink);
    for (const EntityPart& part : parts_) {
      const MshGroup& whole = groups_[part.kind][part.group];
      write_entity(std::to_string(number_of(part)) + " " + std::to_string(whole.dimension) + " " +
                       std::to_string(whole.number) + " 1 " + std::to_string(part.owner + 1),
                   whole, true, sink);
    }
    sink.text("$EndPartitionedEntities\n");
  }

  // Writes the numbers of blocks and rows, and the smallest and largest number.
  static void begin_section(const char* name, std::size_t blocks, std::size_t rows,
                            std::pair<std::int64_t, std::int64_t> range, Sink& sink) {
    sink.text(std::string("$") + name + "\n" + std::to_string(blocks) + " " + std::to_string(rows) +
              " " + std::to_string(range.first) + " " + std::to_string(range.second) + "\n");
  }

  // Writes the first line of a block. `type`: element type, or 0 for nodes.
  static void begin_block(int dimension, std::int64_t entity, int type, std::size_t rows,
                          Sink& sink) {
    sink.text(std::to_string(dimension) + " " + std::to_string(entity) + " " +
              std::to_string(type) + " " + std::to_string(rows) + "\n");
  }

  static std::pair<std::int64_t, std::int64_t> range_of(const std::vector<std::int64_t>& numbers) {
    if (numbers.empty()) return {0, 0};
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    return {*low + 1, *high + 1};
  }

  std::int64_t number_of_node(std::int32_t node) const {
    return mesh_.numbers[static_cast<std::size_t>(node)] + 1;
  }

  std::int64_t number_of_element(std::int32_t element) const {
    return mesh_.element_numbers[static_cast<std::size_t>(element)] + 1;
  }

  void write_nodes(Sink& sink) const {
    begin_section("Nodes", node_rows_.size(), mesh_.numbers.size(), range_of(mesh_.numbers), sink);
    for (const auto& [part, nodes] : node_rows_) {
      begin_block(dimension_of(part.kind), number_of(part), 0, nodes.size(), sink);
      for (const std::int32_t node : nodes) {
        sink.number(number_of_node(node));
        sink.text("\n");
      }
      for (const std::int32_t node : nodes) {
        const Point<3> x = position(node);
        for (std::size_t k = 0; k < 3; ++k) {
          sink.number(x[k]);
          sink.text(k < 2 ? " " : "\n");
        }
      }
    }
    sink.text("$EndNodes\n");
  }

  int type_of(MshKind kind) const {
    // Gmsh's types by corners: none, point, line, triangle, tetrahedron
    constexpr std::array<int, 5> kTypeByCorners{0, 15, 1, 2, 4};
    return kTypeByCorners[static_cast<std::size_t>(corners_of(kind))];
  }

  void write_elements(Sink& sink) const {
    auto range = range_of(mesh_.element_numbers);
    if (own_facets_ > 0) range.second = first_facet_ + own_facets_;
    begin_section("Elements", rows_.size() + (has_ghosts() ? 1 : 0),
                  static_cast<std::size_t>(own_facets_) + mesh_.element_numbers.size(), range,
                  sink);
    std::int64_t facet_number = first_facet_;
    for (const auto& [part, rows] : rows_) {
      begin_block(dimension_of(part.kind), number_of(part), type_of(part.kind), rows.size(), sink);
      for (const std::int32_t row : rows)
        write_row(part.kind, part.kind == kMshFacets ? ++facet_number : number_of_element(row), row,
                  sink);
    }
    if (has_ghosts()) {
      begin_block(dimension_of(kMshElements), ghost_entity(), type_of(kMshElements),
                  static_cast<std::size_t>(ghosts()), sink);
      for (std::int32_t e = first_ghost(); e < first_ghost() + ghosts(); ++e)
        write_row(kMshElements, number_of_element(e), e, sink);
    }
    sink.text("$EndElements\n");
  }

  void write_row(MshKind kind, std::int64_t number, std::int32_t row, Sink& sink) const {
    sink.number(number);
    const auto n = static_cast<std::size_t>(corners_of(kind));
    for (std::size_t k = 0; k < n; ++k) {
      sink.text(" ");
      sink.number(number_of_node(nodes_of(kind)[n * static_cast<std::size_t>(row) + k]));
    }
    sink.text("\n");
  }

  // Writes each ghost element with the partition that owns it and ours, which has it as a ghost.
  void write_ghosts(Sink& sink) const {
    sink.text("$GhostElements\n" + std::to_string(ghosts()) + "\n");
    const std::string ours = " 1 " + std::to_string(comm_.rank() + 1) + "\n";
    for (std::int32_t e = first_ghost(); e < first_ghost() + ghosts(); ++e) {
      sink.number(number_of_element(e));
      sink.text(" ");
      sink.number(mesh_.element_owners[static_cast<std::size_t>(e)] + 1);
      sink.text(ours);
    }
    sink.text("$EndGhostElements\n");
  }

  const Communicator& comm_;
  const DistributedMesh& mesh_;
  std::array<std::vector<MshGroup>, 2> groups_;     // by kind; sorted by tag
  std::array<std::vector<std::int64_t>, 2> taken_;  // numbers of the groups, sorted
  std::vector<std::int32_t> node_regions_;          // tag of the region of each node; 0: none
  RowsByPart node_rows_;
  RowsByPart rows_;                // elements and facets that this rank owns
  std::vector<EntityPart> parts_;  // parts with nodes, elements or facets
  std::int64_t own_facets_ = 0;
  std::int64_t first_facet_ = 0;  // number before that of this rank's first facet
};

}  // namespace

std::string msh_part_path(const std::string& prefix, int rank) {
  return prefix + "_" + std::to_string(rank + 1) + ".msh";
}

void write_msh_parts(const Communicator& comm, const DistributedMesh& mesh,
                     const std::string& prefix) {
  // If one rank fails in any step, all ranks throw.
  collective_try(comm, [&] {
    const MshPart part(comm, mesh);
    OutputFile file(msh_part_path(prefix, comm.rank()));
    file.check();
    file.write([&](Sink& sink) { part.write(sink); }, {});
    publish_together({&file},
                     [&](const std::function<void()>& step) { collective_try(comm, step); });
  });
}

}  // namespace pnpbs::io
