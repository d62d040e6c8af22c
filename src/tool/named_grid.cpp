// SPDX-License-Identifier: BSD-3-Clause
#include "tool/named_grid.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/extension.hpp"
#include "spacing/beside_domain.hpp"
#include "sphere/degrees.hpp"
#include "tool/exit.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {
namespace {

constexpr std::array<std::string_view, 13> gdal_endings{
    "tif", "tiff", "nc", "nc4", "cdf", "grd", "img", "vrt", "hgt", "dem", "bil", "flt", "bag"};

bool is_for_gdal(const std::string& path) {
  return std::ranges::find(gdal_endings, std::string_view(extension_of(path))) !=
         gdal_endings.end();
}

bool is_name(const std::string& text) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text[0])) &&
         std::ranges::all_of(text, fits);
}

struct GridWords {
  std::string name, path, variable;
};

GridWords words_of(const std::string& text, const std::string& option = "--spacing-grid") {
  GridWords words;
  words.path = text;
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos && is_name(text.substr(0, equals))) {
    words.name = text.substr(0, equals);
    words.path = text.substr(equals + 1);
  }
  const std::size_t colon = words.path.rfind(':');
  if (colon != std::string::npos && is_for_gdal(words.path.substr(0, colon))) {
    words.variable = words.path.substr(colon + 1);
    words.path.resize(colon);
  }
  if (words.path.empty())
    throw BadInput(option + ": expected FILE or NAME=FILE, found '" + text + "'");
  return words;
}

bool has_reference_beside(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(std::filesystem::path(path).replace_extension(".prj"), error);
}

}  // namespace

std::string path_of_grid(const std::string& text) { return words_of(text).path; }

NamedGrid::NamedGrid(const std::string& text, int dimension, bool on_sphere,
                     const std::string& option, const std::string& other_name)
    : dimension_(on_sphere ? 2 : dimension), on_sphere_(on_sphere), option_(option) {
  const GridWords words = words_of(text, option);
  name_ = words.name.empty() ? other_name : words.name;
  path_ = words.path, variable_ = words.variable;
  if (!is_for_gdal(path_)) text_ = std::make_unique<Grid>(read_grid(path_, dimension_));
}

NamedGrid::~NamedGrid() {
  if (grid_) library_->grid_destroy(&grid_);
}

void NamedGrid::check(pnpbs_status status) const {
  if (status < 0)
    throw Failure(exit_code_of(status),
                  option_ + " " + path_ + ": " + std::string(library_->last_error()));
}

void NamedGrid::open(const std::string& projection, const Box<3>& domain) {
  if (text_ && !projection.empty() && has_reference_beside(path_)) text_.reset();
  if (!text_) {
    library_ = std::make_unique<GeoLibrary>();
    check(library_->grid_read(path_.c_str(), variable_.c_str(), projection.c_str(),
                              domain.low.data(), domain.high.data(), &grid_));
    return;
  }
  const Box<3> box = extent();
  const Box<2> given{{box.low[0], box.low[1]}, {box.high[0], box.high[1]}};
  const Box<2> plane{{domain.low[0], domain.low[1]}, {domain.high[0], domain.high[1]}};
  const std::string what = option_ + " " + path_ + ": its cells";
  try {
    require_meeting_boxes<2>(what, given, plane);
    if (dimension_ == 3) require_meeting_boxes<3>(what, box, domain);
  } catch (const Error& error) {
    throw BadInput(error.what());
  }
}

Box<3> NamedGrid::extent() const {
  constexpr double no_end = std::numeric_limits<double>::infinity();
  Box<3> box{{-no_end, -no_end, -no_end}, {no_end, no_end, no_end}};
  if (grid_) check(library_->grid_extent(grid_, box.low.data(), box.high.data()));
  if (!text_) return box;
  for (int k = 0; k < dimension_; ++k) {
    if (text_->size[k] == 1) continue;
    const auto size = static_cast<double>(text_->size[k]);
    box.low[k] = text_->origin[k] - 0.5 * text_->step[k];
    box.high[k] = text_->origin[k] + (size - 0.5) * text_->step[k];
  }
  return box;
}

void NamedGrid::evaluate(std::int64_t n, const double* coordinates, double* values,
                         std::int32_t* inside) const {
  if (!on_sphere_) return evaluate_in_plane(n, coordinates, values, inside);
  std::vector<Point<2>> degrees;
  for (std::int64_t i = 0; i < n; ++i) {
    const double* x = coordinates + 3 * i;
    degrees.push_back(degrees_of({x[0], x[1], x[2]}));
  }
  evaluate_in_plane(n, n > 0 ? degrees[0].data() : nullptr, values, inside);
}

void NamedGrid::evaluate_in_plane(std::int64_t n, const double* coordinates, double* values,
                                  std::int32_t* inside) const {
  if (text_) return evaluate_text(n, coordinates, values, inside);
  if (dimension_ == 2) return check(library_->grid_values(grid_, n, coordinates, values, inside));
  std::vector<double> plane(static_cast<std::size_t>(2 * n));
  for (std::int64_t i = 0; i < n; ++i) std::copy_n(coordinates + 3 * i, 2, plane.begin() + 2 * i);
  check(library_->grid_values(grid_, n, plane.data(), values, inside));
}

void NamedGrid::evaluate_text(std::int64_t n, const double* coordinates, double* values,
                              std::int32_t* inside) const {
  const Box<3> box = extent();
  for (std::int64_t i = 0; i < n; ++i) {
    const double* place = coordinates + dimension_ * i;
    values[i] = value_at(*text_, place, dimension_);
    if (!inside) continue;
    inside[i] = has_data_around(*text_, place, dimension_) ? within : without_data;
    for (int k = 0; k < dimension_; ++k)
      if (place[k] < box.low[k] - 0.5 * text_->step[k] ||
          place[k] > box.high[k] + 0.5 * text_->step[k])
        inside[i] = beyond_edge;
  }
}

}  // namespace pnpbs::tool
