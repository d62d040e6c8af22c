// SPDX-License-Identifier: BSD-3-Clause
#include "domain/domain_base.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "domain/given_values.hpp"

namespace pnpbs {

using namespace given_values;

template <int Dim>
void DomainBase<Dim>::add_fixed_nodes(std::int64_t n, const double* coordinates,
                                      const std::int32_t* tags) {
  require_count("n", n, 0);
  const std::vector<Point<Dim>> points = read_points<Dim>("coordinates", n, coordinates);
  const std::vector<std::int32_t> values = read_tags("tags", n, tags);
  for (std::size_t i = 0; i < points.size(); ++i)
    given_nodes_.push_back(
        {points[i], values[i], "fixed node " + std::to_string(given_nodes_.size())});
  checked_ = false;
}

template <int Dim>
void DomainBase<Dim>::set_periodic(const Box<Dim>& box, const std::array<bool, Dim>& periodic,
                                   const std::array<bool, Dim>& flat, const std::int32_t* tags) {
  given_values::require_point<Dim>("low", box.low);
  given_values::require_point<Dim>("high", box.high);
  for (std::size_t k = 0; k < Dim; ++k)
    if (!(box.low[k] < box.high[k]))
      given_values::reject("low[" + std::to_string(k) + "] is " + number_text(box.low[k]) +
                           ", not less than high[" + std::to_string(k) +
                           "] = " + number_text(box.high[k]));
  if (std::ranges::count(periodic, true) == 0)
    given_values::reject("periodic has no axis along which the domain is periodic");
  for (std::size_t a = 0; Dim == 3 && a < Dim; ++a)
    for (std::size_t b = 0; b < Dim; ++b)
      if (flat[a] && periodic[b] && !flat[b])
        throw Error(ErrorKind::unsupported,
                    "a periodic domain in space cannot have flat sides along axis " +
                        std::to_string(a) + " and not along axis " + std::to_string(b) +
                        ": make all periodic axes flat, or none");
  const std::vector<std::int32_t> of_sides = read_tags("tags", 2 * Dim, tags);
  cell_ = PeriodicCell<Dim>(box, periodic);
  std::ranges::copy(of_sides, side_tags_.begin());
  flat_ = flat;
  checked_ = false;
}

template <int Dim>
void DomainBase<Dim>::add_hole(const Point<Dim>& point) {
  require_point<Dim>("point", point);
  region_points_.push_back({point, "hole " + std::to_string(holes_given_++)});
  checked_ = false;
}

template <int Dim>
void DomainBase<Dim>::add_hole_of_file(const Point<Dim>& point, std::string name) {
  require_point<Dim>("point", point);
  region_points_.push_back({point, std::move(name), 0, true});
  checked_ = false;
}

template <int Dim>
void DomainBase<Dim>::add_region(const Point<Dim>& point, std::int32_t tag) {
  require_point<Dim>("point", point);
  require_tag("tag", tag);
  region_points_.push_back({point, "region " + std::to_string(regions_given_++), tag});
  checked_ = false;
}

template <int Dim>
void DomainBase<Dim>::add_region_of_file(const Point<Dim>& point, std::int32_t tag,
                                         std::string name) {
  require_point<Dim>("point", point);
  require_tag("tag", tag);
  region_points_.push_back({point, std::move(name), tag, true});
  checked_ = false;
}

template class DomainBase<2>;
template class DomainBase<3>;

}  // namespace pnpbs
