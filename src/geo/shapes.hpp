// SPDX-License-Identifier: BSD-3-Clause
// The shapes of a layer in the form that a domain takes them: projected, and divided into curves
// that bound the domain and curves inside it.
#pragma once

#include <string>
#include <vector>

#include "base/message_text.hpp"
#include "geo/outlines.hpp"
#include "geo/projection.hpp"
#include "geo/region_points.hpp"
#include "geo/shape_file.hpp"
#include "pnpbs/pnpbs.h"

namespace pnpbs::geo {

// The arguments of pnpbs_geo_read_regions().
struct Request {
  std::string path, layer, projection, unit, tag_field, region_field;
};

// The projected shapes of a layer.
class Shapes {
 public:
  explicit Shapes(const Request& request);  // reads the file; throws Error

  // Adds the shapes to a domain. Throws Error with the message of libpnpbs and its points.
  void add_to(pnpbs_domain domain, pnpbs_context context, double corner_angle) const;

  const Projection& projection() const { return projection_; }
  bool on_sphere() const { return projection_.on_sphere(); }
  const std::vector<Note>& notes() const { return layer_.notes; }
  const Projection::Scale& scale() const { return scale_; }
  std::int64_t vertices() const;
  std::int64_t boundary_curves() const;
  std::int64_t inner_curves() const;
  std::int64_t points() const { return static_cast<std::int64_t>(layer_.spots.size()); }

  // Returns the text with additions to the message in it: `last`, the last one of this library, or
  // the last one of libpnpbs on this thread. Longitude and latitude are added after each projected
  // point, then the features with a segment there, and advice where curves cross. Any other text is
  // returned as it is.
  std::string explained(const std::string& text, const MessageText& last) const;

 private:
  MessageText with_degrees(const MessageText& message) const;
  std::string degrees_for(const NamedPoint& point) const;
  std::vector<const Route*> routes_at(const NamedPoint& point) const;
  std::string features_text(const std::vector<const Route*>& routes) const;
  bool are_neighbours(const std::vector<const Route*>& routes) const;
  std::string advice_on_crossing(const NamedPoint& point) const;
  void project();
  void find_regions();
  void take_notes();
  void add_curves(pnpbs_domain domain, pnpbs_context context, double corner_angle) const;
  std::vector<RegionPoint> region_points_in(pnpbs_domain domain, pnpbs_context context) const;
  std::vector<double> coordinates_of(std::vector<Point<2>> points) const;
  MessageText words_for(const Point<2>& given, std::int64_t feature) const;
  std::string words_for(const Curve& curve) const;

  LayerShapes layer_;  // its paths are moved into routes_
  Projection projection_;
  Projection::Scale scale_;
  std::vector<Point<2>> places_;
  // Feature in which each vertex of the file first appears.
  std::vector<std::int64_t> feature_of_place_;
  std::vector<Route> routes_;  // what the file has
  Outlines outlines_;
  std::int64_t lines_along_boundary_ = 0;
  std::vector<RegionPoint> region_points_;
};

}  // namespace pnpbs::geo
