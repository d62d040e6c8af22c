// SPDX-License-Identifier: BSD-3-Clause
// A body-centred cubic lattice with random displacements returns to the lattice, with the same bits
// for any number of threads and any order in memory. The number of threads is fixed per process, so
// the program starts itself: `test_volume_box <threads> <seed> <file>` performs a run from an order
// that the seed shuffles, and writes the final positions.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "run_kernel_suite.hpp"
#include "volume_box.hpp"

namespace {

std::string program;

constexpr volume_box::Crystal kCrystal{WHEN_SANITIZED(12, 24)};  // with 24 cells: 29 449 nodes
constexpr double kShaken = 0.3;                                  // largest displacement, in d
constexpr int kSteps = 200;

// All positions, by id.
using Places = std::vector<Point<3>>;

Places relax(int seed) {
  std::vector<Bubble<3>> bubbles = volume_box::sites(kCrystal);
  volume_box::shake(bubbles, kShaken);
  if (seed != 0) Random(static_cast<std::uint64_t>(seed)).shuffle(bubbles);
  volume_box::Relaxation relaxation(kCrystal);
  relaxation.set(bubbles);
  relaxation.steps(kSteps);
  Places places(bubbles.size());
  for (const Bubble<3>& b : relaxation.bubbles().bubbles())
    places[static_cast<std::size_t>(b.id)] = b.x;
  return places;
}

// Runs in a process of its own, without Check; failures end it.
int do_run(const char* threads, const char* seed, const char* name) {
  pnpbs::start_kokkos(std::atoi(threads), 1, [] {});
  const Places places = relax(std::atoi(seed));
  pnpbs::end_kokkos();
  std::ofstream file(name, std::ios::binary);
  file.write(reinterpret_cast<const char*>(places.data()),
             static_cast<std::streamsize>(places.size() * sizeof(Point<3>)));
  return file.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
}

Places run(int threads, int seed) {
  const std::string number = std::to_string(threads), shuffled = std::to_string(seed);
  const std::string name = PNPBS_TEST_WORK_DIR "/volume_box_" + number + "_" + shuffled;
  const pid_t child = fork();
  if (child == 0) {
    // Spinning threads block others on a busy machine.
    setenv("OMP_WAIT_POLICY", "passive", 0);
    execl(program.c_str(), program.c_str(), number.c_str(), shuffled.c_str(), name.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 1;
  ck_assert(waitpid(child, &status, 0) == child);
  ck_assert_int_eq(status, 0);
  Places places(volume_box::sites(kCrystal).size());
  std::ifstream file(name, std::ios::binary);
  file.read(reinterpret_cast<char*>(places.data()),
            static_cast<std::streamsize>(places.size() * sizeof(Point<3>)));
  ck_assert(file.good() && file.peek() == EOF);
  std::remove(name.c_str());
  return places;
}

std::vector<Bubble<3>> bubbles_at(const Places& places) {
  std::vector<Bubble<3>> bubbles = volume_box::sites(kCrystal);
  for (std::size_t i = 0; i < bubbles.size(); ++i) {
    quick_assert(bubbles[i].moves || bubbles[i].x == places[i]);
    bubbles[i].x = places[i];
  }
  return bubbles;
}

}  // namespace

START_TEST(shaken_lattice_comes_to_rest) {
  std::vector<Bubble<3>> shaken = volume_box::sites(kCrystal);
  volume_box::shake(shaken, kShaken);
  const volume_box::Deviation before = volume_box::deviation_from_sites(shaken, kCrystal);
  ck_assert_double_eq_tol(before.mean, 0.75 * kShaken, 0.01 * kShaken);  // mean over a ball

  const Places places = run(1, 0);
  const volume_box::Deviation after =
      volume_box::deviation_from_sites(bubbles_at(places), kCrystal);
  std::printf("from the lattice, in d: mean %.3g, largest %.3g; before %.3g, %.3g\n", after.mean,
              after.max, before.mean, before.max);
  ck_assert_double_lt(after.mean, 1e-5);
  ck_assert_double_lt(after.max, 1e-4);

  ck_assert(run(2, 0) == places);
  ck_assert(run(1, 71) == places);
}
END_TEST

int main(int argc, char** argv) {
  if (argc == 4) return do_run(argv[1], argv[2], argv[3]);
  program = argv[0];
  return run_suite("volume_box", {shaken_lattice_comes_to_rest});
}
