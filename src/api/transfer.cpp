// SPDX-License-Identifier: BSD-3-Clause
// C interface: transfer of fields from earlier nodes to present ones.
#include <cmath>
#include <string>

#include "api/placement_calls.hpp"
#include "api/sphere_points.hpp"
#include "base/kokkos_runtime.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

// Runs body(transfer object) as a collective call. If it fails on one rank, it fails on all.
template <class Body>
pnpbs_status collective(pnpbs_transfer transfer, const Body& body) {
  return guarded(transfer, [&](TransferObject& object) {
    const Computing computing(*object.context);
    collective_try(*object.context->communicator, [&] { body(object); });
    return PNPBS_OK;
  });
}

void require_field(NodalResults& results, std::int64_t n, std::int64_t components,
                   const double* values) {
  results.prepare_order();
  if (components < 1)
    throw Error(ErrorKind::argument,
                "argument components = " + std::to_string(components) + "; expected at least 1");
  if (n != results.count())
    throw Error(ErrorKind::argument, "argument n = " + std::to_string(n) + "; this rank has " +
                                         std::to_string(results.count()) +
                                         " nodes: give values for each of them");
  if (n > 0) require_pointer(values, "values");
  for (std::int64_t k = 0; k < n * components; ++k)
    if (!std::isfinite(values[k]))
      throw Error(ErrorKind::argument,
                  "argument values: component " + std::to_string(k % components) + " at node " +
                      std::to_string(results.nodes().id(results.node_at(k / components))) + " is " +
                      number_text(values[k]) + "; all must be finite");
}

// Creates a transfer. Throws unless the order is the same on all ranks, since they would wait for
// each other. Collective.
pnpbs_status create(pnpbs_placement placement, TransferOrder order, std::int64_t n,
                    std::int32_t components, const double* values, pnpbs_transfer* transfer) {
  return collective_create(
      placement, transfer, "transfer", transfers, [&](PlacementObject& object) {
        NodalResults& results = object.placement->results();
        const Communicator& comm = results.communicator();
        collective_try(comm, [&] { require_field(results, n, components, values); });
        if (!comm.same_on_all(static_cast<std::uint64_t>(components)))
          throw Error(ErrorKind::argument, "argument components = " + std::to_string(components) +
                                               " here; all ranks must give the same");
        if (!comm.same_on_all(static_cast<std::uint64_t>(order)))
          throw Error(ErrorKind::argument, "all ranks must request a transfer of the same order");
        auto made = std::make_shared<TransferObject>();
        made->context = object.context;
        made->transfer = make_field_transfer(results, order, components, values);
        made->sphere_radius = results.sphere_radius();
        return made;
      });
}

}  // namespace

pnpbs_status pnpbs_transfer_create(pnpbs_placement placement, int64_t n, int32_t components,
                                   const double* values, pnpbs_transfer* transfer) {
  return create(placement, TransferOrder::first, n, components, values, transfer);
}

pnpbs_status pnpbs_transfer_create_second_order(pnpbs_placement placement, int64_t n,
                                                int32_t components, const double* values,
                                                pnpbs_transfer* transfer) {
  return create(placement, TransferOrder::second, n, components, values, transfer);
}

pnpbs_status pnpbs_transfer_order(pnpbs_transfer transfer, int32_t* order, int64_t* linear_nodes) {
  return guarded(transfer, [&](TransferObject& object) {
    const std::int64_t linear = object.transfer->nodes_of_first_order();
    if (order) *order = linear < 0 ? 1 : 2;
    if (linear_nodes) *linear_nodes = linear;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_transfer_destroy(pnpbs_transfer* transfer) {
  return destroy(transfer, transfers);
}

pnpbs_status pnpbs_transfer_sizes(pnpbs_transfer transfer, int32_t* dim, int32_t* components) {
  return guarded(transfer, [&](TransferObject& object) {
    if (dim) *dim = object.sphere_radius > 0 ? 3 : object.transfer->dimension();
    if (components) *components = static_cast<std::int32_t>(object.transfer->components());
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_transfer_at_points(pnpbs_transfer transfer, int64_t n, const double* coordinates,
                                      double* values) {
  return collective(transfer, [&](TransferObject& object) {
    require_count(n, "n");
    if (n > 0) require_pointer(coordinates, "coordinates");
    if (n > 0) require_pointer(values, "values");
    require_kokkos();
    std::vector<double> on_sphere;
    if (object.sphere_radius > 0) {
      on_sphere =
          put_on_sphere(object.sphere_radius, require_directions("coordinates", n, coordinates));
      coordinates = on_sphere.data();
    }
    object.transfer->evaluate(n, coordinates, values);
  });
}

pnpbs_status pnpbs_transfer_at_nodes(pnpbs_transfer transfer, pnpbs_placement placement,
                                     int32_t conserve, int64_t capacity, double* values) {
  return guarded(transfer, [&](TransferObject& object) {
    const auto target = require(placement);
    const Computing computing(*object.context);
    collective_try(*object.context->communicator, [&] {
      if (target->context != object.context)
        throw Error(ErrorKind::argument,
                    "argument placement belongs to another context than the transfer");
      NodalResults& results = target->placement->results();
      if (object.sphere_radius != results.sphere_radius())
        throw Error(ErrorKind::argument,
                    "argument placement is not on the sphere that the transfer's nodes are on");
      if (results.dimension() != object.transfer->dimension())
        throw Error(ErrorKind::argument, "argument placement has " +
                                             std::to_string(results.dimension()) +
                                             " dimensions; the transfer's nodes had " +
                                             std::to_string(object.transfer->dimension()));
      results.prepare_order();
      require_capacity(capacity, results.count());
      if (results.count() > 0) require_pointer(values, "values");
      object.transfer->evaluate_at_nodes(results, conserve != 0, values);
    });
    return PNPBS_OK;
  });
}
