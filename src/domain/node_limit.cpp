// SPDX-License-Identifier: BSD-3-Clause
#include "domain/node_limit.hpp"

#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace pnpbs {

namespace {

// Returns the number with three digits and a suitable unit, such as "1.23 GiB".
std::string bytes_text(double bytes) {
  const char* const units[] = {" bytes", " KiB", " MiB", " GiB", " TiB"};
  int unit = 0;
  for (; bytes >= 1000 && unit < 4; ++unit) bytes /= 1024;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, bytes, std::chars_format::general, 3);
  return std::string(text, end.ptr) + units[unit];
}

std::string about_resolve(const NodeLimit& limit) {
  if (!limit.resolves) return "";
  return "; the option resolve reduces d at thin walls, narrow gaps and sharp edges: repair the "
         "geometry there, or leave the option at 0";
}

}  // namespace

void NodeLimit::report_too_many(double nodes, double d, const MessageText& place) const {
  throw Error(ErrorKind::spacing,
              "spacing d = " + number_text(d) + " near " + place + " would mean about " +
                  number_text(std::round(nodes)) + " nodes or more; the option max_nodes allows " +
                  std::to_string(max_nodes) + ": use a larger spacing or a larger max_nodes" +
                  about_resolve(*this));
}

void NodeLimit::require_memory_for(double nodes, double bytes_per_node, const char* name) const {
  const double bytes = bytes_per_node * nodes;
  if (bytes <= max_bytes) return;
  throw Error(ErrorKind::memory,
              "about " + number_text(std::round(nodes)) + " " + name + " or more would need " +
                  bytes_text(bytes) + " of memory, and " + bytes_text(max_bytes) +
                  " are available: use a larger spacing or more machines; the option "
                  "max_memory = 0 switches this check off" +
                  about_resolve(*this));
}

}  // namespace pnpbs
