// SPDX-License-Identifier: BSD-3-Clause
#include "results/cracks.hpp"

#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "base/fixed_point.hpp"
#include "base/index.hpp"
#include "base/mixed_hash.hpp"
#include "base/space_vectors.hpp"
#include "base/union_find.hpp"
#include "comm/records.hpp"
#include "geometry/volume/triangles.hpp"
#include "results/copy_numbers.hpp"

namespace pnpbs {
namespace {

bool is_one_of(const std::vector<std::int32_t>& tags, std::int32_t tag) {
  return std::ranges::find(tags, tag) != tags.end();
}

bool is_inner(const BoundaryEdge& edge) {
  return edge.left_inside && edge.right_inside && edge.begin != edge.end;
}

// Returns the ids of nodes in ascending order.
template <std::size_t n, class IdOf>
std::array<std::int64_t, n> ascending(std::array<std::int64_t, n> nodes, const IdOf& id_of) {
  for (std::int64_t& node : nodes) node = id_of(node);
  std::ranges::sort(nodes);
  return nodes;
}

// Calls visit(places, tag) for the facets of inner curves or surfaces with these tags, each once
// over all ranks.
template <class Visit>
void for_crack_facets(const Results<2>& results, const std::vector<std::int32_t>& tags,
                      const Visit& visit) {
  results.for_boundary_edges([&](const auto& places, const BoundaryEdge& edge) {
    if (is_inner(edge) && is_one_of(tags, edge.tag)) visit(places, edge.tag);
  });
}
template <class Visit>
void for_crack_facets(const Results<3>& results, const std::vector<std::int32_t>& tags,
                      const Visit& visit) {
  results.for_inner_facets([&](const auto& places, std::int32_t tag) {
    if (is_one_of(tags, tag)) visit(places, tag);
  });
}

// The nodes of a facet by memory indices. Side 0 is left of the edge from the first to the second
// node; from side 0 a triangle is counter-clockwise.
template <int Dim>
using FacetNodes = std::array<std::int64_t, Dim>;

// Finds the facets of cracks around single nodes of the plane.
class CrackEdges {
 public:
  CrackEdges(const Level<2>& level, const std::vector<std::int32_t>& tags)
      : level_(level), tags_(tags), node_of_(level.geometry.boundary().nodes.size(), -1) {
    for (std::int64_t i = 0; i < level.nodes.count; ++i)
      if (const std::int32_t b = level.nodes.boundary_node(i); b >= 0) node_of_[index(b)] = i;
  }

  std::vector<FacetNodes<2>> around(std::int64_t i) const {
    std::vector<FacetNodes<2>> edges;
    const std::int32_t b = level_.nodes.boundary_node(i);
    if (b < 0) return edges;
    const IncidentSectors& sectors = level_.geometry.sectors();
    for (std::int32_t k = sectors.begin(b); k < sectors.end(b); ++k) {
      const BoundaryEdge& edge = level_.geometry.boundary().facets[index(sectors.edge(k).edge)];
      if (is_inner(edge) && is_one_of(tags_, edge.tag))
        edges.push_back({node_of_[index(edge.begin)], node_of_[index(edge.end)]});
    }
    return edges;
  }

 private:
  const Level<2>& level_;
  const std::vector<std::int32_t>& tags_;
  std::vector<std::int64_t> node_of_;  // memory indices by boundary nodes; -1: not on this rank
};

// Finds the facets of cracks around single nodes in space.
class CrackTriangles {
 public:
  CrackTriangles(const Level<3>& level, const std::vector<std::int32_t>& tags)
      : facets_(level), tags_(tags) {}

  std::vector<FacetNodes<3>> around(std::int64_t i) {
    std::vector<FacetNodes<3>> triangles;
    for (const InnerFacet& facet : facets_.around(i))
      if (is_one_of(tags_, facet.tag)) triangles.push_back(facet.nodes);
    return triangles;
  }

 private:
  InnerFacets facets_;
  const std::vector<std::int32_t>& tags_;
};

// The elements around a node in sectors that facets of cracks separate. Sector 0 keeps the node.
template <int Dim>
struct NodeSectors {
  struct Element {
    std::array<std::int64_t, Dim + 1> ids;  // of the corners, ascending
    std::array<std::int64_t, Dim + 1> nodes;
    std::size_t sector = 0;
  };
  struct Face {
    std::array<std::int64_t, Dim> ids;  // ascending
    FacetNodes<Dim> nodes;
    std::array<std::size_t, 2> sectors;  // on both sides
    bool on_crack;
  };
  std::vector<Element> elements;  // ordered by their ids
  std::vector<Face> faces;        // at the node, ordered by their ids
  std::size_t count = 1;          // of sectors
};

// Divides the elements around one node after the other into sectors.
template <int Dim>
class SectorFinder {
 public:
  SectorFinder(const Level<Dim>& level, const std::vector<std::int32_t>& tags)
      : level_(level), cracks_(level, tags) {}

  NodeSectors<Dim> at(std::int64_t i) {
    NodeSectors<Dim> found;
    const std::vector<FacetNodes<Dim>> cracks = cracks_.around(i);
    if (cracks.empty()) return found;
    find_elements(i, found);
    find_faces(i, found);
    UnionFind<std::size_t> sectors(found.elements.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face &one = faces_[f], &other = faces_[std::min(f + 1, faces_.size() - 1)];
      const bool has_other = &one != &other && one.ids == other.ids;
      if (has_other) ++f;
      const auto crack = std::ranges::find(
          cracks, one.ids, [&](const FacetNodes<Dim>& nodes) { return sorted_ids(nodes); });
      const bool on_crack = has_other && crack != cracks.end();
      if (has_other && !on_crack) sectors.join(one.element, other.element);
      std::array<std::size_t, 2> sides{one.element, has_other ? other.element : one.element};
      if (on_crack && is_odd(one.nodes) != is_odd(*crack)) std::swap(sides[0], sides[1]);
      found.faces.push_back({one.ids, one.nodes, sides, on_crack});
    }
    number_sectors(sectors, found);
    return found;
  }

 private:
  // A face of an element, which lies at its side 0.
  struct Face {
    std::array<std::int64_t, Dim> ids;  // ascending
    FacetNodes<Dim> nodes;
    std::size_t element;
  };

  std::int64_t id(std::int64_t i) const { return level_.nodes.id(i); }

  template <std::size_t n>
  std::array<std::int64_t, n> sorted_ids(const std::array<std::int64_t, n>& nodes) const {
    return ascending(nodes, [this](std::int64_t i) { return id(i); });
  }

  // Returns whether an odd number of swaps puts the ids in order.
  bool is_odd(const FacetNodes<Dim>& nodes) const {
    bool odd = false;
    for (std::size_t k = 0; k < Dim; ++k)
      for (std::size_t l = k + 1; l < Dim; ++l) odd = odd != (id(nodes[k]) > id(nodes[l]));
    return odd;
  }

  void find_elements(std::int64_t i, NodeSectors<Dim>& found) const {
    level_.stars.for_simplices(i, [&](const typename Stars<Dim>::Corners& others) {
      std::array<std::int64_t, Dim + 1> nodes{i};
      std::copy(others.begin(), others.end(), nodes.begin() + 1);
      found.elements.push_back({sorted_ids(nodes), nodes});
    });
    std::ranges::sort(found.elements, {}, &NodeSectors<Dim>::Element::ids);
  }

  // Lists the faces at node i, which is the first corner of each element, ordered by their ids.
  void find_faces(std::int64_t i, const NodeSectors<Dim>& found) {
    faces_.clear();
    for (std::size_t e = 0; e < found.elements.size(); ++e) {
      const auto& nodes = found.elements[e].nodes;
      std::array<FacetNodes<Dim>, Dim> faces;
      if constexpr (Dim == 2)
        faces = {{{i, nodes[1]}, {nodes[2], i}}};
      else
        faces = {{{i, nodes[1], nodes[2]}, {i, nodes[2], nodes[3]}, {i, nodes[3], nodes[1]}}};
      for (const FacetNodes<Dim>& face : faces) faces_.push_back({sorted_ids(face), face, e});
    }
    std::ranges::sort(faces_, {}, [](const Face& f) { return std::pair(f.ids, f.element); });
  }

  // The first face on a crack has the sector that keeps the node at its side 0, so it is the same
  // side along a crack. The other sectors are numbered in the order of their first elements.
  void number_sectors(UnionFind<std::size_t>& sectors, NodeSectors<Dim>& found) const {
    const auto first = std::ranges::find(found.faces, true, &NodeSectors<Dim>::Face::on_crack);
    if (first == found.faces.end()) return;
    std::vector<std::size_t> roots{sectors.root(first->sectors[0])};
    const auto number = [&](std::size_t element) {
      const std::size_t root = sectors.root(element);
      const auto known = std::ranges::find(roots, root);
      if (known == roots.end()) roots.push_back(root);
      return static_cast<std::size_t>(std::ranges::find(roots, root) - roots.begin());
    };
    for (std::size_t e = 0; e < found.elements.size(); ++e) found.elements[e].sector = number(e);
    for (auto& face : found.faces)
      for (std::size_t& side : face.sectors) side = found.elements[side].sector;
    found.count = roots.size();
  }

  const Level<Dim>& level_;
  std::conditional_t<Dim == 2, CrackEdges, CrackTriangles> cracks_;
  std::vector<Face> faces_;  // of the elements around a node
};

// A corner of an element that is a copy.
template <int Dim>
struct ElementNews {
  std::array<std::int64_t, Dim + 1> ids;  // of the corners, ascending
  std::int64_t id, number;                // of the original, and of the copy
};

// The numbers of the copies of a node on both sides of a face.
template <int Dim>
struct FacetNews {
  std::array<std::int64_t, Dim> ids;  // ascending
  std::int64_t id;
  std::array<std::int64_t, 2> numbers;
};

// Returns those with these ids, from a list in the order of ids.
template <class News, std::size_t N>
std::span<const News> those_with(const std::vector<News>& news,
                                 const std::array<std::int64_t, N>& ids) {
  return {std::ranges::lower_bound(news, ids, {}, &News::ids),
          std::ranges::upper_bound(news, ids, {}, &News::ids)};
}

}  // namespace

// Makes the cracks in steps. The owner of a node finds the sectors around it, and sends the numbers
// of the copies to the owners of the elements and facets there.
template <int Dim>
class CrackMaker {
 public:
  CrackMaker(Results<Dim>& results, const std::vector<std::int32_t>& tags)
      : results_(results), level_(results.level()), comm_(results.communicator()), tags_(tags) {}

  Cracks<Dim> make() {
    require_same_tags();
    collective_try(comm_, [this] { find_facets(); });
    require_tags_of_facets();
    if constexpr (Dim == 3) cracks_.covered_ = covered_share();
    collective_try(comm_, [this] { find_sectors(); });
    number_copies();
    send_copies();
    collective_try(comm_, [this] {
      assemble_elements();
      assemble_facets();
      list_copies();
    });
    return std::move(cracks_);
  }

 private:
  // An owned node with copies.
  struct Split {
    std::int64_t place;
    NodeSectors<Dim> sectors;
    std::int64_t first = 0;  // number of the first copy

    std::int64_t number(std::size_t sector) const {
      return sector == 0 ? kOriginal : first + static_cast<std::int64_t>(sector) - 1;
    }
  };

  std::int64_t id(std::int64_t place) const { return level_.nodes.id(results_.node_at(place)); }
  int owner_of(std::int64_t node) const {
    return level_.nodes.owned(node) ? comm_.rank() : results_.owner_of(node);
  }

  void require_same_tags() const {
    std::uint64_t hash = mixed(tags_.size());
    for (const std::int32_t tag : tags_) hash = mixed(hash ^ static_cast<std::uint32_t>(tag));
    if (!comm_.same_on_all(hash))
      throw Error(ErrorKind::argument,
                  "the tags of cracks differ between ranks: all ranks must give the same");
  }

  void find_facets() {
    for_crack_facets(results_, tags_, [&](const auto& places, std::int32_t tag) {
      cracks_.facets_.push_back(without_copies(places, tag));
    });
    std::ranges::sort(cracks_.facets_, {}, &CrackFacet<Dim>::places);
  }

  void require_tags_of_facets() const {
    std::vector<std::int64_t> counts(tags_.size(), 0);
    for (const CrackFacet<Dim>& facet : cracks_.facets_)
      for (std::size_t k = 0; k < tags_.size(); ++k) counts[k] += facet.tag == tags_[k];
    comm_.allreduce_sum(counts);
    for (std::size_t k = 0; k < tags_.size(); ++k)
      if (counts[k] == 0)
        throw Error(ErrorKind::argument, "no inner " + std::string(Dim == 2 ? "curve" : "surface") +
                                             " has the tag " + std::to_string(tags_[k]) +
                                             " of a crack");
  }

  // Returns the area of the facets over that of the surfaces. Collective.
  double covered_share() const requires(Dim == 3) {
    const FacetIndex<3>& sides = level_.geometry.domain().index().sides();
    const auto count = static_cast<std::int32_t>(level_.geometry.boundary().facets.size());
    double area = 0;
    for (std::int32_t f = 0; f < count; ++f) {
      const BoundaryTriangle& triangle = sides.facet(f);
      if (triangle.front_inside && triangle.back_inside && is_one_of(tags_, triangle.tag))
        area += length(area_normal(sides.corners(f)));
    }
    FixedPointSum share;
    for (const CrackFacet<3>& facet : cracks_.facets_) {
      FacetCorners<3> x;
      for (std::size_t k = 0; k < 3; ++k)
        x[k] = level_.nodes.position(results_.node_at(facet.places[k]));
      share.add(length(area_normal(x)) / area);
    }
    return comm_.allreduce_sum(share).value();
  }

  void find_sectors() {
    SectorFinder<Dim> finder(level_, tags_);
    for (std::int64_t place = 0; place < results_.count(); ++place) {
      NodeSectors<Dim> sectors = finder.at(results_.node_at(place));
      if (sectors.count > 1) splits_.push_back({place, std::move(sectors)});
    }
  }

  void number_copies() {
    std::vector<CopiedNode> nodes;
    for (const Split& split : splits_)
      nodes.push_back({split.place, static_cast<std::int64_t>(split.sectors.count) - 1});
    cracks_.all_ = pnpbs::number_copies(results_, nodes);
    for (std::size_t k = 0; k < splits_.size(); ++k) splits_[k].first = nodes[k].first;
  }

  // Sends the copies around owned nodes to the owners of elements and facets. Collective.
  void send_copies() {
    Outbox of_elements, of_facets;
    collective_try(comm_, [&] {
      for (const Split& split : splits_) {
        const std::int64_t node = id(split.place);
        for (const auto& element : split.sectors.elements) {
          if (element.sector == 0) continue;
          const std::int64_t least = *std::ranges::find(
              element.nodes, element.ids[0], [this](std::int64_t i) { return level_.nodes.id(i); });
          pack(of_elements.to(owner_of(least)),
               ElementNews<Dim>{element.ids, node, split.number(element.sector)});
        }
        for (const auto& face : split.sectors.faces) send_face(split, face, of_facets);
      }
    });
    elements_ = deliver<ElementNews<Dim>>(comm_, of_elements);
    facets_ = deliver<FacetNews<Dim>>(comm_, of_facets);
    std::ranges::sort(elements_, {}, &ElementNews<Dim>::ids);
    std::ranges::sort(facets_, {}, &FacetNews<Dim>::ids);
  }

  // Sends the copies at a face that may be a facet to the owners of its nodes, one of which visits
  // the facet.
  void send_face(const Split& split, const typename NodeSectors<Dim>::Face& face, Outbox& outbox) {
    if (face.sectors[0] == 0 && face.sectors[1] == 0) return;
    if (!std::ranges::all_of(face.nodes, [this](std::int64_t i) { return may_be_split(i); }))
      return;
    std::array<int, Dim> owners;
    std::ranges::transform(face.nodes, owners.begin(), [this](auto i) { return owner_of(i); });
    std::ranges::sort(owners);
    const auto end = std::unique(owners.begin(), owners.end());
    for (auto owner = owners.begin(); owner != end; ++owner)
      pack(outbox.to(*owner),
           FacetNews<Dim>{face.ids,
                          id(split.place),
                          {split.number(face.sectors[0]), split.number(face.sectors[1])}});
  }

  static CrackFacet<Dim> without_copies(const std::array<std::int64_t, Dim>& places,
                                        std::int32_t tag) {
    CrackFacet<Dim> facet{places, {}, tag};
    for (auto& side : facet.copies) side.fill(kOriginal);
    return facet;
  }

  template <std::size_t n>
  std::array<std::int64_t, n> sorted_ids(const std::array<std::int64_t, n>& places) const {
    return ascending(places, [this](std::int64_t place) { return id(place); });
  }

  template <std::size_t n>
  std::size_t corner(const std::array<std::int64_t, n>& places, std::int64_t node) const {
    const auto found =
        std::ranges::find(places, node, [this](std::int64_t place) { return id(place); });
    return static_cast<std::size_t>(found - places.begin());
  }

  // Returns whether node i, by its memory index, lies on a curve or surface.
  bool may_be_split(std::int64_t i) const {
    if constexpr (Dim == 2)
      return level_.nodes.boundary_node(i) >= 0;
    else
      return level_.nodes.carrier(i) != Carrier::free;
  }

  // Keeps the numbers of the copies of ghosts.
  void note_copy(std::int64_t place, std::int64_t number) {
    if (number != kOriginal && place >= results_.count()) ghosts_.push_back({place, number});
  }

  void assemble_elements() {
    if (elements_.empty()) return;
    results_.for_elements([&](const std::array<std::int64_t, Dim + 1>& places) {
      if (std::ranges::none_of(
              places, [this](std::int64_t place) { return may_be_split(results_.node_at(place)); }))
        return;
      const auto news = those_with(elements_, sorted_ids(places));
      if (news.empty()) return;
      typename Cracks<Dim>::Element element{places, {}};
      element.copies.fill(kOriginal);
      for (const ElementNews<Dim>& one : news) {
        const std::size_t k = corner(places, one.id);
        element.copies[k] = one.number;
        note_copy(places[k], one.number);
      }
      cracks_.elements_.push_back(element);
    });
    std::ranges::sort(cracks_.elements_, {}, &Cracks<Dim>::Element::places);
  }

  void assemble_facets() {
    if (facets_.empty()) return;
    std::vector<CrackFacet<Dim>> others;
    results_.for_facets_without_tags([&](const std::array<std::int64_t, Dim>& places) {
      if (!news_of(places).empty() && !cracks_.facet(places))
        others.push_back(without_copies(places, 0));
    });
    cracks_.facets_.insert(cracks_.facets_.end(), others.begin(), others.end());
    std::ranges::sort(cracks_.facets_, {}, &CrackFacet<Dim>::places);
    for (CrackFacet<Dim>& facet : cracks_.facets_)
      for (const FacetNews<Dim>& one : news_of(facet.places)) {
        const std::size_t k = corner(facet.places, one.id);
        for (std::size_t side = 0; side < 2; ++side) {
          facet.copies[side][k] = one.numbers[side];
          note_copy(facet.places[k], one.numbers[side]);
        }
      }
  }
  auto news_of(const std::array<std::int64_t, Dim>& places) const {
    return those_with(facets_, sorted_ids(places));
  }

  // Lists the copies, and replaces their numbers by indices into the list.
  void list_copies() {
    std::vector<CrackCopy>& copies = cracks_.copies_;
    for (const Split& split : splits_)
      for (std::size_t sector = 1; sector < split.sectors.count; ++sector)
        copies.push_back({split.place, split.number(sector)});
    cracks_.owned_ = std::ssize(copies);
    std::ranges::sort(ghosts_, {}, &CrackCopy::number);
    for (const CrackCopy& copy : ghosts_)
      if (std::ssize(copies) == cracks_.owned_ || copies.back().number != copy.number)
        copies.push_back(copy);
    const auto own_end = copies.begin() + cracks_.owned_;
    const auto to_index = [&](std::int64_t& number) {
      if (number == kOriginal) return;
      auto found =
          std::ranges::lower_bound(copies.begin(), own_end, number, {}, &CrackCopy::number);
      if (found == own_end || found->number != number)
        found = std::ranges::lower_bound(own_end, copies.end(), number, {}, &CrackCopy::number);
      number = found - copies.begin();
    };
    for (auto& element : cracks_.elements_) std::ranges::for_each(element.copies, to_index);
    for (CrackFacet<Dim>& facet : cracks_.facets_)
      for (auto& side : facet.copies) std::ranges::for_each(side, to_index);
  }

  Results<Dim>& results_;
  const Level<Dim>& level_;
  const Communicator& comm_;
  const std::vector<std::int32_t>& tags_;
  Cracks<Dim> cracks_;
  std::vector<Split> splits_;  // in the order of their ids
  std::vector<ElementNews<Dim>> elements_;
  std::vector<FacetNews<Dim>> facets_;
  std::vector<CrackCopy> ghosts_;  // copies of ghosts, perhaps several times
};

template <int Dim>
Cracks<Dim> make_cracks(Results<Dim>& results, const std::vector<std::int32_t>& tags) {
  if (results.kind() == GeometryKind::surface)
    throw Error(ErrorKind::argument,
                "argument placement has surfaces alone, which have no inner surfaces for cracks");
  results.prepare_stars();
  return CrackMaker<Dim>(results, tags).make();
}

template Cracks<2> make_cracks(Results<2>&, const std::vector<std::int32_t>&);
template Cracks<3> make_cracks(Results<3>&, const std::vector<std::int32_t>&);

}  // namespace pnpbs
