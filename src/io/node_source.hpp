// SPDX-License-Identifier: BSD-3-Clause
// The interface between results and writers. A source delivers nodes, elements, and facets of
// boundary and inner surfaces one window at a time, so that writing needs little memory. Elements
// are triangles in the plane and tetrahedra in space; facets are edges and triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "formats/group_names.hpp"
#include "io/output_fields.hpp"

namespace pnpbs::io {

// The kind of the cells of a grid. A file has cells of one kind only, since many programs do not
// read mixed ones.
enum class Cells { nodes, elements, facets };

// Properties of all nodes, elements and facets together. Their numbers start at 0.
struct Contents {
  int dimension = 2;           // dimension of the elements
  int coordinates = 2;         // number of coordinates of the nodes; 3 on a sphere, too
  bool is_piece = false;       // one of several pieces, which is numbered by itself and has ghosts
  bool with_elements = false;  // with elements and facets
  // 2: nodes include a mid node for each edge, after all others, and elements and facets have those
  // of their edges after their corners, in the order of VTK
  int order = 1;
  Cells cells = Cells::nodes;  // facets for surface meshes, which have no elements
  bool with_regions = false;   // elements have tags of regions
  bool is_beside = false;      // a grid of the facets that belongs to a grid of the elements
  std::int64_t nodes = 0, elements = 0, facets = 0;
  bool is_periodic = false;         // elements beside the cell have copies of nodes
  std::array<double, 3> periods{};  // along the axes; 0 along those that are not periodic
  // Tags of the facets on flat periodic sides: low x, high x, low y and so on; 0 on other sides
  std::array<std::int32_t, 6> flat_tags{};
  const GroupNames* names = nullptr;                 // names of tags; nullptr for pieces
  const std::vector<OutputField>* fields = nullptr;  // nullptr: no output fields

  std::size_t field_count() const { return fields ? fields->size() : 0; }

  int cell_nodes() const {
    return cells == Cells::nodes ? 1 : cells == Cells::elements ? element_nodes() : facet_nodes();
  }
  std::int64_t cell_count() const {
    return cells == Cells::nodes ? nodes : cells == Cells::elements ? elements : facets;
  }
  int element_nodes() const { return nodes_of(dimension + 1); }
  int facet_nodes() const { return nodes_of(dimension); }

  // Returns the number of nodes of a cell with so many corners.
  int nodes_of(int corners) const { return order == 2 ? corners * (corners + 1) / 2 : corners; }
};

// Nodes of a window.
struct NodeRows {
  std::int64_t first = 0;          // number of the first node
  std::vector<double> x;           // [nodes][coordinates]
  std::vector<std::int64_t> ids;   // [nodes], -1 for mid nodes
  std::vector<std::int32_t> tags;  // [nodes], 0: inner node
  // [nodes], tag of the region; only if with_regions, not for pieces
  std::vector<std::int32_t> regions;
  std::vector<double> spacing;       // [nodes], d at the node
  std::vector<std::uint8_t> ghosts;  // [nodes], 1 for ghosts; for pieces only
  // Only if is_periodic: [nodes], the number of the node of which it is a copy, or its own number,
  // and the periods from that node to it.
  std::vector<std::int64_t> partners;
  std::vector<std::array<std::int32_t, 3>> images;
};

// Values of an output field in a window.
struct FieldRows {
  std::int64_t first = 0;
  std::vector<double> values;  // [nodes][components]
};

// Elements of a window.
struct ElementRows {
  std::int64_t first = 0;
  std::vector<std::int64_t> nodes;  // [elements][element_nodes()], numbers
  std::vector<float> quality;       // [elements], 2 r_in / R of triangles, 3 r_in / R of tetrahedra
  std::vector<std::int32_t> regions;  // [elements], 0: no tag; only if with_regions
};

// Side of an edge, seen from its first corner to its second. both: the edge is on an inner curve.
enum class Side : std::uint8_t { left, right, both };

// Facets of a window, including those on inner curves and surfaces.
struct FacetRows {
  std::int64_t first = 0;
  std::vector<std::int64_t> nodes;  // [facets][facet_nodes()], numbers
  std::vector<std::int32_t> tags;   // [facets]
  std::vector<float> quality;       // [facets], 2 r_in / R; in space only
  std::vector<Side> domain;  // [facets], side of the domain; in the plane only, not for pieces
};

// All nodes, facets or elements with one tag.
struct TagGroup {
  std::int32_t tag;
  std::int64_t count = 0;
  std::array<double, 3> low, high;  // bounding box; z is 0 in the plane
};

// A source of nodes, elements and facets for writers.
class NodeSource {
 public:
  virtual ~NodeSource() = default;

  const Contents& contents() const { return contents_; }

  // Each function iterates over all rows once. It calls visit() with this rank's part of each
  // window, even if the part is empty. The parts of a window are in the order of the ranks. visit()
  // may communicate. Collective.
  virtual void for_nodes(const std::function<void(const NodeRows&)>& visit) const = 0;
  virtual void for_field(std::size_t field,
                         const std::function<void(const FieldRows&)>& visit) const = 0;
  virtual void for_elements(const std::function<void(const ElementRows&)>& visit) const = 0;
  virtual void for_facets(const std::function<void(const FacetRows&)>& visit) const = 0;

  // Return the groups of all ranks, sorted by tag; none for pieces. Collective.
  virtual std::vector<TagGroup> node_groups() const { return {}; }
  virtual std::vector<TagGroup> facet_groups() const { return {}; }
  virtual std::vector<TagGroup> region_groups() const { return {}; }  // only if with_regions

 protected:
  Contents contents_;
};

// The facets of another source as a grid of their own. Nodes keep their numbers.
class FacetGrid : public NodeSource {
 public:
  // `of` must outlive this object.
  explicit FacetGrid(const NodeSource& of) : of_(of) {
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
