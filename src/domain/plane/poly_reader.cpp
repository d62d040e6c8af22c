// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/poly_reader.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "domain/plane/text_fields.hpp"

namespace pnpbs {

namespace {

struct PolyGraph {
  std::int64_t first_number = 0;
  std::vector<double> xy;
  std::vector<std::int32_t> vertex_tags;
  std::vector<std::int64_t> segment_ends;
  std::vector<std::int32_t> segment_tags;
  std::vector<double> holes;

  std::int64_t vertices() const { return static_cast<std::int64_t>(xy.size() / 2); }
};

// The text of a file must outlive the fields read from it.
struct NodeFile {
  std::string text;
  std::string name;
};

std::int64_t read_count(TextFields& fields, const std::string& what) {
  const std::int64_t count = fields.integer("the number of " + what);
  if (count < 0) fields.fail("the number of " + what + " is " + std::to_string(count));
  return count;
}

// A count that may be left out at the end of its line.
std::int64_t read_optional(TextFields& fields, const std::string& what, std::int64_t max,
                           std::int64_t if_missing = 0) {
  TextFields ahead = fields;
  if (!ahead.next()) return if_missing;
  const std::int64_t value = fields.integer(what);
  if (value < 0 || value > max) {
    fields.fail("found " + std::to_string(value) + ", expected " + what + " (0 to " +
                std::to_string(max) + ")");
  }
  return value;
}

// A section's lines. Nothing is allocated for lines that do not come. Like Triangle, takes no
// notice of further fields at the end of a line.
void read_lines(TextFields& fields, std::int64_t count, const std::string& what,
                const std::function<void()>& read) {
  for (std::int64_t i = 0; i < count; ++i) {
    if (!fields.next_line()) {
      fields.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                  " " + what);
    }
    read();
  }
}

void begin_section(TextFields& fields, const std::string& what) {
  if (!fields.next_line()) fields.fail("the file ends, expected the number of " + what);
}

// Reads the vertex section; false if it is empty, which means a .node file.
bool read_vertices(TextFields& fields, PolyGraph& graph) {
  begin_section(fields, "vertices");
  const std::int64_t count = read_count(fields, "vertices");
  const std::int64_t dimension = read_optional(fields, "the dimension 2", 3, 2);
  if (dimension != 2) fields.fail("found dimension " + std::to_string(dimension) + ", expected 2");
  const std::int64_t attributes = read_optional(fields, "the number of attributes", 1000);
  const std::int64_t markers = read_optional(fields, "the number of boundary markers", 1);
  read_lines(fields, count, "vertices", [&] {
    const std::int64_t number = fields.integer("a vertex number");
    if (graph.xy.empty() && number != 0 && number != 1) {
      fields.fail("the first vertex is " + std::to_string(number) + ", expected 0 or 1");
    }
    if (graph.xy.empty()) graph.first_number = number;
    const std::int64_t expected = graph.first_number + graph.vertices();
    if (number != expected) {
      fields.fail("found vertex " + std::to_string(number) + ", expected vertex " +
                  std::to_string(expected));
    }
    graph.xy.push_back(fields.coordinate("x"));
    graph.xy.push_back(fields.coordinate("y"));
    for (std::int64_t a = 0; a < attributes; ++a) {
      if (!fields.next()) fields.fail("the line ends, expected an attribute");
    }
    graph.vertex_tags.push_back(markers > 0 ? fields.tag("a boundary marker") : 0);
  });
  return count > 0;
}

std::int64_t read_end(TextFields& fields, const PolyGraph& graph) {
  const std::int64_t number = fields.integer("a vertex number");
  const std::int64_t index = number - graph.first_number;
  if (number < graph.first_number || index >= graph.vertices()) {
    fields.fail("there is no vertex " + std::to_string(number) + ", expected " +
                std::to_string(graph.first_number) + " to " +
                std::to_string(graph.first_number + graph.vertices() - 1));
  }
  return index;
}

void read_segments(TextFields& fields, PolyGraph& graph) {
  begin_section(fields, "segments");
  const std::int64_t count = read_count(fields, "segments");
  const std::int64_t markers = read_optional(fields, "the number of boundary markers", 1);
  read_lines(fields, count, "segments", [&] {
    fields.integer("a segment number");
    const std::int64_t begin = read_end(fields, graph);
    const std::int64_t end = read_end(fields, graph);
    if (begin == end) fields.fail("both ends of the segment are the same vertex");
    graph.segment_ends.push_back(begin);
    graph.segment_ends.push_back(end);
    graph.segment_tags.push_back(markers > 0 ? fields.tag("a boundary marker") : 1);
  });
}

void read_holes(TextFields& fields, PolyGraph& graph) {
  begin_section(fields, "holes");
  const std::int64_t count = read_count(fields, "holes");
  read_lines(fields, count, "holes", [&] {
    fields.integer("a hole number");
    graph.holes.push_back(fields.coordinate("x"));
    graph.holes.push_back(fields.coordinate("y"));
  });
}

void skip_regions(TextFields& fields) {
  if (!fields.next_line()) return;
  const std::int64_t count = read_count(fields, "regions");
  read_lines(fields, count, "regions", [] {});
  if (fields.next_line()) fields.fail("found more lines than expected");
}

void parse(PlaneDomain& domain, std::string_view text, const std::string& name,
           const std::function<NodeFile()>& node_file) {
  if (text.find('\0') != std::string_view::npos) {
    throw Error(ErrorKind::file, name + ": holds zero bytes, expected text in .poly format");
  }
  PolyGraph graph;
  TextFields fields(text, name);
  if (!read_vertices(fields, graph)) {
    if (!node_file) {
      fields.fail("0 vertices mean a separate .node file, which only a .poly file can have");
    }
    const NodeFile nodes = node_file();
    TextFields node_fields(nodes.text, nodes.name);
    if (!read_vertices(node_fields, graph)) node_fields.fail("the file holds no vertices");
    if (node_fields.next_line()) node_fields.fail("found more lines than expected");
  }
  read_segments(fields, graph);
  read_holes(fields, graph);
  skip_regions(fields);
  try {
    domain.add_pslg(graph.vertices(), graph.xy.data(), graph.vertex_tags.data(),
                    static_cast<std::int64_t>(graph.segment_tags.size()), graph.segment_ends.data(),
                    graph.segment_tags.data(), static_cast<std::int64_t>(graph.holes.size() / 2),
                    graph.holes.data(), graph.first_number);
  } catch (const Error& error) {
    throw Error(ErrorKind::file, name + ": " + error.what());
  }
}

std::string read_whole(const std::string& path) {
  const auto fail = [&path](const std::string& why) {
    throw Error(ErrorKind::file, path + ": cannot be read: " + why);
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) fail(std::strerror(errno));
  std::string text;
  std::array<char, 65536> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), file.get())) {
    text.append(part.data(), count);
    // Not text: it may be a device that never ends.
    if (std::memchr(part.data(), 0, count) != nullptr) break;
  }
  if (std::ferror(file.get())) fail(std::strerror(errno));
  return text;
}

std::string node_path(std::string path) {
  constexpr std::string_view kEnding = ".poly";
  if (path.ends_with(kEnding)) path.resize(path.size() - kEnding.size());
  return path + ".node";
}

}  // namespace

void read_poly_file(PlaneDomain& domain, const std::string& path) {
  parse(domain, read_whole(path), path, [&path] {
    const std::string beside = node_path(path);
    return NodeFile{read_whole(beside), beside};
  });
}

void parse_poly(PlaneDomain& domain, std::string_view text, const std::string& name) {
  parse(domain, text, name, nullptr);
}

}  // namespace pnpbs
