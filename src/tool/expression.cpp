// SPDX-License-Identifier: BSD-3-Clause
#include "tool/expression.hpp"

#include <muParser.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "sphere/degrees.hpp"
#include "tool/exit.hpp"
#include "tool/formula_text.hpp"
#include "tool/interrupt.hpp"
#include "tool/names.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

// muParser does not check the number of arguments; refuse_other_hypots does.
double hypot_of(const double* numbers, int n) {
  return n == 2 ? std::hypot(numbers[0], numbers[1])
                : std::hypot(numbers[0], numbers[1], numbers[2]);
}
double pow_of(double a, double b) { return std::pow(a, b); }
double mod_of(double a, double b) { return std::fmod(a, b); }
double floor_of(double a) { return std::floor(a); }
double ceil_of(double a) { return std::ceil(a); }
double cbrt_of(double a) { return std::cbrt(a); }

// Option of the formula that is being evaluated. Callbacks of muParser have no user data, so a
// thread-local variable passes it.
thread_local const std::string* current_option = nullptr;

// Properties of the domain's shape at all points of a batch, computed when the formula first uses
// them. Callbacks of muParser receive it through a thread-local pointer.
struct ShapeAtPoints {
  using Question =
      std::function<void(double number, std::int64_t n, const double* coordinates, double* values)>;
  struct Answers {
    std::string_view name;
    double number;
    std::vector<double> values;
  };

  std::int64_t n;
  const double* coordinates;
  pnpbs_domain domain;
  std::int64_t place = 0;
  std::vector<Answers> known{};

  double value(std::string_view name, double number, const Question& ask) {
    for (const Answers& answers : known)
      if (answers.name == name && answers.number == number)
        return answers.values[static_cast<std::size_t>(place)];
    constexpr std::size_t many = 32;
    if (known.size() == many)
      throw BadInput(*current_option + ": the argument of " + std::string(name) +
                     "(...) must be a constant number");
    std::vector<double> values(static_cast<std::size_t>(n));
    ask(number, n, coordinates, values.data());
    known.push_back({name, number, std::move(values)});
    return known.back().values[static_cast<std::size_t>(place)];
  }
};

thread_local ShapeAtPoints* shape_at_places = nullptr;
thread_local pnpbs_context shape_context = nullptr;

// Returns an arbitrary value as long as there is no domain.
double shape_value(const char* name, double number, const ShapeAtPoints::Question& ask) {
  return shape_at_places ? shape_at_places->value(name, number, ask) : 1;
}

// Sets the thread-local variables for the duration of a batch.
class ShapeForBatch {
 public:
  ShapeForBatch(ShapeAtPoints& shape, pnpbs_context context, const std::string& option) {
    current_option = &option;
    shape_at_places = &shape;
    shape_context = context;
  }
  ShapeForBatch(const ShapeForBatch&) = delete;
  ShapeForBatch& operator=(const ShapeForBatch&) = delete;
  ~ShapeForBatch() { shape_at_places = nullptr; }
};

double distance_to(double tag) {
  return shape_value("dist", tag, [](double number, std::int64_t n, const double* x, double* d) {
    check(
        pnpbs_domain_distance(shape_at_places->domain, static_cast<std::int32_t>(number), n, x, d),
        shape_context);
  });
}

// Returns the least of the distances to the boundaries with these tags.
double dist_of(const double* tags, int count) {
  double least = std::numeric_limits<double>::infinity();
  for (const double tag : std::span(tags, static_cast<std::size_t>(count))) {
    if (!(tag == std::floor(tag)) || tag == 0 || std::fabs(tag) > 2e9)
      throw BadInput(*current_option + ": dist(" + short_number(tag) +
                     "): expected a tag, an integer other than 0");
    least = std::min(least, distance_to(tag));
  }
  return least;
}

double shape_spacing(const char* name, double number, double per_turn, double across,
                     double per_edge) {
  if (!(number > 0))
    throw BadInput(*current_option + ": " + name + "(" + short_number(number) +
                   "): expected a number of nodes greater than 0");
  return shape_value(name, number, [=](double, std::int64_t n, const double* x, double* d) {
    check(
        pnpbs_domain_shape_spacing(shape_at_places->domain, per_turn, across, per_edge, 0, n, x, d),
        shape_context);
  });
}

constexpr std::int32_t kRegionColumns = 4;

// Returns one of the tags of the regions at a point, of which there are several on interfaces.
double region_at(std::int32_t column) {
  return shape_value("region", column, [](double k, std::int64_t n, const double* x, double* of) {
    std::vector<std::int32_t> tags(static_cast<std::size_t>(n * kRegionColumns));
    check(pnpbs_domain_regions_at(shape_at_places->domain, n, x, kRegionColumns, tags.data()),
          shape_context);
    for (std::int64_t i = 0; i < n; ++i)
      of[i] = tags[static_cast<std::size_t>(i * kRegionColumns + static_cast<std::int64_t>(k))];
  });
}

double curvature_of(double nodes) { return shape_spacing("curvature", nodes, nodes, 0, 0); }
double gap_of(double nodes) { return shape_spacing("gap", nodes, 0, nodes, 0); }

// Finds the calls in the text, because evaluation does not reach calls in a branch of ?: that is
// not taken.
std::vector<std::string> shape_calls_in(const std::string& text) {
  std::vector<std::string> calls;
  for (const char* function : {"dist", "curvature", "gap"})
    for (std::string& call : calls_of(function, text)) calls.push_back(std::move(call));
  return calls;
}

void define_shape_functions(mu::Parser& parser) {
  constexpr bool fold_constants = false;  // the values depend on the point
  parser.DefineFun("dist", dist_of, fold_constants);
  parser.DefineFun("curvature", curvature_of, fold_constants);
  parser.DefineFun("gap", gap_of, fold_constants);
}

void define_names(mu::Parser& parser) {
  parser.DefineFun("hypot", hypot_of);
  parser.DefineFun("pow", pow_of);
  parser.DefineFun("mod", mod_of);
  parser.DefineFun("floor", floor_of);
  parser.DefineFun("ceil", ceil_of);
  parser.DefineFun("cbrt", cbrt_of);
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineConst("e", std::numbers::e);
}

std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names;
  for (const auto& [name, place] : parser.GetVar()) names.push_back(name);
  for (const auto& [name, function] : parser.GetFunDef()) names.push_back(name);
  for (const auto& [name, value] : parser.GetConst()) names.push_back(name);
  return names;
}

std::string trimmed(std::string token) {
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  while (!token.empty() && is_space(token.back())) token.pop_back();
  return token;
}

// Returns the letters, digits and points of the formula from a position on.
std::string word_at(const std::string& formula, std::size_t position) {
  const auto in_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.'; };
  const auto begin = formula.begin() + static_cast<std::ptrdiff_t>(position);
  return {begin, std::find_if_not(begin, formula.end(), in_word)};
}

constexpr const char* kQuotes = "quotes are for names of groups, as in dist('open sea')";

std::string about_unknown(const mu::Parser::exception_type& error, const mu::Parser& parser) {
  const std::string token = trimmed(error.GetToken()), formula = error.GetExpr();
  const auto position = static_cast<std::size_t>(std::max(0, error.GetPos()));
  const auto first = static_cast<unsigned char>(token.empty() ? ' ' : token[0]);
  if (parser.GetFunDef().contains(token))
    return "'" + token + "' needs its arguments in parentheses";
  if (std::isdigit(first)) return "'" + word_at(formula, position) + "' is no number";
  if (first == '\'') return kQuotes;
  if (!std::isalpha(first) && first != '_') return "unexpected '" + token + "'";
  if (token == "z") return "unknown name 'z': this domain is in the plane and has x and y";
  const std::size_t dist = formula.rfind("dist(", position);
  if (dist != std::string::npos && formula.find(')', dist) > position)
    return "unknown name '" + token +
           "': a name of a group with blanks or signs is in quotes, as in dist('open sea')";
  return "unknown name '" + token + "'" + did_you_mean(token, known_names(parser));
}

std::string in_words(const mu::Parser::exception_type& error, const mu::Parser& parser) {
  const std::string token = trimmed(error.GetToken());
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return about_unknown(error, parser);
    case mu::ecSTR_RESULT:
      return kQuotes;
    case mu::ecUNEXPECTED_EOF:
      return "the expression ends too early";
    case mu::ecMISSING_PARENS:
      return "a closing parenthesis is missing";
    case mu::ecUNEXPECTED_OPERATOR:
      return "unexpected operator '" + token + "'" +
             (token == "*" ? "; powers are written x^y" : "");
    case mu::ecUNEXPECTED_PARENS:
      return "unexpected parenthesis '" + token + "'";
    case mu::ecUNEXPECTED_ARG_SEP:
      return "unexpected comma";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return "an operator is missing before '" + token + "'";
    case mu::ecTOO_MANY_PARAMS:
      return "too many arguments for '" + token + "'";
    case mu::ecTOO_FEW_PARAMS:
      return "too few arguments for '" + token + "'";
    default: {
      std::string message = error.GetMsg();
      while (!message.empty() && message.back() == '.') message.pop_back();
      return message;
    }
  }
}

// A name in the formula and its value at one point.
struct FieldInFormula {
  Expression::Field field;
  double value = 1;
};

int threads_of_openmp() {
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

// Calls work(thread) for 0 <= thread < threads, at the same time.
template <class Work>
void on_threads(int threads, const Work& work) {
#ifdef _OPENMP
#pragma omp parallel for num_threads(threads) schedule(static, 1)
#endif
  for (int thread = 0; thread < threads; ++thread) work(thread);
}

}  // namespace

struct Expression::Parser {
  mu::Parser parser;
  std::string text;  // of the formula
  Names names = Names::coordinates;
  std::string option;  // that the formula was given by
  std::vector<NamedGroup> groups;
  std::vector<FieldInFormula> fields;
  int dimension;
  double place[3] = {0, 0, 0};
  double lon = 0, lat = 0;  // at `place`, in degrees
  bool asks_lon = false, asks_lat = false;
  double dist = 1, seglen = 1, region = 1;  // at `place`
  bool uses_shape = false;
  bool asks_dist = false, asks_seglen = false, asks_region = false;
  std::vector<std::string> shape_calls;
  pnpbs_domain domain = nullptr;
  pnpbs_context context = nullptr;

  // Returns a copy for another thread, with variables of its own.
  std::unique_ptr<Parser> copy() const {
    auto copied = std::make_unique<Parser>(*this);
    copied->parser.ClearVar();
    copied->define_coordinates();
    for (FieldInFormula& each : copied->fields)
      copied->parser.DefineVar(each.field.name, &each.value);
    for (NamedGroup& group : copied->groups) copied->parser.DefineVar(group.identifier, &group.tag);
    copied->parser.SetExpr(text);
    return copied;
  }

  void define_coordinates() {
    for (int k = 0; k < dimension; ++k) parser.DefineVar(std::string(1, "xyz"[k]), &place[k]);
    if (names == Names::shape_on_sphere) {
      parser.DefineVar("lon", &lon);
      parser.DefineVar("lat", &lat);
    }
    if (names != Names::coordinates) {
      parser.DefineVar("dist", &dist);
      parser.DefineVar("seglen", &seglen);
      parser.DefineVar("region", &region);
    }
  }
  void find_out() {
    const auto& used = parser.GetUsedVar();
    asks_dist = used.contains("dist");
    asks_seglen = used.contains("seglen");
    asks_region = used.contains("region");
    asks_lon = used.contains("lon");
    asks_lat = used.contains("lat");
    shape_calls = shape_calls_in(text);
    uses_shape = !shape_calls.empty() || asks_dist || asks_seglen || asks_region;
  }
  // Evaluates all calls of shape functions at a point, also those in branches that are not taken
  // there. Errors then appear before the run. The library also computes here what it cannot compute
  // inside a callback.
  void call_all_at(const double* there) {
    ShapeAtPoints shape{1, there, domain};
    const ShapeForBatch telling(shape, context, option);
    go_to(there);
    for (const std::string& call : shape_calls) {
      mu::Parser alone = parser;
      alone.SetExpr(call);
      alone.Eval();
    }
  }
  // A group whose name already has another meaning in formulas is left out.
  void define_groups() {
    const std::vector<std::string> known = known_names(parser);
    std::erase_if(groups, [&](const NamedGroup& group) {
      return std::ranges::find(known, group.identifier) != known.end();
    });
    for (NamedGroup& group : groups) parser.DefineVar(group.identifier, &group.tag);
  }
  void define_fields() {
    for (FieldInFormula& each : fields) {
      const std::vector<std::string> known = known_names(parser);
      if (std::ranges::find(known, each.field.name) != known.end())
        throw BadInput(each.field.option + ": '" + each.field.name +
                       "' means something else in formulas, or is given twice: choose another "
                       "name");
      parser.DefineVar(each.field.name, &each.value);
    }
  }
  void go_to(const double* there) {
    std::copy_n(there, dimension, place);
    const Point<3> x{place[0], place[1], place[2]};
    if (asks_lon) lon = longitude_of(x);
    if (asks_lat) lat = latitude_of(x);
  }
  double value() {
    if (asks_dist) dist = distance_to(0);
    if (asks_seglen) seglen = shape_spacing("seglen", 1, 0, 0, 1);
    if (!asks_region) return parser.Eval();
    // Nodes on an interface belong to several regions, so the smallest value holds there.
    const double first = region = region_at(0);
    double least = parser.Eval();
    for (std::int32_t k = 1; k < kRegionColumns; ++k) {
      region = region_at(k);
      if (region == first) break;
      least = std::min(least, parser.Eval());
    }
    return least;
  }
  // Evaluates the formula at the points first to last - 1. values_of_fields has those of each field
  // at all points.
  void evaluate(std::int64_t first, std::int64_t last, const double* coordinates,
                const std::vector<std::vector<double>>& values_of_fields, double* values) {
    for (std::int64_t i = first; i < last; ++i) {
      if (uses_shape) shape_at_places->place = i;
      go_to(coordinates + dimension * i);
      for (std::size_t k = 0; k < fields.size(); ++k)
        fields[k].value = values_of_fields[k][static_cast<std::size_t>(i)];
      values[i] = value();
    }
  }
};

Expression::Expression(const std::string& given, int dimension, const std::string& option,
                       Names names, std::vector<Field> fields)
    : parser_(std::make_unique<Parser>()) {
  const FormulaSource source{option, given};
  std::string text = given;
  if (names != Names::coordinates) parser_->groups = groups_in(text);
  for (Field& field : fields) parser_->fields.push_back({std::move(field)});
  reject_invalid_formula(source);
  refuse_other_hypots(source);
  mu::Parser& parser = parser_->parser;
  parser_->dimension = dimension;
  parser_->option = option;
  parser_->text = text;
  parser_->names = names;
  current_option = &parser_->option;
  try {
    define_names(parser);
    parser_->define_coordinates();
    if (names != Names::coordinates) define_shape_functions(parser);
    parser_->define_fields();
    parser_->define_groups();
    parser.SetExpr(text);
    parser.Eval();
    parser_->find_out();
  } catch (const mu::Parser::exception_type& error) {
    fail_at(source, static_cast<std::size_t>(std::max(0, error.GetPos())), in_words(error, parser));
  }
  if (parser.GetNumResults() != 1) {
    fail_at(source, text.find(','),
            "one value is expected, not several (decimals come after a point)");
  }
}

Expression::~Expression() = default;

void Expression::set_shape_domain(pnpbs_domain domain, pnpbs_context context) {
  parser_->domain = domain;
  parser_->context = context;
  of_other_threads_.clear();
  if (!parser_->uses_shape && parser_->fields.empty()) return;
  if (parser_->asks_region &&
      pnpbs_domain_regions_at(domain, 0, nullptr, 1, nullptr) == PNPBS_ERROR_ARGUMENT)
    throw BadInput(parser_->option +
                   ": region: no region of the domain has a tag; --region, --region-field, "
                   "--fragment and files give tags");
  if (!parser_->groups.empty()) {
    const std::vector<GroupName> names = group_names(domain, context);
    for (NamedGroup& group : parser_->groups)
      group.tag = tag_of_group(group.name, names, parser_->option);
  }
  constexpr double anywhere[3] = {0, 0, 0};
  parser_->call_all_at(anywhere);
  double value;
  at(1, anywhere, &value);
}

bool Expression::is_constant() const {
  return parser_->parser.GetUsedVar().empty() && !parser_->uses_shape && parser_->fields.empty();
}

double Expression::at(const double* place) const {
  parser_->go_to(place);
  return parser_->parser.Eval();
}

// Evaluates point by point. muParser's bulk mode is no faster on one thread, and does not let the
// caller choose the number of threads. Functions of the shape are computed for the whole batch when
// the first point needs them; the formula is then evaluated on this thread, because they are passed
// to it in thread-local variables.
void Expression::at(std::int64_t n, const double* coordinates, double* values) const {
  std::vector<std::vector<double>> of_fields;
  for (const FieldInFormula& each : parser_->fields) {
    of_fields.emplace_back(static_cast<std::size_t>(n));
    each.field.values(n, coordinates, of_fields.back().data());
  }
  if (parser_->uses_shape) {
    ShapeAtPoints shape{n, coordinates, parser_->domain};
    const ShapeForBatch telling(shape, parser_->context, parser_->option);
    return parser_->evaluate(0, n, coordinates, of_fields, values);
  }
  constexpr std::int64_t few = 1000;  // points, which one thread evaluates as fast as several
  const std::int64_t threads =
      uses_threads_ ? std::min<std::int64_t>(threads_of_openmp(), n / few + 1) : 1;
  while (std::ssize(of_other_threads_) < threads - 1) of_other_threads_.push_back(parser_->copy());
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(threads));
  on_threads(static_cast<int>(threads), [&](int thread) {
    const auto k = static_cast<std::size_t>(thread);
    Parser& parser = thread == 0 ? *parser_ : *of_other_threads_[k - 1];
    try {
      parser.evaluate(n * thread / threads, n * (thread + 1) / threads, coordinates, of_fields,
                      values);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

std::int32_t call_expression(std::int64_t n, std::int32_t /*dim*/, const double* coordinates,
                             double* values, void* user) {
  if (callbacks_give_up()) return 1;
  try {
    static_cast<const Expression*>(user)->at(n, coordinates, values);
    return 0;
  } catch (...) {
    return 1;
  }
}

std::string expression_help() {
  mu::Parser parser;
  define_names(parser);
  std::string list;
  for (const auto& [name, function] : parser.GetFunDef()) list += (list.empty() ? "" : " ") + name;
  return "x, y, z (of bodies), lon, lat (degrees, with --sphere), pi, e, numbers, + - * / ^ ( ), "
         "comparisons, a ? b : c, and the "
         "functions " +
         list +
         "; in --spacing and --field also dist, the distance to the boundary, dist(TAG), "
         "dist(NAME) and dist(NAME, NAME, ...), to the curves, surfaces and nodes with the tag or "
         "the name of one of the groups, the "
         "names of --spacing-grid and, with _slope after them, the slopes of the grids, by_depth "
         "of --depth-rule, "
         "seglen, the length of the input's edges, region, the tag of the region at the point, "
         "curvature(N), the d for N nodes per turn, and "
         "gap(N), the d for N nodes across, which grow by 0.15 per unit of distance";
}

}  // namespace pnpbs::tool
