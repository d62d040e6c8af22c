// SPDX-License-Identifier: BSD-3-Clause
#include "tool/domain.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "io/extension.hpp"
#include "tool/exit.hpp"

namespace pnpbs::tool {
namespace {

constexpr std::size_t max_bytes = std::size_t{1} << 30;  // an endless stream is an error

std::string standard_input() {
  std::string text;
  char part[1 << 16];
  for (;;) {
    const ssize_t size = ::read(STDIN_FILENO, part, sizeof part);
    if (size == 0) return text;
    if (size < 0 && errno == EINTR) continue;
    if (size < 0)
      throw BadInput(std::string("cannot read standard input: ") + std::strerror(errno));
    text.append(part, static_cast<std::size_t>(size));
    if (text.size() > max_bytes) throw BadInput("standard input is longer than 1 GiB");
  }
}

bool is_surface(const std::string& extension) {
  constexpr std::array<std::string_view, 5> surfaces{"stl", "off", "obj", "ply", "smesh"};
  return std::ranges::find(surfaces, extension) != surfaces.end();
}

// A .poly is Triangle's or TetGen's: the second number of both is the dimension. Only what is
// certainly a body's is said to be one; all else, pipes too, is for the reader of plane domains.
bool has_three_dimensions(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path);
  std::string line, vertices, dimension;
  while (std::getline(file, line)) {
    std::istringstream words(line.substr(0, line.find('#')));
    if (words >> vertices) return words >> dimension && dimension == "3";
  }
  return false;
}

}  // namespace

DomainSource::DomainSource(const Arguments& arguments)
    : path_(arguments.domain),
      level_set_(LevelSet::in(path_)),
      primitive_(level_set_ ? std::nullopt : primitive_in(path_)),
      feature_angle_(arguments.feature_angle.value_or(default_feature_angle)),
      filled_(!arguments.surfaces_only) {
  const std::string extension = io::extension_of(path_);
  if (level_set_ || primitive_ || is_surface(extension) ||
      (extension == "poly" && has_three_dimensions(path_)))
    dimension_ = 3;
}

void DomainSource::read(pnpbs_domain domain, pnpbs_context context, const Ranks& ranks) const {
  const bool from_input = path_ == "-";
  const std::string text = from_input ? ranks.from_first(standard_input) : "";
  ranks.agreed([&] {
    if (from_input) {
      check(pnpbs_domain_parse_poly(domain, text.data(), static_cast<std::int64_t>(text.size()),
                                    "standard input"),
            context);
    } else {
      add_to(domain, context);
    }
    check(pnpbs_domain_check(domain), context);
  });
}

void DomainSource::add_to(pnpbs_domain domain, pnpbs_context context) const {
  if (dimension_ == 2) return read_plane(domain, context);
  check(pnpbs_domain_set_filled(domain, filled_ ? 1 : 0), context);
  if (level_set_) return level_set_->add_to(domain, context);
  if (primitive_) return add(*primitive_, domain, context);
  check(pnpbs_domain_read_surface(domain, PNPBS_BOUNDARY, path_.c_str(), feature_angle_), context);
}

// Whatever its name. But who gives a file that is none needs to know how it was taken.
void DomainSource::read_plane(pnpbs_domain domain, pnpbs_context context) const {
  try {
    check(pnpbs_domain_read_poly(domain, path_.c_str()), context);
  } catch (const Failure& error) {
    const std::string extension = io::extension_of(path_);
    std::error_code none;
    if (extension == "poly" || !std::filesystem::is_regular_file(path_, none)) throw;
    throw BadInput(std::string(error.what()) + "\nIt was read as a .poly file: its name does not " +
                   "end in .stl, .off, .obj, .ply or .smesh.");
  }
}

}  // namespace pnpbs::tool
