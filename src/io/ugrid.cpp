// SPDX-License-Identifier: BSD-3-Clause
// UGRID writer: a mesh of triangles by the conventions of UGRID 1.0 (ugrid-conventions.github.io)
// in NetCDF. It has nodes, triangles and the boundary edges of the domain, with their properties.
// Numbers start at 0; triangles are counter-clockwise.
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "base/error.hpp"
#include "io/formats.hpp"
#include "io/netcdf.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::io {

namespace {

// The writer of one file.
class UgridWriter {
 public:
  UgridWriter(const NodeSource& nodes, SharedFile& file)
      : nodes_(nodes), all_(nodes.contents()), file_(file) {}

  void write() {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    if (all_.elements > kMost)
      throw Error(ErrorKind::argument, "a UGRID file can have " + std::to_string(kMost) +
                                           " triangles, and this one would have " +
                                           std::to_string(all_.elements));
    require_other_names();
    std::vector<std::int64_t> edges{0};
    for_bounding_edges([&](const FacetRows&, std::size_t) { ++edges[0]; });
    file_.ranks().allreduce_sum(edges);
    declare(edges[0]);
    file_.append_text(netcdf_head(contents_));
    for (const std::function<void()>& append : appends_) append();
  }

 private:
  // Throws if a field has the name of another variable, since NetCDF requires unique names.
  void require_other_names() const {
    constexpr std::array<std::string_view, 10> taken{
        "mesh",          "mesh_node_x",     "mesh_node_y",         "mesh_node_lon",
        "mesh_node_lat", "mesh_face_nodes", "mesh_boundary_nodes", "boundary_tag",
        "region",        "quality"};
    for (std::size_t f = 0; f < all_.field_count(); ++f) {
      const std::string& name = (*all_.fields)[f].name;
      if (std::ranges::find(taken, name) != taken.end() || name.starts_with('-'))
        throw Error(
            ErrorKind::argument,
            "a .ugrid file cannot have an output field '" + name + "': the name " +
                (name.starts_with('-') ? "begins with a minus" : "is that of another variable"));
    }
  }

  // Indices in the list of dimensions. Dimensions of fields with several components follow.
  static constexpr std::size_t kNodes = 0, kFaces = 1, kThree = 2, kEdges = 3, kTwo = 4;
  using Attributes = std::vector<NetcdfAttribute>;

  // Declares all variables and the functions that write them. A whole sphere has no boundary. Its
  // dimension is omitted, since NetCDF would read 0 as unlimited.
  void declare(std::int64_t edges) {
    contents_.dimensions = {
        {"nMesh_node", all_.nodes}, {"nMesh_face", all_.elements}, {"Three", 3}};
    if (edges > 0) {
      contents_.dimensions.push_back({"nMesh_boundary", edges});
      contents_.dimensions.push_back({"Two", 2});
    }
    contents_.attributes = {{"Conventions", "CF-1.8 UGRID-1.0"},
                            {"title", "nodes and triangles by pnpbs"}};
    declare_mesh(edges > 0);
    declare_places();
    declare_faces();
    if (edges > 0) declare_boundary();
    declare_fields();
  }

  void declare_mesh(bool with_boundary) {
    Attributes topology{{"cf_role", "mesh_topology"},
                        {"topology_dimension", std::int32_t{2}},
                        {"node_coordinates", coordinates()},
                        {"face_node_connectivity", "mesh_face_nodes"}};
    if (with_boundary) topology.push_back({"boundary_node_connectivity", "mesh_boundary_nodes"});
    add("mesh", NumberType::int32, {}, topology, [this] {
      file_.append([&](Sink& sink) {
        const std::int32_t nothing = 0;
        if (file_.is_first()) sink.bytes(&nothing, sizeof nothing);
      });
    });
  }

  bool on_sphere() const { return all_.coordinates == 3; }
  std::string coordinates() const {
    return on_sphere() ? "mesh_node_lon mesh_node_lat" : "mesh_node_x mesh_node_y";
  }

  void declare_places() {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string name = on_sphere() ? (k == 0 ? "lon" : "lat") : (k == 0 ? "x" : "y");
      const std::string standard =
          on_sphere() ? (k == 0 ? "longitude" : "latitude") : "projection_" + name + "_coordinate";
      Attributes attributes{{"standard_name", standard}};
      if (on_sphere()) attributes.push_back({"units", k == 0 ? "degrees_east" : "degrees_north"});
      add("mesh_node_" + name, NumberType::real, {kNodes}, attributes, [this, k] {
        append_of_nodes<double>(
            [&](const NodeRows& rows, std::size_t i) { return place(rows, i)[k]; });
      });
    }
  }

  Point<2> place(const NodeRows& rows, std::size_t i) const {
    const double* x = &rows.x[static_cast<std::size_t>(all_.coordinates) * i];
    return on_sphere() ? degrees_of({x[0], x[1], x[2]}) : Point<2>{x[0], x[1]};
  }

  void declare_faces() {
    add("mesh_face_nodes", NumberType::int32, {kFaces, kThree},
        {{"cf_role", "face_node_connectivity"}, {"start_index", std::int32_t{0}}}, [this] {
          nodes_.for_elements([&](const ElementRows& rows) {
            append(std::vector<std::int32_t>(rows.nodes.begin(), rows.nodes.end()));
          });
        });
    add("quality", NumberType::real32, {kFaces}, of("face", "2 r_in / R of the triangle"),
        [this] { nodes_.for_elements([&](const ElementRows& rows) { append(rows.quality); }); });
    if (!all_.with_regions) return;
    add("region", NumberType::int32, {kFaces}, of("face", "tag of the region"),
        [this] { nodes_.for_elements([&](const ElementRows& rows) { append(rows.regions); }); });
  }

  void declare_boundary() {
    add("mesh_boundary_nodes", NumberType::int32, {kEdges, kTwo},
        {{"cf_role", "boundary_node_connectivity"}, {"start_index", std::int32_t{0}}}, [this] {
          append_of_edges([](const FacetRows& rows, std::size_t e, std::vector<std::int32_t>& to) {
            to.push_back(static_cast<std::int32_t>(rows.nodes[2 * e]));
            to.push_back(static_cast<std::int32_t>(rows.nodes[2 * e + 1]));
          });
        });
    add("boundary_tag", NumberType::int32, {kEdges}, of("boundary", "tag of the curve"), [this] {
      append_of_edges([](const FacetRows& rows, std::size_t e, std::vector<std::int32_t>& to) {
        to.push_back(rows.tags[e]);
      });
    });
  }

  void declare_fields() {
    add("tag", NumberType::int32, {kNodes}, of("node", "tag of the curve, 0 inside"),
        [this] { nodes_.for_nodes([&](const NodeRows& rows) { append(rows.tags); }); });
    add("spacing", NumberType::real, {kNodes}, of("node", "wanted distance of nodes, d"),
        [this] { nodes_.for_nodes([&](const NodeRows& rows) { append(rows.spacing); }); });
    for (std::size_t f = 0; f < all_.field_count(); ++f) {
      const OutputField& field = (*all_.fields)[f];
      std::vector<std::size_t> dimensions{kNodes};
      if (field.components > 1) {
        dimensions.push_back(contents_.dimensions.size());
        contents_.dimensions.push_back({"n_" + field.name, field.components});
      }
      add(field.name, NumberType::real, dimensions, of("node", field.name),
          [this, f] { nodes_.for_field(f, [&](const FieldRows& rows) { append(rows.values); }); });
    }
  }

  Attributes of(const std::string& location, const std::string& name) const {
    Attributes attributes{{"mesh", "mesh"}, {"location", location}, {"long_name", name}};
    if (location == "node") attributes.push_back({"coordinates", coordinates()});
    return attributes;
  }

  void add(const std::string& name, NumberType type, const std::vector<std::size_t>& dimensions,
           const Attributes& attributes, const std::function<void()>& append) {
    contents_.variables.push_back({name, type, dimensions, attributes});
    appends_.push_back(append);
  }

  // Calls visit(rows, e) for edges that bound the domain. Edges of inner curves do not.
  template <class Visit>
  void for_bounding_edges(const Visit& visit) const {
    nodes_.for_facets([&](const FacetRows& rows) {
      for (std::size_t e = 0; e < rows.tags.size(); ++e)
        if (rows.domain[e] != Side::both) visit(rows, e);
    });
  }

  template <class Give>
  void append_of_edges(const Give& give) {
    nodes_.for_facets([&](const FacetRows& rows) {
      std::vector<std::int32_t> values;
      for (std::size_t e = 0; e < rows.tags.size(); ++e)
        if (rows.domain[e] != Side::both) give(rows, e, values);
      append(std::move(values));
    });
  }

  template <class Value, class Give>
  void append_of_nodes(const Give& give) {
    nodes_.for_nodes([&](const NodeRows& rows) {
      std::vector<Value> values;
      for (std::size_t i = 0; i < rows.ids.size(); ++i) values.push_back(give(rows, i));
      append(std::move(values));
    });
  }

  template <class Value>
  void append(std::vector<Value> values) {
    make_big_endian(values);
    file_.append([&](Sink& sink) { sink.array(std::span<const Value>(values)); });
  }

  const NodeSource& nodes_;
  const Contents& all_;
  SharedFile& file_;
  NetcdfContents contents_;
  std::vector<std::function<void()>> appends_;  // writers of the variables, in their order
};

}  // namespace

void write_ugrid(const NodeSource& nodes, SharedFile& file) { UgridWriter(nodes, file).write(); }

}  // namespace pnpbs::io
