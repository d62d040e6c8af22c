// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/poly_reader.hpp"

#include <functional>
#include <vector>

#include "base/error.hpp"
#include "formats/poly_sections.hpp"
#include "formats/text_fields.hpp"
#include "formats/whole_file.hpp"

namespace pnpbs {

namespace {

struct SegmentSection {
  std::vector<std::int64_t> ends;
  std::vector<std::int32_t> tags;
};

SegmentSection read_segments(TextFields& fields, const VertexSection<2>& vertices) {
  SegmentSection segments;
  begin_section(fields, "segments");
  const std::int64_t count = read_count(fields, "segments");
  const std::int64_t markers = read_optional(fields, "the number of boundary markers", 1);
  read_lines(fields, count, "segments", [&] {
    fields.integer("a segment number");
    const std::int64_t begin = read_vertex(fields, vertices);
    const std::int64_t end = read_vertex(fields, vertices);
    if (begin == end) fields.fail("both ends of the segment are the same vertex");
    segments.ends.push_back(begin);
    segments.ends.push_back(end);
    segments.tags.push_back(markers > 0 ? fields.tag("a boundary marker") : 1);
  });
  return segments;
}

void parse(PlaneDomain& domain, std::string_view text, const std::string& name,
           const std::function<NodeFile()>& node_file) {
  expect_text(text, name, ".poly");
  TextFields fields(text, name);
  const VertexSection<2> vertices = read_vertices<2>(fields, node_file);
  const SegmentSection segments = read_segments(fields, vertices);
  const std::vector<double> holes = read_holes<2>(fields);
  skip_regions(fields);
  try {
    domain.add_pslg(vertices.count(), vertices.coordinates.data(), vertices.tags.data(),
                    static_cast<std::int64_t>(segments.tags.size()), segments.ends.data(),
                    segments.tags.data(), static_cast<std::int64_t>(holes.size() / 2), holes.data(),
                    vertices.first_number);
  } catch (const Error& error) {
    throw Error(ErrorKind::file, name + ": " + error.what());
  }
}

std::string node_path(std::string path) {
  constexpr std::string_view kEnding = ".poly";
  if (path.ends_with(kEnding)) path.resize(path.size() - kEnding.size());
  return path + ".node";
}

}  // namespace

void read_poly_file(PlaneDomain& domain, const std::string& path) {
  parse(domain, read_whole_file(path), path, [&path] {
    const std::string beside = node_path(path);
    return NodeFile{read_whole_file(beside), beside};
  });
}

void parse_poly(PlaneDomain& domain, std::string_view text, const std::string& name) {
  parse(domain, text, name, nullptr);
}

}  // namespace pnpbs
