// SPDX-License-Identifier: BSD-3-Clause
// Tests meshes distributed over ranks against the same placement on one rank. Each element belongs
// to one rank. Ghost layers, facets and the ranks that share a node equal those found by a search
// over all elements. The test uses the public interface only. Usage: distributed_mesh
#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh_parts.hpp"

namespace {

Ids sorted(Ids ids) {
  std::ranges::sort(ids);
  return ids;
}

// ------------------------------------------------------------------ regions --------------------

pnpbs_status plane_with_regions(pnpbs_domain domain, const char*) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, inside[] = {0.3, 0.3, 0.8, 0.4, 0.5, 0.8},
               in_both[][2] = {{0.5, 0.5}, {0.1, 0.1}};
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0);
  pnpbs_domain_add_polyline(domain, PNPBS_INNER, 1, 3, inside, nullptr, 0);
  pnpbs_domain_add_region(domain, in_both[0], 11);
  return pnpbs_domain_add_region(domain, in_both[1], -4);
}

pnpbs_status two_boxes(pnpbs_domain domain, const char*) {
  const double corners[4][3] = {{0, 0, 0}, {0.8, 1, 1}, {1.2, 0, 0}, {2, 1, 1}},
               in[] = {1.5, 0.5, 0.5};
  pnpbs_domain_add_box(domain, corners[0], corners[1], 1);
  pnpbs_domain_add_box(domain, corners[2], corners[3], 2);
  return pnpbs_domain_add_region(domain, in, 8);
}

const Case kRegionCases[] = {{"regions of a plane", 2, plane_with_regions, 0.05},
                             {"two boxes", 3, two_boxes, 0.2}};

// ------------------------------------------------------------------ reference ------------------

struct Reference {
  struct Facet {
    std::int32_t tag;
    std::vector<Ids> elements;  // sorted ids of their corners
  };
  std::int32_t dim = 0, corners = 0;
  std::map<std::int64_t, std::pair<std::vector<double>, std::int32_t>> nodes;  // by id: x, tag
  std::map<Ids, std::int32_t> elements;                                        // and their tags
  std::map<Ids, Facet> facets;
};

using Getter = pnpbs_status (*)(pnpbs_placement, std::int64_t, std::int64_t*, std::int64_t*,
                                std::int32_t*);
template <class Visit>
void for_rows(pnpbs_placement p, const Ids& ids, std::size_t width, const Getter& get,
              const Visit& visit) {
  std::int64_t n = 0;
  expect(get(p, 0, &n, nullptr, nullptr) == PNPBS_OK, "count");
  Ids rows(width * static_cast<std::size_t>(n) + 1);
  std::vector<std::int32_t> tags(static_cast<std::size_t>(n) + 1);
  expect(get(p, n, &n, rows.data(), tags.data()) == PNPBS_OK, "rows");
  for (std::size_t r = 0; r < static_cast<std::size_t>(n); ++r) {
    Ids row;
    for (std::size_t k = 0; k < width; ++k)
      row.push_back(ids[static_cast<std::size_t>(rows[width * r + k])]);
    visit(sorted(row), tags[r]);
  }
}
pnpbs_status triangles(pnpbs_placement p, std::int64_t capacity, std::int64_t* n,
                       std::int64_t* rows, std::int32_t* tags) {
  if (tags) pnpbs_placement_get_element_tags(p, capacity, n, tags);
  return pnpbs_placement_get_triangles(p, capacity, n, rows);
}
pnpbs_status tetrahedra(pnpbs_placement p, std::int64_t capacity, std::int64_t* n,
                        std::int64_t* rows, std::int32_t* tags) {
  if (tags) pnpbs_placement_get_element_tags(p, capacity, n, tags);
  return pnpbs_placement_get_tetrahedra(p, capacity, n, rows);
}

// Calls visit(ids of a side, id of the opposite corner) for the sides of an element.
template <class Visit>
void for_sides(const Ids& element, const Visit& visit) {
  for (std::size_t k = 0; k < element.size(); ++k) {
    Ids side = element;
    side.erase(side.begin() + static_cast<std::ptrdiff_t>(k));
    visit(side, element[k]);
  }
}

Reference reference_of(const Case& it) {
  pnpbs_context serial;
  expect(pnpbs_context_create_serial(&serial) == PNPBS_OK, "context of one rank");
  pnpbs_placement p = placed(it, serial);
  Reference all;
  all.dim = it.dim;
  std::int64_t n = 0, n_tetrahedra = 0;
  pnpbs_placement_count(p, &n);
  const auto room = static_cast<std::size_t>(n);
  std::vector<double> x(room * static_cast<std::size_t>(it.dim));
  Ids ids(room);
  std::vector<std::int32_t> tags(room);
  expect(pnpbs_placement_get_nodes(p, n, x.data(), ids.data(), tags.data(), nullptr) == PNPBS_OK,
         "nodes");
  for (std::size_t i = 0; i < room; ++i) {
    const auto at = x.begin() + static_cast<std::ptrdiff_t>(i) * it.dim;
    all.nodes[ids[i]] = {std::vector<double>(at, at + it.dim), tags[i]};
  }
  const auto add_element = [&](const Ids& corners, std::int32_t tag) {
    all.elements[corners] = tag;
  };
  const auto add_facet = [&](const Ids& corners, std::int32_t tag) {
    all.facets[corners].tag = tag;
  };
  if (it.dim == 3) pnpbs_placement_get_tetrahedra(p, 0, &n_tetrahedra, nullptr);
  all.corners = n_tetrahedra > 0 ? 4 : 3;
  if (it.dim == 2) {
    for_rows(p, ids, 3, triangles, add_element);
    for_rows(p, ids, 2, pnpbs_placement_get_boundary_edges, add_facet);
  } else if (all.corners == 4) {
    for_rows(p, ids, 4, tetrahedra, add_element);
    for_rows(p, ids, 3, pnpbs_placement_get_boundary_triangles, add_facet);
  } else {
    for_rows(p, ids, 3, pnpbs_placement_get_boundary_triangles, add_element);
  }
  // The placement returns neither the facets of the wall nor the edges of open surfaces, so the
  // reference finds them from the elements.
  const auto in_wall = [&](std::int64_t id) {
    const std::vector<double>& x = all.nodes[id].first;
    return x[0] == 1 && std::min(x[1], x[2]) > 0.199 && std::max(x[1], x[2]) < 0.801;
  };
  std::map<Ids, std::vector<Ids>> sides;
  for (const auto& element : all.elements)
    for_sides(element.first,
              [&](const Ids& side, std::int64_t) { sides[side].push_back(element.first); });
  for (const auto& [side, elements] : sides) {
    if (it.body == walled_box && std::ranges::all_of(side, in_wall)) all.facets[side].tag = kWall;
    if (all.corners == it.dim && elements.size() == 1)
      all.facets[side].tag = all.elements.at(elements[0]);
    if (all.facets.contains(side)) all.facets[side].elements = elements;
  }
  pnpbs_placement_destroy(&p);
  pnpbs_context_destroy(&serial);
  return all;
}

// ------------------------------------------------------------------ over all ranks -------------

// The owner and number of each node and element, gathered from all ranks.
struct Owned {
  std::int64_t number;
  std::int32_t rank;
};
struct Owners {
  std::map<std::int64_t, Owned> node;
  std::map<Ids, Owned> element;

  explicit Owners(const Part& p) {
    Ids rows;
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.owned_nodes); ++i)
      rows.insert(rows.end(), {p.ids[i], p.numbers[i], rank});
    const Ids all = gathered(rows);
    for (std::size_t k = 0; k < all.size(); k += 3)
      expect(node.insert({all[k], {all[k + 1], static_cast<std::int32_t>(all[k + 2])}}).second,
             "a node has one owner");
    rows.clear();
    for (std::int64_t e = 0; e < p.owned_elements; ++e) {
      const Ids corners = sorted(p.element(e));
      rows.insert(rows.end(), corners.begin(), corners.end());
      rows.insert(rows.end(), {p.element_numbers[static_cast<std::size_t>(e)], rank});
    }
    const Ids elements = gathered(rows);
    for (auto at = elements.begin(); at != elements.end(); at += p.corners + 2)
      expect(element
                 .insert({Ids(at, at + p.corners),
                          {at[p.corners], static_cast<std::int32_t>(at[p.corners + 1])}})
                 .second,
             "an element has one owner");
  }
};

// ------------------------------------------------------------------ checks ---------------------

void check_nodes(const Part& p, const Reference& all, const Owners& owners) {
  expect(p.all_nodes == static_cast<std::int64_t>(all.nodes.size()), "number of nodes");
  expect(owners.node.size() == all.nodes.size(), "all nodes are owned");
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.nodes); ++i) {
    const auto owned = owners.node.find(p.ids[i]);
    const auto one = all.nodes.find(p.ids[i]);
    if (one == all.nodes.end() || owned == owners.node.end())
      return expect(false, "a node of one rank");
    const bool mine = static_cast<std::int64_t>(i) < p.owned_nodes;
    expect((p.owners[i] == rank) == mine, "owned nodes come first");
    expect(p.owners[i] == owned->second.rank, "owner of a node");
    expect(p.numbers[i] == owned->second.number, "number of a node");
    expect(!mine || p.numbers[i] == p.first_node + static_cast<std::int64_t>(i), "they count up");
    expect(
        i == 0 || static_cast<std::int64_t>(i) == p.owned_nodes || p.numbers[i - 1] < p.numbers[i],
        "nodes by number");
    expect(p.tags[i] == one->second.second, "tag of a node");
    for (std::size_t k = 0; k < static_cast<std::size_t>(p.dim); ++k)
      expect(p.x[i * static_cast<std::size_t>(p.dim) + k] == one->second.first[k], "position");
  }
}

double measure(const Reference& all, const Ids& corners) {
  double side[3][3] = {};
  for (std::size_t k = 1; k < corners.size(); ++k)
    for (std::size_t c = 0; c < static_cast<std::size_t>(all.dim); ++c)
      side[k - 1][c] = all.nodes.at(corners[k]).first[c] - all.nodes.at(corners[0]).first[c];
  if (all.dim == 2) return side[0][0] * side[1][1] - side[0][1] * side[1][0];
  if (corners.size() == 3) return 1;
  return side[0][0] * (side[1][1] * side[2][2] - side[1][2] * side[2][1]) +
         side[0][1] * (side[1][2] * side[2][0] - side[1][0] * side[2][2]) +
         side[0][2] * (side[1][0] * side[2][1] - side[1][1] * side[2][0]);
}

// Returns the elements of this rank and of its ghost layers, by a search over all elements.
std::set<Ids> expected_elements(const Reference& all, const Owners& owners, int layers) {
  std::set<Ids> here;
  std::set<std::int64_t> front;
  for (const auto& [id, owned] : owners.node)
    if (owned.rank == rank) front.insert(id);
  for (const auto& [corners, owned] : owners.element)
    if (owned.rank == rank) {
      here.insert(corners);
      front.insert(corners.begin(), corners.end());
    }
  for (int layer = 0; layer < layers; ++layer) {
    for (const auto& [corners, tag] : all.elements)
      if (std::ranges::any_of(corners, [&](auto id) { return front.contains(id); }))
        here.insert(corners);
    for (const Ids& corners : here) front.insert(corners.begin(), corners.end());
  }
  return here;
}

void check_elements(const Part& p, const Reference& all, const Owners& owners, int layers) {
  expect(p.corners == all.corners, "corners");
  expect(p.all_elements == static_cast<std::int64_t>(all.elements.size()), "number of elements");
  std::set<Ids> here;
  std::set<std::int64_t> used;
  for (std::int64_t e = 0; e < p.elements; ++e) {
    const auto k = static_cast<std::size_t>(e);
    const Ids corners = p.element(e), key = sorted(corners);
    const auto owned = owners.element.find(key);
    if (!all.elements.contains(key) || owned == owners.element.end())
      return expect(false, "an element of one rank");
    here.insert(key);
    used.insert(key.begin(), key.end());
    const bool mine = e < p.owned_elements;
    expect(corners[0] == key[0], "the lowest id comes first");
    expect(p.element_owners[k] == owners.node.at(key[0]).rank, "rule of ownership");
    expect((p.element_owners[k] == rank) == mine, "owned elements come first");
    expect(p.element_numbers[k] == owned->second.number, "number of an element");
    expect(!mine || p.element_numbers[k] == p.first_element + e, "they count up");
    if (e > 0 && e < p.owned_elements)
      expect(p.element(e - 1) < p.element(e), "owned elements by the ids of their corners");
    expect(p.element_tags[k] == all.elements.at(key), "tag of an element");
    expect(measure(all, corners) > 0, "orientation");
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const std::size_t at = k * corners.size() + c;
      expect(p.connectivity[at] == owners.node.at(corners[c]).number, "numbers at corners");
      expect(p.connectivity32[at] == p.connectivity[at], "the same in 32 bits");
    }
  }
  expect(here == expected_elements(all, owners, layers), "elements and ghost layers");
  expect(static_cast<std::int64_t>(here.size()) == p.elements, "each element once");
  for (std::int64_t i = p.owned_nodes; i < p.nodes; ++i)
    expect(used.contains(p.ids[static_cast<std::size_t>(i)]), "other nodes are needed");
}

void check_facets(const Part& p, const Reference& all, const Owners& owners) {
  std::set<Ids> here, found;
  std::map<Ids, std::int64_t> local;
  std::int64_t owned = 0;
  for (std::int64_t e = 0; e < p.elements; ++e) {
    local[sorted(p.element(e))] = e;
    for_sides(sorted(p.element(e)), [&](const Ids& side, std::int64_t) {
      if (all.facets.contains(side)) here.insert(side);
    });
  }
  for (std::int64_t f = 0; f < p.facets; ++f) {
    const auto k = static_cast<std::size_t>(f);
    const Ids key = sorted(p.facet(f));
    const auto one = all.facets.find(key);
    if (one == all.facets.end()) return expect(false, "a facet of one rank");
    found.insert(key);
    owned += p.facet_owners[k] == rank;
    expect(p.facet_tags[k] == one->second.tag, "tag of a facet");
    expect(p.facet_inner[k] == (one->second.elements.size() == 2), "is it an inner facet?");
    std::set<std::int32_t> expected;
    std::vector<std::pair<std::int64_t, std::int32_t>> by_number;
    for (const Ids& element : one->second.elements) {
      by_number.push_back({owners.element.at(element).number, owners.element.at(element).rank});
      if (local.contains(element)) expected.insert(static_cast<std::int32_t>(local.at(element)));
    }
    expect(p.facet_owners[k] == std::ranges::min(by_number).second, "owner of a facet");
    std::set<std::int32_t> told{p.facet_elements[2 * k]};
    if (p.facet_elements[2 * k + 1] >= 0) told.insert(p.facet_elements[2 * k + 1]);
    expect(told == expected, "elements at a facet");
    Ids element = p.element(p.facet_elements[2 * k]);
    element.erase(element.begin() + p.facet_opposite[k]);
    expect(sorted(element) == key, "the corner opposite to a facet");
  }
  expect(found == here && static_cast<std::int64_t>(found.size()) == p.facets, "facets");
  MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPI_INT64_T, MPI_SUM, group);
  expect(owned == static_cast<std::int64_t>(all.facets.size()), "each facet has one owner");
}

// Checks that triangles of the boundary are counter-clockwise as seen from outside, that is, from
// the side opposite to the fourth corner of the element.
void check_orientation_of_facets(const Part& p, const Reference& all) {
  for (std::int64_t f = 0; f < p.facets && p.corners == 4; ++f) {
    const auto k = static_cast<std::size_t>(f);
    if (p.facet_inner[k]) continue;
    Ids corners = p.facet(f);
    const Ids element = p.element(p.facet_elements[2 * k]);
    corners.push_back(element[static_cast<std::size_t>(p.facet_opposite[k])]);
    expect(measure(all, corners) < 0, "orientation of a facet");
  }
}

void check_sharing(const Part& p, const Owners& owners) {
  std::map<std::int64_t, std::set<std::int32_t>> all, mine;
  for (const auto& [id, owned] : owners.node) all[id].insert(owned.rank);
  for (const auto& [corners, owned] : owners.element)
    for (const std::int64_t id : corners) all[id].insert(owned.rank);
  for (const auto& [id, ranks] : all)
    if (ranks.size() > 1 && ranks.contains(rank)) {
      mine[id] = ranks;
      mine[id].erase(rank);
    }
  std::map<std::int64_t, std::set<std::int32_t>> told;
  for (std::size_t k = 0; k < static_cast<std::size_t>(p.shared); ++k) {
    const auto node = static_cast<std::size_t>(p.shared_nodes[k]);
    for (std::int64_t s = p.sharing_offsets[k]; s < p.sharing_offsets[k + 1]; ++s)
      told[p.ids[node]].insert(p.sharing_ranks[static_cast<std::size_t>(s)]);
  }
  expect(told == mine, "who shares a node");
}

void check_case(const Case& it) {
  const int before = failures;
  const Reference all = reference_of(it);
  pnpbs_placement placement = placed(it, context);
  for (int layers = 0; layers <= 3; ++layers) {
    pnpbs_mesh mesh;
    expect(pnpbs_mesh_create(placement, layers, &mesh) == PNPBS_OK, "mesh");
    if (layers == 3) pnpbs_placement_destroy(&placement);
    const Part p = part_of(mesh);
    const Owners owners(p);
    check_nodes(p, all, owners);
    check_elements(p, all, owners, layers);
    check_facets(p, all, owners);
    check_orientation_of_facets(p, all);
    check_sharing(p, owners);
    expect(pnpbs_mesh_destroy(&mesh) == PNPBS_OK && !mesh, "destroy");
  }
  if (rank == 0)
    std::printf("%s: %zu nodes, %zu elements, %zu facets%s\n", it.name, all.nodes.size(),
                all.elements.size(), all.facets.size(), failures > before ? ": WRONG" : "");
}

// Checks that an error on one rank is an error on all.
void check_errors() {
  pnpbs_placement placement;
  pnpbs_domain domain = unit_domain(2);
  pnpbs_mesh mesh;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  expect(pnpbs_mesh_create(placement, 0, &mesh) == PNPBS_ERROR_STATE && !mesh, "no nodes yet");
  pnpbs_placement_set_spacing_constant(placement, 0.2);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect(pnpbs_mesh_create(placement, -1, &mesh) == PNPBS_ERROR_ARGUMENT, "too few layers");
  expect(strstr(pnpbs_last_error(context), "ghost_layers = -1; there can be 0 .. 16") != nullptr,
         "they are told");
  expect(pnpbs_mesh_create(placement, 17, &mesh) == PNPBS_ERROR_ARGUMENT, "too many layers");
  if (size > 1) {
    expect(pnpbs_mesh_create(placement, rank == 1, &mesh) == PNPBS_ERROR_ARGUMENT, "other layers");
    expect(pnpbs_mesh_create(placement, 0, rank == 1 ? nullptr : &mesh) == PNPBS_ERROR_ARGUMENT,
           "no place for the handle");
  }
  expect(pnpbs_mesh_create(placement, 0, &mesh) == PNPBS_OK, "mesh");
  Part p = part_of(mesh);
  if (p.nodes > 0)
    expect(pnpbs_mesh_get_nodes(mesh, p.nodes - 1, p.x.data(), nullptr, nullptr, nullptr,
                                nullptr) == PNPBS_ERROR_CAPACITY,
           "too small");
  if (p.elements > 0)
    expect(pnpbs_mesh_get_connectivity(mesh, p.elements, nullptr) == PNPBS_ERROR_ARGUMENT, "NULL");
  pnpbs_mesh dead = mesh;
  expect(pnpbs_mesh_destroy(&mesh) == PNPBS_OK && !mesh && pnpbs_mesh_destroy(&mesh) == PNPBS_OK,
         "destroy");
  expect(pnpbs_mesh_sizes(dead, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr) ==
             PNPBS_ERROR_HANDLE,
         "a handle that is not live");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

void check_all() {
  for (const Case& it : kCases) check_case(it);
  for (const Case& it : kRegionCases) check_case(it);
  check_errors();
}

}  // namespace

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
