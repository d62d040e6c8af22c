// SPDX-License-Identifier: BSD-3-Clause
// Tests the partitioned files of a mesh against its arrays. Each rank reads its own file, and
// common properties of the files are compared over all ranks. Also tests errors on one rank. Usage:
// mesh_files
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "msh_part_reader.hpp"

namespace {

namespace fs = std::filesystem;

// ------------------------------------------------------------------ regions --------------------

// Adds a square of three parts: the middle has one tag and the left part another.
pnpbs_status plane_with_regions(pnpbs_domain domain, const char*) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, left[] = {0.4, 0, 0.4, 1},
               right[] = {0.6, 0, 0.6, 1}, in_left[] = {0.1, 0.1}, between[] = {0.5, 0.5};
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0);
  pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 2, left, nullptr, 0);
  pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 2, right, nullptr, 0);
  pnpbs_domain_set_tag_name(domain, 2, 9, "middle");
  pnpbs_domain_add_region(domain, between, 9);
  return pnpbs_domain_add_region(domain, in_left, 1);
}

// Adds a box within a box, with a region for every element.
pnpbs_status box_in_box(pnpbs_domain domain, const char*) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  const double corners[8][3] = {{.3, .3, .3}, {.7, .3, .3}, {.3, .7, .3}, {.7, .7, .3},
                                {.3, .3, .7}, {.7, .3, .7}, {.3, .7, .7}, {.7, .7, .7}};
  const std::int64_t sides[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                                     {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                     {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  const double inner[] = {0.5, 0.5, 0.5}, outer[] = {0.1, 0.5, 0.5};
  pnpbs_domain_add_box(domain, low, high, 1);
  pnpbs_domain_add_surface(domain, PNPBS_INNER, 8, corners[0], 12, sides[0], nullptr, 40);
  pnpbs_domain_add_region(domain, inner, 4);
  return pnpbs_domain_add_region(domain, outer, 3);
}

const Case kRegions[] = {{"regions", 2, plane_with_regions, 0.05},
                         {"box in box", 3, box_in_box, 0.17}};

// ------------------------------------------------------------------ against the mesh -----------

// Returns whether the group of an entity stands for this tag. Groups cannot be negative, so
// negative tags are part of the name.
bool is_of_tag(const File& file, const Entity& entity, std::int32_t tag) {
  const std::int64_t number = file.parts.at(entity).group;
  if (tag > 0) return number == tag;
  return file.names.at({entity[0], number}) == "\"tag_" + std::to_string(tag) + "\"";
}

// Returns whether the group is that of the inside without a region or tag.
bool is_of_inside(const File& file, const Entity& entity) {
  const std::string& name = file.names.at({entity[0], file.parts.at(entity).group});
  return !name.starts_with("\"region_") && !name.starts_with("\"tag_") && name != "\"middle\"";
}

// An inner node belongs to the region of its elements. Only owned elements are checked, since a
// ghost does not have all of its elements here.
void check_regions_of_nodes(const File& file, const Part& p) {
  for (std::int64_t k = 0; k < p.owned_elements * p.corners; ++k) {
    const auto node = static_cast<std::size_t>(p.element_nodes[static_cast<std::size_t>(k)]);
    const std::int32_t tag = p.element_tags[static_cast<std::size_t>(k / p.corners)];
    if (p.tags[node] != 0 || tag == 0) continue;
    expect(is_of_tag(file, file.nodes.at(p.numbers[node] + 1).entity, tag),
           "a node is with its region");
  }
}

void check_nodes(const File& file, const Part& p) {
  expect(static_cast<std::int64_t>(file.nodes.size()) == p.nodes, "all nodes of the mesh");
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.nodes); ++i) {
    const auto found = file.nodes.find(p.numbers[i] + 1);
    if (found == file.nodes.end()) return expect(false, "nodes have their numbers");
    const FileNode& node = found->second;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto dim = static_cast<std::size_t>(p.dim);
      expect(node.x[k] == (k < dim ? p.x[dim * i + k] : 0), "nodes are where they are");
    }
    expect(file.parts.at(node.entity).partition == p.owners[i] + 1, "owner of a node");
    const bool inside = p.tags[i] == 0;
    expect(node.entity[0] == p.corners - (inside || p.corners == p.dim ? 1 : 2),
           "nodes with a tag are in the boundary");
    expect(inside || is_of_tag(file, node.entity, p.tags[i]), "a node is with its tag");
  }
}

Ids from_one(const Ids& numbers) {
  Ids shifted = numbers;
  for (std::int64_t& number : shifted) ++number;
  return shifted;
}

void check_elements(const File& file, const Part& p) {
  std::int64_t in_file = 0, ghosts = 0;
  for (const auto& entry : file.elements) in_file += entry.second.entity[0] == p.corners - 1;
  expect(in_file == p.elements, "all elements of the mesh");
  for (std::int64_t e = 0; e < p.elements; ++e) {
    const auto k = static_cast<std::size_t>(e);
    const std::int64_t number = p.element_numbers[k] + 1;
    const auto found = file.elements.find(number);
    if (found == file.elements.end()) return expect(false, "elements have their numbers");
    const FileElement& element = found->second;
    const auto first = p.connectivity.begin() + e * p.corners;
    expect(element.corners == from_one(Ids(first, first + p.corners)), "corners of an element");
    const bool is_ghost = p.element_owners[k] != rank;
    const auto ghost = file.ghosts.find(number);
    expect((ghost != file.ghosts.end()) == is_ghost, "is it a ghost?");
    if (!is_ghost) {
      expect(file.parts.at(element.entity).partition == rank + 1, "its owner");
      if (const std::int32_t tag = p.element_tags[k]; tag != 0)
        expect(is_of_tag(file, element.entity, tag), "tag of an element");
      else
        expect(is_of_inside(file, element.entity), "an element without a region");
      continue;
    }
    expect(file.ghost_entities.contains(element.entity[1]), "ghosts have an entity");
    if (ghost == file.ghosts.end()) continue;
    ++ghosts;
    expect(ghost->second.first == p.element_owners[k] + 1, "partition of a ghost");
    expect(ghost->second.second == Ids{rank + 1}, "whose ghost it is");
  }
  expect(ghosts == static_cast<std::int64_t>(file.ghosts.size()), "ghosts are elements here");
  expect(file.has_ghosts == (ghosts > 0), "ghosts only where there are any");
  expect(file.ghost_entities.size() == (ghosts > 0 ? 1U : 0U), "an entity of ghosts");
  for (const auto& entry : file.ghost_entities) {
    expect(entry.second == rank + 1, "partition of the ghosts");
    const Entity as_entity{p.corners - 1, entry.first};
    expect(!file.entities.contains(as_entity) && !file.parts.contains(as_entity),
           "the number of the ghosts' entity is free");
  }
}

// Checks the facets and returns the numbers of this rank's.
Ids check_facets(const File& file, const Part& p) {
  std::map<Ids, std::int32_t> owned;
  for (std::int64_t f = 0; f < p.facets; ++f) {
    if (p.facet_owners[static_cast<std::size_t>(f)] != rank) continue;
    Ids corners;
    for (std::int64_t k = f * (p.corners - 1); k < (f + 1) * (p.corners - 1); ++k)
      corners.push_back(
          p.numbers[static_cast<std::size_t>(p.facet_nodes[static_cast<std::size_t>(k)])] + 1);
    owned[corners] = p.facet_tags[static_cast<std::size_t>(f)];
  }
  Ids numbers;
  for (const auto& entry : file.elements) {
    const FileElement& facet = entry.second;
    if (facet.entity[0] != p.corners - 2) continue;
    numbers.push_back(entry.first);
    const auto found = owned.find(facet.corners);
    if (found == owned.end()) {
      expect(false, "a facet that this rank owns, in its orientation");
      continue;
    }
    expect(is_of_tag(file, facet.entity, found->second), "tag of a facet");
    expect(file.parts.at(facet.entity).partition == rank + 1, "owner of a facet");
  }
  expect(numbers.size() == owned.size(), "all facets that this rank owns");
  return numbers;
}

// Expects that the numbers from `first` on occur once each over all ranks.
void expect_counting(const Ids& mine, std::int64_t first, const char* what) {
  Ids all = gathered(mine);
  std::ranges::sort(all);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k] != first + static_cast<std::int64_t>(k)) return expect(false, what);
}

void check_all_files(const File& file, const Part& p, const Ids& facets) {
  Ids nodes, elements, parts, entities;
  for (const auto& entry : file.nodes)
    if (file.parts.at(entry.second.entity).partition == rank + 1) nodes.push_back(entry.first);
  for (const auto& entry : file.elements)
    if (entry.second.entity[0] == p.corners - 1 && !file.ghosts.contains(entry.first))
      elements.push_back(entry.first);
  expect_counting(nodes, 1, "a node is owned in one file");
  expect_counting(elements, 1, "an element is no ghost in one file");
  expect_counting(facets, p.all_elements + 1, "facets are numbered behind all elements");
  for (const auto& entry : file.parts)
    parts.insert(parts.end(),
                 {entry.first[0], entry.first[1], entry.second.parent[1], entry.second.partition});
  std::map<std::array<std::int64_t, 3>, std::int64_t> numbers;
  std::map<Entity, std::array<std::int64_t, 2>> meanings;
  const Ids all = gathered(parts);
  for (std::size_t k = 0; k < all.size(); k += 4) {
    const std::int64_t number = all[k + 1];
    expect(
        numbers.emplace(std::array{all[k], all[k + 2], all[k + 3]}, number).first->second == number,
        "a part has one number in all files");
    expect(meanings.emplace(Entity{all[k], number}, std::array{all[k + 2], all[k + 3]})
                   .first->second == std::array{all[k + 2], all[k + 3]},
           "a number stands for one part in all files");
  }
  for (const auto& entry : file.entities)
    entities.insert(entities.end(), {entry.first[0], entry.first[1], entry.second});
  const Ids of_all = gathered(entities);
  for (std::size_t k = 0; k < of_all.size(); ++k)
    expect(of_all[k] == entities[k % entities.size()], "all files have the same entities");
}

// Checks that names are quoted.
void check_names(const File& file, const Case& it) {
  const auto is_named = [&](const Entity& entity, const char* name) {
    const auto found = file.names.find(entity);
    expect(found != file.names.end() && found->second == name, name);
  };
  if (it.body == plane_with_curve) {
    is_named({1, 5}, "\"outline\"");
    is_named({1, 7}, "\"tag_7\"");
    is_named({2, 3}, "\"water\"");
    expect(file.names.size() == 4, "groups of the plane");
  }
  if (it.body == walled_box) {
    is_named({2, kWall}, "\"tag_2\"");
    is_named({3, 1}, "\"domain\"");
  }
  if (it.body == plane_with_regions) {
    is_named({2, 1}, "\"region_1\"");
    is_named({2, 9}, "\"middle\"");
    is_named({2, 2}, "\"domain\"");
    expect(file.names.size() == 4, "groups of regions");
  }
  if (it.body == box_in_box) {
    is_named({3, 3}, "\"region_3\"");
    is_named({3, 4}, "\"region_4\"");
    expect(file.names.size() == 3, "no group of elements without a region");
  }
  if (it.body == surface_halves) {
    is_named({2, 1}, "\"tag_1\"");
    is_named({2, 2}, "\"tag_2\"");
  }
}

std::string own_path(const std::string& prefix) {
  return prefix + "_" + std::to_string(rank + 1) + ".msh";
}

void check_case(const Case& it, const std::string& prefix) {
  const int before = failures;
  std::int64_t counts[4] = {};
  pnpbs_placement placement = placed(it, context);
  for (int layers = 0; layers <= 2; ++layers) {
    pnpbs_mesh mesh;
    expect(pnpbs_mesh_create(placement, layers, &mesh) == PNPBS_OK, "mesh");
    expect(pnpbs_mesh_write(mesh, prefix.c_str()) == PNPBS_OK, "write");
    const File file(own_path(prefix));
    const Part p = part_of(mesh);
    expect(file.partitions == size, "one partition for each rank");
    check_nodes(file, p);
    check_elements(file, p);
    check_regions_of_nodes(file, p);
    const Ids facets = check_facets(file, p);
    check_all_files(file, p, facets);
    check_names(file, it);
    pnpbs_mesh_destroy(&mesh);
    counts[0] = p.all_nodes;
    counts[1] = p.all_elements;
    counts[2] = static_cast<std::int64_t>(gathered(facets).size());
    if (layers == 1) counts[3] = static_cast<std::int64_t>(file.ghosts.size());
  }
  pnpbs_placement_destroy(&placement);
  MPI_Allreduce(MPI_IN_PLACE, &counts[3], 1, MPI_INT64_T, MPI_SUM, group);
  if (rank == 0)
    std::printf("%s: %lld nodes, %lld elements, %lld facets, %lld ghosts%s\n", it.name,
                static_cast<long long>(counts[0]), static_cast<long long>(counts[1]),
                static_cast<long long>(counts[2]), static_cast<long long>(counts[3]),
                failures > before ? ": WRONG" : "");
}

// ------------------------------------------------------------------ errors ---------------------

void expect_error(pnpbs_mesh mesh, const char* prefix, pnpbs_status status, const char* part) {
  expect(pnpbs_mesh_write(mesh, prefix) == status, part);
  expect(strstr(pnpbs_last_error(context), part) != nullptr, part);
}

std::string contents(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Checks that an error on one rank is an error on all, and changes no file.
void check_errors(const std::string& folder) {
  const std::string prefix = folder + "/old", other = folder + "/new";
  pnpbs_domain domain = unit_domain(2);
  pnpbs_placement placement;
  pnpbs_mesh mesh;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_spacing_constant(placement, 0.2);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect(pnpbs_mesh_create(placement, 1, &mesh) == PNPBS_OK, "mesh");
  const int last = size - 1;
  expect_error(mesh, rank == last ? nullptr : prefix.c_str(), PNPBS_ERROR_ARGUMENT,
               "argument prefix is NULL");
  expect_error(mesh, rank == last ? "" : prefix.c_str(), PNPBS_ERROR_ARGUMENT,
               "argument prefix is empty; the files are named prefix_1.msh");
  if (size > 1)
    expect_error(mesh, rank == last ? other.c_str() : prefix.c_str(), PNPBS_ERROR_ARGUMENT,
                 "all ranks must give the same");
  expect_error(mesh, (folder + "/none/mesh").c_str(), PNPBS_ERROR_FILE, "/none/mesh_1.msh'");
  expect(!fs::exists(own_path(prefix)) && !fs::exists(own_path(other)), "no file yet");

  std::ofstream(own_path(prefix)) << "old";
  const std::string blocked = prefix + "_" + std::to_string(size) + ".msh";
  MPI_Barrier(group);
  if (rank == last) {
    fs::remove(blocked);
    fs::create_directory(blocked);
  }
  MPI_Barrier(group);
  expect_error(mesh, prefix.c_str(), PNPBS_ERROR_FILE, ("'" + blocked + "'").c_str());
  expect(rank == last || contents(own_path(prefix)) == "old", "an existing file is unchanged");
  MPI_Barrier(group);
  if (rank == last) fs::remove(blocked);
  MPI_Barrier(group);
  expect(pnpbs_mesh_write(mesh, prefix.c_str()) == PNPBS_OK, "write");
  expect(contents(own_path(prefix)).starts_with("$MeshFormat"), "and is replaced");
  MPI_Barrier(group);
  const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  expect(files == 2 * size, "nothing else is left");

  pnpbs_mesh dead = mesh;
  pnpbs_mesh_destroy(&mesh);
  expect(pnpbs_mesh_write(dead, prefix.c_str()) == PNPBS_ERROR_HANDLE, "a handle that is not live");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

void check_all() {
  char folder[] = "/tmp/pnpbs_mesh_files_XXXXXX";
  if (rank == 0 && !mkdtemp(folder)) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, group);
  for (const Case& it : kCases) check_case(it, std::string(folder) + "/mesh");
  for (const Case& it : kRegions) check_case(it, std::string(folder) + "/mesh");
  check_errors(folder);
  MPI_Barrier(group);
  if (rank == 0) fs::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
