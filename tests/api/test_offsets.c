/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests bodies at a distance from others: areas and volumes by Steiner's formula, depths in units
 * of d by a callback, nodes in these bodies, volumes of particles, and invalid input.
 */
#include "volume_support.h"

/* ---------------------------------------------------------------- in the plane ---------- */

static double measure_of(pnpbs_domain domain) {
  double measure;
  MUST(pnpbs_domain_measure(domain, &measure));
  return measure;
}

static void add_square(pnpbs_domain domain) {
  add_rectangle(domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
}

static void add_l(pnpbs_domain domain) {
  const double outline[12] = {0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2};
  MUST(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 6, outline, NULL, 0));
}

static void add_square_with_hole(pnpbs_domain domain) {
  add_square(domain);
  add_rectangle(domain, PNPBS_BOUNDARY, 0.3, 0.3, 0.7, 0.7, 2);
}

/* A body in the plane: its area, the length of its boundary, and the numbers of convex and
 * reentrant right corners. */
typedef struct {
  void (*add)(pnpbs_domain domain);
  double area, around;
  int convex, reentrant;
} plane_body;
static const plane_body plane_bodies[] = {
    {add_square, 1, 4, 4, 0}, {add_l, 3, 8, 5, 1}, {add_square_with_hole, 0.84, 5.6, 4, 4}};

/* Returns the area of the offset body. Along straight sides the area changes by strips, which
 * overlap at one kind of corner and are joined by arcs at the other. */
static double area_within(const plane_body* it, double h) {
  const int sharp = h < 0 ? it->convex : it->reentrant, round = h < 0 ? it->reentrant : it->convex;
  const double strips = it->around * fabs(h) - sharp * h * h + round * PI / 4 * h * h;
  return h < 0 ? it->area - strips : it->area + strips;
}

START_TEST(areas_by_steiner) {
  const plane_body* from = &plane_bodies[_i];
  const double limits[5] = {-INFINITY, -0.13, -0.04, 0.05, 0.1};
  pnpbs_context context;
  pnpbs_domain body;
  int a, b;
  MUST(pnpbs_context_create_serial(&context));
  MUST(pnpbs_domain_create(context, 2, &body));
  from->add(body);
  for (a = 0; a < 5; ++a)
    for (b = a + 1; b < 5; ++b) {
      const double inner = a == 0 ? 0 : area_within(from, limits[a]);
      const double area = area_within(from, limits[b]) - inner;
      pnpbs_domain offset;
      MUST(pnpbs_domain_create(context, 2, &offset));
      MUST(pnpbs_domain_add_offset(offset, body, limits[a], limits[b], NULL, NULL, 0.02, 7));
      /* Arcs become chords no longer than sqrt(2) times the resolution. Without arcs the area is
       * exact. */
      ck_assert_double_eq_tol(measure_of(offset), area, 5e-4);
      if (from->reentrant == 0 && limits[b] < 0)
        ck_assert_double_eq_tol(measure_of(offset), area, 1e-9);
      MUST(pnpbs_domain_destroy(&offset));
    }
  MUST(pnpbs_domain_destroy(&body));
  MUST(pnpbs_context_destroy(&context));
}
END_TEST

/* Two empty domains in the plane. */
typedef struct {
  pnpbs_context context;
  pnpbs_domain body, inset;
} pair;

static pair pair_begin(void) {
  pair it;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 2, &it.body));
  MUST(pnpbs_domain_create(it.context, 2, &it.inset));
  return it;
}

static void pair_end(pair* it) {
  MUST(pnpbs_domain_destroy(&it->body));
  MUST(pnpbs_domain_destroy(&it->inset));
  MUST(pnpbs_context_destroy(&it->context));
}

/* The four corners of the inset are corners of its boundary, and all segments have the tag. */
START_TEST(corners_are_kept) {
  double segments[400][4];
  int32_t tags[400];
  int64_t count, k, corners = 0;
  pair in = pair_begin();
  add_square(in.body);
  MUST(pnpbs_domain_add_offset(in.inset, in.body, -INFINITY, -0.2, NULL, NULL, 0, 7));
  MUST(pnpbs_domain_get_segments(in.inset, 400, &count, segments[0], tags));
  for (k = 0; k < count; ++k) {
    const double x = segments[k][0], y = segments[k][1];
    ck_assert_double_eq_tol(fmin(fmin(x, 1 - x), fmin(y, 1 - y)), 0.2, 1e-10);
    ck_assert_int_eq(tags[k], 7);
    corners += fabs(fabs(x - 0.5) - 0.3) < 1e-9 && fabs(fabs(y - 0.5) - 0.3) < 1e-9;
  }
  ck_assert_int_eq(corners, 4);
  pair_end(&in);
}
END_TEST

static int has_vertex(pnpbs_domain domain, double x, double y) {
  double segments[2000][4];
  int64_t count, k;
  MUST(pnpbs_domain_get_segments(domain, 2000, &count, segments[0], NULL));
  for (k = 0; k < count; ++k)
    if (hypot(segments[k][0] - x, segments[k][1] - y) < 1e-6) return 1;
  return 0;
}

/* Corners at the ends of an arc are kept as well: those of half a disc. */
START_TEST(corners_of_curves_are_kept) {
  const double centre[2] = {0, 0}, chord[4] = {-1, 0, 1, 0}, h = 0.15;
  const double corner = sqrt((1 - h) * (1 - h) - h * h);
  pair in = pair_begin();
  MUST(pnpbs_domain_add_arc(in.body, PNPBS_BOUNDARY, centre, 1, 0, PI, 1));
  MUST(pnpbs_domain_add_polyline(in.body, PNPBS_BOUNDARY, 0, 2, chord, NULL, 0));
  MUST(pnpbs_domain_add_offset(in.inset, in.body, -INFINITY, -h, NULL, NULL, 0.1, 7));
  ck_assert(has_vertex(in.inset, corner, h) && has_vertex(in.inset, -corner, h));
  pair_end(&in);
}
END_TEST

static int32_t constant(int64_t n, int32_t dim, const double* x, double* d, void* user);

/* The inset of a small square beside a large one is left out if it is smaller than twice the
 * resolution or than half of d. */
START_TEST(tiny_pieces_are_left_out) {
  const struct {
    double side, d, depth, resolution;
    int stays;
  } cases[] = {{0.237, 0, 0.1, 0.02, 0},
               {0.3, 0, 0.1, 0.02, 1},
               {0.3, 0.25, 0.42, 0, 0},
               {0.36, 0.25, 0.42, 0, 1}};
  const double depth = cases[_i].d > 0 ? cases[_i].depth * cases[_i].d : cases[_i].depth;
  const double large = 1 - 2 * depth, small = cases[_i].side - 2 * depth;
  double d = cases[_i].d;
  pair in = pair_begin();
  add_square(in.body);
  add_rectangle(in.body, PNPBS_BOUNDARY, 2, 0, 2 + cases[_i].side, cases[_i].side, 1);
  MUST(pnpbs_domain_add_offset(in.inset, in.body, -INFINITY, -cases[_i].depth,
                               d > 0 ? constant : NULL, &d, cases[_i].resolution, 1));
  ck_assert_double_eq_tol(measure_of(in.inset),
                          large * large + (cases[_i].stays ? small * small : 0), 1e-9);
  pair_end(&in);
}
END_TEST

/* Many bays become separate ponds, some no wider than the resolution. */
START_TEST(insets_of_a_lake) {
  pnpbs_domain lake;
  pnpbs_context context;
  double depth, before;
  MUST(pnpbs_context_create_serial(&context));
  MUST(pnpbs_domain_create(context, 2, &lake));
  MUST(pnpbs_domain_read_poly(lake, DATA "/lake_victoria.poly"));
  before = measure_of(lake);
  for (depth = 0.5; depth < 4; depth *= 1.3) {
    pnpbs_domain inset;
    MUST(pnpbs_domain_create(context, 2, &inset));
    MUST(pnpbs_domain_add_offset(inset, lake, -INFINITY, -depth, NULL, NULL, 1, 1));
    ck_assert_double_lt(measure_of(inset), before);
    before = measure_of(inset);
    MUST(pnpbs_domain_destroy(&inset));
  }
  MUST(pnpbs_domain_destroy(&lake));
  MUST(pnpbs_context_destroy(&context));
}
END_TEST

/* If d grows, the boundary lies where the distance is the given multiple of d. */
START_TEST(depth_follows_the_spacing) {
  cone grows = {0.02, 0.1, 0, 0};
  double segments[2000][4];
  int64_t count, k;
  pair in = pair_begin();
  add_square(in.body);
  MUST(pnpbs_domain_add_offset(in.inset, in.body, -INFINITY, -0.5, cone_spacing, &grows, 0, 1));
  MUST(pnpbs_domain_get_segments(in.inset, 2000, &count, segments[0], NULL));
  ck_assert_int_gt(count, 100);
  for (k = 0; k < count; ++k) {
    const double x = segments[k][0], y = segments[k][1];
    ck_assert_double_eq_tol(fmin(fmin(x, 1 - x), fmin(y, 1 - y)), 0.5 * (0.02 + 0.1 * hypot(x, y)),
                            1e-8);
  }
  pair_end(&in);
}
END_TEST

/* ---------------------------------------------------------------- in space -------------- */

START_TEST(volumes_by_steiner) {
  const double limits[4] = {-INFINITY, -0.2, -0.05, 0.1}, corner[3] = {0, 0, 0},
               other[3] = {1, 1, 1};
  double within[4];
  pnpbs_context context;
  pnpbs_domain body;
  int a, b;
  within[0] = 0;
  for (b = 1; b < 3; ++b) within[b] = pow(1 + 2 * limits[b], 3);
  within[3] = 1 + 6 * 0.1 + 12 * PI / 4 * 0.01 + 4 * PI / 3 * 0.001;
  MUST(pnpbs_context_create_serial(&context));
  MUST(pnpbs_domain_create(context, 3, &body));
  MUST(pnpbs_domain_add_box(body, corner, other, 1));
  for (a = 0; a < 4; ++a)
    for (b = a + 1; b < 4; ++b) {
      pnpbs_domain offset;
      MUST(pnpbs_domain_create(context, 3, &offset));
      MUST(pnpbs_domain_add_offset(offset, body, limits[a], limits[b], NULL, NULL, 0.05, 7));
      ck_assert_double_eq_tol(measure_of(offset), within[b] - within[a], b == 3 ? 3e-3 : 1e-7);
      MUST(pnpbs_domain_destroy(&offset));
    }
  MUST(pnpbs_domain_destroy(&body));
  MUST(pnpbs_context_destroy(&context));
}
END_TEST

/* ---------------------------------------------------------------- particles ------------- */

static int32_t larger_bubbles(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  cone_spacing(n, dim, x, d, user);
  for (i = 0; i < n; ++i) d[i] *= dim == 2 ? 1.076 : 1.147;
  return 0;
}

/* The number of particles is that which the measure of the body requires. None lies on its wall,
 * and their volumes sum up to the measure, each near d^dim. The test runs in the plane and in
 * space. */
START_TEST(particles_stand_for_the_body) {
  const int dim = _i + 2;
  const double corner[3] = {0, 0, 0}, other[3] = {1, 1, 1};
  cone grows = {dim == 2 ? 0.02 : 0.08, 0.03, 0, 0};
  double sum = 0, wanted = 0, *x, *volumes;
  int64_t i, n;
  pnpbs_domain body;
  pnpbs_particles particles;
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, dim, &it.domain));
  MUST(pnpbs_domain_create(it.context, dim, &body));
  if (dim == 2)
    add_square(body);
  else
    MUST(pnpbs_domain_add_box(body, corner, other, 1));
  MUST(pnpbs_domain_add_offset(it.domain, body, -INFINITY, dim == 2 ? -0.42 : -0.46, cone_spacing,
                               &grows, 0, 1));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, larger_bubbles, &grows));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_particles_create(it.placement, body, &particles));
  MUST(pnpbs_domain_destroy(&body)); /* particles do not refer to the body */
  MUST(pnpbs_particles_sizes(particles, NULL, &n, NULL));
  x = malloc((size_t)n * 3 * sizeof *x);
  volumes = malloc((size_t)n * sizeof *volumes);
  ck_assert(x && volumes);
  MUST(pnpbs_particles_get(particles, n, x, volumes, NULL, NULL, NULL));
  for (i = 0; i < n; ++i) {
    double d, share, nearest = 1;
    int k;
    cone_spacing(1, dim, x + dim * i, &d, &grows);
    share = volumes[i] / pow(d, dim);
    for (k = 0; k < dim; ++k) nearest = fmin(nearest, fmin(x[dim * i + k], 1 - x[dim * i + k]));
    /* Some were pushed along the wall to where d differs. */
    ck_assert_double_ge(nearest, (dim == 2 ? 0.42 : 0.46) * d * (1 - 0.01));
    ck_assert(share > 0.5 && share < 1.6);
    sum += volumes[i];
    wanted += pow(d, dim);
  }
  ck_assert_double_eq_tol(sum, 1, 1e-12);
  ck_assert_double_eq_tol(wanted, 1, 0.05);
  free(x);
  free(volumes);
  MUST(pnpbs_particles_destroy(&particles));
  job_end(&it);
}
END_TEST

typedef struct {
  int calls;
  double last;
  int32_t stop; /* whether to stop at the end */
} watcher;

static int32_t watch(double fraction, int64_t step, int64_t nodes, double speed, void* user) {
  watcher* w = user;
  (void)step, (void)nodes, (void)speed;
  ck_assert(fraction >= 0 && fraction <= 1);
  ++w->calls;
  w->last = fraction;
  return w->stop && fraction == 1;
}

static int lines_of(const char* path) {
  FILE* file = fopen(path, "r");
  int c, lines = 0;
  ck_assert_msg(file != NULL, "no %s", path);
  while ((c = fgetc(file)) != EOF) lines += c == '\n';
  fclose(file);
  return lines;
}

/* Files of particles: the placement's monitor is called and can stop them, particles can be written
 * after their placement is destroyed, and their fields need distinct names. */
START_TEST(particle_files) {
  const char *csv[] = {"test_offsets.csv"}, *ele[] = {"test_offsets.ele"};
  double *masses, d = 0.1;
  int64_t n;
  watcher w = {0, 0, 1};
  pnpbs_domain body;
  pnpbs_particles particles;
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 2, &it.domain));
  MUST(pnpbs_domain_create(it.context, 2, &body));
  add_square(body);
  MUST(pnpbs_domain_add_offset(it.domain, body, -INFINITY, -0.42 * d, NULL, NULL, 0.01, 1));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1.076 * d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_particles_create(it.placement, body, &particles));
  MUST(pnpbs_domain_destroy(&body));
  MUST(pnpbs_particles_sizes(particles, NULL, &n, NULL));
  masses = calloc((size_t)n, sizeof *masses);
  ck_assert_ptr_nonnull(masses);
  MUST(pnpbs_particles_add_output_field(particles, "mass", n, 1, masses));
#define REFUSED(first, second, ...)                                                                \
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_particles_add_output_field(particles, __VA_ARGS__), first, \
            second)
  REFUSED("mass", "choose another", "mass", n, 1, masses);
  REFUSED("volume", "choose another", "volume", n, 1, masses);
  REFUSED("particles", "give values for each of them", "heat", n - 1, 1, masses);
  REFUSED("components = 0", "1 to", "heat", n, 0, masses);
  REFUSED("values", "NULL", "heat", n, 1, NULL);
#undef REFUSED
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_particles_write(particles, 1, ele, NULL), ".ele",
            "cannot contain particles");
  MUST(pnpbs_placement_set_monitor(it.placement, watch, &w));
  remove(csv[0]);
  ck_assert_int_eq(pnpbs_particles_write(particles, 1, csv, NULL), PNPBS_STOPPED);
  ck_assert_ptr_null(fopen(csv[0], "r"));
  ck_assert(w.calls > 0 && w.last == 1);
  ck_assert_int_eq(pnpbs_particles_write(particles, 0, NULL, NULL), PNPBS_STOPPED);
  w.stop = 0;
  MUST(pnpbs_particles_write(particles, 1, csv, NULL));
  ck_assert_int_eq(lines_of(csv[0]), n + 1);
  remove(csv[0]);
  MUST(pnpbs_placement_destroy(&it.placement));
  w.calls = 0;
  MUST(pnpbs_particles_write(particles, 1, csv, NULL));
  ck_assert_int_eq(lines_of(csv[0]), n + 1);
  ck_assert_int_eq(w.calls, 0);
  remove(csv[0]);
  free(masses);
  MUST(pnpbs_particles_destroy(&particles));
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- bad ones -------------- */

static int32_t constant(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)dim, (void)x;
  for (i = 0; i < n; ++i) d[i] = *(double*)user;
  return *(double*)user == 77 ? 77 : 0;
}

START_TEST(bad_input) {
  const double corner[3] = {0, 0, 0}, other[3] = {1, 1, 1};
  double d = 0.1, negative = -0.1, failing = 77;
  pnpbs_context context, stranger;
  pnpbs_domain to, body, box, sheet, foreign;
  MUST(pnpbs_context_create_serial(&context));
  MUST(pnpbs_context_create_serial(&stranger));
  MUST(pnpbs_domain_create(context, 2, &to));
  MUST(pnpbs_domain_create(context, 2, &body));
  MUST(pnpbs_domain_create(context, 3, &box));
  MUST(pnpbs_domain_create(context, 3, &sheet));
  MUST(pnpbs_domain_create(stranger, 2, &foreign));
  add_square(body);
  add_square(to);
  MUST(pnpbs_domain_add_box(box, corner, other, 1));
  MUST(pnpbs_domain_add_box(sheet, corner, other, 1));
  MUST(pnpbs_domain_set_filled(sheet, 0));
#define REFUSED(status, first, second, ...) \
  MUST_FAIL(PNPBS_ERROR_##status, pnpbs_domain_add_offset(__VA_ARGS__), first, second)
  REFUSED(ARGUMENT, "low is -1", "high, which is -1", to, body, -1, -1, constant, &d, 0, 1);
  REFUSED(ARGUMENT, "low is nan", "", to, body, NAN, -1, constant, &d, 0, 1);
  REFUSED(ARGUMENT, "high is inf", "finite", to, body, 0, INFINITY, constant, &d, 0, 1);
  REFUSED(ARGUMENT, "resolution is -1", "0 for", to, body, -1, 1, constant, &d, -1, 1);
  REFUSED(ARGUMENT, "resolution is 0", "positive", to, body, -INFINITY, 0, NULL, NULL, 0, 1);
  REFUSED(ARGUMENT, "tag", "0", to, body, -1, 1, constant, &d, 0, 0);
  REFUSED(ARGUMENT, "body", "NULL", to, NULL, -1, 1, constant, &d, 0, 1);
  REFUSED(ARGUMENT, "body has three dimensions", "two", to, box, -1, 1, constant, &d, 0, 1);
  REFUSED(ARGUMENT, "body has no inside", "", box, sheet, -1, 1, constant, &d, 0, 1);
  REFUSED(ARGUMENT, "body belongs", "context", to, foreign, -1, 1, constant, &d, 0, 1);
  REFUSED(SPACING, "-0.1", "", to, body, -1, 1, constant, &negative, 0, 1);
  REFUSED(CALLBACK, "77", "", to, body, -1, 1, constant, &failing, 0, 1);
  REFUSED(DOMAIN, "from -infinity to -6 d", "negative at none", to, body, -INFINITY, -6, constant,
          &d, 0, 1);
  REFUSED(DOMAIN, "from -infinity to -6 d", "negative at none", box, box, -INFINITY, -6, constant,
          &d, 0, 1);
#undef REFUSED
  /* No domain has changed. */
  ck_assert_double_eq(measure_of(to), 1);
  ck_assert_double_eq(measure_of(box), 1);
  MUST(pnpbs_domain_destroy(&to));
  MUST(pnpbs_domain_destroy(&body));
  MUST(pnpbs_domain_destroy(&box));
  MUST(pnpbs_domain_destroy(&sheet));
  MUST(pnpbs_domain_destroy(&foreign));
  MUST(pnpbs_context_destroy(&stranger));
  MUST(pnpbs_context_destroy(&context));
}
END_TEST

/* The body must contain the nodes, and the nodes must fill it. */
START_TEST(bad_bodies) {
  job it = square_job(1);
  pnpbs_domain body;
  pnpbs_particles particles;
  MUST(pnpbs_domain_create(it.context, 2, &body));
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_particles_create(it.placement, it.domain, &particles), "nodes",
            "");
  MUST(pnpbs_placement_set(it.placement, "steps", "5"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_particles_create(it.placement, NULL, &particles), "body",
            "NULL");
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_particles_create(it.placement, body, &particles), "", "");
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_particles_create(it.placement, it.domain, &particles),
            "on its wall or outside", "pnpbs_domain_add_offset");
  add_rectangle(body, PNPBS_BOUNDARY, -3, -3, 4, 4, 1);
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_particles_create(it.placement, body, &particles),
            "do not fill this body", "");
  ck_assert_ptr_null(particles);
  MUST(pnpbs_domain_destroy(&body));
  job_end(&it);
}
END_TEST

TEST_SUITE(test_offsets) {
  Suite* suite = suite_create("offsets");
  TCase* good = tcase_create("good");
  TCase* bad = tcase_create("bad");
  tcase_add_loop_test(good, areas_by_steiner, 0, COUNT_OF(plane_bodies));
  tcase_add_test(good, corners_are_kept);
  tcase_add_test(good, corners_of_curves_are_kept);
  tcase_add_loop_test(good, tiny_pieces_are_left_out, 0, 4);
  tcase_add_test(good, insets_of_a_lake);
  tcase_add_test(good, depth_follows_the_spacing);
  tcase_add_test(good, volumes_by_steiner);
  tcase_add_loop_test(good, particles_stand_for_the_body, 0, 2);
  tcase_add_test(good, particle_files);
  tcase_add_test(bad, bad_input);
  tcase_add_test(bad, bad_bodies);
  tcase_set_timeout(good, 0);
  tcase_set_timeout(bad, 0);
  suite_add_tcase(suite, good);
  suite_add_tcase(suite, bad);
  return run_suite(suite);
}
