// SPDX-License-Identifier: BSD-3-Clause
#include "tool/domain.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

#include "base/extension.hpp"
#include "tool/exit.hpp"
#include "tool/names.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

struct Shape {
  const char* name;
  std::size_t numbers;
  const char* usage;
};

constexpr std::array shapes{
    Shape{"box", 6, "box(x0,y0,z0, x1,y1,z1), two opposite corners"},
    Shape{"ball", 4, "ball(x,y,z, r), centre and radius"},
    Shape{"cylinder", 7, "cylinder(x0,y0,z0, x1,y1,z1, r), the ends of its axis and the radius"}};

const Shape& shape_called(const std::string& name) {
  std::vector<std::string> names{"levelset"};
  for (const Shape& shape : shapes) {
    if (shape.name == name) return shape;
    names.emplace_back(shape.name);
  }
  throw BadInput("--domain: there is no file and no body '" + name + "'" +
                 did_you_mean(name, names) + " (known: box, ball, cylinder, levelset)");
}

}  // namespace

std::optional<Primitive> primitive_in(const std::string& text) {
  const std::size_t open = text.find('(');
  if (open == 0 || open == std::string::npos || !text.ends_with(')')) return std::nullopt;
  if (text.find('/') != std::string::npos) return std::nullopt;
  std::error_code error;
  if (std::filesystem::exists(text, error)) return std::nullopt;
  Primitive primitive{text.substr(0, open), {}};
  const Shape& shape = shape_called(primitive.shape);
  const auto numbers = numbers_between_commas(text.substr(open + 1, text.size() - open - 2));
  if (!numbers || numbers->size() != shape.numbers)
    throw BadInput("--domain: '" + text + "' is not " + shape.usage);
  primitive.numbers = *numbers;
  return primitive;
}

void add(const Primitive& primitive, pnpbs_domain domain, pnpbs_context context) {
  constexpr std::int32_t tag = 1;
  const double* x = primitive.numbers.data();
  if (primitive.shape == "box") check(pnpbs_domain_add_box(domain, x, x + 3, tag), context);
  if (primitive.shape == "ball") check(pnpbs_domain_add_ball(domain, x, x[3], tag), context);
  if (primitive.shape == "cylinder")
    check(pnpbs_domain_add_cylinder(domain, x, x + 3, x[6], tag), context);
}

namespace {

constexpr std::size_t numbers_before_formula = 7;

// Returns the position after the given number of commas, or npos if there are fewer.
std::size_t behind_commas(const std::string& text, std::size_t commas) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < commas; ++k) {
    const std::size_t comma = text.find(',', at);
    if (comma == std::string::npos) return comma;
    at = comma + 1;
  }
  return at;
}

}  // namespace

std::unique_ptr<LevelSet> LevelSet::in(const std::string& text) {
  const std::string name = "levelset(";
  std::error_code error;
  if (!text.starts_with(name) || std::filesystem::exists(text, error)) return nullptr;
  const bool whole = text.ends_with(')');
  const std::string inner = text.substr(name.size(), text.size() - name.size() - (whole ? 1 : 0));
  const std::size_t formula = behind_commas(inner, numbers_before_formula);
  const auto numbers =
      numbers_between_commas(formula == std::string::npos ? inner : inner.substr(0, formula - 1));
  if (!whole || formula == std::string::npos || !numbers)
    throw BadInput(
        "--domain: '" + text +
        "' is not levelset(x0,y0,z0, x1,y1,z1, h, f), two opposite corners of a box, the "
        "resolution, and a formula in x, y and z that is negative inside the body");
  return std::unique_ptr<LevelSet>(new LevelSet(*numbers, inner.substr(formula)));
}

LevelSet::LevelSet(std::vector<double> numbers, const std::string& formula)
    : numbers_(std::move(numbers)), f_(formula, 3, "--domain") {}

void LevelSet::add_to(pnpbs_domain domain, pnpbs_context context) const {
  constexpr std::int32_t tag = 1;
  const double* x = numbers_.data();
  check(pnpbs_domain_add_level_set(domain, call_expression, f_.as_user(), x, x + 3, x[6], tag),
        context);
}

namespace {

constexpr std::size_t max_bytes = std::size_t{1} << 30;  // limit for an endless stream

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

// Returns 3 for surfaces, TetGen's .poly, and .msh files that are not planar.
int dimension_of(const std::string& path, bool surfaces_only) {
  if (path == "-") return 2;
  if (surfaces_only && extension_of(path) == "msh") return 3;
  std::int32_t dimension = 2;
  check(pnpbs_file_dimension(path.c_str(), &dimension), nullptr);
  return dimension;
}

}  // namespace

std::int32_t tag_of_facets(const std::string& group, int dimension,
                           const std::vector<GroupName>& names, const std::string& option) {
  std::vector<std::string> known;
  for (const GroupName& each : names) {
    if (each.dimension != dimension) continue;
    if (each.name == group) return each.tag;
    known.push_back(each.name);
  }
  std::int32_t tag = 0;
  const char* end = group.data() + group.size();
  const auto read = std::from_chars(group.data(), end, tag);
  if (read.ec == std::errc() && read.ptr == end && tag != 0) return tag;
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  throw BadInput(option + ": '" + group + "' is neither a tag nor the name of a group of " +
                 (dimension == 2 ? "triangles" : "segments") + did_you_mean(group, known) +
                 (known.empty() ? " (the domain has no named ones)" : " (known: " + list + ")"));
}

DomainSource::DomainSource(const Arguments& arguments)
    : path_(arguments.domain),
      geo_(GeoFile::is_meant_by(arguments) ? std::make_unique<GeoFile>(arguments) : nullptr),
      level_set_(LevelSet::in(path_)),
      primitive_(level_set_ ? std::nullopt : primitive_in(path_)),
      sphere_(arguments.sphere),
      feature_angle_(arguments.feature_angle.value_or(default_feature_angle)),
      corner_angle_(arguments.corner_angle.value_or(0)),
      snap_(arguments.snap),
      filled_(!arguments.surfaces_only),
      repair_(arguments.repair),
      resurface_(arguments.resurface),
      fragment_(arguments.fragment),
      repair_if_needed_(arguments.repair_if_needed),
      quiet_(arguments.quiet),
      inner_(arguments.inner),
      names_(arguments.names),
      regions_(arguments.regions) {
  if (sphere_ && !geo_ && !path_.empty())
    throw BadInput(
        "--sphere is for the coasts in GeoJSON, shapefiles and other files that GDAL reads, "
        "and '" +
        path_ + "' is none of these");
  if (sphere_) dimension_ = 3;
  if (geo_ || sphere_) return;
  dimension_ = level_set_ || primitive_ ? 3 : dimension_of(path_, arguments.surfaces_only);
}

void DomainSource::read(pnpbs_domain domain, pnpbs_context context, const Ranks& ranks) const {
  const bool from_input = path_ == "-";
  const std::string text = from_input ? ranks.from_first(standard_input) : "";
  ranks.collective_try([&] {
    if (from_input) {
      check(pnpbs_domain_parse_poly(domain, text.data(), static_cast<std::int64_t>(text.size()),
                                    "standard input"),
            context);
    } else {
      add_to(domain, context);
    }
    name_groups(domain, context);
    add_regions(domain, context);
    if (dimension_ == 2) check(pnpbs_domain_set_corner_angle(domain, corner_angle_), context);
    if (snap_) check(pnpbs_domain_set_snap(domain, *snap_), context);
    check_domain(domain, context, ranks.is_first() && !quiet_);
  });
}

bool DomainSource::may_be_repaired() const {
  return repair_if_needed_ && !geo_ && !level_set_ && !primitive_;
}

void DomainSource::repair(pnpbs_domain domain, double resolution, pnpbs_context context) const {
  check(pnpbs_domain_set_resurfaced(domain, resolution), context);
  check(pnpbs_domain_check(domain), context);
}

void DomainSource::check_domain(pnpbs_domain domain, pnpbs_context context, bool talk) const {
  const pnpbs_status status = pnpbs_domain_check(domain);
  if (status == PNPBS_ERROR_DOMAIN && may_be_repaired()) {
    if (talk)
      std::cerr << "pnpbs: note: the body is repaired, because it is refused otherwise: "
                << pnpbs_last_error(context) << "\n";
    return repair(domain, 0, context);
  }
  if (status >= 0) return;
  std::string message = pnpbs_last_error(context);
  std::int32_t reason = PNPBS_REASON_OTHER;
  check(pnpbs_last_error_data(context, &reason, nullptr), context);
  if (geo_) {
    message = geo_->explained(message);
  } else if (reason == PNPBS_REASON_CROSSING && !fragment_) {
    message += "\n--fragment splits curves where they cross or overlap";
  }
  throw Failure(exit_code_of(status), message);
}

void DomainSource::name_groups(pnpbs_domain domain, pnpbs_context context) const {
  for (const auto& [tag, name] : names_)
    check(pnpbs_domain_set_tag_name(domain, sphere_ ? 1 : dimension_ - 1, tag, name.c_str()),
          context);
  const std::vector<GroupName> names = group_names(domain, context);
  for (const std::string& group : inner_)
    check(pnpbs_domain_set_role(domain, tag_of_facets(group, 2, names, "--inner"), PNPBS_INNER),
          context);
}

void DomainSource::add_regions(pnpbs_domain domain, pnpbs_context context) const {
  for (const Region& region : regions_) {
    std::vector<double> point = region.point;
    if (sphere_) {
      point.resize(3);
      check(pnpbs_sphere_points(1, 1, region.point.data(), point.data()), context);
    }
    check(pnpbs_domain_add_region(domain, point.data(), region.tag), context);
  }
}

void DomainSource::create(pnpbs_context context, pnpbs_domain* domain) const {
  if (!sphere_) {
    check(pnpbs_domain_create(context, dimension_, domain), context);
    return;
  }
  Point<3> outside;
  check(pnpbs_sphere_points(1, 1, sphere_->outside.data(), outside.data()), nullptr);
  check(pnpbs_domain_create_sphere(context, sphere_->radius, outside.data(), domain), context);
}

void DomainSource::add_to(pnpbs_domain domain, pnpbs_context context) const {
  if (is_whole_sphere()) return;
  if (fragment_) check(pnpbs_domain_set_fragment(domain, *fragment_), context);
  if (geo_) {
    geo_->read();
    return geo_->add_to(domain, context, corner_angle_);
  }
  if (dimension_ == 2) return read_plane(domain, context);
  check(pnpbs_domain_set_filled(domain, filled_ ? 1 : 0), context);
  if (repair_) check(pnpbs_domain_set_repair(domain, *repair_), context);
  if (resurface_) check(pnpbs_domain_set_resurfaced(domain, *resurface_), context);
  if (is_msh()) return read_msh(domain, context);
  if (level_set_) return level_set_->add_to(domain, context);
  if (primitive_) return add(*primitive_, domain, context);
  check(pnpbs_domain_read_surface(domain, PNPBS_BOUNDARY, path_.c_str(), feature_angle_), context);
}

bool DomainSource::is_msh() const { return extension_of(path_) == "msh"; }

void DomainSource::read_msh(pnpbs_domain domain, pnpbs_context context) const {
  check(pnpbs_domain_read_msh(domain, path_.c_str(), feature_angle_), context);
}

// Reads every file other than .msh as .poly, whatever its extension. If that fails for another
// extension, the message says how the file was read.
void DomainSource::read_plane(pnpbs_domain domain, pnpbs_context context) const {
  if (is_msh()) return read_msh(domain, context);
  try {
    check(pnpbs_domain_read_poly(domain, path_.c_str()), context);
  } catch (const Failure& error) {
    const std::string extension = extension_of(path_);
    std::error_code none;
    if (extension == "poly" || !std::filesystem::is_regular_file(path_, none)) throw;
    throw BadInput(std::string(error.what()) + "\nIt was read as a .poly file: its name does not " +
                   "end in .stl, .off, .obj, .ply, .smesh, .msh, .geojson, .shp or .gpkg.");
  }
}

}  // namespace pnpbs::tool
