// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/quadratic_fits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cholesky.hpp"
#include "base/execution.hpp"
#include "results/ghost_values.hpp"

namespace pnpbs {

namespace {

constexpr int binomial(int n, int k) {
  int result = 1;
  for (int i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
  return result;
}

// The monomials up to fourth order, in ascending order. Products of two monomials of second order
// are among them.
template <int Dim>
class Monomials {
 public:
  static constexpr int kOrder = 4;
  static constexpr int up_to(int order) { return binomial(order + Dim, Dim); }
  static constexpr int kFitted = up_to(2) - 1;  // The constant is not fitted.
  static constexpr int kAll = up_to(kOrder);
  using Exponents = std::array<int, Dim>;

  Monomials() {
    int next = 0;
    for (int order = 0; order <= kOrder; ++order) {
      Exponents e{};
      list(order, 0, e, next);
    }
  }

  int product(int a, int b) const {
    Exponents e = exponents_[index(a)];
    for (std::size_t k = 0; k < Dim; ++k) e[k] += exponents_[index(b)][k];
    return number(e);
  }

  // Evaluates the first `count` monomials, which must be all up to some order.
  void evaluate(const Point<Dim>& x, int count, double* values) const {
    std::array<std::array<double, kOrder + 1>, Dim> powers;
    for (std::size_t k = 0; k < Dim; ++k) {
      powers[k][0] = 1;
      for (std::size_t e = 1; e <= kOrder; ++e) powers[k][e] = powers[k][e - 1] * x[k];
    }
    for (int m = 0; m < count; ++m) {
      values[m] = 1;
      for (std::size_t k = 0; k < Dim; ++k) values[m] *= powers[k][index(exponents_[index(m)][k])];
    }
  }

  // Shifts sums of monomials around one point to another point, from which it is `way` away, and
  // adds them to the sums there.
  void add_shifted(const double* sums, const double* way, int count, double* to) const {
    for (int m = 0; m < count; ++m)
      for (const Term& term : terms_[index(m)])
        to[m] += term.factor * way[term.of_way] * sums[term.of_sums];
  }

  void prepare_shifts() {
    for (int m = 0; m < kAll; ++m)
      for (int part = 0; part <= m; ++part) {
        Exponents rest = exponents_[index(m)];
        double factor = 1;
        bool divides = true;
        for (std::size_t k = 0; k < Dim; ++k) {
          factor *= binomial(rest[k], exponents_[index(part)][k]);
          rest[k] -= exponents_[index(part)][k];
          divides = divides && rest[k] >= 0;
        }
        if (divides) terms_[index(m)].push_back({factor, number(rest), part});
      }
  }

 private:
  struct Term {
    double factor;
    int of_way, of_sums;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  void list(int order, std::size_t k, Exponents& e, int& next) {
    if (k + 1 == Dim) {
      e[k] = order;
      exponents_[index(next++)] = e;
      return;
    }
    for (e[k] = order; e[k] >= 0; --e[k]) list(order - e[k], k + 1, e, next);
    e[k] = 0;
  }

  int number(const Exponents& e) const {
    return static_cast<int>(std::ranges::find(exponents_, e) - exponents_.begin());
  }

  std::array<Exponents, kAll> exponents_;
  std::array<std::vector<Term>, kAll> terms_;
};

// Solves for several right-hand sides with a matrix whose rows and columns may have different
// scales. Returns false if it is nearly singular.
template <std::size_t N>
bool solve_scaled(SquareMatrix<N>& a, std::int64_t sides, double* b) {
  constexpr double kSingular = 1e-7;  // Smallest independent part of a column.
  std::array<double, N> scale;
  if (!scale_to_unit_diagonal(a, scale) || !factor_cholesky(a, kSingular)) return false;
  for (std::int64_t side = 0; side < sides; ++side) {
    double* const x = b + side * static_cast<std::int64_t>(N);
    for (std::size_t i = 0; i < N; ++i) x[i] *= scale[i];
    solve_factored(a, x);
    for (std::size_t i = 0; i < N; ++i) x[i] *= scale[i];
  }
  return true;
}

// Computes sums over neighbours, and fits from these sums, for the nodes of a rank.
template <int Dim>
class Fitting {
 public:
  using M = Monomials<Dim>;
  static constexpr int kOfField = M::up_to(2);

  Fitting(const Results<Dim>& results, const std::vector<PatchNode<Dim>>& nodes,
          std::int64_t components, const std::vector<double>& values)
      : results_(results), nodes_(nodes), components_(components), values_(values) {
    monomials_.prepare_shifts();
  }

  // Columns of the sums around a node: monomials, then for each component differences of values
  // times the monomials up to second order.
  std::int64_t sum_columns() const { return M::kAll + kOfField * components_; }
  std::vector<double> sums() const {
    std::vector<double> all(static_cast<std::size_t>(results_.count() * sum_columns()));
    for_each("pnpbs::QuadraticFits::sums", results_.count(), [&](std::int64_t p) {
      double* const own = all.data() + p * sum_columns();
      std::array<double, M::kAll> here;
      for (const std::int64_t q : neighbours(p)) {
        monomials_.evaluate(way(p, q), M::kAll, here.data());
        for (int m = 0; m < M::kAll; ++m) own[m] += here[static_cast<std::size_t>(m)];
        for (std::int64_t c = 0; c < components_; ++c) {
          const double rise = value(q, c) - value(p, c);
          for (int m = 0; m < kOfField; ++m)
            own[M::kAll + c * kOfField + m] += rise * here[static_cast<std::size_t>(m)];
        }
      }
    });
    return all;
  }

  // Columns of the fits: a flag, then the coefficients. They are computed from the sums of all
  // nodes and ghosts.
  std::int64_t fit_columns() const { return 1 + M::kFitted * components_; }
  std::vector<double> fits(const std::vector<double>& sums) const {
    std::vector<double> all(static_cast<std::size_t>(results_.count() * fit_columns()));
    for_each("pnpbs::QuadraticFits::fits", results_.count(),
             [&](std::int64_t p) { fit(p, sums, all.data() + p * fit_columns()); });
    return all;
  }

 private:
  // Returns the neighbours including the node itself, in the order of their ids.
  std::vector<std::int64_t> neighbours(std::int64_t p) const {
    std::vector<std::int64_t> places{p};
    results_.level().stars.for_neighbours(
        results_.node_at(p), [&](std::int64_t j) { places.push_back(results_.place_of(j)); });
    std::sort(places.begin(), places.end(), [&](std::int64_t a, std::int64_t b) {
      return nodes_[static_cast<std::size_t>(a)].id < nodes_[static_cast<std::size_t>(b)].id;
    });
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

  Point<Dim> way(std::int64_t p, std::int64_t q) const {
    const Point<Dim>&from = nodes_[static_cast<std::size_t>(p)].x,
          &to = nodes_[static_cast<std::size_t>(q)].x;
    Point<Dim> way;
    for (int k = 0; k < Dim; ++k) way[k] = to[k] - from[k];
    return way;
  }

  double value(std::int64_t p, std::int64_t c) const {
    return values_[static_cast<std::size_t>(p * components_ + c)];
  }

  void fit(std::int64_t p, const std::vector<double>& sums, double* result) const {
    std::array<double, M::kAll> moments{}, shift;
    std::vector<double> fields(static_cast<std::size_t>(kOfField * components_));
    std::array<double, kOfField> risen;
    for (const std::int64_t q : neighbours(p)) {
      const double* const theirs = sums.data() + q * sum_columns();
      monomials_.evaluate(way(p, q), M::kAll, shift.data());
      monomials_.add_shifted(theirs, shift.data(), M::kAll, moments.data());
      for (std::int64_t c = 0; c < components_; ++c) {
        const double rise = value(q, c) - value(p, c);
        for (int m = 0; m < kOfField; ++m)
          risen[static_cast<std::size_t>(m)] =
              theirs[M::kAll + c * kOfField + m] + rise * theirs[m];
        monomials_.add_shifted(risen.data(), shift.data(), kOfField, fields.data() + c * kOfField);
      }
    }
    SquareMatrix<M::kFitted> normal;
    for (int i = 0; i < M::kFitted; ++i)
      for (int j = 0; j < M::kFitted; ++j)
        normal[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
            moments[static_cast<std::size_t>(monomials_.product(i + 1, j + 1))];
    for (std::int64_t c = 0; c < components_; ++c)
      std::copy_n(fields.begin() + c * kOfField + 1, M::kFitted, result + 1 + c * M::kFitted);
    result[0] = solve_scaled(normal, components_, result + 1) ? 1 : 0;
  }

  const Results<Dim>& results_;
  const std::vector<PatchNode<Dim>>& nodes_;
  std::int64_t components_;
  const std::vector<double>& values_;
  Monomials<Dim> monomials_;
};

}  // namespace

template <int Dim>
QuadraticFits<Dim>::QuadraticFits(Results<Dim>& results, std::vector<PatchNode<Dim>> nodes,
                                  std::int64_t components, const std::vector<double>& values)
    : nodes_(std::move(nodes)) {
  const Communicator& comm = results.communicator();
  const Fitting<Dim> fitting(results, nodes_, components, values);
  std::vector<double> sums, fits;
  collective_try(comm, [&] { sums = fitting.sums(); });
  sums = with_ghosts(results, fitting.sum_columns(), sums.data());
  collective_try(comm, [&] { fits = fitting.fits(sums); });
  columns_ = fitting.fit_columns();
  std::int64_t without = 0;
  const std::int64_t owned = results.count();
  for (std::int64_t p = 0; p < owned; ++p) {
    // Nodes on surfaces alone do not determine derivatives normal to the surface.
    double& has = fits[static_cast<std::size_t>(p * columns_)];
    if (results.kind() == GeometryKind::surface) has = 0;
    without += has == 0;
  }
  nodes_without_ =
      static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(without)));
  fits_ = with_ghosts(results, columns_, fits.data());
}

template <int Dim>
Point<Dim> QuadraticFits<Dim>::way_from(std::int32_t place, const Point<Dim>& x) const {
  const Point<Dim>& from = nodes_[static_cast<std::size_t>(place)].x;
  Point<Dim> way;
  for (int k = 0; k < Dim; ++k) way[k] = x[k] - from[k];
  return way;
}

template <int Dim>
double QuadraticFits<Dim>::rise(std::int32_t place, std::int64_t component,
                                const Point<Dim>& x) const {
  using M = Monomials<Dim>;
  const Point<Dim> way = way_from(place, x);
  const double* c = fit(place) + 1 + component * M::kFitted;
  double rise = 0;
  for (int k = 0; k < Dim; ++k) rise += *c++ * way[k];
  for (int i = 0; i < Dim; ++i)
    for (int j = i; j < Dim; ++j) rise += *c++ * way[i] * way[j];
  return rise;
}

template class QuadraticFits<2>;
template class QuadraticFits<3>;

}  // namespace pnpbs
