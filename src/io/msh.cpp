// SPDX-License-Identifier: BSD-3-Clause
// Writer of Gmsh's format 4.1 as text. The facets of each tag form an entity and a physical group,
// as do the elements of each tagged region and the remaining elements ("inside"). A node belongs to
// the entity of its tag. If no facet has its tag, it belongs to that of its region or the inside.
// Without elements, the nodes of each tag are point elements of a group.
// Numbers start at 1, in the order of ids or corners.
#include <algorithm>
#include <vector>

#include "io/msh_data.hpp"
#include "io/msh_groups.hpp"
#include "io/msh_periodic.hpp"
#include "io/numbered_rows.hpp"

namespace pnpbs::io {
namespace {

enum Type {
  line = 1,
  triangle = 2,
  tetrahedron = 4,
  second_order_line = 8,
  second_order_triangle = 9,
  second_order_tetrahedron = 11,
  point = 15
};

// A node that is kept in memory until its block is written. Tags of nodes and cells are those of
// Writer::tag_of_block().
struct BufferedNode {
  std::int32_t tag;
  std::int64_t number;
  std::array<double, 3> x;
};

// A facet or element that is kept in memory.
struct BufferedCell {
  std::int32_t tag;
  std::int64_t number;
  std::size_t index;  // in the nodes of all cells that are kept
};

// The writer of one file.
class Writer {
 public:
  Writer(const NodeSource& nodes, SharedFile& file)
      : nodes_(nodes),
        all_(nodes.contents()),
        file_(file),
        groups_(msh_groups(nodes)),
        periodic_(nodes, groups_, file),
        node_data_(nodes) {}

  void write() {
    file_.append_text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    count_nodes();
    hold_nodes();
    file_.append_text(physical_names(physical_groups()));
    write_entities();
    write_nodes();
    write_elements();
    periodic_.append(4, file_);
    node_data_.append(blocks_of_nodes(), file_);
  }

 private:
  bool has_inside_elements() const { return all_.with_elements && groups_.inside.rows.count > 0; }
  bool has_inside() const { return has_inside_elements() || inside_nodes_ > 0; }

  std::vector<const MshGroup*> physical_groups() const {
    std::vector<const MshGroup*> groups;
    for (std::size_t g = 0; g < group_count(); ++g) groups.push_back(&group(g));
    if (has_inside_elements()) groups.push_back(&groups_.inside);
    return groups;
  }

  // ------------------------------------------------------------ blocks
  // Groups of tags come first, then groups of regions.
  std::size_t group_count() const { return groups_.tagged.size() + groups_.regions.size(); }
  const MshGroup& group(std::size_t g) const {
    const std::size_t tagged = groups_.tagged.size();
    return g < tagged ? groups_.tagged[g] : groups_.regions[g - tagged];
  }
  static std::int32_t tag_of_block(std::size_t g) { return static_cast<std::int32_t>(g) + 1; }

  // Returns the block of a node. kInside also stands for inner nodes in general, which are too many
  // to keep in memory and are streamed.
  std::int32_t block_of(const NodeRows& rows, std::size_t i) const {
    const MshGroup* tagged = groups_.of(rows.tags[i]);
    if (tagged)
      return rows.tags[i] == 0 ? NodeDataByBlock::kInside : tag_of_block(index_of(tagged));
    return all_.with_regions ? block_of_region(rows.regions[i]) : NodeDataByBlock::kInside;
  }

  std::int32_t block_of_region(std::int32_t region) const {
    const MshGroup* group = group_of(groups_.regions, region);
    if (!group) return NodeDataByBlock::kInside;
    return tag_of_block(groups_.tagged.size() +
                        static_cast<std::size_t>(group - groups_.regions.data()));
  }

  // Counts the nodes of each group and computes the bounding box of all nodes.
  void count_nodes() {
    TagGroup& box = groups_.inside.rows;
    bool first = true;
    node_counts_.assign(group_count(), 0);
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
    counts[static_cast<std::size_t>(all_.dimension)] = groups_.regions.size();
    if (!groups_.tagged.empty())
      counts[static_cast<std::size_t>(groups_.tagged[0].dimension)] = groups_.tagged.size();
    if (has_inside()) ++counts[static_cast<std::size_t>(all_.dimension)];
    const std::vector<MshGroup> links = periodic_.entities(groups_.inside.rows);
    counts[static_cast<std::size_t>(all_.dimension - 1)] += links.size();
    file_.append_text("$Entities\n");
    file_.append([&](Sink& sink) {
      if (!file_.is_first()) return;
      for (std::size_t d = 0; d < 4; ++d) {
        sink.number(counts[d]);
        sink.text(d < 3 ? " " : "\n");
      }
      for (std::size_t g = 0; g < group_count(); ++g) {
        if (g == groups_.tagged.size()) write_links(links, sink);
        write_entity(std::to_string(group(g).number), group(g), true, sink);
      }
      if (groups_.regions.empty()) write_links(links, sink);
      if (has_inside())
        write_entity(std::to_string(groups_.inside.number), groups_.inside, has_inside_elements(),
                     sink);
    });
    file_.append_text("$EndEntities\n");
  }

  static void write_links(const std::vector<MshGroup>& links, Sink& sink) {
    for (const MshGroup& link : links) write_entity(std::to_string(link.number), link, false, sink);
  }

  // ------------------------------------------------------------ nodes
  void write_nodes() {
    const std::string n = std::to_string(all_.nodes);
    auto blocks = std::ranges::count_if(node_counts_, [](std::int64_t count) { return count > 0; });
    if (inside_nodes_ > 0) ++blocks;
    file_.append_text("$Nodes\n" + std::to_string(blocks) + " " + n +
                      (all_.nodes > 0 ? " 1 " : " 0 ") + n + "\n");
    for (std::size_t g = 0; g < group_count(); ++g) {
      if (node_counts_[g] == 0) continue;
      begin_block(group(g), "0", node_counts_[g]);
      for_nodes_of(g, write_number);
      for_nodes_of(g, write_place);
    }
    if (inside_nodes_ > 0) {
      begin_block(groups_.inside, "0", inside_nodes_);
      for_inside_nodes(write_number);
      for_inside_nodes(write_place);
    }
    file_.append_text("$EndNodes\n");
  }

  static void write_number(const BufferedNode& node, Sink& sink) {
    sink.number(node.number);
    sink.text("\n");
  }

  static void write_place(const BufferedNode& node, Sink& sink) {
    for (std::size_t k = 0; k < 3; ++k) {
      sink.number(node.x[k]);
      sink.text(k < 2 ? " " : "\n");
    }
  }

  void begin_block(const MshGroup& group, const std::string& kind, std::int64_t count) {
    file_.append_text(std::to_string(group.dimension) + " " + std::to_string(group.number) + " " +
                      kind + " " + std::to_string(count) + "\n");
  }

  BufferedNode row(const NodeRows& rows, std::size_t i) const {
    const auto coordinates = static_cast<std::size_t>(all_.coordinates);
    BufferedNode node{block_of(rows, i), rows.first + static_cast<std::int64_t>(i) + 1, {}};
    for (std::size_t k = 0; k < coordinates; ++k) node.x[k] = rows.x[coordinates * i + k];
    return node;
  }

  bool is_streamed(std::size_t g) const {
    return g < groups_.tagged.size() && group(g).rows.tag == 0;
  }

  std::vector<std::int32_t> blocks_of_nodes() const {
    std::vector<std::int32_t> blocks;
    for (std::size_t g = 0; g < group_count(); ++g)
      if (node_counts_[g] > 0)
        blocks.push_back(is_streamed(g) ? NodeDataByBlock::kInside : tag_of_block(g));
    if (inside_nodes_ > 0) blocks.push_back(NodeDataByBlock::kInside);
    return blocks;
  }

  void hold_nodes() {
    std::vector<std::int64_t> of_regions(groups_.regions.size(), 0);
    nodes_.for_nodes([&](const NodeRows& rows) {
      std::vector<BufferedNode> held;
      std::vector<std::int32_t> blocks;
      for (std::size_t i = 0; i < rows.tags.size(); ++i) {
        blocks.push_back(block_of(rows, i));
        if (blocks.back() == NodeDataByBlock::kInside) continue;
        held.push_back(row(rows, i));
        const auto g = static_cast<std::size_t>(blocks.back() - 1);
        if (g >= groups_.tagged.size()) ++of_regions[g - groups_.tagged.size()];
      }
      node_data_.add_window(blocks);
      held_nodes_.add_window(std::move(held), file_.ranks());
    });
    held_nodes_.sort();
    if (!of_regions.empty()) count_nodes_of_regions(std::move(of_regions));
  }

  // Moves the counts of nodes in regions from the inside to their groups. Collective.
  void count_nodes_of_regions(std::vector<std::int64_t> counts) {
    file_.ranks().allreduce_sum(counts);
    for (std::size_t r = 0; r < counts.size(); ++r) {
      node_counts_[groups_.tagged.size() + r] = counts[r];
      inside_nodes_ -= counts[r];
    }
  }

  template <class Write>
  void for_nodes_of(std::size_t g, const Write& write) {
    if (is_streamed(g))
      for_inside_nodes(write);
    else
      held_nodes_.append(tag_of_block(g), file_, write);
  }

  template <class Write>
  void for_inside_nodes(const Write& write) {
    nodes_.for_nodes([&](const NodeRows& rows) {
      file_.append([&](Sink& sink) {
        for (std::size_t i = 0; i < rows.tags.size(); ++i)
          if (block_of(rows, i) == NodeDataByBlock::kInside) write(row(rows, i), sink);
      });
    });
  }

  // ------------------------------------------------------------ elements
  void write_elements() {
    const std::size_t blocks = group_count() + (has_inside_elements() ? 1 : 0);
    const std::int64_t count = all_.with_elements ? all_.facets + all_.elements : all_.nodes;
    const std::string n = std::to_string(count);
    file_.append_text("$Elements\n" + std::to_string(blocks) + " " + n +
                      (count > 0 ? " 1 " : " 0 ") + n + "\n");
    all_.with_elements ? write_facets() : write_points();
    if (!groups_.regions.empty()) write_regions();
    if (has_inside_elements()) write_inside();
    file_.append_text("$EndElements\n");
  }

  void write_points() {
    for (std::size_t g = 0; g < groups_.tagged.size(); ++g) {
      begin_block(group(g), std::to_string(point), group(g).rows.count);
      for_nodes_of(g, [](const BufferedNode& node, Sink& sink) {
        sink.number(node.number);
        sink.text(" ");
        sink.number(node.number);
        sink.text("\n");
      });
    }
  }

  void write_facets() {
    RowsByTag<BufferedCell> facets;
    cell_nodes_.clear();
    nodes_.for_facets([&](const FacetRows& rows) {
      std::vector<BufferedCell> held;
      for (std::size_t f = 0; f < rows.tags.size(); ++f)
        held.push_back(
            cell(tag_of_block(index_of(groups_.of(rows.tags[f]))), rows, all_.facet_nodes(), f));
      facets.add_window(std::move(held), file_.ranks());
    });
    facets.sort();
    for (std::size_t g = 0; g < groups_.tagged.size(); ++g)
      write_cells(g, all_.facet_nodes(), facets);
  }

  // Keeps the elements of regions in memory, because one pass over all elements for each region
  // could be slow.
  void write_regions() {
    RowsByTag<BufferedCell> elements;
    cell_nodes_.clear();
    nodes_.for_elements([&](const ElementRows& rows) {
      std::vector<BufferedCell> held;
      for (std::size_t e = 0; e < rows.regions.size(); ++e) {
        const std::int32_t block = block_of_region(rows.regions[e]);
        if (block == NodeDataByBlock::kInside) continue;
        held.push_back(cell(block, rows, all_.element_nodes(), e));
        held.back().number += all_.facets;
      }
      elements.add_window(std::move(held), file_.ranks());
    });
    elements.sort();
    for (std::size_t g = groups_.tagged.size(); g < group_count(); ++g)
      write_cells(g, all_.element_nodes(), elements);
  }

  // Keeps the nodes of facet or element i of the rows.
  template <class Rows>
  BufferedCell cell(std::int32_t block, const Rows& rows, int nodes, std::size_t i) {
    const auto n = static_cast<std::size_t>(nodes);
    const BufferedCell cell{block, rows.first + static_cast<std::int64_t>(i) + 1,
                            cell_nodes_.size() / n};
    const auto first = rows.nodes.begin() + static_cast<std::ptrdiff_t>(n * i);
    cell_nodes_.insert(cell_nodes_.end(), first, first + nodes);
    return cell;
  }

  void write_cells(std::size_t g, int nodes, const RowsByTag<BufferedCell>& cells) {
    begin_block(group(g), std::to_string(type_of(nodes)), group(g).rows.count);
    cells.append(tag_of_block(g), file_, [&](const BufferedCell& cell, Sink& sink) {
      sink.number(cell.number);
      write_msh_nodes(cell_nodes_, cell.index, nodes, sink);
      sink.text("\n");
    });
  }

  // Returns the type of facets and elements with so many nodes.
  Type type_of(int nodes) const {
    if (all_.order == 2)
      return nodes == 3   ? second_order_line
             : nodes == 6 ? second_order_triangle
                          : second_order_tetrahedron;
    return nodes == 2 ? line : nodes == 3 ? triangle : tetrahedron;
  }

  void write_inside() {
    begin_block(groups_.inside, std::to_string(type_of(all_.element_nodes())),
                groups_.inside.rows.count);
    nodes_.for_elements([&](const ElementRows& rows) {
      file_.append([&](Sink& sink) {
        std::int64_t number = all_.facets + rows.first;
        for (std::size_t e = 0; e < rows.quality.size(); ++e) {
          ++number;
          if (all_.with_regions && rows.regions[e] != 0) continue;
          sink.number(number);
          write_msh_nodes(rows.nodes, e, all_.element_nodes(), sink);
          sink.text("\n");
        }
      });
    });
  }

  const NodeSource& nodes_;
  const Contents& all_;
  SharedFile& file_;
  MshGroups groups_;
  MshPeriodic periodic_;
  std::vector<std::int64_t> node_counts_;  // nodes of each group
  std::int64_t inside_nodes_ = 0;          // nodes of no group
  RowsByTag<BufferedNode> held_nodes_;
  std::vector<std::int64_t> cell_nodes_;  // of the facets or elements that are kept in memory
  NodeDataByBlock node_data_;
};

}  // namespace

void write_msh(const NodeSource& nodes, SharedFile& file) { Writer(nodes, file).write(); }

}  // namespace pnpbs::io
