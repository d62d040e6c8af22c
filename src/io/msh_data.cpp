// SPDX-License-Identifier: BSD-3-Clause
#include "io/msh_data.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace pnpbs::io {

namespace {

// Returns the number of components in the file. Gmsh has scalars, vectors and tensors in space;
// missing components are written as 0.
std::int64_t components_of_gmsh(std::int64_t components) {
  return components == 1 ? 1 : components <= 3 ? 3 : 9;
}

std::size_t components_of(const Contents& all, std::size_t field) {
  return static_cast<std::size_t>((*all.fields)[field].components);
}

// Returns the head of the section: name, time, time step, number of components and number of rows.
std::string heading(const OutputField& field, std::int64_t nodes) {
  return "$NodeData\n1\n\"" + field.name + "\"\n1\n0\n3\n0\n" +
         std::to_string(components_of_gmsh(field.components)) + "\n" + std::to_string(nodes) + "\n";
}

// Writes the number of a node and its values.
void write_row(std::int64_t number, std::span<const double> values, Sink& sink) {
  const std::size_t components = values.size();
  const auto written = components_of_gmsh(static_cast<std::int64_t>(components));
  sink.number(number);
  for (std::size_t c = 0; c < static_cast<std::size_t>(written); ++c) {
    sink.text(" ");
    sink.number(c < components ? values[c] : 0.0);
  }
  sink.text("\n");
}

// The values of a node that is kept in memory.
struct BufferedValues {
  std::int32_t tag;
  std::int64_t number;
  std::array<double, 9> values;
};

// Calls visit(i, number, values) for each node of this rank in a window.
template <class Visit>
void for_rows(const FieldRows& rows, std::size_t components, const Visit& visit) {
  for (std::size_t i = 0; i * components < rows.values.size(); ++i)
    visit(i, rows.first + static_cast<std::int64_t>(i) + 1,
          std::span(rows.values).subspan(i * components, components));
}

// Appends the rows of nodes with wanted(place). `place` counts the nodes of this rank over all
// windows. Collective.
template <class Wanted>
void append_rows(const NodeSource& nodes, std::size_t field, const Wanted& wanted,
                 SharedFile& file) {
  const std::size_t components = components_of(nodes.contents(), field);
  std::size_t before = 0;  // nodes of earlier windows
  nodes.for_field(field, [&](const FieldRows& rows) {
    file.append([&](Sink& sink) {
      for_rows(rows, components, [&](std::size_t i, std::int64_t number, const auto& values) {
        if (wanted(before + i)) write_row(number, values, sink);
      });
    });
    before += rows.values.size() / components;
  });
}

// Appends the head and the end of each field around append_rows_of(field). Collective.
template <class AppendRows>
void append_fields(const Contents& all, SharedFile& file, const AppendRows& append_rows_of) {
  for (std::size_t k = 0; k < all.field_count(); ++k) {
    file.append_text(heading((*all.fields)[k], all.nodes));
    append_rows_of(k);
    file.append_text("$EndNodeData\n");
  }
}

}  // namespace

void append_node_data(const NodeSource& nodes, SharedFile& file) {
  append_fields(nodes.contents(), file, [&](std::size_t field) {
    append_rows(
        nodes, field, [](std::size_t) { return true; }, file);
  });
}

void NodeDataByBlock::add_window(const std::vector<std::int32_t>& blocks) {
  if (nodes_.contents().field_count() > 0)
    blocks_.insert(blocks_.end(), blocks.begin(), blocks.end());
}

void NodeDataByBlock::append(const std::vector<std::int32_t>& order, SharedFile& file) const {
  append_fields(nodes_.contents(), file,
                [&](std::size_t field) { append_field(field, order, file); });
}

void NodeDataByBlock::append_field(std::size_t field, const std::vector<std::int32_t>& order,
                                   SharedFile& file) const {
  const std::size_t components = components_of(nodes_.contents(), field);
  RowsByTag<BufferedValues> held;
  std::size_t before = 0;  // nodes of earlier windows
  nodes_.for_field(field, [&](const FieldRows& rows) {
    std::vector<BufferedValues> own;
    for_rows(rows, components, [&](std::size_t i, std::int64_t number, const auto& values) {
      if (blocks_[before + i] == kInside) return;
      own.push_back({blocks_[before + i], number, {}});
      std::ranges::copy(values, own.back().values.begin());
    });
    before += rows.values.size() / components;
    held.add_window(std::move(own), file.ranks());
  });
  held.sort();
  for (const std::int32_t block : order) {
    if (block == kInside)
      append_rows(
          nodes_, field, [&](std::size_t place) { return blocks_[place] == kInside; }, file);
    else
      held.append(block, file, [&](const BufferedValues& row, Sink& sink) {
        write_row(row.number, std::span(row.values).first(components), sink);
      });
  }
}

}  // namespace pnpbs::io
