// SPDX-License-Identifier: BSD-3-Clause
// Gmsh's format 4.1, as text: the one that Gmsh writes itself. The facets of each tag are an entity
// and a physical group, and so is the inside; a node belongs to the entity of its tag, or to the
// inside where no facet has its tag. Without elements the nodes of each tag are points of a group.
// All are numbered from 1, in the order of ids or corners.
#include <algorithm>
#include <vector>

#include "io/msh_data.hpp"
#include "io/msh_groups.hpp"
#include "io/numbered_rows.hpp"
#include "io/rows_by_tag.hpp"

namespace pnpbs::io {
namespace {

enum Type { line = 1, triangle = 2, tetrahedron = 4, point = 15 };

struct HeldNode {
  std::int32_t tag;
  std::int64_t number;
  std::array<double, 3> x;
};

struct HeldFacet {
  std::int32_t tag;
  std::int64_t number;
  std::array<std::int64_t, 3> corners;
};

class Writer {
 public:
  Writer(const NodeSource& nodes, SharedFile& file)
      : nodes_(nodes),
        all_(nodes.contents()),
        file_(file),
        groups_(msh_groups(nodes)),
        node_data_(nodes) {}

  void write() {
    file_.append_text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    count_nodes();
    file_.append_text(physical_names(physical_groups()));
    write_entities();
    write_nodes();
    write_elements();
    node_data_.append(blocks_of_nodes(), file_);
  }

 private:
  bool has_inside_elements() const { return all_.with_elements && all_.elements > 0; }
  bool has_inside() const { return has_inside_elements() || inside_nodes_ > 0; }

  std::vector<const MshGroup*> physical_groups() const {
    std::vector<const MshGroup*> groups;
    for (const MshGroup& group : groups_.tagged) groups.push_back(&group);
    if (has_inside_elements()) groups.push_back(&groups_.inside);
    return groups;
  }

  // How many of them belong to each group, and the box around all.
  void count_nodes() {
    TagGroup& box = groups_.inside.rows;
    bool first = true;
    node_counts_.assign(groups_.tagged.size(), 0);
    for (const TagGroup& tag : nodes_.node_groups()) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = first ? tag.low[k] : std::min(box.low[k], tag.low[k]);
        box.high[k] = first ? tag.high[k] : std::max(box.high[k], tag.high[k]);
      }
      first = false;
      if (const MshGroup* group = groups_.of(tag.tag))
        node_counts_[index_of(group)] += tag.count;
      else
        inside_nodes_ += tag.count;
    }
  }

  std::size_t index_of(const MshGroup* group) const {
    return static_cast<std::size_t>(group - groups_.tagged.data());
  }

  // ------------------------------------------------------------ entities
  void write_entities() {
    std::array<std::size_t, 4> counts{};
    if (!groups_.tagged.empty())
      counts[static_cast<std::size_t>(groups_.tagged[0].dimension)] = groups_.tagged.size();
    if (has_inside()) ++counts[static_cast<std::size_t>(all_.dimension)];
    file_.append_text("$Entities\n");
    file_.append([&](Sink& sink) {
      if (!file_.is_first()) return;
      for (std::size_t d = 0; d < 4; ++d) {
        sink.number(counts[d]);
        sink.text(d < 3 ? " " : "\n");
      }
      for (const MshGroup& group : groups_.tagged)
        write_entity(std::to_string(group.number), group, true, sink);
      if (has_inside())
        write_entity(std::to_string(groups_.inside.number), groups_.inside, has_inside_elements(),
                     sink);
    });
    file_.append_text("$EndEntities\n");
  }

  // ------------------------------------------------------------ nodes
  void write_nodes() {
    hold_nodes();
    const std::string n = std::to_string(all_.nodes);
    auto blocks = std::ranges::count_if(node_counts_, [](std::int64_t count) { return count > 0; });
    if (inside_nodes_ > 0) ++blocks;
    file_.append_text("$Nodes\n" + std::to_string(blocks) + " " + n +
                      (all_.nodes > 0 ? " 1 " : " 0 ") + n + "\n");
    for (std::size_t g = 0; g < groups_.tagged.size(); ++g) {
      if (node_counts_[g] == 0) continue;
      begin_block(groups_.tagged[g], "0", node_counts_[g]);
      for_nodes_of(groups_.tagged[g], write_number);
      for_nodes_of(groups_.tagged[g], write_place);
    }
    if (inside_nodes_ > 0) {
      begin_block(groups_.inside, "0", inside_nodes_);
      for_inside_nodes(write_number);
      for_inside_nodes(write_place);
    }
    file_.append_text("$EndNodes\n");
  }

  static void write_number(const HeldNode& node, Sink& sink) {
    sink.number(node.number);
    sink.text("\n");
  }

  static void write_place(const HeldNode& node, Sink& sink) {
    for (std::size_t k = 0; k < 3; ++k) {
      sink.number(node.x[k]);
      sink.text(k < 2 ? " " : "\n");
    }
  }

  void begin_block(const MshGroup& group, const std::string& kind, std::int64_t count) {
    file_.append_text(std::to_string(group.dimension) + " " + std::to_string(group.number) + " " +
                      kind + " " + std::to_string(count) + "\n");
  }

  // Those inside, and without elements the inner ones, are too many to be kept.
  bool is_held(std::int32_t tag) const { return tag != 0 && groups_.of(tag); }

  HeldNode row(const NodeRows& rows, std::size_t i) const {
    const auto dimension = static_cast<std::size_t>(all_.dimension);
    HeldNode node{rows.tags[i], rows.first + static_cast<std::int64_t>(i) + 1, {}};
    for (std::size_t k = 0; k < dimension; ++k) node.x[k] = rows.x[dimension * i + k];
    return node;
  }

  std::int32_t block_of(std::int32_t tag) const {
    return is_held(tag) ? tag : NodeDataByBlock::kInside;
  }

  std::vector<std::int32_t> blocks_of_nodes() const {
    std::vector<std::int32_t> blocks;
    for (std::size_t g = 0; g < groups_.tagged.size(); ++g)
      if (node_counts_[g] > 0) blocks.push_back(block_of(groups_.tagged[g].rows.tag));
    if (inside_nodes_ > 0) blocks.push_back(NodeDataByBlock::kInside);
    return blocks;
  }

  void hold_nodes() {
    nodes_.for_nodes([&](const NodeRows& rows) {
      std::vector<HeldNode> held;
      std::vector<std::int32_t> blocks;
      for (std::size_t i = 0; i < rows.tags.size(); ++i) {
        blocks.push_back(block_of(rows.tags[i]));
        if (blocks.back() != NodeDataByBlock::kInside) held.push_back(row(rows, i));
      }
      node_data_.add_window(blocks);
      held_nodes_.add_window(std::move(held), file_.ranks());
    });
    held_nodes_.sort();
  }

  template <class Write>
  void for_nodes_of(const MshGroup& group, const Write& write) {
    if (group.rows.tag == 0)
      for_inside_nodes(write);
    else
      held_nodes_.append(group.rows.tag, file_, write);
  }

  template <class Write>
  void for_inside_nodes(const Write& write) {
    nodes_.for_nodes([&](const NodeRows& rows) {
      file_.append([&](Sink& sink) {
        for (std::size_t i = 0; i < rows.tags.size(); ++i)
          if (!is_held(rows.tags[i])) write(row(rows, i), sink);
      });
    });
  }

  // ------------------------------------------------------------ elements
  void write_elements() {
    const std::size_t blocks = groups_.tagged.size() + (has_inside_elements() ? 1 : 0);
    const std::int64_t count = all_.with_elements ? all_.facets + all_.elements : all_.nodes;
    const std::string n = std::to_string(count);
    file_.append_text("$Elements\n" + std::to_string(blocks) + " " + n +
                      (count > 0 ? " 1 " : " 0 ") + n + "\n");
    all_.with_elements ? write_facets() : write_points();
    if (has_inside_elements()) write_inside();
    file_.append_text("$EndElements\n");
  }

  void write_points() {
    for (const MshGroup& group : groups_.tagged) {
      begin_block(group, std::to_string(point), group.rows.count);
      for_nodes_of(group, [](const HeldNode& node, Sink& sink) {
        sink.number(node.number);
        sink.text(" ");
        sink.number(node.number);
        sink.text("\n");
      });
    }
  }

  void write_facets() {
    hold_facets();
    const auto corners = static_cast<std::size_t>(all_.facet_corners());
    for (const MshGroup& group : groups_.tagged) {
      begin_block(group, std::to_string(all_.dimension == 2 ? line : triangle), group.rows.count);
      held_facets_.append(group.rows.tag, file_, [&](const HeldFacet& facet, Sink& sink) {
        sink.number(facet.number);
        for (std::size_t k = 0; k < corners; ++k) {
          sink.text(" ");
          sink.number(facet.corners[k] + 1);
        }
        sink.text("\n");
      });
    }
  }

  void hold_facets() {
    const auto corners = static_cast<std::size_t>(all_.facet_corners());
    nodes_.for_facets([&](const FacetRows& rows) {
      std::vector<HeldFacet> held;
      for (std::size_t f = 0; f < rows.tags.size(); ++f) {
        held.push_back({rows.tags[f], rows.first + static_cast<std::int64_t>(f) + 1, {}});
        for (std::size_t k = 0; k < corners; ++k)
          held.back().corners[k] = rows.corners[corners * f + k];
      }
      held_facets_.add_window(std::move(held), file_.ranks());
    });
    held_facets_.sort();
  }

  void write_inside() {
    begin_block(groups_.inside, std::to_string(all_.dimension == 2 ? triangle : tetrahedron),
                all_.elements);
    nodes_.for_elements([&](const ElementRows& rows) {
      file_.append([&](Sink& sink) {
        std::int64_t number = all_.facets + rows.first;
        for (std::size_t e = 0; e < rows.quality.size(); ++e) {
          sink.number(++number);
          write_corners(rows.corners, e, all_.element_corners(), sink);
          sink.text("\n");
        }
      });
    });
  }

  const NodeSource& nodes_;
  const Contents& all_;
  SharedFile& file_;
  MshGroups groups_;
  std::vector<std::int64_t> node_counts_;  // of the groups
  std::int64_t inside_nodes_ = 0;          // of none of them
  RowsByTag<HeldNode> held_nodes_;
  RowsByTag<HeldFacet> held_facets_;
  NodeDataByBlock node_data_;
};

}  // namespace

void write_msh(const NodeSource& nodes, SharedFile& file) { Writer(nodes, file).write(); }

}  // namespace pnpbs::io
