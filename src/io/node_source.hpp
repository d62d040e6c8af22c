// SPDX-License-Identifier: BSD-3-Clause
// What the writers write: nodes, elements and the facets of boundary and inner surfaces, a window
// at a time, so that writing takes hardly any memory beside the nodes themselves. Elements are
// triangles in the plane and tetrahedra in space; facets are edges, and triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "formats/group_names.hpp"
#include "io/output_fields.hpp"

namespace pnpbs::io {

// What the cells of a grid are. Those of one file are all of one kind, since many programs read no
// others.
enum class Cells { nodes, elements, facets };

// What all ranks hold together. Nodes, elements and facets are numbered through, from 0.
struct Contents {
  int dimension = 2;           // of elements
  int coordinates = 2;         // of nodes: 3 on a sphere, too
  bool is_piece = false;       // one of many, which stands for itself and knows ghosts
  bool with_elements = false;  // and facets?
  Cells cells = Cells::nodes;  // of surfaces alone, which have no elements, the facets
  bool with_regions = false;   // have elements tags, of the regions that they lie in?
  bool is_beside = false;      // a grid of the facets beside that of the elements
  std::int64_t nodes = 0, elements = 0, facets = 0;
  const GroupNames* names = nullptr;                 // of tags; none of pieces
  const std::vector<OutputField>* fields = nullptr;  // none: no field of the caller's

  std::size_t field_count() const { return fields ? fields->size() : 0; }

  int cell_corners() const {
    return cells == Cells::nodes ? 1 : cells == Cells::elements ? dimension + 1 : dimension;
  }
  std::int64_t cell_count() const {
    return cells == Cells::nodes ? nodes : cells == Cells::elements ? elements : facets;
  }
  int element_corners() const { return dimension + 1; }
  int facet_corners() const { return dimension; }
};

struct NodeRows {
  std::int64_t first = 0;             // number of the first one here
  std::vector<double> x;              // [nodes][coordinates]
  std::vector<std::int64_t> ids;      // [nodes]
  std::vector<std::int32_t> tags;     // [nodes], 0: inner node
  std::vector<std::int32_t> regions;  // [nodes], where they lie; with_regions only, not of pieces
  std::vector<double> spacing;        // [nodes], d at the node
  std::vector<std::uint8_t> ghosts;   // [nodes], 1: another rank's; pieces only
};

// Of one field of the caller's.
struct FieldRows {
  std::int64_t first = 0;
  std::vector<double> values;  // [nodes][components]
};

struct ElementRows {
  std::int64_t first = 0;
  std::vector<std::int64_t> corners;  // [elements][dimension + 1], numbers
  std::vector<float> quality;         // [elements], 2 r_in / R, in space 3 r_in / R
  std::vector<std::int32_t> regions;  // [elements], 0: without a tag; with_regions only
};

// Of an edge, from its first corner to its second. both: it is on an inner curve.
enum class Side : std::uint8_t { left, right, both };

struct FacetRows {  // on inner curves and surfaces, too
  std::int64_t first = 0;
  std::vector<std::int64_t> corners;  // [facets][dimension], numbers
  std::vector<std::int32_t> tags;     // [facets]
  std::vector<float> quality;         // [facets], 2 r_in / R; in space only
  std::vector<Side> domain;           // [facets], where it is; in the plane only, not of pieces
};

// All nodes, all facets, or all elements of regions, with one tag.
struct TagGroup {
  std::int32_t tag;
  std::int64_t count = 0;
  std::array<double, 3> low, high;  // the box around them; z is 0 in the plane
};

class NodeSource {
 public:
  virtual ~NodeSource() = default;

  const Contents& contents() const { return contents_; }

  // Each call goes through all of them once: visit gets this rank's part of one window after the
  // other, empty ones included, and may do collective work. The parts of a window are in the order
  // of the ranks. Collective.
  virtual void for_nodes(const std::function<void(const NodeRows&)>& visit) const = 0;
  virtual void for_field(std::size_t field,
                         const std::function<void(const FieldRows&)>& visit) const = 0;
  virtual void for_elements(const std::function<void(const ElementRows&)>& visit) const = 0;
  virtual void for_facets(const std::function<void(const FacetRows&)>& visit) const = 0;

  // By tag, of all ranks; none of pieces. Collective.
  virtual std::vector<TagGroup> node_groups() const { return {}; }
  virtual std::vector<TagGroup> facet_groups() const { return {}; }
  virtual std::vector<TagGroup> region_groups() const { return {}; }  // with_regions only

 protected:
  Contents contents_;
};

// The facets of another source, for a grid beside that of its elements; their corners are numbered
// as there.
class FacetsBeside : public NodeSource {
 public:
  // That outlives this.
  explicit FacetsBeside(const NodeSource& of) : of_(of) {
    contents_ = of.contents();
    contents_.cells = Cells::facets;
    contents_.is_beside = true;
  }

  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override {
    of_.for_nodes(visit);
  }
  void for_field(std::size_t field,
                 const std::function<void(const FieldRows&)>& visit) const override {
    of_.for_field(field, visit);
  }
  void for_elements(const std::function<void(const ElementRows&)>& visit) const override {
    of_.for_elements(visit);
  }
  void for_facets(const std::function<void(const FacetRows&)>& visit) const override {
    of_.for_facets(visit);
  }

 private:
  const NodeSource& of_;
};

}  // namespace pnpbs::io
