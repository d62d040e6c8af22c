// SPDX-License-Identifier: BSD-3-Clause
// CSV writer: comma-separated values with one line of column names.
#include "io/formats.hpp"
#include "io/particle_fields.hpp"

namespace pnpbs::io {

namespace {

std::vector<FieldColumns> all_columns(const NodeSource& nodes) {
  std::vector<FieldColumns> all;
  for (std::size_t k = 0; k < nodes.contents().field_count(); ++k)
    all.push_back(field_columns(nodes, k));
  return all;
}

// Returns the column names of a field. Names of fields have no colon, so columns have different
// names.
std::string field_names(const OutputField& field) {
  if (field.components == 1) return "," + field.name;
  std::string names;
  for (std::int64_t c = 0; c < field.components; ++c)
    names += "," + field.name + ":" + std::to_string(c);
  return names;
}

std::string column_names(const Contents& all) {
  std::string names = all.coordinates == 2 ? "id,x,y,tag,spacing" : "id,x,y,z,tag,spacing";
  for (std::size_t k = 0; k < all.field_count(); ++k) names += field_names((*all.fields)[k]);
  return names + "\n";
}

// Writes the values of a node. `place` counts the nodes of this rank over all windows.
void write_fields(const std::vector<FieldColumns>& fields, std::size_t place, Sink& sink) {
  for (const FieldColumns& field : fields)
    for (std::size_t c = 0; c < field.components; ++c) {
      sink.text(",");
      sink.number(field.values[field.components * place + c]);
    }
}

}  // namespace

void write_csv(const NodeSource& nodes, SharedFile& file) {
  const auto coordinates = static_cast<std::size_t>(nodes.contents().coordinates);
  const std::vector<FieldColumns> fields = all_columns(nodes);
  std::size_t before = 0;  // nodes of earlier windows
  file.append_text(column_names(nodes.contents()));
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        sink.number(rows.ids[i]);
        sink.text(",");
        for (std::size_t k = 0; k < coordinates; ++k) {
          sink.number(rows.x[coordinates * i + k]);
          sink.text(",");
        }
        sink.number(rows.tags[i]);
        sink.text(",");
        sink.number(rows.spacing[i]);
        write_fields(fields, before + i, sink);
        sink.text("\n");
      }
    });
    before += rows.ids.size();
  });
}

}  // namespace pnpbs::io
