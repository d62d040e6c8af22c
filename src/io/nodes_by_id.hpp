// SPDX-License-Identifier: BSD-3-Clause
// All nodes of a placement in the order of their ids, elements and facets of the boundary in the
// order of their corners: the same whole for any number of ranks.
#pragma once

#include <array>
#include <optional>

#include "comm/id_blocks.hpp"
#include "io/node_source.hpp"
#include "results/element_regions.hpp"
#include "results/results.hpp"

namespace pnpbs::io {

template <int Dim>
class NodesById : public NodeSource {
 public:
  // Collective.
  NodesById(Results<Dim>& results, bool elements, const std::vector<OutputField>& fields);

  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override;
  void for_field(std::size_t field,
                 const std::function<void(const FieldRows&)>& visit) const override;
  void for_elements(const std::function<void(const ElementRows&)>& visit) const override;
  void for_facets(const std::function<void(const FacetRows&)>& visit) const override;
  std::vector<TagGroup> node_groups() const override;
  std::vector<TagGroup> facet_groups() const override;
  std::vector<TagGroup> region_groups() const override;

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
  template <class Rows>
  void number_rows(Rows& rows, std::size_t count, std::int64_t& before) const;
  std::int64_t first_place_in(std::size_t part) const;
  std::int64_t label(std::int64_t place) const;
  template <std::size_t n>
  std::array<std::int64_t, n> labels(const std::array<std::int64_t, n>& places) const;
  void label_by_numbers(std::vector<std::int64_t>& labels) const;

  const Results<Dim>& results_;
  const Communicator& comm_;
  std::int64_t owned_ = 0;                                // nodes of this rank
  mutable std::optional<ElementRegions<Dim>> region_of_;  // with_regions only
  // More ranks than one know nodes of others by their ids; one alone by their places, which are
  // the numbers.
  std::optional<IdBlocks> blocks_;
  std::vector<std::int64_t> bounds_;  // ids that parts of windows begin with
};

extern template class NodesById<2>;
extern template class NodesById<3>;

}  // namespace pnpbs::io
