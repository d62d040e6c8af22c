// SPDX-License-Identifier: BSD-3-Clause
// Tests hundreds of damaged checkpoints. Reading any file must give the placement that was written,
// or an error with a message. It must never crash, hang or give another placement.
//
// The file under test remains as mutate_checkpoint.vtkhdf in the working folder after a crash. More
// damaged files can be tested by hand:
// PNPBS_MUTATIONS=40000 PNPBS_SEED=7 test_mutate_checkpoint
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "check_runner.h"
#include "damage.hpp"
#include "pnpbs/pnpbs.h"

namespace {

const char* const file_name = "mutate_checkpoint.vtkhdf";

std::string whole_file() {
  std::ifstream file(file_name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void set_file(const std::string& bytes) {
  std::ofstream(file_name, std::ios::binary | std::ios::trunc) << bytes;
}

// A placement in the unit square. On request it has a spacing by values at nodes, which its
// checkpoint then contains.
struct Job {
  pnpbs_context context = nullptr;
  pnpbs_domain domain = nullptr;
  pnpbs_placement placement = nullptr;

  Job() {
    const std::array<double, 8> square{0, 0, 1, 0, 1, 1, 0, 1};
    ck_assert_int_eq(pnpbs_context_create_serial(&context), PNPBS_OK);
    ck_assert_int_eq(pnpbs_domain_create(context, 2, &domain), PNPBS_OK);
    ck_assert_int_eq(
        pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square.data(), nullptr, 0),
        PNPBS_OK);
    ck_assert_int_eq(pnpbs_placement_create(context, domain, &placement), PNPBS_OK);
    ck_assert_int_eq(pnpbs_placement_set(placement, "steps", "40"), PNPBS_OK);
    ck_assert_int_eq(pnpbs_placement_set_spacing_constant(placement, 0.3), PNPBS_OK);
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  ~Job() { pnpbs_context_destroy(&context); }

  void write(bool values_at_nodes) {
    ck_assert_int_ge(pnpbs_placement_run(placement), 0);
    if (values_at_nodes) {
      std::int64_t n = 0;
      ck_assert_int_eq(pnpbs_placement_count(placement, &n), PNPBS_OK);
      const std::vector<double> d(static_cast<std::size_t>(n), 0.25);
      ck_assert_int_eq(pnpbs_placement_set_spacing_at_nodes(placement, n, d.data()), PNPBS_OK);
    }
    ck_assert_int_ge(pnpbs_placement_step(placement, 7), 0);
    ck_assert_int_eq(pnpbs_placement_write_checkpoint(placement, file_name), PNPBS_OK);
  }

  std::string hash() {
    const char* text = nullptr;
    ck_assert_int_eq(pnpbs_placement_get_string(placement, "hash", &text), PNPBS_OK);
    return text;
  }
};

struct Tally {
  int refused = 0, read = 0;
};

// Reads a damaged file. All files are read by the same `reader`, which must remain usable when a
// file is rejected.
void try_to_read(Job& reader, const std::string& bytes, const std::string& hash, Tally& tally) {
  set_file(bytes);
  const pnpbs_status status = pnpbs_placement_read_checkpoint(reader.placement, file_name);
  if (status == PNPBS_OK) {
    ck_assert(reader.hash() == hash);
    ++tally.read;
    return;
  }
  ck_assert_msg(status == PNPBS_ERROR_FILE || status == PNPBS_ERROR_ARGUMENT ||
                    status == PNPBS_ERROR_DOMAIN || status == PNPBS_ERROR_SPACING,
                "status %d: %s", static_cast<int>(status), pnpbs_last_error(reader.context));
  ck_assert_msg(std::strstr(pnpbs_last_error(reader.context), file_name) != nullptr, "%s",
                pnpbs_last_error(reader.context));
  ++tally.refused;
}

void damage_by_chance(bool values_at_nodes) {
  Job writer, reader;
  writer.write(values_at_nodes);
  const std::string bytes = whole_file(), hash = writer.hash();
  Tally tally;
  try_to_read(reader, bytes, hash, tally);
  ck_assert_int_eq(tally.read, 1);
  const std::uint64_t mutations = from_environment("PNPBS_MUTATIONS", 300);
  Damage damage(from_environment("PNPBS_SEED", 1));
  for (std::uint64_t k = 0; k < mutations; ++k)
    try_to_read(reader, damage.to_bytes(bytes), hash, tally);
  ck_assert_int_gt(tally.refused, static_cast<int>(mutations / 3));
  // The file may be cut off at any position.
  Tally cut;
  for (std::size_t part = 0; part < 60; ++part)
    try_to_read(reader, bytes.substr(0, bytes.size() * part / 60), hash, cut);
  ck_assert_int_eq(cut.read, 0);
  // The intact file must be read, and the run must continue from it.
  try_to_read(reader, bytes, hash, tally);
  ck_assert_int_ge(pnpbs_placement_run(writer.placement), 0);
  ck_assert_int_ge(pnpbs_placement_run(reader.placement), 0);
  ck_assert(reader.hash() == writer.hash());
  std::remove(file_name);
}

START_TEST(damaged) { damage_by_chance(false); }
END_TEST

START_TEST(damaged_with_values_at_nodes) { damage_by_chance(true); }
END_TEST

// Every bit of the nodes matters: one flipped bit anywhere in an array must be detected.
START_TEST(flipped_bits_of_nodes) {
  Job writer, reader;
  writer.write(false);
  const std::string bytes = whole_file(), hash = writer.hash();
  std::int64_t n = 0;
  ck_assert_int_eq(pnpbs_placement_count(writer.placement, &n), PNPBS_OK);
  const auto count = static_cast<std::size_t>(n);
  std::vector<double> xy(2 * count), d(count);
  std::vector<std::int64_t> ids(count);
  ck_assert_int_eq(
      pnpbs_placement_get_nodes(writer.placement, n, xy.data(), ids.data(), nullptr, d.data()),
      PNPBS_OK);
  Tally tally;
  int tried = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (xy[2 * k] == 0 || xy[2 * k + 1] == 0) continue;
    std::array<double, 3> row{xy[2 * k], xy[2 * k + 1], 0};
    const std::size_t at =
        bytes.find(std::string(reinterpret_cast<const char*>(row.data()), sizeof row));
    ck_assert_msg(at != std::string::npos, "the file has no node %d", static_cast<int>(k));
    for (const std::size_t bit : {0, 13, 63, 64, 127}) {
      std::string flipped = bytes;
      flipped[at + bit / 8] ^= static_cast<char>(1U << bit % 8);
      try_to_read(reader, flipped, hash, tally);
      ++tried;
    }
    row[0] = NAN;
    std::string nan = bytes;
    nan.replace(at, sizeof row, reinterpret_cast<const char*>(row.data()), sizeof row);
    try_to_read(reader, nan, hash, tally);
    ++tried;
  }
  ck_assert_int_gt(tried, 20);
  ck_assert_int_eq(tally.refused, tried);
  std::remove(file_name);
}
END_TEST

START_TEST(foreign_files) {
  Job reader;
  Tally tally;
  const std::string signature = "\x89HDF\r\n\x1a\n";
  for (const std::string& bytes :
       {std::string(), std::string("x"), std::string("8 2 0 0\n1 0 0\n"), signature,
        signature + std::string(5000, '\0'), signature + std::string(5000, '\xff')})
    try_to_read(reader, bytes, "", tally);
  ck_assert_int_eq(tally.read, 0);
  ck_assert_int_eq(pnpbs_placement_read_checkpoint(reader.placement, "/"), PNPBS_ERROR_FILE);
  ck_assert_int_eq(pnpbs_placement_read_checkpoint(reader.placement, "/dev/null"),
                   PNPBS_ERROR_FILE);
  ck_assert_int_ge(pnpbs_placement_run(reader.placement), 0);
  std::remove(file_name);
}
END_TEST

}  // namespace

TEST_SUITE(mutate_checkpoint) {
  Suite* suite = suite_create("mutate_checkpoint");
  TCase* tests = tcase_create("mutate_checkpoint");
  tcase_add_test(tests, damaged);
  tcase_add_test(tests, damaged_with_values_at_nodes);
  tcase_add_test(tests, flipped_bits_of_nodes);
  tcase_add_test(tests, foreign_files);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
