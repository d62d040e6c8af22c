// SPDX-License-Identifier: BSD-3-Clause
// Reads a partitioned file of Gmsh by a parser that follows Gmsh's documentation and shares no code
// with the library. The constructor checks that the counts and ranges in the file match its
// contents.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "mesh_parts.hpp"

namespace {

using Entity = std::array<std::int64_t, 2>;  // dimension, number

struct PartOfEntity {
  Entity parent{};
  std::int64_t partition = 0, group = 0;
};
struct FileNode {
  Entity entity{};
  std::array<double, 3> x{};
};
struct FileElement {
  Entity entity{};
  std::int64_t type = 0;
  Ids corners;
};

class File {
 public:
  std::map<Entity, std::string> names;      // of groups
  std::map<Entity, std::int64_t> entities;  // their groups
  std::map<Entity, PartOfEntity> parts;
  std::map<std::int64_t, std::int64_t> ghost_entities;  // their partitions
  std::map<std::int64_t, FileNode> nodes;
  std::map<std::int64_t, FileElement> elements;
  // The owner of each ghost element, and the partitions that have it as a ghost.
  std::map<std::int64_t, std::pair<std::int64_t, Ids>> ghosts;
  std::int64_t partitions = 0;
  bool has_ghosts = false;

  explicit File(const std::string& path) : in_(path) {
    expect(in_.is_open(), "there is a file");
    for (std::string section; in_ >> section;) {
      read(section);
      expect(next<std::string>() == "$End" + section.substr(1), "a section ends");
    }
  }

 private:
  template <class Value>
  Value next() {
    Value value{};
    expect(static_cast<bool>(in_ >> value), "something to read");
    return value;
  }
  std::int64_t number() { return next<std::int64_t>(); }

  void read(const std::string& section) {
    if (section == "$MeshFormat")
      expect(next<std::string>() == "4.1" && number() == 0 && number() == 8, "format");
    else if (section == "$PhysicalNames")
      read_names();
    else if (section == "$Entities")
      read_entities(false);
    else if (section == "$PartitionedEntities")
      read_entities(true);
    else if (section == "$Nodes")
      read_nodes();
    else if (section == "$Elements")
      read_elements();
    else if (section == "$GhostElements")
      read_ghosts();
    else
      expect(false, "a known section");
  }

  void read_names() {
    for (std::int64_t n = number(); n > 0; --n) {
      const Entity entity{number(), number()};
      std::string name;
      std::getline(in_ >> std::ws, name);
      expect(names.emplace(entity, name).second, "one name of each group");
    }
  }

  void read_entities(bool partitioned) {
    if (partitioned) {
      partitions = number();
      for (std::int64_t n = number(); n > 0; --n) {
        const std::int64_t entity = number();
        ghost_entities[entity] = number();
      }
    }
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& count : counts) count = number();
    expect(counts[0] == 0, "no points");
    for (std::int64_t dimension = 1; dimension < 4; ++dimension)
      for (std::int64_t n = counts[static_cast<std::size_t>(dimension)]; n > 0; --n)
        read_entity({dimension, number()}, partitioned);
  }

  void read_entity(const Entity& entity, bool partitioned) {
    PartOfEntity part;
    if (partitioned) {
      part.parent = {number(), number()};
      expect(number() == 1, "of one partition");
      part.partition = number();
    }
    std::array<double, 6> box{};
    for (double& bound : box) bound = next<double>();
    expect(number() == 1, "of one group");
    part.group = number();
    expect(number() == 0, "nothing bounds it");
    expect(!entities.contains(entity) && !parts.contains(entity), "an entity comes once");
    expect(names.contains({entity[0], part.group}), "its group has a name");
    if (!partitioned) {
      entities[entity] = part.group;
      return;
    }
    expect(entities.contains(part.parent) && entities[part.parent] == part.group, "its parent");
    expect(part.parent[0] == entity[0], "of the same dimension");
    parts[entity] = part;
  }

  // Returns the numbers of blocks and rows, and the range of the row numbers.
  std::array<std::int64_t, 4> read_sizes() {
    std::array<std::int64_t, 4> sizes{};
    for (std::int64_t& size : sizes) size = number();
    return sizes;
  }
  template <class Rows>
  void check_sizes(const std::array<std::int64_t, 4>& sizes, const Rows& rows) const {
    expect(sizes[1] == static_cast<std::int64_t>(rows.size()), "as many rows as there should be");
    expect(sizes[2] == (rows.empty() ? 0 : rows.begin()->first), "the least number");
    expect(sizes[3] == (rows.empty() ? 0 : rows.rbegin()->first), "the largest number");
  }

  void read_nodes() {
    const auto sizes = read_sizes();
    for (std::int64_t block = 0; block < sizes[0]; ++block) {
      const Entity entity{number(), number()};
      expect(parts.contains(entity), "nodes of an entity that is there");
      expect(number() == 0, "not parametric");
      Ids numbers(static_cast<std::size_t>(number()));
      for (std::int64_t& one : numbers) one = number();
      for (const std::int64_t one : numbers) {
        FileNode node{entity, {}};
        for (double& x : node.x) x = next<double>();
        expect(nodes.emplace(one, node).second, "a node comes once in a file");
      }
    }
    check_sizes(sizes, nodes);
  }

  void read_elements() {
    const std::map<std::int64_t, std::size_t> corners{{1, 2}, {2, 3}, {4, 4}};
    const auto sizes = read_sizes();
    for (std::int64_t block = 0; block < sizes[0]; ++block) {
      const Entity entity{number(), number()};
      expect(parts.contains(entity) || ghost_entities.contains(entity[1]),
             "elements of an entity that is there");
      const std::int64_t type = number();
      if (!corners.contains(type)) return expect(false, "a line, a triangle or a tetrahedron");
      expect(static_cast<std::int64_t>(corners.at(type)) == entity[0] + 1, "of its dimension");
      for (std::int64_t n = number(); n > 0; --n) {
        const std::int64_t one = number();
        FileElement element{entity, type, Ids(corners.at(type))};
        for (std::int64_t& corner : element.corners) {
          corner = number();
          expect(nodes.contains(corner), "corners are in the file");
        }
        expect(elements.emplace(one, element).second, "an element comes once in a file");
      }
    }
    check_sizes(sizes, elements);
  }

  void read_ghosts() {
    has_ghosts = true;
    for (std::int64_t n = number(); n > 0; --n) {
      const std::int64_t element = number(), partition = number();
      Ids with(static_cast<std::size_t>(number()));
      for (std::int64_t& one : with) one = number();
      expect(ghosts.emplace(element, std::pair{partition, with}).second, "a ghost comes once");
    }
  }

  std::ifstream in_;
};

}  // namespace
