// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .poly format: valid variants, and invalid files.
#include <clocale>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>

#include "domain/from_files.hpp"
#include "expect_error.hpp"
#include "run_suite.hpp"

using pnpbs::PlaneDomain;

namespace {

const char* const square =
    "4 2 0 0\n1 0 0\n2 2 0\n3 2 2\n4 0 2\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";

void parse_poly(PlaneDomain& domain, std::string_view text, const std::string& name) {
  add_poly(domain, pnpbs::parse_poly(text, name));
}

void read_poly(PlaneDomain& domain, const std::string& path) {
  add_poly(domain, pnpbs::read_poly(path));
}

PlaneDomain read(const std::string& text) {
  PlaneDomain domain;
  parse_poly(domain, text, "x.poly");
  domain.check();
  return domain;
}

void expect_file_error(std::initializer_list<const char*> parts, const std::string& text) {
  expect_error(pnpbs::ErrorKind::file, parts, [&text] {
    PlaneDomain domain;
    parse_poly(domain, text, "x.poly");
  });
}

std::string work_path(const std::string& name) {
  return std::string(PNPBS_TEST_WORK_DIR "/") + name;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

}  // namespace

START_TEST(numbered_from_one) {
  const PlaneDomain domain = read(square);
  ck_assert_double_eq(domain.area(), 4);
  ck_assert_str_eq(domain.corners()[0].name.c_str(), "vertex 1");
  ck_assert_str_eq(domain.curves()[3].name.c_str(), "segment 4");
  ck_assert_int_eq(domain.curves()[3].tag, 1);
}
END_TEST

START_TEST(numbered_from_zero_with_all_sections) {
  const PlaneDomain domain = read(
      "\xef\xbb\xbf# a comment\r\n"
      "8 2 1 1   # vertices with one attribute and a marker\r\n\r\n"
      "0 0 0 3.5 0\r\n1 +4 0 -1e300 9\r\n2 4 4 x 0\r\n3 0.0e0 .4e1 0 0\r\n"
      "4 1 1 0 0\r\n5 2 1 0 0\r\n6 2 2 0 0\r\n7 1 2 0 0\r\n"
      "\t8 1 # segments\r\n"
      "0 0 1 5\r\n1 1 2 5\r\n2 2 3 5\r\n3 3 0 -6\r\n"
      "4 4 5 0\r\n5 5 6 7\r\n6 6 7 7\r\n7 7 4 7\r\n"
      "1\r\n0 1.5 1.5\r\n"
      "3 # regions\r\n0 0.5 0.5 17 0.1\r\n1 3 3 17. -1\r\n2 3 3 0.5");
  ck_assert_double_eq(domain.area(), 15);
  ck_assert_int_eq(domain.corners()[1].tag, 9);
  ck_assert_int_eq(domain.corners()[2].tag, 5);
  ck_assert_int_eq(domain.curves()[3].tag, -6);
  ck_assert_int_eq(domain.curves()[4].tag, 1);  // 0 means no marker
  ck_assert_str_eq(domain.corners()[0].name.c_str(), "vertex 0");
  ck_assert_ptr_nonnull(domain.regions());
  ck_assert_int_eq(domain.regions()->tag_at({3, 0.5}), 17);
  ck_assert_uint_eq(domain.warnings().size(), 1);
}
END_TEST

START_TEST(missing_counts_are_zero) {
  ck_assert_double_eq(read(replaced(square, "4 2 0 0", "4")).area(), 4);
  ck_assert_double_eq(read(replaced(square, "4 2 0 0", "4 2")).area(), 4);
  ck_assert_double_eq(read(replaced(square, "4 0\n1 1", "4\n1 1")).area(), 4);
}
END_TEST

START_TEST(any_locale) {
  // Files have decimal points also in locales with decimal commas.
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) std::setlocale(LC_ALL, "C");
  ck_assert_double_eq(read(replaced(square, "3 2 2", "3 2.5 2.5")).area(), 5);
  std::setlocale(LC_ALL, "C");
}
END_TEST

START_TEST(vertices_in_a_node_file) {
  const std::string path = work_path("split.poly");
  write(path, "0 2 0 0\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  write(work_path("split.node"), "4 2 0 0\n1 0 0\n2 2 0\n3 2 2\n4 0 2\n# end\n");
  PlaneDomain domain;
  read_poly(domain, path);
  domain.check();
  ck_assert_double_eq(domain.area(), 4);
  write(work_path("split.node"), "4 2 0 0\n1 0 0\n2 2 zero\n3 2 2\n4 0 2\n");
  PlaneDomain bad;
  expect_error(pnpbs::ErrorKind::file, {"split.node:3: found 'zero', expected y"},
               [&] { read_poly(bad, path); });
  std::remove(work_path("split.node").c_str());
  expect_error(pnpbs::ErrorKind::file, {"split.node: cannot be read"},
               [&] { read_poly(bad, path); });
  std::remove(path.c_str());
  expect_file_error({"x.poly:1: 0 vertices mean a separate .node file"}, "0 2 0 0\n4 0\n");
}
END_TEST

START_TEST(unreadable_files) {
  PlaneDomain domain;
  expect_error(pnpbs::ErrorKind::file, {"none.poly: cannot be read: No such file"},
               [&] { read_poly(domain, work_path("none.poly")); });
  expect_error(pnpbs::ErrorKind::file, {": cannot be read: Is a directory"},
               [&] { read_poly(domain, work_path("")); });
  expect_error(pnpbs::ErrorKind::file, {"/dev/zero: holds zero bytes"},
               [&] { read_poly(domain, "/dev/zero"); });
}
END_TEST

START_TEST(truncated_files) {
  expect_file_error({"x.poly:1: the file ends, expected the number of vertices"}, "");
  expect_file_error({"x.poly:2: the file ends, expected the number of vertices"}, "# nothing\n\n");
  expect_file_error({"x.poly:3: the file ends after 2 of 4 vertices"}, "4 2 0 0\n1 0 0\n2 2 0\n");
  expect_file_error({"the file ends, expected the number of segments"},
                    "3 2 0 0\n1 0 0\n2 2 0\n3 2 2\n");
  expect_file_error({"x.poly:7: the file ends after 1 of 4 segments"},
                    std::string(square).substr(0, 42));
  const std::string whole = square;
  expect_file_error({"x.poly:10: the file ends, expected the number of holes"},
                    whole.substr(0, whole.size() - 2));
  // Any truncation is either an error or still a valid graph.
  for (std::size_t length = 0; length < whole.size(); ++length) {
    PlaneDomain domain;
    try {
      parse_poly(domain, whole.substr(0, length), "x.poly");
      ck_assert_uint_ge(length, whole.size() - 1);
    } catch (const pnpbs::Error& error) {
      ck_assert(error.kind() == pnpbs::ErrorKind::file);
    }
  }
}
END_TEST

START_TEST(wrong_fields) {
  expect_file_error({"x.poly:1: found 'a?b', expected the number of vertices"},
                    "a\x01"
                    "b 2\n");
  expect_file_error({"x.poly: holds zero bytes"}, std::string("4 2\0 0", 6));
  expect_file_error({"x.poly:1: the number of vertices is -4"}, "-4 2 0 0\n");
  expect_file_error({"x.poly:1: found dimension 3, expected 2"}, "4 3 0 0\n");
  expect_file_error({"x.poly:1: found 2, expected the number of boundary markers"}, "4 2 0 2\n");
  expect_file_error({"x.poly:2: the first vertex is 2, expected 0 or 1"}, "4 2 0 0\n2 0 0\n");
  expect_file_error({"x.poly:3: found vertex 3, expected vertex 2"},
                    replaced(square, "\n2 2 0", "\n3 2 0"));
  expect_file_error({"x.poly:4: found vertex 2, expected vertex 3"},
                    replaced(square, "\n3 2 2", "\n2 2 2"));
  expect_file_error({"x.poly:3: found '2,5', expected x"}, replaced(square, "2 2 0", "2 2,5 0"));
  expect_file_error({"x.poly:3: found 'nan', expected x"}, replaced(square, "2 2 0", "2 nan 0"));
  expect_file_error({"x.poly:3: found '-inf', expected y"}, replaced(square, "2 2 0", "2 0 -inf"));
  expect_file_error({"x.poly:3: found '1e400', expected x"},
                    replaced(square, "2 2 0", "2 1e400 0"));
  expect_file_error({"x.poly:3: found '1e151', expected x"},
                    replaced(square, "2 2 0", "2 1e151 0"));
  expect_file_error({"x.poly:3: the line ends, expected y"}, replaced(square, "2 2 0", "2 2"));
  expect_file_error({"x.poly:7: there is no vertex 5, expected 1 to 4"},
                    replaced(square, "1 1 2\n", "1 5 2\n"));
  expect_file_error({"x.poly:7: there is no vertex 0"}, replaced(square, "1 1 2\n", "1 1 0\n"));
  expect_file_error({"x.poly:7: both ends of the segment"}, replaced(square, "1 1 2\n", "1 2 2\n"));
  expect_file_error({"x.poly:7: found '1.5', expected a vertex number"},
                    replaced(square, "1 1 2\n", "1 1.5 2\n"));
  expect_file_error({"x.poly:7: the line ends, expected a boundary marker"},
                    replaced(square, "4 0\n1 1", "4 1\n1 1"));
  expect_file_error({"found '99999999999', expected a boundary marker (a 32-bit integer)"},
                    "1 2 0 1\n1 0 0 99999999999\n");
  expect_file_error({"found '123456789012345678901234...'", "expected the number of vertices"},
                    "12345678901234567890123456 2 0 0\n");
}
END_TEST

START_TEST(huge_counts_cost_nothing) {
  expect_file_error({"x.poly:2: the file ends after 1 of 9000000000000000000 vertices"},
                    "9000000000000000000 2 0 0\n1 0 0\n");
  expect_file_error({"after 4 of 4000000000000 segments"},
                    replaced(square, "4 0\n1 1", "4000000000000 0\n1 1").substr(0, 72));
}
END_TEST

START_TEST(a_bad_file_leaves_the_domain_as_it_was) {
  PlaneDomain domain;
  parse_poly(domain, square, "x.poly");
  expect_error(pnpbs::ErrorKind::file, {"y.poly:1"}, [&] { parse_poly(domain, "4 4", "y.poly"); });
  domain.check();
  ck_assert_double_eq(domain.area(), 4);
}
END_TEST

START_TEST(mutated_files_do_no_harm) {
  std::ifstream file(PNPBS_SOURCE_DIR "/examples/data/lake_victoria.poly");
  const std::string lake{std::istreambuf_iterator<char>(file), {}};
  std::mt19937 random(11);
  const auto any = [&random](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  const std::string alphabet = "0123456789.-+e #\n\tnaif\x80";
  int accepted = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text = trial % 2 == 0 ? lake : std::string(square);
    for (std::size_t k = any(4) + 1; k > 0 && !text.empty(); --k) {
      const std::size_t at = any(text.size());
      const std::size_t kind = any(5);
      if (kind == 0) text.erase(at, any(40) + 1);
      if (kind == 1) text.insert(at, text.substr(any(text.size()), any(60)));
      if (kind == 2) text.resize(at);
      if (kind >= 3) text[at] = alphabet[any(alphabet.size())];
    }
    try {
      read(text);
      ++accepted;
    } catch (const pnpbs::Error& error) {
      const bool expected =
          error.kind() == pnpbs::ErrorKind::file || error.kind() == pnpbs::ErrorKind::domain;
      ck_assert_msg(expected, "kind %d: %s", static_cast<int>(error.kind()), error.what());
    }
  }
  ck_assert_int_gt(accepted, 50);
}
END_TEST

TEST_SUITE(test_poly_reader) {
  return run_suite(
      "poly_reader",
      {numbered_from_one, numbered_from_zero_with_all_sections, missing_counts_are_zero, any_locale,
       vertices_in_a_node_file, unreadable_files, truncated_files, wrong_fields,
       huge_counts_cost_nothing, a_bad_file_leaves_the_domain_as_it_was, mutated_files_do_no_harm});
}
