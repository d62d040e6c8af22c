// SPDX-License-Identifier: BSD-3-Clause
#include "io/msh_data.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "io/rows_by_tag.hpp"

namespace pnpbs::io {

namespace {

// Gmsh knows scalars, vectors and tensors of space; what is missing is 0.
std::int64_t components_of_gmsh(std::int64_t components) {
  return components == 1 ? 1 : components <= 3 ? 3 : 9;
}

constexpr const char* kEnd = "$EndNodeData\n";

std::size_t components_of(const Contents& all, std::size_t field) {
  return static_cast<std::size_t>((*all.fields)[field].components);
}

// Its name, its time, and its time step, components and rows.
std::string heading(const OutputField& field, std::int64_t nodes) {
  return "$NodeData\n1\n\"" + field.name + "\"\n1\n0\n3\n0\n" +
         std::to_string(components_of_gmsh(field.components)) + "\n" + std::to_string(nodes) + "\n";
}

// The number of a node, and its values, as many as Gmsh has.
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

struct HeldValues {
  std::int32_t tag;
  std::int64_t number;
  std::array<double, 9> values;
};

// Calls visit(i, number, values) for each node in this rank's part of a window.
template <class Visit>
void for_rows(const FieldRows& rows, std::size_t components, const Visit& visit) {
  for (std::size_t i = 0; i * components < rows.values.size(); ++i)
    visit(i, rows.first + static_cast<std::int64_t>(i) + 1,
          std::span(rows.values).subspan(i * components, components));
}

}  // namespace

void append_node_data(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  for (std::size_t k = 0; k < all.field_count(); ++k) {
    file.append_text(heading((*all.fields)[k], all.nodes));
    nodes.for_field(k, [&](const FieldRows& rows) {
      file.append([&](Sink& sink) {
        for_rows(rows, components_of(all, k),
                 [&](std::size_t, std::int64_t number, std::span<const double> values) {
                   write_row(number, values, sink);
                 });
      });
    });
    file.append_text(kEnd);
  }
}

void NodeDataByBlock::add_window(const std::vector<std::int32_t>& blocks) {
  if (nodes_.contents().field_count() > 0)
    blocks_.insert(blocks_.end(), blocks.begin(), blocks.end());
}

void NodeDataByBlock::append(const std::vector<std::int32_t>& order, SharedFile& file) const {
  const Contents& all = nodes_.contents();
  for (std::size_t k = 0; k < all.field_count(); ++k) {
    file.append_text(heading((*all.fields)[k], all.nodes));
    append_field(k, order, file);
    file.append_text(kEnd);
  }
}

void NodeDataByBlock::append_field(std::size_t field, const std::vector<std::int32_t>& order,
                                   SharedFile& file) const {
  const std::size_t components = components_of(nodes_.contents(), field);
  RowsByTag<HeldValues> held;
  std::size_t before = 0;  // nodes of windows that have been
  nodes_.for_field(field, [&](const FieldRows& rows) {
    std::vector<HeldValues> own;
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
      append_inside(field, file);
    else
      held.append(block, file, [&](const HeldValues& row, Sink& sink) {
        write_row(row.number, std::span(row.values).first(components), sink);
      });
  }
}

void NodeDataByBlock::append_inside(std::size_t field, SharedFile& file) const {
  const std::size_t components = components_of(nodes_.contents(), field);
  std::size_t before = 0;
  nodes_.for_field(field, [&](const FieldRows& rows) {
    file.append([&](Sink& sink) {
      for_rows(rows, components, [&](std::size_t i, std::int64_t number, const auto& values) {
        if (blocks_[before + i] == kInside) write_row(number, values, sink);
      });
    });
    before += rows.values.size() / components;
  });
}

}  // namespace pnpbs::io
