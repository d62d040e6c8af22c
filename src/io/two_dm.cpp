// SPDX-License-Identifier: BSD-3-Clause
// Writer of the 2DM format of Aquaveo's SMS (https://www.xmswiki.com/wiki/SMS:2D_Mesh_Files_*.2dm),
// one card per line: triangles "E3T number corner corner corner material", nodes "ND number x y z",
// and node strings "NS node node ... -node number" of the boundary, one tag each. Numbers start at
// 1.
#include "base/error.hpp"
#include "io/boundary_loops.hpp"
#include "io/numbered_rows.hpp"

namespace pnpbs::io {

namespace {

constexpr std::size_t kNodesOfLine = 10;  // as SMS writes them

void append_triangles(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  nodes.for_elements([&](const ElementRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t e = 0; e < rows.quality.size(); ++e) {
        sink.text("E3T ");
        sink.number(++number);
        write_corners(rows.nodes, e, all.element_nodes(), sink);
        sink.text(" ");
        sink.number(all.with_regions ? block_of_tag(rows.regions[e]) : 1);
        sink.text("\n");
      }
    });
  });
}

// Writes a node string. The last node has a minus sign, and the tag follows as the number of the
// string.
void write_string(const BoundaryChain& chain, Sink& sink) {
  const std::size_t n = chain.nodes.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (k % kNodesOfLine == 0) sink.text(k == 0 ? "NS" : "\nNS");
    sink.text(k + 1 < n ? " " : " -");
    sink.number(chain.nodes[k] + 1);
  }
  sink.text(" ");
  sink.number(chain.kind);
  sink.text("\n");
}

// Returns the node strings, the same ones on all ranks. Throws for tags below 1. Collective.
std::vector<BoundaryChain> strings_of(const NodeSource& nodes, const Communicator& comm) {
  std::vector<BoundaryChain> chains =
      chains_of(boundary_loops(nodes, comm), [](std::int32_t tag) { return tag; });
  for (const BoundaryChain& chain : chains)
    if (chain.kind < 1)
      throw Error(ErrorKind::argument,
                  "a .2dm file numbers node strings by tags from 1 on, and the tag of a curve is " +
                      std::to_string(chain.kind));
  return chains;
}

void append_strings(const std::vector<BoundaryChain>& chains, SharedFile& file) {
  file.append([&](Sink& sink) {
    if (!file.is_first()) return;
    for (const BoundaryChain& chain : chains) write_string(chain, sink);
  });
}

}  // namespace

void write_2dm(const NodeSource& nodes, SharedFile& file) {
  largest_block(nodes, "2dm", "materials");  // throws for negative tags
  const std::vector<BoundaryChain> strings = strings_of(nodes, file.ranks());
  file.append_text("MESH2D\nMESHNAME \"pnpbs\"\nNUM_MATERIALS_PER_ELEM 1\n");
  append_triangles(nodes, file);
  // The file has heights: z points up, so it is minus the depth.
  append_map_places(nodes, file,
                    [](std::int64_t number, const Point<2>& x, double depth, Sink& sink) {
                      sink.text("ND ");
                      sink.number(number);
                      for (const double value : {x[0], x[1], 0 - depth}) {
                        sink.text(" ");
                        sink.number(value);
                      }
                      sink.text("\n");
                    });
  append_strings(strings, file);
}

}  // namespace pnpbs::io
