// SPDX-License-Identifier: BSD-3-Clause
#include "settings/options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "settings/named_rows.hpp"

namespace pnpbs {

namespace {

// Maximum number of nodes on all ranks together, which sums and ids are designed for
// (base/fixed_point.hpp).
constexpr double kMaxNodesInAll = 0x1p40;

// Defaults for bubbles in space (docs/volumes.md). They replace the other defaults, also under
// method=paper.
struct VolumeDefault {
  const char* name;
  const char* value;
  const char* best_value = nullptr;  // under effort=best; NULL if it is the same
};
constexpr VolumeDefault kVolumeDefaults[] = {
    {"rest_length", "1.2"},
    {"time_step", "0.6"},
    {"max_move", "0.05"},
    {"steps", "60", "200"},
    {"coarsest_steps", "400", "1000"},
    {"refined_steps", "100", "300"},
    {"delete_above", "19"},
    // A vacancy leaves the overlap ratios of its neighbours near 13. Only the target mean distance
    // fills it.
    {"insert_below", "9"},
    {"sweeps", "3"},
    {"sweep_weight", "1"},
    {"list_radius", "1.5"},
    {"exchange_interval", "1"},
    {"event_interval", "10"},
    {"tolerance_mean", "0.025", "0.008"},
};

const VolumeDefault* default_in_space(std::string_view name) {
  for (const VolumeDefault& in_space : kVolumeDefaults)
    if (in_space.name == name) return &in_space;
  return nullptr;
}

// Appends the default in space to the help of each option that has one.
std::vector<OptionRow> naming_both_defaults(std::vector<OptionRow> rows) {
  static std::vector<std::string> texts;  // the help pointers refer to these texts
  texts.reserve(rows.size());
  for (OptionRow& row : rows)
    if (const VolumeDefault* in_space = default_in_space(row.name)) {
      std::string text = std::string(row.help) + "; default in space " + in_space->value;
      if (in_space->best_value) text += std::string(", with effort=best ") + in_space->best_value;
      row.help = texts.emplace_back(std::move(text)).c_str();
    }
  return rows;
}

}  // namespace

const std::vector<OptionRow>& option_table() {
  using T = OptionType;
  static const std::vector<OptionRow> table = naming_both_defaults({
      {"method", T::choice, "default", nullptr, nullptr, 0, 0, "default | paper",
       "preset for the options below: the best by measurement, or exactly the paper's scheme"},
      {"effort", T::choice, "default", nullptr, nullptr, 0, 0, "default | best",
       "second preset: fast and good, or about three times slower for the best spacing possible"},
      {"law", T::choice, "push", "cubic", nullptr, 0, 0, "push | cubic",
       "force between bubbles: a push, linear in the plane and smooth in space, or equation (2) of "
       "the paper"},
      {"scheme", T::choice, "damped", "predictor_corrector", nullptr, 0, 0,
       "damped | predictor_corrector",
       "time step of equation (1): one force per step, or the paper's Euler predictor-corrector"},
      {"finish", T::choice, "none", "runge_kutta", nullptr, 0, 0, "none | runge_kutta",
       "last step of a run: like the others, or fourth-order Runge-Kutta"},
      {"rest_length", T::real, "1.06", nullptr, nullptr, 0.8, 1.4, nullptr,
       "distance at which the push ends, in desired distances"},
      {"time_step", T::real, "0.8", "0.3", nullptr, 1e-3, 2, nullptr,
       "in units of sqrt(m / k0) of a scaled bubble"},
      {"damping", T::real, "0.2", "0.7", "0.1", 0, 100, nullptr,
       "c of equation (1), in units of sqrt(k0 m) of a scaled bubble"},
      {"max_move", T::real, "0.03", nullptr, nullptr, 1e-3, 0.2, nullptr,
       "maximum displacement of a node in one step, in spacings"},
      {"steps", T::integer, "300", "1000", nullptr, 0, 1e9, nullptr,
       "maximum number of steps of a run"},
      {"levels", T::integer, "3", "0", "4", 0, 10, nullptr,
       "number of coarser levels that provide the first nodes, each with twice the spacing of "
       "the next; fewer where d varies too fast for them or requires few nodes, or the boundary "
       "requires too many"},
      {"coarsest_steps", T::integer, "100", nullptr, "1000", 0, 1e9, nullptr,
       "maximum number of steps on the coarsest of several levels"},
      {"refined_steps", T::integer, "80", nullptr, "500", 0, 1e9, nullptr,
       "maximum number of steps on the levels between the coarsest and the finest"},
      {"event_interval", T::integer, "20", "8", nullptr, 1, 1e6, nullptr,
       "steps between events: refresh of d, population, stop test, monitor"},
      {"population_share", T::real, "0.6", "0.75", nullptr, 0, 1, nullptr,
       "maximum share of the steps during which the population is adjusted"},
      {"population_tolerance", T::real, "0.0002", nullptr, nullptr, 0, 1, nullptr,
       "the adjustment ends when two events in a row change at most this share of the nodes"},
      {"delete_above", T::real, "8.5", "9", nullptr, 6, 100, nullptr,
       "bubbles with a larger overlap ratio are deleted"},
      {"insert_below", T::real, "4.4", "5", nullptr, 0, 14, nullptr,
       "new bubbles are inserted beside those with a smaller overlap ratio"},
      {"mean_distance", T::real, "1", "0", nullptr, 0, 1.2, nullptr,
       "target mean distance of touching bubbles, in desired distances, for inserting and "
       "deleting in every octave of d; 0: the result of the two thresholds"},
      {"tolerance_mean", T::real, "0.006", "0.001", "0.003", 0, 1, nullptr,
       "stop test: the mean scaled speed must be below this (spacings per unit of time)"},
      {"tolerance_max", T::real, "0.15", "0.05", nullptr, 0, 10, nullptr,
       "stop test: the largest scaled speed must be below this (spacings per unit of time)"},
      {"sweeps", T::integer, "6", "0", "8", 0, 10000, nullptr,
       "finishing sweeps, which move nodes towards the mean of their Delaunay neighbours"},
      {"sweep_weight", T::real, "0.6", nullptr, nullptr, 0, 1, nullptr,
       "fraction of the distance to that mean by which a sweep moves a node"},
      {"first_row", T::integer, "1", "0", nullptr, 0, 1, nullptr,
       "1, only in the plane and with sweeps: before the sweeps, one node is put over each regular "
       "edge of the boundary, in place of the first row that the bubbles have made"},
      {"topology_repairs", T::integer, "0", nullptr, "1", 0, 1000, nullptr,
       "maximum rounds at the end of every level that insert or delete nodes where one is "
       "missing or in excess: tried on a copy of the nodes around, and kept where the triangles "
       "improve"},
      {"smoothing_rounds", T::integer, "10", "0", nullptr, 0, 10000, nullptr,
       "maximum rounds after the sweeps that repair triangles below 0.82, and then all bad "
       "ones; before the sweeps, excess nodes are deleted; 0: neither; in space slivers are "
       "repaired unless it is 0"},
      {"smooth_below", T::real, "0.82", nullptr, "0.87", 0, 1, nullptr,
       "triangles are bad if their quality, 2 r_in / R, or 1.365 times the sine of the smallest "
       "angle is below this; only in the plane"},
      {"sliver_angle", T::real, "33", nullptr, "38", 0, 40, nullptr,
       "tetrahedra with a dihedral angle below this, in degrees, are slivers and repaired; only "
       "in space"},
      {"centroidal_sweeps", T::integer, "0", nullptr, nullptr, 0, 10000, nullptr,
       "only in the plane and on spheres, for finite volumes: sweeps after the repairs that move "
       "inner nodes to the centroids of their Voronoi cells for the density d^-4"},
      {"obtuse_rounds", T::integer, "0", nullptr, nullptr, 0, 10000, nullptr,
       "only in the plane and on spheres, for finite volumes: maximum rounds at the end that "
       "repair triangles with an angle above 89.5 degrees"},
      {"split_elements_on_boundary", T::integer, "0", nullptr, nullptr, 0, 1, nullptr,
       "1, only in the plane and on spheres: triangles with all nodes on the boundary are split at "
       "the end, by nodes at the middles of their longest inner edges"},
      {"list_radius", T::real, "1.6", "1.7", nullptr, 1.5, 3, nullptr,
       "radius of the lists during the run, in desired distances"},
      {"adjacency_radius", T::real, "1.7", nullptr, nullptr, 0.5, 4, nullptr,
       "radius of the returned adjacency lists, in desired distances"},
      {"growth_limit", T::real, "0.3", "0", nullptr, 0, 1e6, nullptr,
       "maximum growth of d per unit of length; 0: no limit. If not set, it applies only where "
       "the given d grows faster, with a warning"},
      {"resolve", T::integer, "0", nullptr, nullptr, 0, 1, nullptr,
       "1, only in space: d is reduced where it does not resolve the shape, to half of a wall's "
       "thickness, 3/4 of a gap's width, and at sharp edges; from there it grows by "
       "growth_limit"},
      {"conforming_rounds", T::integer, "8", nullptr, nullptr, 0, 20, nullptr,
       "only in space: maximum number of times that d is halved where elements are missing at "
       "the end of a run, their boundary is torn or their angles are below min_angle, and the "
       "run continues from its nodes; 0: d is unchanged"},
      {"min_angle", T::real, "2", nullptr, nullptr, 0, 25, nullptr,
       "only in space: d is reduced also where tetrahedra have a dihedral angle below this, in "
       "degrees, at the end of a run, as long as conforming_rounds allows, unless the body itself "
       "is sharper than 33 degrees there; 0: small angles do not count"},
      {"wanted_nodes", T::real, "0", nullptr, nullptr, 0, kMaxNodesInAll, nullptr,
       "requested number of nodes: d is multiplied by the factor with which a run is expected "
       "to reach it. A run that ends more than 1 % off is repeated once from the start, with a "
       "corrected factor. 0: d is unchanged"},
      {"exchange_interval", T::integer, "5", nullptr, nullptr, 1, 64, nullptr,
       "steps between exchanges of ghosts between ranks"},
      {"rebalance_above", T::real, "1.1", nullptr, nullptr, 1, 1e6, nullptr,
       "the work is repartitioned at an event when its largest share exceeds the mean by this "
       "factor"},
      {"metis_seed", T::integer, "1", nullptr, nullptr, 0, 2e9, nullptr,
       "seed of the partition; the nodes do not depend on it"},
      {"max_nodes", T::integer, "100000000", nullptr, nullptr, 1, kMaxNodesInAll, nullptr,
       "a larger number of nodes is rejected as an error in d"},
      {"max_memory", T::real, "1", nullptr, nullptr, 0, 1e6, nullptr,
       "a run is refused if it would need more than this share of the memory available on its "
       "machines; 0: no check"},
      {"restart_options", T::choice, "same", nullptr, nullptr, 0, 0, "same | changed",
       "whether options set to other values than those of a checkpoint are refused when it is "
       "read, or change from there on"},
      {"threads", T::integer, "0", nullptr, nullptr, 0, 4096, nullptr,
       "threads of the process, set on the context before anything runs; 0: OMP_NUM_THREADS or "
       "KOKKOS_NUM_THREADS, else the number of cores divided by that of ranks on the machine"},
  });
  return table;
}

namespace {

// Options that the nodes do not depend on. The presets are among them because they only set the
// defaults of other options.
constexpr std::string_view kNotDeciding[] = {
    "method",     "effort",    "adjacency_radius", "exchange_interval", "rebalance_above",
    "metis_seed", "max_nodes", "max_memory",       "restart_options",   "threads"};

std::vector<std::string> choices_of(const OptionRow& row) {
  std::vector<std::string> names;
  std::string_view rest = row.choices;
  while (!rest.empty()) {
    const std::size_t bar = rest.find(" | ");
    names.emplace_back(rest.substr(0, bar));
    rest = bar == std::string_view::npos ? "" : rest.substr(bar + 3);
  }
  return names;
}

const OptionRow& find_row(const std::string& key) {
  return row_named(key, option_table(), "option");
}

[[noreturn]] void reject(const OptionRow& row, const std::string& value) {
  throw Error(ErrorKind::argument,
              std::string("option ") + row.name + " = \"" + value + "\": expected " +
                  (row.type == OptionType::choice
                       ? "one of "
                       : std::string(row.type == OptionType::integer ? "an integer" : "a number") +
                             " in ") +
                  row.range());
}

template <class Number>
bool parse_number(const std::string& text, Number& value) {
  const char* begin = text.c_str();
  const char* end = begin + text.size();
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  const auto result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end && begin != end;
}

}  // namespace

std::string OptionRow::range() const {
  if (type == OptionType::choice) return choices;
  return number_text(min) + " .. " + number_text(max);
}

void Options::set(const std::string& key, const std::string& value) {
  const OptionRow& row = find_row(key);
  if (row.type == OptionType::choice) {
    const std::vector<std::string> known = choices_of(row);
    if (std::find(known.begin(), known.end(), value) == known.end()) reject(row, value);
  } else if (row.type == OptionType::integer) {
    std::int64_t number;
    if (!parse_number(value, number) || static_cast<double>(number) < row.min ||
        static_cast<double>(number) > row.max)
      reject(row, value);
  } else {
    double number;
    if (!parse_number(value, number) || !(number >= row.min && number <= row.max))
      reject(row, value);
  }
  values_[key] = value;
}

void Options::set_integer(const std::string& key, std::int64_t value) {
  set(key, std::to_string(value));
}

void Options::set_real(const std::string& key, double value) {
  const OptionRow& row = find_row(key);
  if (row.type == OptionType::integer && value == std::floor(value) && std::fabs(value) < 1e15)
    set(key, std::to_string(static_cast<std::int64_t>(value)));
  else
    set(key, number_text(value));
}

std::string Options::text(const char* key) const {
  const auto found = values_.find(key);
  if (found != values_.end()) return found->second;
  const OptionRow& row = find_row(key);
  const bool best = chosen("effort", "best");
  if (const VolumeDefault* in_space = default_in_space(key); in_space && dimension_ == 3)
    return best && in_space->best_value ? in_space->best_value : in_space->value;
  if (row.paper_value && chosen("method", "paper")) return row.paper_value;
  if (row.best_value && best) return row.best_value;
  return row.default_value;
}

Options Options::in(int dimension) const {
  Options copy = *this;
  copy.dimension_ = dimension;
  return copy;
}

bool Options::chosen(const char* preset, const char* value) const {
  const auto found = values_.find(preset);
  return found != values_.end() && found->second == value;
}

bool Options::is_given(const char* key) const {
  if (is_set(key)) return true;
  const OptionRow& row = find_row(key);
  const VolumeDefault* in_space = dimension_ == 3 ? default_in_space(key) : nullptr;
  const bool by_effort = in_space ? in_space->best_value != nullptr : row.best_value != nullptr;
  const bool by_method = !in_space && row.paper_value;
  return (by_effort && is_set("effort")) || (by_method && is_set("method"));
}

std::size_t Options::fingerprint() const {
  std::string all;
  for (const auto& [key, value] : values_) all += key + "=" + value + ";";
  return std::hash<std::string>{}(all);
}

std::vector<std::pair<std::string, std::string>> Options::deciding() const {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const OptionRow& row : option_table()) {
    if (std::ranges::find(kNotDeciding, std::string_view(row.name)) != std::end(kNotDeciding))
      continue;
    std::string value = row.type == OptionType::choice    ? choice(row.name)
                        : row.type == OptionType::integer ? std::to_string(integer(row.name))
                                                          : number_text(real(row.name));
    // An unset limit has another meaning than a set limit of the same value.
    if (std::string_view(row.name) == "growth_limit" && !is_set("growth_limit"))
      value += " (not set)";
    rows.emplace_back(row.name, std::move(value));
  }
  return rows;
}

std::int64_t Options::integer(const char* key) const {
  std::int64_t value = 0;
  parse_number(text(key), value);
  return value;
}

double Options::real(const char* key) const {
  double value = 0;
  parse_number(text(key), value);
  return value;
}

std::string Options::choice(const char* key) const { return text(key); }

}  // namespace pnpbs
