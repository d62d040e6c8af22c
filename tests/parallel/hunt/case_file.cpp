// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads cases as text files.

#include "case_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "number_text.hpp"

namespace hunt {

namespace {

class CaseWriter {
 public:
  explicit CaseWriter(std::ostream& file) : file_(file) {}

  void write(const Case& job) {
    line("hunt-case", 1);
    line("case", job.seed, job.number);
    line("name", job.name);
    write_body(job.body);
    write_spacing("spacing", job.spacing);
    write_spacing("second", job.second);
    for (const auto& [key, value] : job.options) line("option", key, value);
    line("wanted-nodes", job.wanted_nodes);
    line("by-steps", job.by_steps, job.steps);
    line("adapts", job.adapts, job.at_nodes);
    line("end");
  }

 private:
  void put(const std::string& text) { file_ << ' ' << text; }
  void put(const char* text) { file_ << ' ' << text; }
  void put(double value) { file_ << ' ' << decimal_text(value); }
  void put(bool value) { file_ << ' ' << (value ? 1 : 0); }
  template <class Integer>
  void put(Integer value) {
    file_ << ' ' << value;
  }
  template <class Value, std::size_t n>
  void put(const std::array<Value, n>& values) {
    for (const Value& value : values) put(value);
  }

  template <class... Values>
  void line(const char* key, const Values&... values) {
    file_ << key;
    (put(values), ...);
    file_ << '\n';
  }

  void write_body(const Body& body) {
    line("dim", body.dim);
    line("filled", body.filled);
    line("frame", body.frame.rotation, body.frame.scale, body.frame.offset);
    line("bounds", body.low, body.high);
    line("resolution", body.resolution);
    if (!body.file.empty()) line("file", std::filesystem::path(body.file).filename().string());
    for (const Solid& solid : body.solids)
      line("solid", solid.is_box ? "box" : "capsule", solid.taken_away ? "removed" : "added",
           solid.a, solid.b, solid.radius);
    for (const auto& box : body.boxes) line("box", box);
    for (std::size_t c = 0; c < body.cylinders.size(); ++c)
      line("cylinder", body.cylinders[c], body.radii[c]);
    for (const Point& fixed : body.fixed) line("fixed", fixed);
    for (const Curve& curve : body.curves) {
      line("curve", curve.role, curve.closed, curve.corner_angle, curve.points.size());
      for (const auto& point : curve.points) line("", point);
    }
    for (const Mesh& mesh : body.meshes) write_mesh(mesh);
  }

  void write_mesh(const Mesh& mesh) {
    const bool has_tags = !mesh.tags.empty();
    line("mesh", mesh.role, mesh.points.size(), mesh.triangles.size(), has_tags);
    for (const Point& point : mesh.points) line("", point);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (has_tags)
        line("", mesh.triangles[t], mesh.tags[t]);
      else
        line("", mesh.triangles[t]);
  }

  // A spacing uses the frame of the body, so the frame is not written here.
  void write_spacing(const char* key, const Spacing& spacing) {
    line(key, spacing.name(), spacing.base, spacing.slope, spacing.from, spacing.directions,
         spacing.width, spacing.factor);
  }

  std::ostream& file_;
};

class CaseReader {
 public:
  explicit CaseReader(const std::string& path) : path_(path), file_(path) {
    if (!file_) throw std::runtime_error(path + ": the file cannot be opened.");
  }

  Case read() && {
    next_line();
    if (word() != "hunt-case" || integer() != 1) fail("the file is no case of the program hunt");
    end_line();
    for (;;) {
      next_line();
      const std::string key = word();
      if (key == "end") break;
      if (!take_body(key) && !take_part(key) && !take_run(key))
        fail("\"" + key + "\" is no keyword of a case");
      end_line();
    }
    made_.spacing.frame = made_.second.frame = made_.body.frame;
    return std::move(made_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(path_ + ", line " + std::to_string(number_) + ": " + what + ".");
  }

  void next_line() {
    std::string text;
    do {
      ++number_;
      if (!std::getline(file_, text)) fail("the file ends before the line \"end\"");
    } while (text.empty() || text[0] == '#');
    line_.clear();
    line_.str(text);
  }

  void end_line() {
    std::string left;
    if (line_ >> left) fail("\"" + left + "\" is too much");
  }

  std::string word() {
    std::string text;
    if (!(line_ >> text)) fail("a word or a number is missing");
    return text;
  }

  // Returns the rest of the line without leading blanks.
  std::string rest() {
    std::string text;
    std::getline(line_ >> std::ws, text);
    return text;
  }

  double real() {
    const std::string text = word();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (*end != 0) fail("\"" + text + "\" is no number");
    return value;
  }

  std::int64_t integer() {
    const std::string text = word();
    char* end = nullptr;
    const long long value = std::strtoll(text.c_str(), &end, 10);
    if (*end != 0) fail("\"" + text + "\" is no integer");
    return value;
  }

  std::int64_t count() {
    const std::int64_t value = integer();
    if (value < 0) fail("a number of lines is negative");
    return value;
  }

  bool flag() { return one_of("0", "1"); }

  // Returns whether the next word is the second of the two, and fails if it is neither.
  bool one_of(const char* first, const char* second) {
    const std::string text = word();
    if (text != first && text != second)
      fail("\"" + text + "\" is neither " + first + " nor " + second);
    return text == second;
  }

  Point point() {
    Point made;
    for (double& value : made) value = real();
    return made;
  }

  bool take_body(const std::string& key) {
    Body& body = made_.body;
    if (key == "dim")
      body.dim = one_of("2", "3") ? 3 : 2;
    else if (key == "filled")
      body.filled = flag();
    else if (key == "frame")
      take_frame(body.frame);
    else if (key == "bounds")
      body.low = point(), body.high = point();
    else if (key == "resolution")
      body.resolution = real();
    else if (key == "file")
      body.file = (std::filesystem::path(path_).parent_path() / rest()).string();
    else
      return false;
    return true;
  }

  bool take_part(const std::string& key) {
    Body& body = made_.body;
    if (key == "solid") {
      take_solid();
    } else if (key == "box") {
      body.boxes.push_back({point(), point()});
    } else if (key == "cylinder") {
      body.cylinders.push_back({point(), point()});
      body.radii.push_back(real());
    } else if (key == "fixed") {
      body.fixed.push_back(point());
    } else if (key == "curve") {
      take_curve();
    } else if (key == "mesh") {
      take_mesh();
    } else {
      return false;
    }
    return true;
  }

  bool take_run(const std::string& key) {
    if (key == "case") {
      made_.seed = static_cast<std::uint64_t>(integer());
      made_.number = static_cast<std::uint64_t>(integer());
    } else if (key == "name") {
      made_.name = rest();
    } else if (key == "spacing") {
      take_spacing(made_.spacing);
    } else if (key == "second") {
      take_spacing(made_.second);
    } else if (key == "option") {
      const std::string option = word();
      made_.options.emplace_back(option, rest());
    } else if (key == "wanted-nodes") {
      made_.wanted_nodes = real();
    } else if (key == "by-steps") {
      made_.by_steps = flag();
      made_.steps = integer();
    } else if (key == "adapts") {
      made_.adapts = flag();
      made_.at_nodes = flag();
    } else {
      return false;
    }
    return true;
  }

  void take_frame(Frame& frame) {
    for (Point& row : frame.rotation) row = point();
    frame.scale = real();
    frame.offset = point();
  }

  void take_solid() {
    Solid solid;
    solid.is_box = one_of("capsule", "box");
    solid.taken_away = one_of("added", "removed");
    solid.a = point();
    solid.b = point();
    solid.radius = real();
    made_.body.solids.push_back(solid);
  }

  void take_curve() {
    Curve curve;
    curve.role = static_cast<std::int32_t>(integer());
    curve.closed = flag();
    curve.corner_angle = real();
    for (std::int64_t left = count(); left > 0; --left) {
      end_line();
      next_line();
      const double x = real(), y = real();
      curve.points.push_back({x, y});
    }
    made_.body.curves.push_back(std::move(curve));
  }

  void take_mesh() {
    Mesh mesh;
    mesh.role = static_cast<std::int32_t>(integer());
    const std::int64_t points = count(), triangles = count();
    const bool has_tags = flag();
    for (std::int64_t k = 0; k < points; ++k) {
      end_line();
      next_line();
      mesh.points.push_back(point());
    }
    for (std::int64_t k = 0; k < triangles; ++k) {
      end_line();
      next_line();
      mesh.triangles.emplace_back();
      for (std::int64_t& corner : mesh.triangles.back()) {
        corner = integer();
        if (corner < 0 || corner >= points) fail("a triangle has a corner that is no point");
      }
      if (has_tags) mesh.tags.push_back(static_cast<std::int32_t>(integer()));
    }
    made_.body.meshes.push_back(std::move(mesh));
  }

  void take_spacing(Spacing& spacing) {
    const std::string name = word();
    int kind = 0;
    for (spacing.kind = Spacing::Kind::constant; spacing.name() != name;) {
      if (++kind > static_cast<int>(Spacing::Kind::waves)) fail("\"" + name + "\" is no spacing");
      spacing.kind = static_cast<Spacing::Kind>(kind);
    }
    spacing.base = real();
    spacing.slope = real();
    spacing.from = point();
    spacing.directions = static_cast<int>(integer());
    spacing.width = real();
    spacing.factor = real();
  }

  std::string path_;
  std::ifstream file_;
  std::istringstream line_;
  int number_ = 0;
  Case made_;
};

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void copy_body(const std::filesystem::path& from, const std::filesystem::path& folder) {
  const std::filesystem::path to = folder / from.filename();
  if (!std::filesystem::exists(to))
    std::filesystem::copy_file(from, to);
  else if (contents(from) != contents(to))
    throw std::runtime_error(to.string() + ": a file with other contents has this name.");
}

}  // namespace

void write_case(const Case& job, const std::string& path) {
  std::ofstream file(path);
  CaseWriter(file).write(job);
  file.close();
  if (!file) throw std::runtime_error(path + ": the file cannot be written.");
  if (!job.body.file.empty()) copy_body(job.body.file, std::filesystem::path(path).parent_path());
}

Case read_case(const std::string& path) { return CaseReader(path).read(); }

}  // namespace hunt
