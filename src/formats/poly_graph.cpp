// SPDX-License-Identifier: BSD-3-Clause
#include "formats/poly_graph.hpp"

#include <functional>

#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

void read_segments(TextFields& fields, PolyGraph& graph) {
  begin_section(fields, "segments");
  const std::int64_t count = read_count(fields, "segments");
  const std::int64_t markers = read_optional(fields, "the number of boundary markers", 1);
  read_lines(fields, count, "segments", [&] {
    fields.integer("a segment number");
    const std::int64_t begin = read_vertex(fields, graph.vertices);
    const std::int64_t end = read_vertex(fields, graph.vertices);
    if (begin == end) fields.fail("both ends of the segment are the same vertex");
    graph.segment_ends.push_back(begin);
    graph.segment_ends.push_back(end);
    graph.segment_tags.push_back(markers > 0 ? fields.tag("a boundary marker") : 1);
  });
}

PolyGraph parse(std::string_view text, const std::string& name,
                const std::function<NodeFile()>& node_file) {
  expect_text(text, name, ".poly");
  TextFields fields(text, name);
  PolyGraph graph;
  graph.name = name;
  graph.vertices = read_vertices<2>(fields, node_file);
  read_segments(fields, graph);
  graph.holes = read_holes<2>(fields);
  graph.regions = read_regions<2>(fields);
  return graph;
}

std::string node_path(std::string path) {
  constexpr std::string_view kEnding = ".poly";
  if (path.ends_with(kEnding)) path.resize(path.size() - kEnding.size());
  return path + ".node";
}

}  // namespace

PolyGraph read_poly(const std::string& path) {
  return parse(read_whole_file(path), path, [&path] {
    const std::string beside = node_path(path);
    return NodeFile{read_whole_file(beside), beside};
  });
}

PolyGraph parse_poly(std::string_view text, const std::string& name) {
  return parse(text, name, nullptr);
}

}  // namespace pnpbs
