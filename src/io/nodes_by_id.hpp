// SPDX-License-Identifier: BSD-3-Clause
// All nodes of a placement in the order of their ids, triangles and boundary edges in the order of
// their corners: the same whole for any number of ranks.
#pragma once

#include <optional>

#include "comm/id_blocks.hpp"
#include "io/node_source.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs::io {

class NodesById : public NodeSource {
 public:
  // Collective.
  NodesById(PlacementOf<2>& placement, bool elements);

  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override;
  void for_triangles(const std::function<void(const TriangleRows&)>& visit) const override;
  void for_edges(const std::function<void(const EdgeRows&)>& visit) const override;

 private:
  // Each rank has one part of it, of kWindow nodes.
  struct Window {
    std::int64_t begin, end;  // places of this rank's nodes that are in it
    std::int64_t first;       // number of the first node of this rank's part
  };
  template <class Visit>
  void for_windows(const Visit& visit) const;
  template <class Row, class Label>
  std::vector<Row> brought(std::vector<Row> rows, const Label& first_label) const;
  std::int64_t first_place_in(std::size_t part) const;
  std::int64_t label(std::int64_t place) const;
  void label_by_numbers(std::vector<std::int64_t>& labels) const;

  const PlacementOf<2>& placement_;
  const Communicator& comm_;
  // More ranks than one know nodes of others by their ids; one alone by their places, which are
  // the numbers.
  std::optional<IdBlocks> blocks_;
  std::vector<std::int64_t> bounds_;  // ids that parts of windows begin with
};

}  // namespace pnpbs::io
