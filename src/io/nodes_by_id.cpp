// SPDX-License-Identifier: BSD-3-Clause
#include "io/nodes_by_id.hpp"

#include <algorithm>
#include <ranges>
#include <tuple>

#include "comm/records.hpp"
#include "io/rows.hpp"

namespace pnpbs::io {

namespace {

struct NodeRow {
  std::int64_t id;
  double x[2], d;
  std::int64_t tag;
};

// Nodes by their labels: see NodesById::label.
struct TriangleRow {
  std::int64_t corners[3];  // the least first
  double quality;
};

struct EdgeRow {
  std::int64_t ends[2];
  std::int64_t tag;
};

NodeRow node_row(const Nodes<2>& nodes, std::int64_t i) {
  return {nodes.id(i), {nodes.x[0](i), nodes.x[1](i)}, nodes.d(i), nodes.tag(i)};
}

NodeRows sorted_nodes(std::vector<NodeRow> rows) {
  std::ranges::sort(rows, {}, &NodeRow::id);
  NodeRows sorted;
  for (const NodeRow& row : rows) {
    sorted.ids.push_back(row.id);
    sorted.xy.insert(sorted.xy.end(), row.x, row.x + 2);
    sorted.spacing.push_back(row.d);
    sorted.tags.push_back(static_cast<std::int32_t>(row.tag));
  }
  return sorted;
}

TriangleRows sorted_triangles(std::vector<TriangleRow> rows) {
  std::ranges::sort(rows, {}, [](const TriangleRow& t) {
    return std::tuple(t.corners[0], t.corners[1]);  // the third follows from the first two
  });
  TriangleRows sorted;
  for (const TriangleRow& row : rows) {
    sorted.corners.insert(sorted.corners.end(), row.corners, row.corners + 3);
    sorted.quality.push_back(static_cast<float>(row.quality));
  }
  return sorted;
}

EdgeRows sorted_edges(std::vector<EdgeRow> rows) {
  std::ranges::sort(rows, {},
                    [](const EdgeRow& e) { return std::tuple(e.ends[0], e.ends[1], e.tag); });
  EdgeRows sorted;
  for (const EdgeRow& row : rows) {
    sorted.ends.insert(sorted.ends.end(), row.ends, row.ends + 2);
    sorted.tags.push_back(static_cast<std::int32_t>(row.tag));
  }
  return sorted;
}

}  // namespace

NodesById::NodesById(PlacementOf<2>& placement, bool elements)
    : placement_(placement), comm_(placement.communicator()) {
  prepare(placement, elements);
  contents_.elements = elements;
  std::vector<std::int64_t> counts{placement.count(), 0, 0};
  if (elements) {
    placement.for_elements([&](const auto&) { ++counts[1]; });
    placement.for_boundary_facets([&](const auto&, std::int32_t) { ++counts[2]; });
  }
  comm_.allreduce_sum(counts);
  contents_.nodes = counts[0];
  contents_.triangles = counts[1];
  contents_.edges = counts[2];
  if (comm_.size() == 1) return;
  const View<std::int64_t> id = placement.level().nodes.id;
  blocks_.emplace(comm_, placement.count(),
                  [&](std::int64_t place) { return id(placement.node_at(place)); });
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; number < contents_.nodes; number += kWindow)
    numbers.push_back(number);
  bounds_ = blocks_->ids_at(numbers);
}

// ------------------------------------------------------------------ windows --------------------

// The place of this rank's first node in this part or in one behind it.
std::int64_t NodesById::first_place_in(std::size_t part) const {
  const std::int64_t owned = placement_.count();
  if (!blocks_) return std::min(static_cast<std::int64_t>(part) * kWindow, owned);
  if (part >= bounds_.size()) return owned;
  const View<std::int64_t> id = placement_.level().nodes.id;
  const auto places = std::views::iota(std::int64_t{0}, owned);
  return *std::ranges::lower_bound(
      places, bounds_[part], {}, [&](std::int64_t place) { return id(placement_.node_at(place)); });
}

template <class Visit>
void NodesById::for_windows(const Visit& visit) const {
  const auto ranks = static_cast<std::size_t>(comm_.size());
  const auto rank = static_cast<std::size_t>(comm_.rank());
  for (std::size_t part = 0; static_cast<std::int64_t>(part) * kWindow < contents_.nodes;
       part += ranks)
    visit(Window{first_place_in(part), first_place_in(part + ranks),
                 static_cast<std::int64_t>(part + rank) * kWindow});
}

// Brings each row to the rank that has its first node in its part of the window.
template <class Row, class Label>
std::vector<Row> NodesById::brought(std::vector<Row> rows, const Label& first_label) const {
  if (!blocks_) return rows;
  return redistribute<Row>(comm_, rows, [&](const Row& row) {
    const auto part = std::ranges::upper_bound(bounds_, first_label(row)) - bounds_.begin() - 1;
    return static_cast<int>(part % comm_.size());
  });
}

std::int64_t NodesById::label(std::int64_t place) const {
  return blocks_ ? placement_.level().nodes.id(placement_.node_at(place)) : place;
}

void NodesById::label_by_numbers(std::vector<std::int64_t>& labels) const {
  if (blocks_) labels = blocks_->numbers_of(labels);
}

// ------------------------------------------------------------------ rows -----------------------

void NodesById::for_nodes(const std::function<void(const NodeRows&)>& visit) const {
  const Nodes<2>& nodes = placement_.level().nodes;
  for_windows([&](const Window& window) {
    std::vector<NodeRow> own;
    for (std::int64_t place = window.begin; place < window.end; ++place)
      own.push_back(node_row(nodes, placement_.node_at(place)));
    NodeRows rows = sorted_nodes(brought(std::move(own), [](const NodeRow& n) { return n.id; }));
    rows.first = window.first;
    visit(rows);
  });
}

void NodesById::for_triangles(const std::function<void(const TriangleRows&)>& visit) const {
  const Nodes<2>& nodes = placement_.level().nodes;
  const auto position = [&](std::int64_t place) {
    return nodes.position(placement_.node_at(place));
  };
  std::int64_t before = 0;
  for_windows([&](const Window& window) {
    std::vector<TriangleRow> own;
    placement_.for_elements(
        window.begin, window.end, [&](const std::array<std::int64_t, 3>& places) {
          const auto [a, b, c] = places;
          own.push_back(
              {{label(a), label(b), label(c)}, quality_of(position(a), position(b), position(c))});
        });
    TriangleRows rows = sorted_triangles(
        brought(std::move(own), [](const TriangleRow& t) { return t.corners[0]; }));
    label_by_numbers(rows.corners);
    const RankSpan span = span_of(comm_, rows.quality.size());
    rows.first = before + span.first;
    before += span.total;
    visit(rows);
  });
}

// All at once: the boundary is in every rank's memory anyway.
void NodesById::for_edges(const std::function<void(const EdgeRows&)>& visit) const {
  std::vector<EdgeRow> own;
  placement_.for_boundary_facets([&](const std::array<std::int64_t, 2>& places, std::int32_t tag) {
    const auto [a, b] = places;
    own.push_back({{label(a), label(b)}, tag});
  });
  if (blocks_)
    own = redistribute<EdgeRow>(comm_, own,
                                [&](const EdgeRow& e) { return blocks_->rank_of(e.ends[0]); });
  EdgeRows rows = sorted_edges(std::move(own));
  label_by_numbers(rows.ends);
  rows.first = span_of(comm_, rows.tags.size()).first;
  visit(rows);
}

}  // namespace pnpbs::io
