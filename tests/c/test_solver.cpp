// Arrays of whole reports and what solvers need, in C: the numbers of C++, and wrong use by name.
#include <gtest/gtest.h>
#include <tact/contact_sums.h>
#include <tact/report_arrays.h>
#include <tact/solver.h>
#include <tact/tact_c.h>

#include <algorithm>
#include <vector>

#include "tests/c/mesh_for_c.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

// A ball under a cloth, in a world of C and one of C++.
struct BallUnderCloth {
  BallUnderCloth() {
    tact_settings settings = TACT_SETTINGS_INIT;
    settings.threads = 1;
    settings.points = settings.patches = true;
    EXPECT_EQ(tact_world_create(&settings, &world), TACT_OK);
    add(translated(sheet(12, 12, 2.0, 2.0), {0.03, 0.02, 1.03}), TACT_SURFACE_SHEET);
    add(icosphere(2), TACT_SURFACE_CLOSED);
    EXPECT_EQ(tact_world_detect(world), TACT_OK) << tact_last_error_message();
    report = &cpp.detect();
  }
  ~BallUnderCloth() { tact_world_destroy(world); }
  void add(const Mesh& mesh, tact_surface surface) {
    tact_body_definition definition = definition_of(mesh);
    definition.surface = surface;
    definition.margin = 0.04;
    tact_body body{};
    EXPECT_EQ(tact_world_add_body(world, &definition, &body), TACT_OK);
    cpp.add_body(
        {.positions = mesh.positions, .facets = mesh.facets, .surface = static_cast<Surface>(surface), .margin = 0.04});
    first_rows.push_back(static_cast<int>(x.cols()));
    x.conservativeResize(3, x.cols() + mesh.positions.cols());
    x.rightCols(mesh.positions.cols()) = mesh.positions;
  }
  std::vector<tact_stencil> stencils() const {
    size_t count = 0;
    EXPECT_EQ(tact_report_stencils(world, first_rows.data(), 2, nullptr, 0, &count), TACT_OK);
    std::vector<tact_stencil> all(count);
    EXPECT_EQ(tact_report_stencils(world, first_rows.data(), 2, all.data(), count, &count), TACT_OK);
    return all;
  }
  tact_world world{};
  World cpp{{.threads = 1, .outputs = {.patches = true, .points = true}}};
  const Report* report = nullptr;
  Eigen::Matrix3Xd x{3, 0};
  std::vector<int> first_rows;
};

TEST(ReportArraysInC, HoldWhatThoseOfCppDo) {
  const BallUnderCloth scene;
  size_t rows = 0;
  ASSERT_EQ(tact_report_point_count(scene.world, &rows), TACT_OK);
  ASSERT_EQ(rows, point_count(*scene.report));
  ASSERT_GT(rows, 10u);
  std::vector<int> vertices(3 * rows), expected_vertices(3 * rows);
  std::vector<double> gaps(rows), normals(3 * rows), expected_gaps(rows), expected_normals(3 * rows);
  std::vector<std::uint64_t> ids(rows), patches(rows), expected_ids(rows), expected_patches(rows);
  tact_point_arrays arrays = TACT_POINT_ARRAYS_INIT;
  arrays.b_vertices = vertices.data();
  arrays.gaps = gaps.data();
  arrays.normals = normals.data();
  arrays.ids = ids.data();
  arrays.patch_ids = patches.data();
  ASSERT_EQ(tact_report_copy_points(scene.world, &arrays, rows), TACT_OK) << tact_last_error_message();
  copy_points(*scene.report, {.b_vertices = expected_vertices,
                              .normals = expected_normals,
                              .gaps = expected_gaps,
                              .ids = expected_ids,
                              .patch_ids = expected_patches});
  EXPECT_EQ(vertices, expected_vertices);
  EXPECT_EQ(gaps, expected_gaps);
  EXPECT_EQ(normals, expected_normals);
  EXPECT_EQ(ids, expected_ids);
  EXPECT_EQ(patches, expected_patches);
  for (const size_t wrong : {size_t{0}, rows - 1, rows + 1})
    EXPECT_EQ(tact_report_copy_points(scene.world, &arrays, wrong), TACT_ERROR_WRONG_SIZE);
  EXPECT_EQ(tact_report_copy_points(scene.world, nullptr, rows), TACT_ERROR_NULL_ARGUMENT);
  arrays.struct_size = 3;
  EXPECT_EQ(tact_report_copy_points(scene.world, &arrays, rows), TACT_ERROR_WRONG_STRUCT_SIZE);
}

TEST(ReportArraysInC, OfFacetPairsAndImpacts) {
  const BallUnderCloth scene;
  Eigen::Matrix3Xd down = scene.x.leftCols(scene.first_rows[1]);
  down.row(2).array() -= 0.5;
  const tact_columns columns = columns_of(down);
  ASSERT_EQ(tact_world_set_positions(scene.world, {0, 1, 0}, &columns), TACT_ERROR_FOREIGN_BODY);
  std::vector<tact_body> bodies(2);
  size_t count = 0;
  ASSERT_EQ(tact_world_bodies(scene.world, bodies.data(), 2, &count), TACT_OK);
  ASSERT_EQ(tact_world_set_positions(scene.world, bodies[0], &columns), TACT_OK);
  ASSERT_EQ(tact_world_detect_motion(scene.world, TACT_IMPACTS_ALL), TACT_OK);
  const tact_impact* impacts = nullptr;
  ASSERT_EQ(tact_motion_impacts(scene.world, &impacts, &count), TACT_OK);
  ASSERT_GT(count, 10u);
  std::vector<double> times(count);
  std::vector<std::uint8_t> kinds(count);
  tact_impact_arrays of_impacts = TACT_IMPACT_ARRAYS_INIT;
  of_impacts.times = times.data();
  of_impacts.kinds = kinds.data();
  ASSERT_EQ(tact_motion_copy_impacts(scene.world, &of_impacts, count), TACT_OK);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_EQ(times[i], impacts[i].time);
    EXPECT_EQ(kinds[i], impacts[i].kind);
  }
  ASSERT_EQ(tact_world_detect(scene.world), TACT_OK);
  ASSERT_EQ(tact_report_facet_pair_count(scene.world, &count), TACT_OK);
  tact_contact contact = TACT_CONTACT_INIT;
  ASSERT_EQ(tact_report_contact(scene.world, 0, &contact), TACT_OK);
  ASSERT_EQ(count, contact.facet_pair_count);
  ASSERT_GT(count, 10u);
  std::vector<int> facets(2 * count);
  tact_facet_pair_arrays of_pairs = TACT_FACET_PAIR_ARRAYS_INIT;
  of_pairs.facets = facets.data();
  ASSERT_EQ(tact_report_copy_facet_pairs(scene.world, &of_pairs, count), TACT_OK);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_EQ(facets[2 * i], contact.facet_pairs[i].a);
    EXPECT_EQ(facets[2 * i + 1], contact.facet_pairs[i].b);
  }
}

TEST(SolverInC, HasTheNumbersOfCpp) {
  const BallUnderCloth scene;
  const std::vector<tact_stencil> stencils = scene.stencils();
  const std::vector<solver::Stencil> expected = solver::stencils(*scene.report, scene.first_rows);
  const size_t n = stencils.size(), vertices = static_cast<size_t>(scene.x.cols());
  ASSERT_EQ(n, expected.size());
  std::vector<double> values(n), gradients(12 * n), hessians(144 * n), friction(n);
  const tact_terms terms{values.data(), gradients.data(), hessians.data()};
  ASSERT_EQ(tact_stencil_barriers(stencils.data(), n, scene.x.data(), scene.x.data(), vertices, 0.08, terms), TACT_OK);
  const std::vector<double> limits(n, 2.0);
  ASSERT_EQ(tact_stencil_friction(stencils.data(), n, scene.x.data(), vertices, limits.data(), 1e-3,
                                  {friction.data(), nullptr, nullptr}),
            TACT_OK);
  std::vector<int32_t> colors(n);
  ASSERT_EQ(tact_stencil_colors(stencils.data(), n, static_cast<size_t>(scene.first_rows[1]), colors.data()), TACT_OK);
  const solver::Coloring coloring = solver::color(expected, scene.first_rows[1]);
  for (int c = 0; c < coloring.count(); ++c)
    for (const int s : coloring.of(c)) EXPECT_EQ(colors[static_cast<size_t>(s)], c);
  for (size_t i = 0; i < n; ++i) {
    const solver::Corners x = solver::gather(expected[i], scene.x);
    const solver::Term term =
        solver::projected(solver::barrier_term(expected[i], x, 0.08, solver::mollifier_threshold(x)));
    EXPECT_EQ(values[i], term.value);
    EXPECT_EQ(solver::Vector12d::Map(&gradients[12 * i]), term.gradient);
    EXPECT_EQ(solver::Matrix12d::Map(&hessians[144 * i]), term.hessian);
    EXPECT_EQ(friction[i],
              solver::friction_term(expected[i], solver::tangents(expected[i].normal), x, 2.0, 1e-3).value);
  }
  ASSERT_EQ(tact_stencil_gaps(stencils.data(), n, scene.x.data(), vertices, {values.data(), nullptr, nullptr}),
            TACT_OK);
  for (size_t i = 0; i < n; ++i) EXPECT_NEAR(values[i], stencils[i].gap, 1e-12);
  ASSERT_EQ(tact_stencil_penalties(stencils.data(), n, scene.x.data(), vertices, 0.08, terms), TACT_OK);
  for (size_t i = 0; i < n; ++i)
    EXPECT_NEAR(values[i], 0.5 * (0.08 - stencils[i].gap) * (0.08 - stencils[i].gap), 1e-12);
}

TEST(SolverInC, HasTheStencilsOfImpacts) {
  BallUnderCloth scene;
  Eigen::Matrix3Xd down = scene.x.leftCols(scene.first_rows[1]);
  down.row(2).array() -= 0.5;
  const tact_columns columns = columns_of(down);
  tact_body cloth{};
  size_t count = 0;
  ASSERT_EQ(tact_world_bodies(scene.world, &cloth, 1, &count), TACT_OK);
  ASSERT_EQ(tact_world_set_positions(scene.world, cloth, &columns), TACT_OK);
  ASSERT_EQ(tact_world_detect_motion(scene.world, TACT_IMPACTS_ALL), TACT_OK);
  const tact_impact* impacts = nullptr;
  ASSERT_EQ(tact_motion_impacts(scene.world, &impacts, &count), TACT_OK);
  Eigen::Matrix3Xd end = scene.x;
  end.leftCols(down.cols()) = down;
  const auto vertices = static_cast<size_t>(end.cols());
  std::vector<tact_stencil> stencils(count);
  size_t stops = 0;
  ASSERT_EQ(tact_motion_stencils(scene.world, scene.first_rows.data(), 2, scene.x.data(), end.data(), vertices,
                                 stencils.data(), count, &stops),
            TACT_OK);
  const Eigen::Matrix3Xd ways = end - scene.x;
  std::vector<double> rates(stops);
  ASSERT_EQ(tact_stencil_gap_rates(stencils.data(), stops, ways.data(), vertices, rates.data()), TACT_OK);
  scene.cpp.set_positions(scene.cpp.bodies()[0], down);
  const auto expected = solver::impact_stencils(scene.cpp.detect_motion().impacts(), scene.first_rows, scene.x, end);
  ASSERT_EQ(stops, expected.size());
  ASSERT_GT(stops, 10u);
  for (size_t i = 0; i < stops; ++i) {
    EXPECT_TRUE(std::ranges::equal(stencils[i].vertices, expected[i].vertices));
    EXPECT_EQ(stencils[i].gap, expected[i].gap);
    EXPECT_EQ(rates[i], solver::gap_rate(expected[i], solver::gather(expected[i], ways)));
  }
  EXPECT_EQ(tact_motion_stencils(scene.world, scene.first_rows.data(), 1, scene.x.data(), end.data(), vertices, nullptr,
                                 0, &stops),
            TACT_ERROR_WRONG_SIZE);
}

TEST(SolverInC, RefusesWhatIsNoStencil) {
  const BallUnderCloth scene;
  std::vector<tact_stencil> stencils = scene.stencils();
  const size_t n = stencils.size(), vertices = static_cast<size_t>(scene.x.cols());
  std::vector<double> values(n, 7.0);
  const auto gaps = [&](size_t count) {
    return tact_stencil_gaps(stencils.data(), n, scene.x.data(), count, {values.data(), nullptr, nullptr});
  };
  EXPECT_EQ(gaps(5), TACT_ERROR_INDEX_OUT_OF_RANGE);
  stencils[n - 1].kind = 4;
  EXPECT_EQ(gaps(vertices), TACT_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(values[0], 7.0) << "nothing is written";
  EXPECT_EQ(tact_stencil_gaps(nullptr, 1, scene.x.data(), 1, {values.data(), nullptr, nullptr}),
            TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_report_stencils(scene.world, scene.first_rows.data(), 1, nullptr, 0, nullptr),
            TACT_ERROR_NULL_ARGUMENT);
  size_t count = 0;
  EXPECT_EQ(tact_report_stencils(scene.world, scene.first_rows.data(), 1, nullptr, 0, &count), TACT_ERROR_WRONG_SIZE);
}

TEST(ContactSumsInC, HaveTheNumbersOfCpp) {
  const BallUnderCloth scene;
  std::vector<tact_point_impulse> impulses;
  std::vector<PointImpulse> same;
  for (const tact_stencil& stencil : scene.stencils()) {
    impulses.push_back({stencil.id, {1.0, stencil.gap, 2.0}});
    same.push_back({stencil.id, {1.0, stencil.gap, 2.0}});
  }
  const ContactSums expected = sum_contacts(scene.cpp, *scene.report, same);
  tact_contact_sums room = TACT_CONTACT_SUMS_INIT;
  ASSERT_EQ(tact_report_sum_contacts(scene.world, impulses.data(), impulses.size(), &room), TACT_OK);
  ASSERT_EQ(room.sum_count, expected.sums.size());
  ASSERT_EQ(room.vertex_count, expected.vertices.size());
  std::vector<tact_contact_sum> sums(room.sum_count);
  std::vector<tact_vertex_of_body> vertices(room.vertex_count);
  room.sums = sums.data();
  room.sum_capacity = sums.size();
  room.vertices = vertices.data();
  room.vertex_capacity = vertices.size();
  ASSERT_EQ(tact_report_sum_contacts(scene.world, impulses.data(), impulses.size(), &room), TACT_OK);
  for (size_t i = 0; i < sums.size(); ++i) {
    const ContactSum& sum = expected.sums[i];
    EXPECT_EQ(sums[i].kind, static_cast<int>(sum.kind));
    EXPECT_EQ(sums[i].a.index, sum.a.index);
    EXPECT_EQ(sums[i].patch, sum.patch);
    EXPECT_EQ(sums[i].points, sum.points);
    EXPECT_EQ(sums[i].area, sum.area);
    EXPECT_EQ(sums[i].deepest_gap, sum.deepest_gap);
    EXPECT_EQ(sums[i].mean_gap, sum.mean_gap);
    EXPECT_EQ(Eigen::Vector3d(sums[i].center), sum.center);
    EXPECT_EQ(Eigen::Vector3d(sums[i].force), sum.force);
    EXPECT_EQ(Eigen::Vector3d(sums[i].torque), sum.torque);
    ASSERT_EQ(sums[i].vertex_count, sum.vertices.size());
    for (size_t k = 0; k < sum.vertices.size(); ++k)
      EXPECT_EQ(vertices[sums[i].first_vertex + k].vertex, sum.vertices[k].vertex);
  }
  EXPECT_EQ(tact_report_sum_contacts(scene.world, nullptr, 1, &room), TACT_ERROR_NULL_ARGUMENT);
  impulses[1].id = impulses[0].id;
  EXPECT_EQ(tact_report_sum_contacts(scene.world, impulses.data(), 2, &room), TACT_ERROR_INVALID_ARGUMENT);
}

TEST(RotationsInC, AreThoseOfCpp) {
  const double quaternion[4]{0.0, 0.0, 0.6, 0.8}, twice[4]{0.0, 0.0, 1.2, 1.6};
  double rotation[9], nearest[9];
  ASSERT_EQ(tact_rotation_of_quaternion(quaternion, rotation), TACT_OK);
  EXPECT_NEAR(rotation[1], -0.96, 1e-15) << "row by row";
  EXPECT_NEAR(rotation[3], 0.96, 1e-15);
  ASSERT_EQ(tact_nearest_rotation(rotation, nearest), TACT_OK);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(nearest[i], rotation[i], 1e-15);
  EXPECT_EQ(tact_rotation_of_quaternion(twice, rotation), TACT_ERROR_NOT_A_ROTATION);
  EXPECT_EQ(tact_nearest_rotation(nullptr, rotation), TACT_ERROR_NULL_ARGUMENT);
}

}  // namespace
}  // namespace tact::tests
