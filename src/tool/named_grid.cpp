// SPDX-License-Identifier: BSD-3-Clause
#include "tool/named_grid.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/extension.hpp"
#include "base/small_letters.hpp"
#include "spacing/outside_domain.hpp"
#include "sphere/degrees.hpp"
#include "tool/exit.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {
namespace {

constexpr double max_points = 1e9;

// The words of a text file, and the line of the current one.
class Words {
 public:
  explicit Words(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) throw BadInput("cannot read '" + path + "': " + std::strerror(errno));
    std::error_code error;  // folders can be opened like files
    if (std::filesystem::is_directory(path, error))
      throw BadInput("cannot read '" + path + "': it is a folder, not a file");
    for (const char byte : {'\xef', '\xbb', '\xbf'})  // byte order mark of UTF-8
      if (file_.peek() == static_cast<unsigned char>(byte)) file_.get();
  }

  bool next(std::string& word) {
    word.clear();
    for (int c = file_.get(); c != std::char_traits<char>::eof(); c = file_.get()) {
      if (std::isspace(c)) {
        if (!word.empty()) {
          file_.unget();
          return true;
        }
        line_ += c == '\n' || (c == '\r' && file_.peek() != '\n');
      } else {
        if (word.size() >= 64) fail("a number", word + "...");
        word.push_back(static_cast<char>(c));
      }
    }
    return !word.empty();
  }

  double number(const std::string& word, const char* expected) const {
    double value = 0;
    const char* end = word.data() + word.size();
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const auto result = std::from_chars(begin, end, value);
    if (result.ec != std::errc() || result.ptr != end) fail(expected, "'" + word + "'");
    return value;
  }

  [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
    throw BadInput(path_ + ":" + std::to_string(line_) + ": expected " + expected + ", found " +
                   found);
  }

 private:
  std::string path_;
  std::ifstream file_;
  std::int64_t line_ = 1;
};

bool begins_with_letter(const std::string& word) {
  return std::isalpha(static_cast<unsigned char>(word[0])) != 0;
}

using Header = std::map<std::string, double>;

// Reads name and value pairs. Leaves the first word of the values in `word`.
Header read_header(Words& words, std::string& word) {
  constexpr std::array<std::string_view, 14> known{
      "ncols",     "nrows",     "nlayers",  "xllcorner", "yllcorner", "zllcorner", "xllcenter",
      "yllcenter", "zllcenter", "cellsize", "dx",        "dy",        "dz",        "nodata_value"};
  Header header;
  while (words.next(word) && begins_with_letter(word)) {
    const std::string name = to_lower_case(word);
    if (name == "nan" || name == "inf") break;
    if (std::ranges::find(known, name) == known.end()) {
      words.fail(
          "ncols, nrows, nlayers, xllcorner or xllcenter (y, z as well), cellsize or dx and dy "
          "(and "
          "dz), nodata_value",
          "'" + word + "'");
    }
    std::string value;
    if (!words.next(value)) words.fail("a value of " + word, "the end of the file");
    header[name] = words.number(value, "a number");
  }
  return header;
}

double value_of(const Header& header, const Words& words, const std::string& name) {
  const auto found = header.find(name);
  if (found == header.end()) words.fail(name + " in the header", "none");
  return found->second;
}

std::int64_t count_of(const Header& header, const Words& words, const std::string& name) {
  const double value = value_of(header, words, name);
  if (!(value >= 1 && value <= max_points && value == std::floor(value))) {
    words.fail(name + " to be a whole number from 1 to 1e9", std::to_string(value));
  }
  return static_cast<std::int64_t>(value);
}

double origin_of(const Header& header, const Words& words, char axis, double step) {
  const std::string letter(1, axis);
  const auto centre = header.find(letter + "llcenter");
  if (centre != header.end()) return centre->second;
  return value_of(header, words, letter + "llcorner") + 0.5 * step;
}

// Returns the names of the steps for messages.
std::string steps_called(int dimension) { return dimension == 3 ? "dx, dy and dz" : "dx and dy"; }

// Reads one step for all directions, or one per direction, as GDAL writes cells that are not
// squares.
void read_steps(const Header& header, const Words& words, int dimension, Grid& grid) {
  const bool squares = header.contains("cellsize");
  const bool each = header.contains("dx") || header.contains("dy") || header.contains("dz");
  if (squares && each) words.fail("cellsize, or " + steps_called(dimension), "both in the header");
  if (!squares && !each)
    words.fail("cellsize, or " + steps_called(dimension) + ", in the header", "none");
  for (int k = 0; k < dimension; ++k) {
    const std::string name = squares ? "cellsize" : std::string("d") + "xyz"[k];
    grid.step[k] = value_of(header, words, name);
    if (!(grid.step[k] > 0 && std::isfinite(grid.step[k])))
      words.fail(name + " to be positive", std::to_string(grid.step[k]));
  }
}

// Reads the shape of the grid, which has three dimensions if there are layers, and two otherwise.
void read_shape(const Header& header, const Words& words, Grid& grid) {
  constexpr const char* counts[] = {"ncols", "nrows", "nlayers"};
  const int dimension = header.contains("nlayers") ? 3 : 2;
  double points = 1;
  for (int k = 0; k < dimension; ++k) {
    grid.size[k] = count_of(header, words, counts[k]);
    points *= static_cast<double>(grid.size[k]);
  }
  if (points > max_points) words.fail("at most 1e9 grid points", "more");
  read_steps(header, words, dimension, grid);
  for (int k = 0; k < dimension; ++k)
    grid.origin[k] = origin_of(header, words, "xyz"[k], grid.step[k]);
}

// Grows the array with the values read, because the size in the header may be wrong.
std::vector<double> read_values(Words& words, std::string word, std::int64_t count) {
  std::vector<double> values;
  for (bool more = !word.empty(); more; more = words.next(word)) {
    if (static_cast<std::int64_t>(values.size()) == count) words.fail("no more values", word);
    values.push_back(words.number(word, "a spacing"));
  }
  if (static_cast<std::int64_t>(values.size()) < count) {
    words.fail(std::to_string(count) + " values", "only " + std::to_string(values.size()));
  }
  return values;
}

// Reverses the rows of each layer: the northern row comes first in the file and last in the grid.
void turn_layers_upside_down(Grid& grid) {
  const std::int64_t columns = grid.size[0], rows = grid.size[1];
  for (auto layer = grid.values.begin(); layer != grid.values.end(); layer += columns * rows)
    for (std::int64_t row = 0; row < rows / 2; ++row)
      std::swap_ranges(layer + row * columns, layer + (row + 1) * columns,
                       layer + (rows - 1 - row) * columns);
}

// Returns the location of a value. Rows are counted from the north, as in the file.
std::string place_of_value(const Grid& grid, std::size_t value, int dimension) {
  const auto i = static_cast<std::int64_t>(value);
  const std::int64_t at[] = {i % grid.size[0], i / grid.size[0] % grid.size[1],
                             i / grid.size[0] / grid.size[1]};
  double x[3];
  for (int k = 0; k < 3; ++k) x[k] = grid.origin[k] + static_cast<double>(at[k]) * grid.step[k];
  const bool has_layers = grid.size[2] > 1;
  return "row " + std::to_string(grid.size[1] - at[1]) + ", column " + std::to_string(at[0] + 1) +
         (has_layers ? ", layer " + std::to_string(at[2] + 1) : "") + ", at " +
         place_text(x, has_layers ? dimension : 2, false);
}

// Throws if a value that is not declared as missing is not a number.
void require_numbers(const Grid& grid, const std::string& path, int dimension) {
  const auto wrong = std::ranges::find_if(grid.values, [](double v) { return !std::isfinite(v); });
  if (wrong == grid.values.end()) return;
  const auto i = static_cast<std::size_t>(wrong - grid.values.begin());
  throw BadInput(path + ": the value in " + place_of_value(grid, i, dimension) + " is " +
                 number_text(*wrong) +
                 ": expected a number, or the header line 'nodata_value nan' for missing values");
}

// Spreads values to cells without data from their neighbours, one ring at a time.
void fill_gaps(Grid& grid, double no_data, const Words& words) {
  std::deque<std::int64_t> front;
  std::vector<bool> known(grid.values.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    known[i] = grid.values[i] != no_data && !(std::isnan(no_data) && std::isnan(grid.values[i]));
    if (known[i]) front.push_back(static_cast<std::int64_t>(i));
  }
  if (front.empty()) words.fail("data", "no cell that has any");
  if (front.size() == known.size()) return;
  grid.has_data = known;
  for (; !front.empty(); front.pop_front()) {
    const std::int64_t layer_size = grid.size[0] * grid.size[1];
    const std::int64_t column = front[0] % grid.size[0];
    const std::int64_t row = front[0] % layer_size / grid.size[0], layer = front[0] / layer_size;
    const auto visit = [&](bool exists, std::int64_t offset) {
      const auto to = static_cast<std::size_t>(front[0] + offset);
      if (!exists || known[to]) return;
      known[to] = true;
      grid.values[to] = grid.values[static_cast<std::size_t>(front[0])];
      front.push_back(front[0] + offset);
    };
    visit(column > 0, -1);
    visit(column + 1 < grid.size[0], 1);
    visit(row > 0, -grid.size[0]);
    visit(row + 1 < grid.size[1], grid.size[0]);
    visit(layer > 0, -layer_size);
    visit(layer + 1 < grid.size[2], layer_size);
  }
}

// The grid points around a point, and its fractional position between them.
struct Around {
  std::array<std::int64_t, 3> cell{}, next{};
  std::array<double, 3> fraction{};
  Around(const Grid& grid, const double* place, int dimension) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
      const double last = static_cast<double>(grid.size[k] - 1);
      const double at = std::clamp((place[k] - grid.origin[k]) / grid.step[k], 0.0, last);
      cell[k] = static_cast<std::int64_t>(at);
      next[k] = std::min(cell[k] + 1, grid.size[k] - 1);
      fraction[k] = at - static_cast<double>(cell[k]);
    }
  }
};

}  // namespace

Grid read_grid(const std::string& path, int dimension) {
  Words words(path);
  std::string word;
  const Header header = read_header(words, word);
  if (dimension == 2 && header.contains("nlayers"))
    throw BadInput(path +
                   ": a grid with layers (nlayers) is for bodies; this domain is in the plane");
  Grid grid;
  read_shape(header, words, grid);
  grid.values = read_values(words, word, grid.size[0] * grid.size[1] * grid.size[2]);
  turn_layers_upside_down(grid);
  const auto no_data = header.find("nodata_value");
  fill_gaps(grid, no_data == header.end() ? -9999.0 : no_data->second, words);
  require_numbers(grid, path, dimension);
  return grid;
}

void require_spacings(const Grid& grid, const std::string& path, int dimension) {
  const auto wrong = std::ranges::find_if(grid.values, [](double value) { return value <= 0; });
  if (wrong == grid.values.end()) return;
  const auto i = static_cast<std::size_t>(wrong - grid.values.begin());
  throw BadInput(path + ": the value in " + place_of_value(grid, i, dimension) + " is " +
                 number_text(*wrong) + ": d must be greater than 0");
}

double value_at(const Grid& grid, const double* place, int dimension) {
  const Around at(grid, place, dimension);
  const auto in_row = [&](std::int64_t j, std::int64_t layer) {
    const double* row = grid.values.data() + grid.size[0] * (j + grid.size[1] * layer);
    return std::lerp(row[at.cell[0]], row[at.next[0]], at.fraction[0]);
  };
  const auto in_layer = [&](std::int64_t layer) {
    return std::lerp(in_row(at.cell[1], layer), in_row(at.next[1], layer), at.fraction[1]);
  };
  const double low = in_layer(at.cell[2]);
  return at.fraction[2] == 0 ? low : std::lerp(low, in_layer(at.next[2]), at.fraction[2]);
}

bool has_data_around(const Grid& grid, const double* place, int dimension) {
  if (grid.has_data.empty()) return true;
  const Around around(grid, place, dimension);
  for (const std::int64_t layer : {around.cell[2], around.next[2]})
    for (const std::int64_t row : {around.cell[1], around.next[1]})
      for (const std::int64_t column : {around.cell[0], around.next[0]})
        if (grid.has_data[static_cast<std::size_t>(column +
                                                   grid.size[0] * (row + grid.size[1] * layer))])
          return true;
  return false;
}

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
