// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "base/point_text.hpp"
#include "formats/msh_fields.hpp"
#include "formats/msh_mesh.hpp"
#include "formats/msh_node_table.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {
namespace {

// A type of elements in Gmsh's files (reference manual, section "MSH file format").
struct MshType {
  std::int32_t number;
  MshShape shape;
  int nodes;  // corners first
};

// Supported types, up to fifth order.
constexpr std::array kMshTypes{
    MshType{15, MshShape::point, 1},        MshType{1, MshShape::line, 2},
    MshType{8, MshShape::line, 3},          MshType{26, MshShape::line, 4},
    MshType{27, MshShape::line, 5},         MshType{28, MshShape::line, 6},
    MshType{2, MshShape::triangle, 3},      MshType{9, MshShape::triangle, 6},
    MshType{20, MshShape::triangle, 9},     MshType{21, MshShape::triangle, 10},
    MshType{22, MshShape::triangle, 12},    MshType{23, MshShape::triangle, 15},
    MshType{24, MshShape::triangle, 15},    MshType{25, MshShape::triangle, 21},
    MshType{3, MshShape::quadrangle, 4},    MshType{10, MshShape::quadrangle, 9},
    MshType{16, MshShape::quadrangle, 8},   MshType{4, MshShape::tetrahedron, 4},
    MshType{11, MshShape::tetrahedron, 10}, MshType{29, MshShape::tetrahedron, 20},
    MshType{30, MshShape::tetrahedron, 35}, MshType{31, MshShape::tetrahedron, 56},
    MshType{5, MshShape::hexahedron, 8},    MshType{12, MshShape::hexahedron, 27},
    MshType{17, MshShape::hexahedron, 20},  MshType{92, MshShape::hexahedron, 64},
    MshType{93, MshShape::hexahedron, 125}, MshType{6, MshShape::prism, 6},
    MshType{13, MshShape::prism, 18},       MshType{18, MshShape::prism, 15},
    MshType{7, MshShape::pyramid, 5},       MshType{14, MshShape::pyramid, 14},
    MshType{19, MshShape::pyramid, 13}};

// The regions of a mesh. They are created when an element refers to them, from the entities of the
// file.
class MshRegionTable {
 public:
  // Adds an entity. `group` is its first physical group, or 0 if it has none.
  void add_entity(int dimension, std::int32_t entity, std::int32_t group) {
    group_of_[{dimension, entity}] = group;
    if (dimension > 0 && group != 0) any_group_[static_cast<std::size_t>(dimension)] = true;
  }
  // Adds `bound` to the boundary of an entity of dimension `dimension`.
  void add_bound(int dimension, std::int32_t bound, bool bounds_one_in_group) {
    ++bounds_[{dimension - 1, bound}][bounds_one_in_group];
  }

  std::int32_t group_of(int dimension, std::int32_t entity) const {
    const auto found = group_of_.find({dimension, entity});
    return found == group_of_.end() ? 0 : found->second;
  }

  // Returns the index of the region, which is created if necessary.
  std::int32_t region_of(int dimension, std::int32_t entity, std::int32_t group) {
    const std::array<std::int32_t, 3> key{dimension, entity, group};
    const auto [found, is_new] =
        region_at_.try_emplace(key, static_cast<std::int32_t>(regions_.size()));
    if (is_new) regions_.push_back({dimension, entity, group, bounds_of(dimension, entity)});
    return found->second;
  }
  std::vector<MshRegion> take() { return std::move(regions_); }

 private:
  // Returns how many entities the entity bounds. If physical groups define the domain, entities in
  // no group do not count.
  int bounds_of(int dimension, std::int32_t entity) const {
    const auto found = bounds_.find({dimension, entity});
    if (found == bounds_.end()) return 0;
    const auto& [in_none, in_group] = found->second;
    return any_group_[static_cast<std::size_t>(dimension) + 1] ? in_group : in_none + in_group;
  }

  std::vector<MshRegion> regions_;
  std::map<std::array<std::int32_t, 3>, std::int32_t> region_at_;
  std::map<GroupTag, std::int32_t> group_of_;  // group of each entity
  // Numbers of entities in no physical group, and in one, that an entity bounds.
  std::map<GroupTag, std::array<int, 2>> bounds_;
  std::array<bool, 4> any_group_{};  // by dimension: some entity is in a group
};

constexpr std::array kEntityNames{"point", "curve", "surface", "volume"};
constexpr std::int64_t kMaxNodes = std::numeric_limits<std::int32_t>::max();

constexpr std::size_t kDouble = sizeof(double), kSize = sizeof(std::int64_t), kInt = 4;
constexpr std::size_t kTextNumber = 2;  // a digit and a separator. [bytes]

std::size_t index_of(MshShape shape) { return static_cast<std::size_t>(shape); }

class MshParser {
 public:
  MshParser(std::string_view bytes, const std::string& name, MshSections wanted)
      : fields_(bytes, name), name_(name), wanted_(wanted) {}

  MshMesh parse() {
    mesh_.name = name_;
    read_format();
    while (const auto line = fields_.line()) {
      if (!line->starts_with('$') || line->starts_with("$End"))
        fields_.fail_found(*line, "the beginning of a section such as '$Nodes'");
      read_section(std::string(line->substr(1)));
    }
    if (!has_nodes_) fields_.fail("the file ends, expected '$Nodes'");
    if (!has_elements_) fields_.fail("the file ends, expected '$Elements'");
    mesh_.regions = regions_.take();
    if (is_old_) remove_repeated(mesh_);
    warn();
    return std::move(mesh_);
  }

 private:
  // ------------------------------------------------------------ sections
  void read_format() {
    const std::string what = "'$MeshFormat', with which Gmsh's files begin";
    const std::string_view first = fields_.required_line(what);
    if (first != "$MeshFormat") fields_.fail_found(first, what);
    TextFields line(fields_.required_line("the version of the format"), name_);
    line.next_line();
    const std::string version(line.next().value_or(""));
    const std::string kind(line.next().value_or("")), bytes(line.next().value_or(""));
    is_old_ = version == "2.2" || version == "2" || version == "2.1";
    if (!is_old_ && version != "4.1")
      fields_.fail_found(version, "version 4.1 or 2.2 of the format (in Gmsh: -format msh41)");
    if (kind != "0" && kind != "1") fields_.fail_found(kind, "0 for text or 1 for binary");
    if (bytes != "8") fields_.fail_found(bytes, "numbers of 8 bytes");
    if (kind == "1") read_byte_order();
    expect_end("MeshFormat");
  }

  void read_byte_order() {
    fields_.set_binary(std::endian::little);
    const std::int32_t one = fields_.int32("the integer 1");
    if (one == 1 << 24) {
      fields_.set_binary(std::endian::big);
    } else if (one != 1) {
      fields_.fail("found " + std::to_string(one) + ", expected the integer 1");
    }
  }

  void read_section(const std::string& section) {
    if (section == "PhysicalNames") {
      read_names();
    } else if (section == "Entities") {
      read_entities();
    } else if (section == "PartitionedEntities") {
      fields_.fail("the mesh is partitioned: write it without partitions");
    } else if (section == "Nodes") {
      if (std::exchange(has_nodes_, true)) fields_.fail("found a second section $Nodes");
      is_old_ ? read_old_nodes() : read_nodes();
      nodes_.build(mesh_.node_tags);
      if (const auto tag = nodes_.repeated())
        fields_.fail("there are two nodes " + std::to_string(*tag));
    } else if (section == "Elements") {
      if (!has_nodes_) fields_.fail("found $Elements before $Nodes");
      if (std::exchange(has_elements_, true)) fields_.fail("found a second section $Elements");
      is_old_ ? read_old_elements() : read_elements();
    } else if (section == "NodeData" && wanted_ == MshSections::mesh_and_node_values) {
      read_node_values();
    } else {
      fields_.skip_section(section);
      return;
    }
    expect_end(section);
  }

  void expect_end(const std::string& section) {
    const std::string end = "$End" + section;
    if (const std::string_view line = fields_.required_line("'" + end + "'"); line != end)
      fields_.fail_found(line, "'" + end + "'");
  }

  // ------------------------------------------------------------ names and entities
  std::int64_t count_in_line(const std::string& what) {
    const std::string_view line = fields_.required_line("the number of " + what);
    std::int64_t count = 0;
    if (!parse_field(line, count) || count < 0) fields_.fail_found(line, "the number of " + what);
    return count;
  }

  void read_names() {
    const std::int64_t count = count_in_line("names");
    for (std::int64_t i = 0; i < count; ++i) {
      const std::string_view line = fields_.required_line(part_of(i, count, "names"));
      const std::size_t begin = line.find('"'), end = line.rfind('"');
      if (begin == std::string_view::npos || begin == end)
        fields_.fail_found(line, "a dimension, a tag and a name in quotation marks");
      TextFields numbers(line.substr(0, begin), name_);
      numbers.next_line();
      std::int32_t dimension = -1, tag = 0;
      if (!parse_field(numbers.next().value_or(""), dimension) || dimension < 0 || dimension > 3 ||
          !parse_field(numbers.next().value_or(""), tag) || tag <= 0)
        fields_.fail_found(line, "a dimension from 0 to 3, a positive tag and a name");
      if (end > begin + 1)
        mesh_.names.add({dimension, tag}, std::string(line.substr(begin + 1, end - begin - 1)));
    }
  }

  void read_entities() {
    std::array<std::int64_t, 4> counts;
    for (std::size_t d = 0; d < 4; ++d)
      counts[d] = fields_.size("the number of " + std::string(kEntityNames[d]) + "s");
    for (int d = 0; d < 4; ++d) {
      const std::string name = kEntityNames[static_cast<std::size_t>(d)];
      const std::size_t numbers = d == 0 ? 3 : 6;
      fields_.require_room(counts[static_cast<std::size_t>(d)], name + "s",
                           (numbers + 2) * kTextNumber, kInt + numbers * kDouble + kSize);
      for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(d)]; ++i) read_entity(d, name);
    }
  }

  void read_entity(int dimension, const std::string& name) {
    const std::int32_t tag = fields_.int32("the tag of a " + name);
    for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) fields_.any_number("a bound of the " + name);
    std::int32_t group = 0;
    const std::int64_t groups = fields_.count("physical groups", kTextNumber, kInt);
    for (std::int64_t i = 0; i < groups; ++i) {
      const std::int32_t one = positive(fields_.int32("the tag of a physical group"));
      if (i == 0) group = one;
    }
    if (groups > 1) in_several_.push_back(name + " " + std::to_string(tag));
    regions_.add_entity(dimension, tag, group);
    if (dimension == 0) return;
    const std::int64_t bounds = fields_.count("entities that bound it", kTextNumber, kInt);
    for (std::int64_t i = 0; i < bounds; ++i) {
      const std::int32_t side = positive(fields_.int32("the tag of an entity that bounds it"));
      regions_.add_bound(dimension, side, group != 0);
    }
  }

  // Returns the tag without its sign, which is an orientation.
  std::int32_t positive(std::int32_t tag) const {
    if (tag == std::numeric_limits<std::int32_t>::min() || tag == 0)
      fields_.fail("found " + std::to_string(tag) + ", expected the tag of a group or entity");
    return tag < 0 ? -tag : tag;
  }

  // ------------------------------------------------------------ nodes
  void require_nodes(std::int64_t count) const {
    if (count > kMaxNodes) fields_.fail("more than 2147483647 nodes");
  }

  Point<3> read_point() {
    const double x = fields_.coordinate("x"), y = fields_.coordinate("y");
    return {x, y, fields_.coordinate("z")};
  }

  void read_nodes() {
    const std::int64_t blocks = fields_.size("the number of blocks");
    const std::int64_t count = fields_.count("nodes", 4 * kTextNumber, kSize + 3 * kDouble);
    require_nodes(count);
    fields_.size("the least tag");
    fields_.size("the largest tag");
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::int32_t dimension = read_dimension();
      fields_.int32("the tag of an entity");
      const bool parametric = fields_.int32("0 or 1, for parametric coordinates") != 0;
      const int parameters = parametric ? dimension : 0;
      const std::int64_t here = fields_.count("nodes", 4 * kTextNumber, kSize + 3 * kDouble);
      if (here > count - static_cast<std::int64_t>(mesh_.node_tags.size()))
        fields_.fail("found more nodes than the " + std::to_string(count) + " announced");
      for (std::int64_t i = 0; i < here; ++i)
        mesh_.node_tags.push_back(fields_.size("a node's tag"));
      for (std::int64_t i = 0; i < here; ++i) {
        mesh_.nodes.push_back(read_point());
        for (int k = 0; k < parameters; ++k) fields_.any_number("a parametric coordinate");
      }
    }
    require_all(mesh_.nodes.size(), count, "nodes");
  }

  void read_old_nodes() {
    const std::int64_t count = count_in_line("nodes");
    require_nodes(count);
    fields_.require_room(count, "nodes", 4 * kTextNumber, kInt + 3 * kDouble);
    for (std::int64_t i = 0; i < count; ++i) {
      mesh_.node_tags.push_back(fields_.int32("a node's number"));
      mesh_.nodes.push_back(read_point());
    }
  }

  // ------------------------------------------------------------ elements
  std::int32_t read_dimension() {
    const std::int32_t dimension = fields_.int32("the dimension of an entity");
    if (dimension < 0 || dimension > 3)
      fields_.fail("found " + std::to_string(dimension) + ", expected a dimension from 0 to 3");
    return dimension;
  }

  const MshType& read_type() {
    const std::int32_t number = fields_.int32("a type of elements");
    const auto found = std::ranges::find(kMshTypes, number, &MshType::number);
    if (found == kMshTypes.end())
      fields_.fail("elements of type " + std::to_string(number) +
                   " cannot be read: expected points, lines, triangles, quadrangles, tetrahedra, "
                   "hexahedra, prisms or pyramids, of fifth order at most");
    return *found;
  }

  void read_elements() {
    const std::int64_t blocks = fields_.size("the number of blocks");
    const std::int64_t count = fields_.count("elements", 2 * kTextNumber, 2 * kSize);
    fields_.size("the least tag");
    fields_.size("the largest tag");
    std::int64_t read = 0;
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::int32_t dimension = read_dimension();
      const std::int32_t entity = fields_.int32("the tag of an entity");
      const MshType& type = read_type();
      if (kMshDimensions[index_of(type.shape)] != dimension)
        fields_.fail("found elements of type " + std::to_string(type.number) + " in a " +
                     kEntityNames[static_cast<std::size_t>(dimension)]);
      const auto numbers = 1 + static_cast<std::size_t>(type.nodes);
      const std::int64_t here = fields_.count("elements", numbers * kTextNumber, numbers * kSize);
      if (here > count - read)
        fields_.fail("found more elements than the " + std::to_string(count) + " announced");
      read += here;
      const std::int32_t region =
          regions_.region_of(dimension, entity, regions_.group_of(dimension, entity));
      for (std::int64_t i = 0; i < here; ++i) {
        fields_.size("an element's tag");
        read_corners(type, region, [this] { return fields_.size("a node's tag"); });
      }
    }
    require_all(static_cast<std::size_t>(read), count, "elements");
  }

  void read_old_elements() {
    const std::int64_t count = count_in_line("elements");
    fields_.require_room(count, "elements", 4 * kTextNumber, 2 * kInt);
    for (std::int64_t read = 0; read < count;) {
      // In a text file each element has its own type and tags; in a binary file a block of elements
      // has.
      const bool binary = fields_.is_binary();
      if (!binary) fields_.int32("an element's number");
      const MshType& type = read_type();
      const std::int64_t here = binary ? fields_.int32("the number of elements") : 1;
      if (here < 1 || here > count - read)
        fields_.fail("found " + std::to_string(here) + " elements, expected 1 to " +
                     std::to_string(count - read));
      const std::int32_t tags = fields_.int32("the number of tags");
      if (tags < 0) fields_.fail("the number of tags is " + std::to_string(tags));
      fields_.require_room(tags, "tags", kTextNumber, kInt);
      for (std::int64_t i = 0; i < here; ++i) {
        if (binary) fields_.int32("an element's number");
        const std::int32_t region = read_old_tags(type, tags);
        read_corners(type, region,
                     [this] { return std::int64_t{fields_.int32("a node's number")}; });
      }
      read += here;
    }
  }

  // Reads the tags of an element: the physical group first, then the entity.
  std::int32_t read_old_tags(const MshType& type, std::int32_t tags) {
    std::array<std::int32_t, 2> first{0, 0};
    for (std::int32_t k = 0; k < tags; ++k) {
      const std::int32_t tag = fields_.int32("a tag");
      if (k < 2) first[static_cast<std::size_t>(k)] = tag == 0 ? 0 : positive(tag);
    }
    return regions_.region_of(kMshDimensions[index_of(type.shape)], first[1], first[0]);
  }

  template <class Read>
  void read_corners(const MshType& type, std::int32_t region, const Read& read) {
    MshCells& cells = mesh_.cells[index_of(type.shape)];
    const int corners = kMshCorners[index_of(type.shape)];
    for (int k = 0; k < type.nodes; ++k) {
      const std::int64_t tag = read();
      const std::int32_t node = nodes_.at(tag);
      if (node < 0) fields_.fail("there is no node " + std::to_string(tag));
      if (k < corners) cells.corners.push_back(node);
    }
    const auto last = cells.corners.end() - corners;
    for (auto corner = last; corner != cells.corners.end(); ++corner)
      if (std::find(last, corner, *corner) != corner)
        fields_.fail("an element has node " +
                     std::to_string(mesh_.node_tags[static_cast<std::size_t>(*corner)]) + " twice");
    cells.regions.push_back(region);
    if (type.nodes > corners) ++curved_;
  }

  // ------------------------------------------------------------ node values
  // Names, times and counts stand in lines of text, in either kind of file.
  void read_node_values() {
    MshNodeValues field;
    const std::int64_t texts = count_in_line("string tags");
    for (std::int64_t i = 0; i < texts; ++i) {
      const std::string_view line = fields_.required_line("a string tag");
      if (i > 0) continue;
      const std::size_t begin = line.find('"'), end = line.rfind('"');
      field.name = begin == end ? line : line.substr(begin + 1, end - begin - 1);
    }
    const std::int64_t reals = count_in_line("real tags");
    for (std::int64_t i = 0; i < reals; ++i) fields_.required_line("a real tag");
    const std::int64_t integers = count_in_line("integer tags");
    if (integers < 3) fields_.fail("expected at least 3 integer tags: step, components, nodes");
    count_in_line("the time step");
    const std::int64_t components = count_in_line("components");
    const std::int64_t nodes = count_in_line("nodes");
    for (std::int64_t i = 3; i < integers; ++i) count_in_line("an integer tag");
    if (components < 1 || components > 9)
      fields_.fail("found " + std::to_string(components) + " components, expected 1, 3 or 9");
    require_nodes(nodes);
    const auto each = static_cast<std::size_t>(components);
    fields_.require_room(nodes, "values at nodes", (1 + each) * kTextNumber, kInt + each * kDouble);
    field.components = static_cast<std::int32_t>(components);
    for (std::int64_t i = 0; i < nodes; ++i) {
      field.node_tags.push_back(fields_.int32("a node's number"));
      for (std::size_t c = 0; c < each; ++c)
        field.values.push_back(fields_.any_number("a value at the node"));
    }
    mesh_.node_values.push_back(std::move(field));
  }

  void require_all(std::size_t found, std::int64_t announced, const std::string& what) const {
    if (static_cast<std::int64_t>(found) != announced)
      fields_.fail("found " + part_of(static_cast<std::int64_t>(found), announced, what));
  }

  void warn() {
    if (curved_ > 0)
      mesh_.warnings.emplace_back(
          WarningCode::curved_elements,
          name_ + ": " + std::to_string(curved_) +
              " elements of higher order are treated as straight ones between their corners",
          curved_);
    if (!in_several_.empty())
      mesh_.warnings.emplace_back(
          WarningCode::groups,
          name_ +
              ": in several physical groups, of which the first counts: " + list_text(in_several_),
          std::ssize(in_several_));
  }

  MshFields fields_;
  std::string name_;
  MshSections wanted_;
  bool is_old_ = false, has_nodes_ = false, has_elements_ = false;
  MshMesh mesh_;
  MshNodeTable nodes_;
  MshRegionTable regions_;
  std::vector<std::string> in_several_;
  std::int64_t curved_ = 0;
};

}  // namespace

MshMesh parse_msh(std::string_view bytes, const std::string& name, MshSections wanted) {
  return MshParser(bytes, name, wanted).parse();
}

}  // namespace pnpbs
