// SPDX-License-Identifier: BSD-3-Clause
// Writer of SCHISM's grid hgrid.gr3
// (https://schism-dev.github.io/schism/master/input-output/hgrid.html), which has the layout of
// ADCIRC's fort.14. It has nodes "number x y depth", elements "number 3 corner corner corner", and
// open and land boundary segments, each a count and its nodes. Numbers start at 1. Segments are
// counter-clockwise around the domain and clockwise around islands.
#include "base/small_letters.hpp"
#include "io/boundary_loops.hpp"
#include "io/numbered_rows.hpp"

namespace pnpbs::io {

namespace {

constexpr std::int32_t kLand = 0, kOpen = 1;

// Returns kOpen if the name of the tag begins with "open".
std::int32_t kind_of(const Contents& all, std::int32_t tag) {
  const std::string* name = all.names ? all.names->find({1, tag}) : nullptr;
  return name && to_lower_case(*name).starts_with("open") ? kOpen : kLand;
}

// A boundary segment of the file.
struct Segment {
  std::vector<std::int64_t> nodes;
  bool is_island = false;
};

struct Segments {
  std::vector<Segment> open, land;
};

// Returns the boundary segments. Closed chains except land islands are split in two, because SCHISM
// rejects an open segment that ends where it begins, and its manual requires two segments for a
// boundary that is all land. Islands do not repeat their first node. Collective.
Segments segments_of(const NodeSource& nodes, const Communicator& comm) {
  Segments segments;
  std::vector<Segment> islands;
  const auto kind = [&](std::int32_t tag) { return kind_of(nodes.contents(), tag); };
  for (BoundaryChain& chain : chains_of(boundary_loops(nodes, comm), kind)) {
    std::vector<Segment>& like = chain.kind == kOpen ? segments.open : segments.land;
    if (!chain.is_closed) {
      like.push_back({std::move(chain.nodes)});
    } else if (chain.kind == kLand && chain.is_island) {
      chain.nodes.pop_back();
      islands.push_back({std::move(chain.nodes), true});
    } else {
      const auto half = chain.nodes.begin() + static_cast<std::ptrdiff_t>(chain.nodes.size() / 2);
      like.push_back({{chain.nodes.begin(), half + 1}});
      like.push_back({{half, chain.nodes.end()}});
    }
  }
  // ADCIRC's manual requires islands after all other segments.
  segments.land.insert(segments.land.end(), islands.begin(), islands.end());
  return segments;
}

void append_elements(const NodeSource& nodes, SharedFile& file) {
  nodes.for_elements([&](const ElementRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t e = 0; e < rows.quality.size(); ++e) {
        sink.number(++number);
        sink.text(" 3");
        write_corners(rows.nodes, e, nodes.contents().element_nodes(), sink);
        sink.text("\n");
      }
    });
  });
}

// Appends the segments, which all ranks have; rank 0 writes them.
void append_segments(const std::vector<Segment>& segments, const std::string& kind,
                     SharedFile& file) {
  std::size_t nodes = 0;
  for (const Segment& segment : segments) nodes += segment.nodes.size();
  file.append([&](Sink& sink) {
    if (!file.is_first()) return;
    sink.number(segments.size());
    sink.text(" = Number of " + kind + " boundaries\n");
    sink.number(nodes);
    sink.text(" = Total number of " + kind + " boundary nodes\n");
    std::size_t k = 0;
    for (const Segment& segment : segments) {
      sink.number(segment.nodes.size());
      if (kind == "land") sink.text(segment.is_island ? " 1" : " 0");
      sink.text(" = Number of nodes for " + kind + " boundary ");
      sink.number(++k);
      sink.text("\n");
      for (const std::int64_t node : segment.nodes) {
        sink.number(node + 1);
        sink.text("\n");
      }
    }
  });
}

}  // namespace

void write_gr3(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  file.append_text("triangles of nodes placed by pnpbs\n" + std::to_string(all.elements) + " " +
                   std::to_string(all.nodes) + "\n");
  append_map_places(nodes, file,
                    [](std::int64_t number, const Point<2>& x, double depth, Sink& sink) {
                      sink.number(number);
                      for (const double value : {x[0], x[1], depth}) {
                        sink.text(" ");
                        sink.number(value);
                      }
                      sink.text("\n");
                    });
  append_elements(nodes, file);
  const Segments segments = segments_of(nodes, file.ranks());
  append_segments(segments.open, "open", file);
  append_segments(segments.land, "land", file);
}

}  // namespace pnpbs::io
