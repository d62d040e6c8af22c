// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/limiting_growth.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "comm/records.hpp"
#include "level/finer_region.hpp"
#include "method/constants.hpp"
#include "sizing/closing_patch.hpp"
#include "sizing/estimate.hpp"
#include "spacing/resolving_sources.hpp"

namespace pnpbs {

namespace {

// Upper bound of d. [size of the domain]
constexpr double kMaxSizes = 1024;
// Growth above which d is limited. The margin keeps a d that grows exactly as fast as nodes can
// follow unchanged, because samples are not exact.
constexpr double kTooSteep = method::kTooSteep * method::kGrowthFollowed;

}  // namespace

template <int Dim>
SizingField<Dim> EffectiveSpacing<Dim>::effective_spacing(const Settings& settings,
                                                          double count_factor) const {
  const double wanted = options_.real("wanted_nodes");
  if (wanted == 0) return bounded(spacing_, settings);
  const double factor = count_factor * factor_for(wanted, settings);
  return bounded(spacing_.multiplied(factor), settings);
}

// Returns the factor on d for this number of nodes. The number is proportional to a power of the
// factor: the dimension if few nodes are on the boundary, less if the boundary has many vertices.
// The power follows from the last two rounds. No factor leads below the number of vertices, so the
// search ends when the number does not change any more. Rounds with few samples come near the
// solution, and one or two with many samples correct it.
template <int Dim>
double EffectiveSpacing<Dim>::factor_for(double wanted_nodes, const Settings& settings) const {
  constexpr int kMaxRounds = 10;
  constexpr double kNear = 0.05, kNearByMany = 0.02, kSame = 1e-3, kMinPower = 0.5, kMaxStep = 64;
  const double steepest = settings.bubble_dimension;
  const auto more_than_wanted = [&](double factor, Samples samples) {
    return estimated_nodes(*this, bounded(spacing_.multiplied(factor), settings), settings,
                           samples) /
           wanted_nodes;
  };
  double factor = factor_closed_for(*domain_, spacing_), power = steepest, before = 0, step = 1;
  for (int round = 0; round < kMaxRounds; ++round) {
    const double more = more_than_wanted(factor, Samples::few);
    if (!(more > 0)) return factor;
    if (before > 0) {
      if (more > 1 && std::fabs(more / before - 1) < kSame) return factor;
      if (std::fabs(std::log(step)) > kNear)
        power = std::clamp(-std::log(more / before) / std::log(step), kMinPower, 1.5 * steepest);
    }
    if (std::fabs(more - 1) < kNear) break;
    before = more;
    step = std::clamp(std::pow(more, 1 / power), 1 / kMaxStep, kMaxStep);
    factor *= step;
  }
  for (int round = 0; round < 2; ++round) {
    const double more = more_than_wanted(factor, Samples::many);
    if (!(more > 0)) return factor;
    factor *= std::pow(more, 1 / power);
    if (std::fabs(more - 1) < kNearByMany) break;
  }
  return factor;
}

template <int Dim>
SizingField<Dim> EffectiveSpacing<Dim>::bounded(SizingField<Dim> spacing,
                                                const Settings& settings) const {
  spacing.set_bound(kMaxSizes * size_of(domain_->bounds()));
  if constexpr (Dim == 3) {
    if (!settings.resolve) return spacing;
    const double growth =
        settings.growth_limit > 0 ? settings.growth_limit : method::kGrowthFollowed;
    collective_try(*comm_, [&] {
      spacing.resolve(resolving_sources(spacing, *domain_, settings.node_limit(), kResolved,
                                        [&] { spacing.beat(); }),
                      growth);
    });
  }
  return spacing;
}

template <int Dim>
void EffectiveSpacing<Dim>::limit_growth(SizingField<Dim>& spacing,
                                         const Settings& settings) const {
  const auto explained = [&](const Error& error) {
    return error.message() + " (where d grows by at most " + number_text(settings.growth_limit) +
           ": option growth_limit, 0 is no limit)";
  };
  collective_try(*comm_, [&] {
    try {
      const SpacingEvaluator<Dim> unlimited = [&](std::int64_t n, const Point<Dim>* x, double* d) {
        evaluate_spacing<Dim>(spacing, measure_of(*domain_), n, x, d);
      };
      auto ways = std::make_unique<const LineOfSight<Dim>>(
          domain_->bounds(), measure_of(*domain_),
          indexed_boundary(*domain_, unlimited, settings.max_nodes));
      spacing.limit_growth(comm_, std::move(ways),
                           GrowthRule<Dim>{settings.growth_limit, domain_->embedding()},
                           settings.node_limit());
    } catch (const AgreedError& error) {
      if (!is_lack_of_room(error)) throw;
      throw AgreedError(error.kind(), explained(error), error.reason());
    } catch (const Error& error) {
      if (!is_lack_of_room(error)) throw;
      throw Error(error.kind(), explained(error), error.reason());
    }
  });
}

// The points have d of the spacing itself; the spacing of a level may be multiplied by a factor.
void add_undersampled_points(const UndersampledSpacing& found, const Communicator& comm,
                             const VolumeDomain& domain, SizingField<3>& spacing) {
  SpacingHints<3> places;
  collective_try(comm, [&] {
    const SpacingEvaluator<3> raw = [&](std::int64_t n, const Point<3>* x, double* d) {
      evaluate_spacing<3>(spacing, measure_of(domain), n, x, d);
    };
    const auto inside = [&](const Point<3>& x) {
      return domain.filled() && domain.index().inside(x);
    };
    places = finer_region(found.places(), raw, inside);
    SizingField<3> with_places = spacing;
    with_places.add_undersampled_points(places);
    spacing = std::move(with_places);
  });
}

template <int Dim>
void add_spacing_hints(const std::vector<Point<Dim>>& own, const Communicator& comm,
                       const Domain<Dim>& domain, SizingField<Dim>& spacing) {
  std::vector<Point<Dim>> points = of_all_ranks(comm, own);
  SizingField<Dim> with_hints;
  collective_try(comm, [&] {
    if constexpr (Dim == 3)
      if (domain.filled())
        std::erase_if(points, [&](const Point<3>& x) { return !domain.index().inside(x); });
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<double> d(points.size());
    evaluate_spacing<Dim>(spacing, measure_of(domain), std::ssize(points), points.data(), d.data());
    SpacingHints<Dim> hints;
    for (std::size_t i = 0; i < points.size(); ++i) hints.in_domain.push_back({points[i], d[i]});
    with_hints = spacing;
    with_hints.add_undersampled_points(hints);
  });
  spacing = std::move(with_hints);  // not before all ranks have succeeded
}

template <int Dim>
bool too_steep(const SteepestGrowth<Dim>& steepest) {
  return steepest.growth > kTooSteep;
}

template <int Dim>
Warning warning_of_growth(const SteepestGrowth<Dim>& steepest, double growth_limit) {
  const MessageText found = "the spacing grows by " + rounded_text(steepest.growth) +
                            " per unit of length near " + rounded_point_text<Dim>(steepest.at) +
                            ", faster than nodes can follow: ";
  const std::string what_helps = growth_limit == 0
                                     ? "limit its growth (option growth_limit, " +
                                           number_text(method::kGrowthFollowed) + " or less)"
                                     : "its growth is limited to " + number_text(growth_limit) +
                                           "; set the option growth_limit to choose another limit, "
                                           "or 0 for the spacing as it is given";
  return {WarningCode::growth, found + what_helps, 0, steepest.growth};
}

template class EffectiveSpacing<2>;
template class EffectiveSpacing<3>;
template void add_spacing_hints<2>(const std::vector<Point<2>>&, const Communicator&,
                                   const Domain<2>&, SizingField<2>&);
template void add_spacing_hints<3>(const std::vector<Point<3>>&, const Communicator&,
                                   const Domain<3>&, SizingField<3>&);
template bool too_steep(const SteepestGrowth<2>&);
template bool too_steep(const SteepestGrowth<3>&);
template Warning warning_of_growth(const SteepestGrowth<2>&, double);
template Warning warning_of_growth(const SteepestGrowth<3>&, double);

}  // namespace pnpbs
