// SPDX-License-Identifier: BSD-3-Clause
#include "domain/curve_steps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/point_text.hpp"
#include "domain/plane/curve_track.hpp"
#include "geometry/polyline_track.hpp"

namespace pnpbs {

namespace {

constexpr double kMaxStep = 0.25;         // largest distance between neighbouring samples [d]
constexpr double kMaxRatio = 2;           // largest ratio of d at neighbouring samples
constexpr double kSmallestStep = 1e-3;    // intervals below this are not divided for kMaxRatio [d]
constexpr int kMinIntervals = 8;          // least number of intervals on a curve
constexpr double kMaxParts = 64;          // most parts of an interval in one round
constexpr std::int64_t kBatch = 1 << 16;  // most points in one call of the evaluator

// Samples of d along one curve.
struct Profile {
  std::vector<double> stations;
  std::vector<double> d;   // 0 where d is not evaluated yet
  std::vector<char> open;  // nonzero for intervals that may have to be divided
};

// Returns the integral of ds/d over a step of length h in which d varies linearly from a to b.
double integral(double h, double a, double b) {
  const double x = (b - a) / a;
  return x == 0 ? h / a : h / a * (std::log1p(x) / x);
}

// Returns the fraction of the step at which the integral of ds/d reaches `fraction` of its total.
double inverse(double fraction, double a, double b) {
  const double x = (b - a) / a;
  return x == 0 ? fraction : std::expm1(fraction * std::log1p(x)) / x;
}

template <class Track>
class Profiles {
  static constexpr int kDim = Track::kDim;

 public:
  Profiles(const std::vector<Track>& tracks, const SpacingEvaluator<kDim>& spacing,
           std::int64_t max_nodes)
      : tracks_(tracks), spacing_(spacing), max_nodes_(max_nodes) {}

  const std::vector<Profile>& run() {
    for (const Track& track : tracks_) profiles_.push_back(first_profile(track));
    for (;;) {
      ask();
      require_node_limit();
      bool divided = false;
      for (Profile& profile : profiles_) divided = divide(profile) || divided;
      if (!divided) return profiles_;
    }
  }

 private:
  static Profile first_profile(const Track& track) {
    const std::vector<double>& vertices = track.vertex_stations();
    const auto segments = static_cast<int>(std::min<std::size_t>(vertices.size() - 1, 1 << 20));
    const int parts = (kMinIntervals + segments - 1) / segments;
    Profile profile;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
      for (int k = 0; k < parts; ++k) {
        const double step = (vertices[i + 1] - vertices[i]) / parts;
        profile.stations.push_back(vertices[i] + k * step);
      }
    }
    profile.stations.push_back(vertices.back());
    profile.d.assign(profile.stations.size(), 0);
    profile.open.assign(profile.stations.size() - 1, 1);
    return profile;
  }

  void ask() {
    points_.clear();
    for (std::size_t c = 0; c < profiles_.size(); ++c) {
      std::vector<double> unknown;
      for (std::size_t i = 0; i < profiles_[c].d.size(); ++i) {
        if (profiles_[c].d[i] == 0) unknown.push_back(profiles_[c].stations[i]);
      }
      const std::vector<Point<kDim>> points = tracks_[c].points_at(unknown);
      points_.insert(points_.end(), points.begin(), points.end());
    }
    std::vector<double> values(points_.size());
    const auto count = static_cast<std::int64_t>(points_.size());
    for (std::int64_t first = 0; first < count; first += kBatch) {
      spacing_(std::min(kBatch, count - first), points_.data() + first, values.data() + first);
    }
    fill_in(values);
  }

  void fill_in(const std::vector<double>& values) {
    std::size_t next = 0;
    for (Profile& profile : profiles_) {
      for (double& d : profile.d) {
        if (d != 0) continue;
        d = values[next];
        if (!(d > 0 && std::isfinite(d))) {
          throw Error(ErrorKind::spacing, "the spacing is " + number_text(d) + " at " +
                                              point_text(points_[next]) +
                                              ", expected a positive number");
        }
        if (d < min_) {
          min_ = d;
          min_point_ = points_[next];
        }
        ++next;
      }
    }
  }

  void require_node_limit() const {
    double nodes = 0;
    for (const Profile& profile : profiles_) {
      for (std::size_t i = 0; i < profile.open.size(); ++i) {
        nodes +=
            integral(profile.stations[i + 1] - profile.stations[i], profile.d[i], profile.d[i + 1]);
      }
    }
    const bool held = max_nodes_ > kMaxNodesOnCurves;
    const std::int64_t max = std::min(max_nodes_, kMaxNodesOnCurves);
    if (nodes <= static_cast<double>(max)) return;
    throw Error(ErrorKind::spacing,
                "the boundary would need about " + rounded_text(nodes) + " nodes, more than " +
                    (held ? "the " : "") + std::to_string(max) +
                    (held ? " that every rank can hold" : "") + ": the spacing is " +
                    number_text(min_) + " at " + point_text(min_point_));
  }

  static int parts(double h, double a, double b) {
    const double min = std::min(a, b), max = std::max(a, b);
    const double wanted = std::ceil(h / (kMaxStep * min));
    if (wanted > 1) return static_cast<int>(std::clamp(wanted, 2.0, kMaxParts));
    return max > kMaxRatio * min && h > kSmallestStep * min ? 2 : 1;
  }

  // Divides the open intervals that are too long. Returns false if none exist.
  static bool divide(Profile& profile) {
    if (std::find(profile.open.begin(), profile.open.end(), 1) == profile.open.end()) return false;
    Profile finer;
    bool divided = false;
    for (std::size_t i = 0; i < profile.stations.size(); ++i) {
      finer.stations.push_back(profile.stations[i]);
      finer.d.push_back(profile.d[i]);
      if (i == profile.open.size()) break;
      const double h = profile.stations[i + 1] - profile.stations[i];
      const int count = profile.open[i] ? parts(h, profile.d[i], profile.d[i + 1]) : 1;
      finer.open.push_back(count > 1);
      for (int k = 1; k < count; ++k) {
        const double station = profile.stations[i] + h * k / count;
        finer.stations.push_back(station);
        finer.d.push_back(0);
        finer.open.push_back(1);
        divided = true;
      }
    }
    profile = std::move(finer);
    return divided;
  }

  const std::vector<Track>& tracks_;
  const SpacingEvaluator<kDim>& spacing_;
  std::int64_t max_nodes_;
  std::vector<Profile> profiles_;
  std::vector<Point<kDim>> points_;  // evaluated in this round
  double min_ = HUGE_VAL;            // smallest d so far
  Point<kDim> min_point_{};
};

std::vector<double> equal_steps(const Profile& profile, bool closed) {
  std::vector<double> sums{0};
  for (std::size_t i = 0; i < profile.open.size(); ++i) {
    sums.push_back(sums.back() + integral(profile.stations[i + 1] - profile.stations[i],
                                          profile.d[i], profile.d[i + 1]));
  }
  const double whole = sums.back();
  const auto steps = std::max<std::int64_t>(closed ? 3 : 1, std::llround(whole));
  std::vector<double> stations{0};
  std::size_t i = 0;
  for (std::int64_t k = 1; k < steps; ++k) {
    const double sum = whole * static_cast<double>(k) / static_cast<double>(steps);
    while (i + 2 < sums.size() && sums[i + 1] <= sum) ++i;
    const double fraction = (sum - sums[i]) / (sums[i + 1] - sums[i]);
    const double h = profile.stations[i + 1] - profile.stations[i];
    stations.push_back(profile.stations[i] + h * inverse(fraction, profile.d[i], profile.d[i + 1]));
  }
  stations.push_back(profile.stations.back());
  return stations;
}

}  // namespace

template <class Track>
std::vector<std::vector<double>> equal_step_stations(const std::vector<Track>& tracks,
                                                     const SpacingEvaluator<Track::kDim>& spacing,
                                                     std::int64_t max_nodes) {
  Profiles profiles(tracks, spacing, max_nodes);
  const std::vector<Profile>& resolved = profiles.run();
  std::vector<std::vector<double>> stations;
  for (std::size_t c = 0; c < tracks.size(); ++c)
    stations.push_back(equal_steps(resolved[c], tracks[c].is_closed()));
  return stations;
}

template std::vector<std::vector<double>> equal_step_stations(const std::vector<CurveTrack>&,
                                                              const SpacingEvaluator<2>&,
                                                              std::int64_t);
template std::vector<std::vector<double>> equal_step_stations(const std::vector<PolylineTrack<3>>&,
                                                              const SpacingEvaluator<3>&,
                                                              std::int64_t);

}  // namespace pnpbs
