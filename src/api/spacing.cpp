// SPDX-License-Identifier: BSD-3-Clause
// C interface: the spacing of a placement.
#include <algorithm>
#include <cmath>

#include "api/given_grid.hpp"
#include "api/placement_calls.hpp"
#include "api/spacing_callback.hpp"
#include "api/sphere_points.hpp"
#include "domain/given_values.hpp"
#include "results/nodal_values.hpp"
#include "spacing/files/field_file.hpp"
#include "spacing/given_field.hpp"
#include "spacing/outside_domain.hpp"
#include "spacing/sphere_spacing.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

// Replaces the spacing of a placement by make(p), where p is the placement in its dimension, if
// this succeeds on all ranks. Collective.
template <class Make>
pnpbs_status replace_spacing(pnpbs_placement placement, const Make& make) {
  return local_change(placement, [&](Placement& p) {
    visit_dimension(p, [&]<int Dim>(PlacementImpl<Dim>& in) {
      std::shared_ptr<const Spacing<Dim>> spacing;
      collective_on(p, [&] { spacing = make(in); });
      in.set_spacing(std::move(spacing));
    });
    return PNPBS_OK;
  });
}

// Returns the spacing make<Dim>(), which is the same on every rank. On a sphere it is the spacing
// make<3>() of points in space.
template <int Dim, class Make>
std::shared_ptr<const Spacing<Dim>> local_spacing(const PlacementImpl<Dim>& in, const Make& make) {
  const auto shared = [&]<int In>() {
    using Made = decltype(make.template operator()<In>());
    return std::make_shared<const Made>(make.template operator()<In>());
  };
  std::shared_ptr<const Spacing<Dim>> spacing = spacing_on_sphere(
      in.results().embedding(), [&](double) { return shared.template operator()<3>(); });
  if (!spacing) spacing = shared.template operator()<Dim>();
  return spacing;
}

void require_spacing(double d, const std::string& what) {
  require_spacing_value("argument " + what, d);
}

template <class Field>
Field field_from(std::int64_t n, const double* coordinates, const double* d) {
  given_values::require_count("n", n, 1);
  require_pointer(coordinates, "coordinates");
  require_pointer(d, "d");
  Field field;
  field.points.resize(static_cast<std::size_t>(n));
  for (std::int64_t i = 0; i < n; ++i)
    std::copy_n(coordinates + Field::dim * i, Field::dim,
                field.points[static_cast<std::size_t>(i)].begin());
  field.values.assign(d, d + n);
  return field;
}

template <class Field>
void add_elements(Field& field, std::int64_t elements, const std::int64_t* corners) {
  constexpr int kCorners = Field::corners;
  given_values::require_count("elements", elements, 1);
  require_pointer(corners, "corners");
  const auto nodes = static_cast<std::int64_t>(field.points.size());
  field.elements.resize(static_cast<std::size_t>(elements));
  for (std::int64_t i = 0; i < elements * kCorners; ++i) {
    if (corners[i] < 0 || corners[i] >= nodes)
      throw Error(ErrorKind::argument, "argument corners[" + std::to_string(i / kCorners) + "][" +
                                           std::to_string(i % kCorners) +
                                           "] = " + std::to_string(corners[i]) +
                                           " is not one of the " + std::to_string(nodes) +
                                           " nodes, 0 .. " + std::to_string(nodes - 1));
    field.elements[static_cast<std::size_t>(i / kCorners)][static_cast<std::size_t>(i % kCorners)] =
        static_cast<std::int32_t>(corners[i]);
  }
}

// Sets the spacing of a placement to a field that all ranks must give. read<Field>() returns the
// field of this rank; Field is GivenField in the dimension of the placement, or SphereField.
// Collective.
template <class Read>
pnpbs_status take_field(pnpbs_placement placement, const Read& read) {
  return local_change(placement, [&](Placement& p) {
    visit_dimension(p, [&]<int Dim>(PlacementImpl<Dim>& in) {
      const Communicator& comm = p.communicator();
      std::shared_ptr<const Spacing<Dim>> spacing;
      std::uint64_t hash = 0;
      const auto take = [&]<class Field>(const auto& where) {
        Field field = read.template operator()<Field>();
        hash = hash_of(field);
        in.domain().check();
        spacing = spacing_from_field(std::move(field), where());
      };
      collective_try(comm, [&] {
        if constexpr (Dim == 2)
          if (const Embedding<2>& on = in.results().embedding(); on.is_sphere())
            return take.template operator()<SphereField>([&] { return on.chart(); });
        take.template operator()<GivenField<Dim>>([&] { return in.domain().bounds(); });
      });
      collective_try(comm, [&] {
        if (!comm.same_on_all(hash))
          throw Error(ErrorKind::argument,
                      "arguments of the spacing: all ranks must give the same points and values");
      });
      in.set_spacing(std::move(spacing));
    });
    return PNPBS_OK;
  });
}

}  // namespace

pnpbs_status pnpbs_placement_set_spacing_mesh(pnpbs_placement placement, int64_t n,
                                              const double* coordinates, const double* d,
                                              int64_t elements, const int64_t* corners) {
  return take_field(placement, [&]<class Field>() {
    auto field = field_from<Field>(n, coordinates, d);
    add_elements(field, elements, corners);
    return field;
  });
}

pnpbs_status pnpbs_placement_set_spacing_points(pnpbs_placement placement, int64_t n,
                                                const double* coordinates, const double* d) {
  return take_field(placement, [&]<class Field>() { return field_from<Field>(n, coordinates, d); });
}

pnpbs_status pnpbs_placement_set_spacing_file(pnpbs_placement placement, const char* path,
                                              const char* field) {
  return take_field(placement, [&]<class Field>() {
    require_pointer(path, "path");
    return read_field<Field>(path, field ? field : "");
  });
}

pnpbs_status pnpbs_placement_set_spacing_constant(pnpbs_placement placement, double d) {
  return replace_spacing(placement, [&]<int Dim>(PlacementImpl<Dim>& in) {
    require_spacing(d, "d");
    return local_spacing<Dim>(in, [&]<int In>() { return ConstantSpacing<In>(d); });
  });
}

pnpbs_status pnpbs_placement_set_spacing_callback(pnpbs_placement placement,
                                                  pnpbs_spacing_fn spacing, void* user) {
  return replace_spacing(placement, [&]<int Dim>(PlacementImpl<Dim>& in) {
    return local_spacing<Dim>(in, [&]<int In>() { return spacing_from<In>(spacing, user); });
  });
}

pnpbs_status pnpbs_placement_set_spacing_grid(pnpbs_placement placement, const int64_t* size,
                                              const double* origin, const double* step,
                                              const double* values) {
  return replace_spacing(placement, [&]<int Dim>(PlacementImpl<Dim>& in) {
    const GridArguments grid{size, origin, step, values};
    std::shared_ptr<const Spacing<Dim>> spacing =
        spacing_on_sphere(in.domain().embedding(),
                          [&](double radius) { return spacing_on_sphere_grid(grid, radius); });
    if (!spacing) spacing = spacing_on_grid<Dim>(grid);
    in.domain().check();
    if (in.domain().kind() != GeometryKind::sphere)
      require_meeting_boxes<Dim>("arguments size, origin and step", spacing->extent()->box,
                                 in.domain().bounds());
    return spacing;
  });
}

pnpbs_status pnpbs_placement_set_spacing_at_nodes(pnpbs_placement placement, int64_t n,
                                                  const double* d) {
  return replace_spacing(placement, [&]<int Dim>(PlacementImpl<Dim>& in) {
    Results<Dim>& results = in.results();
    results.prepare_order();
    if (n != results.count())
      throw Error(ErrorKind::argument, "argument n = " + std::to_string(n) + "; this rank has " +
                                           std::to_string(results.count()) +
                                           " nodes: give a value for each of them");
    if (n > 0) require_pointer(d, "d");
    for (std::int64_t i = 0; i < n; ++i)
      if (!std::isfinite(d[i]) || d[i] <= 0)
        throw Error(ErrorKind::spacing,
                    "argument d[" + std::to_string(i) + "] = " + number_text(d[i]) + " at node " +
                        std::to_string(results.level().nodes.id(results.node_at(i))) +
                        ": the spacing must be finite and greater than 0");
    std::vector<double> values(d, d + n);
    return spacing_from(results, std::move(values));
  });
}

pnpbs_status pnpbs_placement_add_spacing_hints(pnpbs_placement placement, int64_t n,
                                               const double* coordinates) {
  return local_change(placement, [&](Placement& p) {
    visit_dimension(p, [&]<int Dim>(PlacementImpl<Dim>& in) {
      std::vector<Point<Dim>> points;
      collective_on(p, [&] {
        given_values::require_count("n", n, 0);
        if (n > 0) require_pointer(coordinates, "coordinates");
        std::vector<double> charted;
        const double* x = placed_coordinates(in.domain().embedding(), n, coordinates, charted);
        points = given_values::read_points<Dim>("coordinates", n, x);
      });
      in.add_spacing_hints(points);
    });
    return PNPBS_OK;
  });
}
