// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/voronoi_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/counting_sort.hpp"
#include "results/results.hpp"
#include "voronoi/element_sites.hpp"
#include "voronoi/small_node_set.hpp"
#include "voronoi/sphere_parts.hpp"

namespace pnpbs {
namespace {

// The contributions of each element to the cells of its sites: a volume for each site, and a part
// of the face between each pair.
template <int Dim, std::size_t Corners>
class ElementParts {
 public:
  // Computes the rows of the other elements. `own` contains the rows of the first `owned` elements,
  // which were computed with their sites.
  ElementParts(const ElementSites<Dim>& all, ChunkedRows<double> own, std::int64_t owned)
      : owned_(owned), own_(std::move(own)) {
    arrived_.build("pnpbs::voronoi::parts", std::ssize(all.elements) - owned,
                   [&] { return Writer(all, owned); });
  }

  // Returns the row of an element (see pair_index).
  std::span<const double> of(std::int32_t element) const {
    return element < owned_ ? own_.row(element) : arrived_.row(element - owned_);
  }

 private:
  class Writer {
   public:
    Writer(const ElementSites<Dim>& all, std::int64_t first)
        : all_(all), first_(first), rows_(all.sphere_radius) {}

    void operator()(std::int64_t row, std::vector<double>& out) {
      x_.clear();
      for (const std::int32_t s : all_.of(all_.elements[static_cast<std::size_t>(first_ + row)]))
        x_.push_back(all_.x[static_cast<std::size_t>(s)]);
      divided_.set(x_);
      divided_.divide_among_corners();
      rows_.append(divided_, out);
    }

   private:
    const ElementSites<Dim>& all_;
    std::int64_t first_;
    PartRows<Dim, Corners> rows_;
    DividedElement<Dim, Corners> divided_;
    std::vector<Point<Dim>> x_;  // Positions of the sites.
  };

  std::int64_t owned_;
  ChunkedRows<double> own_, arrived_;
};

// For each owned node, the elements that have it as a site, and its index among their sites.
template <int Dim>
class ElementsOfSites {
 public:
  struct Entry {
    std::int32_t element, site;
  };

  ElementsOfSites(const ElementSites<Dim>& all, std::int64_t owned_nodes)
      : by_node_(static_cast<std::int64_t>(all.sites.size()),
                 static_cast<std::int32_t>(owned_nodes), key(all, owned_nodes)),
        entries_(static_cast<std::size_t>(by_node_.start().back())) {
    std::vector<Entry> entries(all.sites.size());
    for (std::size_t e = 0; e < all.elements.size(); ++e)
      for (std::int32_t s = 0; s < all.elements[e].sites; ++s)
        entries[static_cast<std::size_t>(all.elements[e].first_site + s)] = {
            static_cast<std::int32_t>(e), s};
    by_node_.for_places(key(all, owned_nodes), [&](std::int64_t s, std::int32_t place) {
      entries_[static_cast<std::size_t>(place)] = entries[static_cast<std::size_t>(s)];
    });
  }

  std::span<const Entry> at(std::int64_t node) const {
    const std::size_t n = static_cast<std::size_t>(node);
    const std::int32_t begin = by_node_.start()[n], end = by_node_.start()[n + 1];
    return std::span(entries_).subspan(static_cast<std::size_t>(begin),
                                       static_cast<std::size_t>(end - begin));
  }

 private:
  static auto key(const ElementSites<Dim>& all, std::int64_t owned_nodes) {
    return [&all, owned_nodes](std::int64_t s) {
      const std::int32_t node = all.sites[static_cast<std::size_t>(s)];
      return node < owned_nodes ? node : -1;
    };
  }

  CountingSort by_node_;
  std::vector<Entry> entries_;
};

// Largest face area that is attributed to rounding. [distance^(dim - 1)]
constexpr double kNoFace = 1e-12;

// Sorts and adds terms, so that the sum does not depend on their order.
double sum_by_size(std::vector<double>& terms) {
  std::ranges::sort(terms);
  double sum = 0;
  for (const double term : terms) sum += term;
  return sum;
}

template <int Dim>
struct CellFace {
  std::int32_t neighbour;
  double area;
  double distance;
  Point<Dim> normal;
};

// Assembles one cell after another from its parts in elements.
template <std::size_t Corners, int Dim>
class CellMaker {
 public:
  CellMaker(const ElementSites<Dim>& all, const ElementsOfSites<Dim>& at_nodes,
            const ElementParts<Dim, Corners>& parts, VoronoiCells& cells)
      : all_(all), at_nodes_(at_nodes), parts_(parts), cells_(cells) {}

  // Stores the volume and boundary of the cell of `node`, and appends its faces to `out`.
  void operator()(std::int64_t node, std::vector<CellFace<Dim>>& out) {
    volumes_.clear();
    faces_.clear();
    neighbours_.clear();
    for (auto& terms : boundary_) terms.clear();
    for (const auto& entry : at_nodes_.at(node))
      add_part(entry.element, static_cast<std::size_t>(entry.site));
    const std::size_t n = static_cast<std::size_t>(node);
    cells_.volumes[n] = sum_by_size(volumes_);
    cells_.at_boundary[n] = !boundary_[0].empty() || volumes_.empty();
    for (std::size_t k = 0; k < Dim; ++k) cells_.boundary[Dim * n + k] = sum_by_size(boundary_[k]);
    append_faces(all_.x[n], out);
  }

 private:
  struct FacePart {
    std::int32_t place;  // Index of the neighbour in neighbours_.
    double area;
  };

  // Returns the index of the neighbour in neighbours_, to which it is added if it is new.
  std::int32_t place_of(std::int32_t neighbour) {
    const std::int32_t place = index_among(neighbours_, neighbour);
    if (place >= 0) return place;
    neighbours_.push_back(neighbour);
    return static_cast<std::int32_t>(neighbours_.size()) - 1;
  }

  void add_part(std::int32_t number, std::size_t site) {
    const auto& element = all_.elements[static_cast<std::size_t>(number)];
    const auto sites = all_.of(element);
    const std::span<const double> parts = parts_.of(number);
    volumes_.push_back(parts[site]);
    for (std::size_t other = 0; other < sites.size(); ++other)
      if (other != site)
        if (const double area = parts[pair_index(sites.size(), site, other)]; area != 0)
          faces_.push_back({place_of(sites[other]), area});
    if (element.boundary == 0) return;
    x_.clear();
    for (const std::int32_t s : sites) x_.push_back(all_.x[static_cast<std::size_t>(s)]);
    divided_.set(x_);
    for (std::size_t k = 0; k < Corners; ++k)
      if (element.boundary >> k & 1U) add_boundary(k, site);
  }

  // Adds a part of the side opposite to corner k, whose height vector points inwards.
  void add_boundary(std::size_t k, std::size_t site) {
    if constexpr (Dim == 3 && Corners == 3)
      if (all_.sphere_radius > 0) return add_coast(k, site);
    const double area = divided_.part_of_side(k, site).measure();
    if (area == 0) return;
    const Point<Dim> inward = divided_.height(k);
    const double length = std::sqrt(dot(inward, inward));
    for (std::size_t c = 0; c < Dim; ++c) boundary_[c].push_back(-inward[c] / length * area);
  }

  // Adds the integral of the outward normal along the part of side k that is closest to the site,
  // on a sphere. The normal of a great circle is the same along the whole side.
  void add_coast(std::size_t k, std::size_t site) requires(Dim == 3 && Corners == 3) {
    const double length = all_.sphere_radius * arc_of(divided_.part_of_side(k, site).points());
    if (length == 0) return;
    const Point<3> normal = unit_vector(cross(x_[(k + 1) % 3], x_[(k + 2) % 3]));
    const double outward = dot(normal, x_[k]) > 0 ? -1 : 1;
    for (std::size_t c = 0; c < 3; ++c) boundary_[c].push_back(outward * normal[c] * length);
  }

  // Returns the length along the sphere between the ends of a chord.
  double along_sphere(double straight) const {
    return 2 * all_.sphere_radius * std::asin(std::min(1.0, straight / (2 * all_.sphere_radius)));
  }

  // Appends the faces in the order of the neighbours' ids.
  void append_faces(const Point<Dim>& x, std::vector<CellFace<Dim>>& out) {
    sort_areas();
    order_.resize(neighbours_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::sort(order_, {}, [&](std::size_t place) { return id(neighbours_[place]); });
    for (const std::size_t place : order_) {
      double area = 0;
      for (std::size_t k = place == 0 ? 0 : ends_[place - 1]; k < ends_[place]; ++k)
        area += areas_[k];
      const std::int32_t neighbour = neighbours_[place];
      const Point<Dim>& there = all_.x[static_cast<std::size_t>(neighbour)];
      const double straight = distance<Dim>(x, there);
      const double away = all_.sphere_radius > 0 ? along_sphere(straight) : straight;
      if (area <= kNoFace * std::pow(away, static_cast<int>(Corners) - 2)) continue;
      Point<Dim> normal;
      for (std::size_t k = 0; k < Dim; ++k) normal[k] = (there[k] - x[k]) / straight;
      out.push_back({neighbour, area, away, normal});
    }
  }
  // Groups the areas by neighbour and sorts each group by size.
  void sort_areas() {
    ends_.assign(neighbours_.size() + 1, 0);
    for (const FacePart& part : faces_) ++ends_[static_cast<std::size_t>(part.place) + 1];
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    areas_.resize(faces_.size());
    for (const FacePart& part : faces_)
      areas_[ends_[static_cast<std::size_t>(part.place)]++] = part.area;
    for (std::size_t place = 0, begin = 0; place < neighbours_.size(); begin = ends_[place++])
      std::sort(areas_.begin() + static_cast<std::ptrdiff_t>(begin),
                areas_.begin() + static_cast<std::ptrdiff_t>(ends_[place]));
  }
  std::int64_t id(std::int32_t node) const { return all_.ids[static_cast<std::size_t>(node)]; }

  const ElementSites<Dim>& all_;
  const ElementsOfSites<Dim>& at_nodes_;
  const ElementParts<Dim, Corners>& parts_;
  VoronoiCells& cells_;
  DividedElement<Dim, Corners> divided_;
  std::vector<Point<Dim>> x_;  // Positions of the sites of an element.
  std::vector<double> volumes_;
  std::array<std::vector<double>, Dim> boundary_;
  std::vector<FacePart> faces_;
  std::vector<std::int32_t> neighbours_;
  std::vector<double> areas_;              // Areas of parts, grouped by neighbour.
  std::vector<std::size_t> ends_, order_;  // Ends of the groups; neighbours by id.
};

// Reserves memory for all faces at once. Growing arrays would be copied and too large.
void reserve(std::size_t faces, VoronoiCells& cells) {
  for (auto* array : {&cells.ids, &cells.numbers}) array->reserve(faces);
  for (auto* array : {&cells.areas, &cells.distances}) array->reserve(faces);
  cells.normals.reserve(faces * static_cast<std::size_t>(cells.dimension));
  cells.offsets.reserve(cells.volumes.size() + 1);
}

template <int Dim>
void append(const ElementSites<Dim>& all, std::span<const CellFace<Dim>> faces,
            VoronoiCells& cells) {
  for (const CellFace<Dim>& face : faces) {
    const std::size_t n = static_cast<std::size_t>(face.neighbour);
    cells.ids.push_back(all.ids[n]);
    cells.numbers.push_back(all.numbers[n]);
    cells.areas.push_back(face.area);
    cells.distances.push_back(face.distance);
    cells.normals.insert(cells.normals.end(), face.normal.begin(), face.normal.end());
  }
  cells.offsets.push_back(static_cast<std::int64_t>(cells.ids.size()));
}

template <std::size_t Corners, int Dim>
std::unique_ptr<VoronoiCells> make(const Communicator& comm, const DistributedMesh& mesh,
                                   double sphere_radius = 0) {
  auto made = std::make_unique<VoronoiCells>();
  VoronoiCells& cells = *made;
  cells.dimension = Dim;
  ChunkedRows<double> own_parts;
  const ElementSites<Dim> all =
      find_element_sites<Corners, Dim>(comm, mesh, sphere_radius, own_parts);
  const ElementsOfSites<Dim> at_nodes(all, mesh.owned_nodes);
  const ElementParts<Dim, Corners> parts(all, std::move(own_parts), mesh.owned_elements);
  cells.volumes.resize(static_cast<std::size_t>(mesh.owned_nodes));
  cells.boundary.resize(static_cast<std::size_t>(Dim * mesh.owned_nodes));
  cells.at_boundary.resize(static_cast<std::size_t>(mesh.owned_nodes));
  ChunkedRows<CellFace<Dim>> faces;
  faces.build("pnpbs::voronoi::cells", mesh.owned_nodes,
              [&] { return CellMaker<Corners, Dim>(all, at_nodes, parts, cells); });
  std::size_t count = 0;
  for (std::int64_t node = 0; node < mesh.owned_nodes; ++node) count += faces.row(node).size();
  reserve(count, cells);
  for (std::int64_t node = 0; node < mesh.owned_nodes; ++node)
    append<Dim>(all, std::as_const(faces).row(node), cells);
  return made;
}

}  // namespace

std::unique_ptr<VoronoiCells> make_voronoi_cells(NodalResults& results) {
  const std::unique_ptr<DistributedMesh> mesh = make_distributed_mesh(results, 1);
  const Communicator& comm = results.communicator();
  if (mesh->dimension == 2) return make<3, 2>(comm, *mesh);
  if (results.dimension() == 2) return make<3, 3>(comm, *mesh, results.sphere_radius());
  if (mesh->corners == 3) return make<3, 3>(comm, *mesh);
  return make<4, 3>(comm, *mesh);
}

}  // namespace pnpbs
