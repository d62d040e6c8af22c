// SPDX-License-Identifier: BSD-3-Clause
#include "io/node_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "parallel/id_blocks.hpp"
#include "parallel/records.hpp"

namespace pnpbs::io {

namespace {

struct NodeRow {
  std::int64_t id;
  double x[2], d;
  std::int64_t tag;
};

struct TriangleRow {
  std::int64_t corners[3];  // ids, the least first
  double quality;
};

struct EdgeRow {
  std::int64_t ends[2];  // ids
  std::int64_t tag;
};

// 2 r_in / R: 1 for an equilateral triangle, 0 for a flat one.
float quality_of(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const auto side = [](const Point<2>& u, const Point<2>& v) {
    return std::hypot(v[0] - u[0], v[1] - u[1]);
  };
  const double a = side(p, q), b = side(q, r), c = side(r, p);
  const double twice_area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  // In ratios, so that no product leaves the range of doubles.
  const double height = twice_area / a;
  const double value = 4 * (height / b) * (height / c) * (a / (a + b + c));
  return std::isfinite(value) ? static_cast<float>(value) : 0.0F;
}

void prepare(Placement& placement, bool elements) {
  if (elements)
    placement.prepare_stars();
  else
    placement.prepare_order();
}

void append_node(const Nodes<2>& nodes, std::int64_t i, NodeBlock& block) {
  block.xy.push_back(nodes.x[0](i));
  block.xy.push_back(nodes.x[1](i));
  block.ids.push_back(nodes.id(i));
  block.tags.push_back(nodes.tag(i));
  block.spacing.push_back(nodes.d(i));
}

// ------------------------------------------------------------------ all by id ------------------

std::vector<std::int64_t> own_ids(const Placement& placement) {
  const View<std::int64_t> id = placement.level().nodes().id;
  const std::int64_t owned = placement.count();
  std::vector<std::int64_t> ids;
  for (std::int64_t place = 0; place < owned; ++place) ids.push_back(id(placement.node_at(place)));
  return ids;
}

std::vector<NodeRow> own_rows(const Placement& placement) {
  const Nodes<2>& nodes = placement.level().nodes();
  const std::int64_t owned = placement.count();
  std::vector<NodeRow> rows;
  for (std::int64_t place = 0; place < owned; ++place) {
    const std::int64_t i = placement.node_at(place);
    rows.push_back({nodes.id(i), {nodes.x[0](i), nodes.x[1](i)}, nodes.d(i), nodes.tag(i)});
  }
  return rows;
}

std::vector<TriangleRow> own_triangles(const Placement& placement) {
  const Nodes<2>& nodes = placement.level().nodes();
  std::vector<TriangleRow> rows;
  placement.for_triangles([&](std::int64_t a, std::int64_t b, std::int64_t c) {
    const std::int64_t i = placement.node_at(a), j = placement.node_at(b), k = placement.node_at(c);
    rows.push_back({{nodes.id(i), nodes.id(j), nodes.id(k)},
                    quality_of(nodes.position(i), nodes.position(j), nodes.position(k))});
  });
  return rows;
}

std::vector<EdgeRow> own_edges(const Placement& placement) {
  const View<std::int64_t> id = placement.level().nodes().id;
  std::vector<EdgeRow> rows;
  placement.for_boundary_edges([&](std::int64_t a, std::int64_t b, std::int32_t tag) {
    rows.push_back({{id(placement.node_at(a)), id(placement.node_at(b))}, tag});
  });
  return rows;
}

void take_nodes(std::vector<NodeRow> rows, NodeBlock& block) {
  std::ranges::sort(rows, {}, &NodeRow::id);
  for (const NodeRow& row : rows) {
    block.ids.push_back(row.id);
    block.xy.insert(block.xy.end(), row.x, row.x + 2);
    block.spacing.push_back(row.d);
    block.tags.push_back(static_cast<std::int32_t>(row.tag));
  }
}

void take_triangles(std::vector<TriangleRow> rows, NodeBlock& block) {
  std::ranges::sort(rows, {}, [](const TriangleRow& t) {
    return std::tuple(t.corners[0], t.corners[1]);  // the third follows from the first two
  });
  for (const TriangleRow& row : rows) {
    block.corners.insert(block.corners.end(), row.corners, row.corners + 3);
    block.quality.push_back(static_cast<float>(row.quality));
  }
}

void take_edges(std::vector<EdgeRow> rows, NodeBlock& block) {
  std::ranges::sort(rows, {},
                    [](const EdgeRow& e) { return std::tuple(e.ends[0], e.ends[1], e.tag); });
  for (const EdgeRow& row : rows) {
    block.edge_ends.insert(block.edge_ends.end(), row.ends, row.ends + 2);
    block.edge_tags.push_back(static_cast<std::int32_t>(row.tag));
  }
}

}  // namespace

NodeBlock block_by_id(Placement& placement, bool elements) {
  prepare(placement, elements);
  const Communicator& comm = placement.communicator();
  // What this rank has, whoever fails at it.
  const auto own = [&](const auto& collect) {
    decltype(collect(placement)) rows;
    agreed(comm, [&] { rows = collect(placement); });
    return rows;
  };
  const IdBlocks blocks(comm, own(own_ids));
  // To the rank that has this id in its block.
  const auto send = [&](auto rows, const auto& id_of) {
    using Row = typename decltype(rows)::value_type;
    return delivered<Row>(comm, rows, [&](const Row& row) { return blocks.rank_of(id_of(row)); });
  };
  NodeBlock block;
  block.nodes = blocks.numbers();
  take_nodes(send(own(own_rows), [](const NodeRow& row) { return row.id; }), block);
  block.elements = elements;
  if (!elements) return block;
  take_triangles(send(own(own_triangles), [](const TriangleRow& t) { return t.corners[0]; }),
                 block);
  take_edges(send(own(own_edges), [](const EdgeRow& e) { return e.ends[0]; }), block);
  block.corners = blocks.numbers_of(block.corners);
  block.edge_ends = blocks.numbers_of(block.edge_ends);
  block.triangles = span_of(comm, block.quality.size());
  block.edges = span_of(comm, block.edge_tags.size());
  return block;
}

// ------------------------------------------------------------------ a piece --------------------

NodeBlock own_piece(Placement& placement, bool elements) {
  prepare(placement, elements);
  NodeBlock block;
  block.is_piece = true;
  block.elements = elements;
  agreed(placement.communicator(), [&] {
    const Nodes<2>& nodes = placement.level().nodes();
    const std::int64_t owned = placement.count();
    for (std::int64_t place = 0; place < owned; ++place)
      append_node(nodes, placement.node_at(place), block);
    // Ghosts in the order in which triangles ask for them.
    std::vector<std::int64_t> number(static_cast<std::size_t>(nodes.count - owned), -1);
    const auto number_of = [&](std::int64_t place) {
      if (place < owned) return place;
      std::int64_t& ghost = number[static_cast<std::size_t>(place - owned)];
      if (ghost < 0) {
        ghost = static_cast<std::int64_t>(block.size());
        append_node(nodes, placement.node_at(place), block);
      }
      return ghost;
    };
    if (elements) {
      placement.for_triangles([&](std::int64_t a, std::int64_t b, std::int64_t c) {
        for (const std::int64_t place : {a, b, c}) block.corners.push_back(number_of(place));
        const auto position = [&](std::int64_t place) {
          return nodes.position(placement.node_at(place));
        };
        block.quality.push_back(quality_of(position(a), position(b), position(c)));
      });
    }
    block.ghosts.resize(block.size(), 1);
    std::fill_n(block.ghosts.begin(), owned, std::uint8_t{0});
    const auto alone = [](std::size_t count) {
      const auto n = static_cast<std::int64_t>(count);
      return RankSpan{0, n, n};
    };
    block.nodes = alone(block.size());
    block.triangles = alone(block.quality.size());
  });
  return block;
}

}  // namespace pnpbs::io
