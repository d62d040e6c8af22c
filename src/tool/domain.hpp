// SPDX-License-Identifier: BSD-3-Clause
// The domain given on the command line: a file, standard input, or a primitive.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tool/arguments.hpp"
#include "tool/expression.hpp"
#include "tool/geo_file.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

// A primitive body as text: "ball(0,0,0, 1)".
struct Primitive {
  std::string shape;
  std::vector<double> numbers;
};

// Parses a primitive. Returns nothing if the text names a file. Throws BadInput if the shape is
// unknown.
std::optional<Primitive> primitive_in(const std::string& text);

void add(const Primitive& primitive, pnpbs_domain domain, pnpbs_context context);

// A body bounded by a level set: "levelset(-2,-2,-2, 2,2,2, 0.1, x^2+y^2+z^2-1)".
class LevelSet {
 public:
  // Parses a level set. Returns nullptr if the text has another beginning or names a file. Throws
  // BadInput.
  static std::unique_ptr<LevelSet> in(const std::string& text);

  // Adds the level set to the domain. This object must outlive the domain and its placements.
  void add_to(pnpbs_domain domain, pnpbs_context context) const;

 private:
  LevelSet(std::vector<double> numbers, const std::string& formula);

  std::vector<double> numbers_;  // two corners of the box, and the resolution
  Expression f_;
};

class DomainSource {
 public:
  // Determines the kind of the domain. Local. Throws BadInput.
  explicit DomainSource(const Arguments& arguments);

  // Returns nullptr if the domain is not a file that GDAL reads.
  const GeoFile* geo() const { return geo_.get(); }
  int dimension() const { return dimension_; }  // 2: in the plane, 3: a body, or on a sphere
  bool on_sphere() const { return sphere_.has_value(); }
  bool is_whole_sphere() const { return on_sphere() && path_.empty(); }
  // Creates an empty domain of this kind. Local. Throws Failure.
  void create(pnpbs_context context, pnpbs_domain* domain) const;

  // Reads the domain. The first rank reads standard input; every rank reads files. This object must
  // outlive the domain. Collective. Throws Failure.
  void read(pnpbs_domain domain, pnpbs_context context, const Ranks& ranks) const;

  // Returns whether the domain consists of triangles that may be repaired as a last resort.
  bool may_be_repaired() const;
  // Repairs the domain to this resolution, 0 for the default. Local. Throws Failure.
  void repair(pnpbs_domain domain, double resolution, pnpbs_context context) const;

 private:
  void add_to(pnpbs_domain domain, pnpbs_context context) const;
  void check_domain(pnpbs_domain domain, pnpbs_context context, bool talk) const;
  void read_plane(pnpbs_domain domain, pnpbs_context context) const;
  void read_msh(pnpbs_domain domain, pnpbs_context context) const;
  void name_groups(pnpbs_domain domain, pnpbs_context context) const;
  void add_regions(pnpbs_domain domain, pnpbs_context context) const;
  bool is_msh() const;

  std::string path_;  // "-" is standard input
  std::unique_ptr<GeoFile> geo_;
  std::unique_ptr<LevelSet> level_set_;
  std::optional<Primitive> primitive_;
  std::optional<SphereRequest> sphere_;
  int dimension_ = 2;
  double feature_angle_;
  double corner_angle_;         // in the plane
  std::optional<double> snap_;  // likewise
  bool filled_;
  std::optional<double> repair_, resurface_;  // their resolutions
  std::optional<std::int32_t> fragment_;      // the rule for overlaps
  bool repair_if_needed_, quiet_;
  std::vector<std::string> inner_;                           // groups
  std::vector<std::pair<std::int32_t, std::string>> names_;  // tags and their names
  std::vector<Region> regions_;
};

// Returns the tag of a group of facets with this dimension, given by its name or number. Throws
// BadInput if `group` is neither.
std::int32_t tag_of_facets(const std::string& group, int dimension,
                           const std::vector<GroupName>& names, const std::string& option);

}  // namespace pnpbs::tool
