// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "formats/msh_mesh.hpp"
#include "formats/msh_node_table.hpp"
#include "spacing/files/field_file.hpp"

namespace pnpbs {

FileField parse_msh_field(std::string_view bytes, const std::string& name,
                          const std::string& wanted) {
  const MshMesh mesh = parse_msh(bytes, name, MshSections::mesh_and_node_values);
  std::vector<FieldName> fields;
  for (const MshNodeValues& field : mesh.node_values)
    fields.push_back({field.name, field.components});
  const MshNodeValues& field = mesh.node_values[chosen_field(fields, wanted, name)];

  FileField file;
  file.field = field.name;
  file.points = mesh.nodes;
  file.values.assign(mesh.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  MshNodeTable nodes;
  nodes.build(mesh.node_tags);
  for (std::size_t i = 0; i < field.node_tags.size(); ++i) {
    const std::int32_t node = nodes.at(field.node_tags[i]);
    if (node < 0)
      throw Error(ErrorKind::file, name + ": '" + field.name + "' has a value at node " +
                                       std::to_string(field.node_tags[i]) +
                                       ", which does not exist");
    file.values[static_cast<std::size_t>(node)] = field.values[i];
  }

  file.triangles = mesh.of(MshShape::triangle).corners;
  const std::vector<std::int32_t>& quadrangles = mesh.of(MshShape::quadrangle).corners;
  for (std::size_t q = 0; q < quadrangles.size(); q += 4)
    for (const std::size_t k : {0, 1, 2, 0, 2, 3}) file.triangles.push_back(quadrangles[q + k]);
  file.tetrahedra = mesh.of(MshShape::tetrahedron).corners;
  for (const MshShape solid : {MshShape::hexahedron, MshShape::prism, MshShape::pyramid})
    file.other_solids += static_cast<std::int64_t>(mesh.of(solid).count());
  return file;
}

}  // namespace pnpbs
