// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/field_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/error.hpp"
#include "base/exact_sum.hpp"
#include "base/execution.hpp"
#include "comm/records.hpp"
#include "domain/given_values.hpp"
#include "results/ghost_values.hpp"
#include "results/results.hpp"
#include "spacing/nodal_search.hpp"
#include "transfer/transfer_spaces.hpp"

namespace pnpbs {

namespace {

// Returns the integrals of the components of a field that is linear on each element of this rank
// and, as the last one, the integral of 1.
template <class Space, std::size_t Corners>
std::vector<ExactSum> integrals_here(const Space& space, const typename Space::Data& patch,
                                     const std::vector<std::array<std::int32_t, Corners>>& elements,
                                     std::int64_t components, const std::vector<double>& values) {
  std::vector<ExactSum> sums(static_cast<std::size_t>(components) + 1);
  for (const auto& element : elements) {
    std::array<Point<Space::kIn>, Corners> corners;
    for (std::size_t k = 0; k < Corners; ++k)
      corners[k] = patch.nodes[static_cast<std::size_t>(element[k])].x;
    const double size = space.measure(corners);
    for (std::int64_t c = 0; c < components; ++c) {
      double sum = 0;
      for (const std::int32_t node : element)
        sum += values[static_cast<std::size_t>(node * components + c)];
      sums[static_cast<std::size_t>(c)].add_product(size / Corners, sum);
    }
    sums.back().add(size);
  }
  return sums;
}

// Returns the integrals over the elements of all ranks. Sums are exact, so that they do not depend
// on the order. If `on_border` is set, the elements are the facets of the border. Collective.
template <class Space>
std::vector<double> integrals(const Communicator& comm, const Space& space,
                              const typename Space::Data& patch, bool on_border,
                              std::int64_t components, const std::vector<double>& values) {
  std::vector<ExactSum> sums;
  std::vector<std::int64_t> entries;
  collective_try(comm, [&] {
    if constexpr (Space::kDim == 3) {
      if (on_border) sums = integrals_here(space, patch, patch.border, components, values);
    }
    if (!on_border) sums = integrals_here(space, patch, patch.simplices, components, values);
    for (ExactSum& sum : sums) {
      sum.carry();
      entries.insert(entries.end(), sum.entries().begin(), sum.entries().end());
    }
  });
  comm.allreduce_sum(entries);
  std::vector<double> results;
  auto next = entries.begin();
  for (ExactSum& sum : sums) {
    std::copy_n(next, ExactSum::kEntries, sum.entries().begin());
    next += ExactSum::kEntries;
    results.push_back(sum.value());
  }
  return results;
}

// Returns the fraction of the curvature that is used: all within the elements and up to about their
// size beyond the border. Farther away, the corners' polynomials are not valid, and the field
// continues linearly.
template <int Dim>
double part_of_curvature(const PatchWeights<Dim>& w) {
  constexpr double kAll = 5, kNone = 9;  // Sums of the absolute weights, which are 1 inside.
  double sum = 0;
  for (const double weight : w.weights) sum += std::fabs(weight);
  return std::clamp((kNone - sum) / (kNone - kAll), 0.0, 1.0);
}

template <class Space>
class FieldTransferOf : public FieldTransfer {
 public:
  static constexpr int Dim = Space::kDim, In = Space::kIn;

  FieldTransferOf(Results<Dim>& results, TransferOrder order, std::int64_t components,
                  const double* values)
      : space_(results) {
    components_ = components;
    typename Space::Data patch = space_.patch(results);
    values_ = with_ghosts(results, components, values);
    const Communicator& comm = results.communicator();
    integrals_ = integrals(comm, space_, patch, results.kind() == GeometryKind::surface, components,
                           values_);
    if (order == TransferOrder::second) fits_.emplace(results, patch.nodes, components, values_);
    collective_try(comm, [&] { space_.add_images(patch); });
    search_.emplace(results.ranks(), space_.searched(std::move(patch)));
  }

  int dimension() const override { return Dim; }
  std::int64_t nodes_of_first_order() const override { return fits_ ? fits_->nodes_without() : -1; }
  void evaluate(std::int64_t n, const double* x, double* values) const override;
  void evaluate_at_nodes(NodalResults& results, bool conserve, double* values) const override;

 private:
  // A point on a simplex or facet of the rank that receives the question.
  struct Question {
    Point<In> x;
    std::int64_t row;
  };

  std::vector<Message> answered(const std::vector<Message>& asked) const;
  void answer(const Question& question, double* values) const;
  void add_curvature(const Point<In>& x, const PatchWeights<Dim>& w, double* values) const;
  void conserve_integrals(Results<Dim>& results, double* values) const;

  Space space_;
  std::optional<NodalSearch<typename Space::Searched>> search_;
  std::vector<double> values_;     // Values at the nodes and ghosts.
  std::vector<double> integrals_;  // Integrals of the components, and the size of all elements.
  std::optional<typename Space::Fits> fits_;
};

// Inside a simplex, rounding must not lead to values outside the range of the corners. Beyond the
// border, the linear function of the adjacent simplex continues.
template <class Space>
void FieldTransferOf<Space>::answer(const Question& question, double* values) const {
  const PatchWeights<Dim> w =
      search_->patch().weights(question.x, static_cast<std::int32_t>(question.row));
  const auto node_of = [&](std::size_t k) { return search_->patch().patch().node_of(w.nodes[k]); };
  for (std::int64_t c = 0; c < components_; ++c) {
    std::array<double, Dim + 1> corner;
    for (std::size_t k = 0; k <= Dim; ++k)
      corner[k] = values_[static_cast<std::size_t>(node_of(k) * components_ + c)];
    double value = w.inside ? w.weights[0] * corner[0] : corner[0];
    for (std::size_t k = 1; k <= Dim; ++k)
      value += w.weights[k] * (w.inside ? corner[k] : corner[k] - corner[0]);
    if (w.inside) {
      const auto [min, max] = std::minmax_element(corner.begin(), corner.end());
      value = std::clamp(value, *min, *max);
    }
    values[c] = value;
  }
  if (fits_) add_curvature(question.x, w, values);
}

// Returns the point that x is where the node of which n is an image takes the place of n.
template <class Patch, class Point>
Point seen_from_node(Point x, const Patch& patch, std::int32_t n) {
  const std::int32_t node = patch.node_of(n);
  if (node == n) return x;
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] += patch.nodes[static_cast<std::size_t>(node)].x[k] -
            patch.nodes[static_cast<std::size_t>(n)].x[k];
  return x;
}

// Blends the linear values with the corners' polynomials by the corners' weights. The result is
// continuous and reproduces fields of second order. Corners without a polynomial remain linear.
template <class Space>
void FieldTransferOf<Space>::add_curvature(const Point<In>& x, const PatchWeights<Dim>& w,
                                           double* values) const {
  const double part = part_of_curvature(w);
  if (part == 0) return;
  const auto& patch = search_->patch().patch();
  for (std::int64_t c = 0; c < components_; ++c) {
    double sum = 0;
    for (std::size_t k = 0; k <= Dim; ++k) {
      const std::int32_t node = patch.node_of(w.nodes[k]);
      if (w.weights[k] == 0 || !fits_->has(node)) continue;
      const double at_corner = values_[static_cast<std::size_t>(node * components_ + c)];
      const Point<In> seen = seen_from_node(x, patch, w.nodes[k]);
      sum += w.weights[k] * (at_corner - values[c] + fits_->rise(node, c, seen));
    }
    values[c] += part * sum;
  }
}

template <class Space>
std::vector<Message> FieldTransferOf<Space>::answered(const std::vector<Message>& asked) const {
  std::vector<Message> answers;
  for (const Message& message : asked) {
    const std::size_t n = message.bytes.size() / sizeof(Question);
    std::vector<double> found(n * static_cast<std::size_t>(components_));
    for_each("pnpbs::FieldTransfer::answered", static_cast<std::int64_t>(n), [&](std::int64_t k) {
      Question question;
      std::memcpy(&question, message.bytes.data() + static_cast<std::size_t>(k) * sizeof question,
                  sizeof question);
      answer(question, found.data() + k * components_);
    });
    answers.push_back({message.rank, Bytes(found.size() * sizeof(double))});
    if (n > 0) std::memcpy(answers.back().bytes.data(), found.data(), answers.back().bytes.size());
  }
  return answers;
}

template <class Space>
void FieldTransferOf<Space>::evaluate(std::int64_t n, const double* x, double* values) const {
  const Communicator& comm = search_->communicator();
  std::vector<Point<In>> points;
  collective_try(comm, [&] {
    given_values::require_points<In>("argument coordinates", n, x);
    points.resize(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      Point<In>& point = points[static_cast<std::size_t>(i)];
      std::copy_n(x + In * i, In, point.begin());
      point = space_.in_cell(point);
    }
  });
  const auto found = search_->find(n, points.data());
  Outbox questions;
  collective_try(comm, [&] {
    for (std::size_t i = 0; i < points.size(); ++i)
      pack(questions.to(found[i].rank), Question{points[i], found[i].row});
  });
  const std::vector<Message> asked = comm.sparse_all_to_all(questions.messages());
  std::vector<Message> answers;
  collective_try(comm, [&] { answers = answered(asked); });
  const std::vector<Message> told = comm.sparse_all_to_all(answers);
  collective_try(comm, [&] {
    RankIndices places;
    for (const Message& theirs : told) places.add(theirs.rank);
    std::vector<std::size_t> at(told.size());  // Answers are in the order of the questions.
    const std::size_t bytes = static_cast<std::size_t>(components_) * sizeof(double);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto k = static_cast<std::size_t>(places.of(found[i].rank));
      std::memcpy(values + static_cast<std::int64_t>(i) * components_, told[k].bytes.data() + at[k],
                  bytes);
      at[k] += bytes;
    }
  });
}

template <class Space>
void FieldTransferOf<Space>::conserve_integrals(Results<Dim>& results, double* values) const {
  const Communicator& comm = search_->communicator();
  const std::vector<double> all = with_ghosts(results, components_, values);
  const std::vector<double> now =
      integrals(comm, space_, space_.patch(results), results.kind() == GeometryKind::surface,
                components_, all);
  const std::int64_t owned = results.count();
  for (std::int64_t c = 0; c < components_; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const double lacking = (integrals_[k] - now[k]) / now.back();
    for (std::int64_t i = 0; i < owned; ++i) values[i * components_ + c] += lacking;
  }
}

template <class Space>
void FieldTransferOf<Space>::evaluate_at_nodes(NodalResults& results, bool conserve,
                                               double* values) const {
  auto& in = static_cast<Results<Dim>&>(results);
  std::vector<double> x;
  collective_try(search_->communicator(), [&] {
    in.prepare_order();
    const std::int64_t owned = in.count();
    for (std::int64_t p = 0; p < owned; ++p) {
      const Point<In> at = space_.position(in, in.node_at(p));
      x.insert(x.end(), at.begin(), at.end());
    }
  });
  evaluate(in.count(), x.data(), values);
  if (conserve) conserve_integrals(in, values);
}

}  // namespace

std::unique_ptr<FieldTransfer> make_field_transfer(NodalResults& results, TransferOrder order,
                                                   std::int64_t components, const double* values) {
  const auto made = [&]<class Space>(auto& in) -> std::unique_ptr<FieldTransfer> {
    return std::make_unique<FieldTransferOf<Space>>(in, order, components, values);
  };
  if (results.dimension() == 3)
    return made.operator()<FlatSpace<3>>(static_cast<Results<3>&>(results));
  auto& in = static_cast<Results<2>&>(results);
  return in.kind() == GeometryKind::sphere ? made.operator()<SphereSpace>(in)
                                           : made.operator()<FlatSpace<2>>(in);
}

}  // namespace pnpbs
