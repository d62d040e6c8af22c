// SPDX-License-Identifier: BSD-3-Clause
// All nodes of a placement in the order of their ids, with elements and facets in the order of
// their corners. The result does not depend on the number of ranks.
#pragma once

#include <array>
#include <optional>

#include "comm/id_blocks.hpp"
#include "io/node_source.hpp"
#include "results/cracks.hpp"
#include "results/element_regions.hpp"
#include "results/mid_nodes.hpp"
#include "results/results.hpp"

namespace pnpbs::io {

// The source for all files that are not in pieces. Mid nodes of edges, with elements of second
// order, or copies of nodes on cracks follow the nodes in the order of their numbers.
template <int Dim>
class NodesById : public NodeSource {
 public:
  // Prepares the results; `fields` must outlive this object. `order` is that of the elements, 0
  // without any. With order 2 the fields have values at ghosts, too. Collective.
  NodesById(Results<Dim>& results, int order, const std::vector<OutputField>& fields);

  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override;
  void for_field(std::size_t field,
                 const std::function<void(const FieldRows&)>& visit) const override;
  void for_elements(const std::function<void(const ElementRows&)>& visit) const override;
  void for_facets(const std::function<void(const FacetRows&)>& visit) const override;
  std::vector<TagGroup> node_groups() const override;
  std::vector<TagGroup> facet_groups() const override;
  std::vector<TagGroup> region_groups() const override;

 private:
  // A window, of which each rank has one part with kWindow nodes.
  struct Window {
    std::int64_t begin, end;  // indices in the results of this rank's nodes in the window
    std::int64_t first;       // number of the first node of this rank's part
  };
  template <class Visit>
  void for_windows(const Visit& visit) const;
  template <class Row, class Label>
  std::vector<Row> brought(std::vector<Row> rows, const Label& first_label) const;
  template <class Rows>
  void number_rows(Rows& rows, const std::vector<std::int64_t>& added, std::size_t count,
                   std::int64_t& before) const;
  template <std::size_t added>
  void for_element_rows(const std::function<void(const ElementRows&)>& visit) const;
  template <std::size_t added>
  void for_facet_rows(const std::function<void(const FacetRows&)>& visit) const;
  template <std::size_t added, std::size_t corners>
  std::array<std::int64_t, added> added_to(const std::array<std::int64_t, corners>& places) const;
  template <std::size_t n>
  std::array<std::int64_t, n> copies_numbered(std::array<std::int64_t, n> copies) const;
  template <class Row>
  void add_facet(const std::array<std::int64_t, Dim>& places, Row row,
                 std::vector<Row>& rows) const;
  template <class Row, class RowsOf, class Visit>
  void for_added_windows(const RowsOf& rows_of, const Visit& visit) const;
  void list_added_nodes();
  Point<3> point(std::int64_t place, const Image<3>& periods) const;
  template <std::size_t n>
  std::array<Point<3>, n> points(const std::array<std::int64_t, n>& places,
                                 const Image<3>& periods) const;
  Image<3> periods_of_copy(const CrackCopy& copy) const;
  std::int64_t first_place_in(std::size_t part) const;
  std::int64_t label(std::int64_t place) const;
  template <std::size_t n>
  std::array<std::int64_t, n> labels(const std::array<std::int64_t, n>& places) const;
  void label_by_numbers(std::vector<std::int64_t>& labels) const;

  const Results<Dim>& results_;
  const Communicator& comm_;
  std::int64_t owned_ = 0;               // number of owned nodes
  std::int64_t node_count_ = 0;          // of all ranks, without added nodes
  const MidNodes* mid_nodes_ = nullptr;  // set for elements of second order
  const Cracks<Dim>* cracks_ = nullptr;  // set for elements with cracks or of a periodic domain
  // The mid nodes or copies that this rank writes, in the order of their numbers.
  struct Added {
    std::int64_t number;
    std::size_t index;  // in the lists of mid nodes or copies
  };
  std::vector<Added> own_added_;
  mutable std::optional<ElementRegions<Dim>> region_of_;  // set if with_regions
  // With several ranks, the label of a node is its id. A single rank uses indices, which are the
  // numbers already.
  std::optional<IdBlocks> blocks_;
  std::vector<std::int64_t> bounds_;  // first id of each part of a window
};

extern template class NodesById<2>;
extern template class NodesById<3>;

}  // namespace pnpbs::io
