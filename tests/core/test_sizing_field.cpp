// SPDX-License-Identifier: BSD-3-Clause
// The sizing field: its parts apply in order, compared with the formula, and report their points.
// Long computations call beat(), and an exception from it ends them.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "domain/volume/volume_domain.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/resolving_sources.hpp"
#include "spacing/sizing_field.hpp"

using P = pnpbs::Point<3>;
using Source = pnpbs::GrowthSource<3>;

namespace {

constexpr double kGrowth = 0.3, kFactor = 1.5, kBound = 0.2, kLevel = 4;
const Source kResolved{{0.2, 0.3, 0.4}, 0.02}, kReduced{{0.7, 0.6, 0.5}, 0.01};

double raw(const P& x) { return 0.05 + 0.1 * x[0] + 0.05 * x[1]; }

// A spacing that reports a value of its own.
class Told : public pnpbs::LocalSpacing<3> {
 public:
  void evaluate(std::int64_t n, const P* x, double* d) const override {
    for (std::int64_t i = 0; i < n; ++i) d[i] = raw(x[i]);
  }
  pnpbs::SpacingHints<3> spacing_hints() const override {
    pnpbs::SpacingHints<3> known;
    known.values.push_back({{0, 0, 0}, raw({0, 0, 0})});
    return known;
  }
};

pnpbs::SizingField<3> field() {
  pnpbs::SizingField<3> f(std::make_shared<Told>());
  pnpbs::SpacingHints<3> finer;
  finer.in_domain.push_back({{0.5, 0.5, 0.5}, 0.03});
  finer.slopes.push_back({0.4, 0.03, {0.5, 0.5, 0.5}, true});
  f.add_undersampled_points(finer);
  f = f.multiplied(kFactor);
  f.set_bound(kBound);
  f.resolve({kResolved}, kGrowth);
  f.reduce_at({kReduced}, kGrowth);
  return f.coarsened(kLevel);
}

double around(const Source& source, const P& x) {
  return source.d + kGrowth * pnpbs::distance<3>(source.x, x);
}

double value_at(const pnpbs::Spacing<3>& spacing, const P& x) {
  double d = 0;
  spacing.evaluate(1, &x, &d);
  return d;
}

}  // namespace

START_TEST(parts_apply_in_their_order) {
  Random random(41);
  const pnpbs::SizingField<3> f = field(), unreduced = f.without_reductions();
  for (int k = 0; k < 1000; ++k) {
    const P x = random.point<3>({{0, 0, 0}, {1, 1, 1}});
    const double resolved = std::min(std::min(kFactor * raw(x), kBound), around(kResolved, x));
    ck_assert_double_eq_tol(value_at(f, x), kLevel * std::min(resolved, around(kReduced, x)),
                            1e-12);
    ck_assert_double_eq_tol(value_at(unreduced, x), kLevel * resolved, 1e-12);
  }
}
END_TEST

START_TEST(values_that_are_not_finite_stay) {
  const auto broken =
      std::make_shared<pnpbs::CallbackSpacing<3>>([](std::int64_t n, const double*, double* d) {
        std::fill(d, d + n, INFINITY);
        return 0;
      });
  pnpbs::SizingField<3> f{broken};
  f.set_bound(kBound);
  ck_assert(std::isinf(value_at(f, {0, 0, 0})));
}
END_TEST

// The value of the source and the points found by runs are multiplied by both factors, those of the
// reductions by one.
START_TEST(places_are_told) {
  const pnpbs::SpacingHints<3> known = field().spacing_hints();
  ck_assert_int_eq(std::ssize(known.values), 1);
  ck_assert_double_eq_tol(known.values[0].d, kLevel * kFactor * raw({0, 0, 0}), 1e-12);
  ck_assert_int_eq(std::ssize(known.in_domain), 2);
  ck_assert_double_eq_tol(known.in_domain[0].d, kLevel * kFactor * 0.03, 1e-12);
  ck_assert(known.in_domain[1].x == kReduced.x);
  ck_assert_double_eq_tol(known.in_domain[1].d, kLevel * kReduced.d, 1e-12);
  ck_assert_int_eq(std::ssize(known.slopes), 1);
  ck_assert_double_eq_tol(known.slopes[0].growth, kLevel * kFactor * 0.4, 1e-12);
  ck_assert_int_eq(std::ssize(field().without_reductions().spacing_hints().in_domain), 1);
}
END_TEST

START_TEST(beats_while_it_is_made) {
  pnpbs::VolumeDomain plate;
  plate.add_box({0, 0, 0}, {1, 1, 0.05}, 1);
  plate.check();
  pnpbs::SizingField<3> f{std::make_shared<pnpbs::ConstantSpacing<3>>(0.2)};
  int beats = 0, stop_at = -1;
  const auto beat = [&] {
    if (beats++ == stop_at) throw pnpbs::Error(pnpbs::ErrorKind::stopped, "enough");
  };
  f.set_beat(beat);
  value_at(f, {0, 0, 0});
  ck_assert_int_eq(beats, 1);
  const auto sources = [&] {
    beats = 0;
    return pnpbs::resolving_sources(f, plate, pnpbs::NodeLimit(1'000'000), pnpbs::kResolved, beat);
  };
  const std::size_t found = sources().size();
  ck_assert_int_gt(static_cast<int>(found), 1000);
  const int all = beats;
  ck_assert_int_gt(all, 10);
  for (stop_at = 0; stop_at < all; stop_at += 3) {
    bool stopped = false;
    try {
      sources();
    } catch (const pnpbs::Error& error) {
      stopped = error.kind() == pnpbs::ErrorKind::stopped;
    }
    ck_assert(stopped);
  }
}
END_TEST

TEST_SUITE(test_sizing_field) {
  return run_kernel_suite(
      "sizing_field", {parts_apply_in_their_order, values_that_are_not_finite_stay, places_are_told,
                       beats_while_it_is_made});
}
