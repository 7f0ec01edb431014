// Arrays over a whole report hold what its contacts do, row by row.
#include <gtest/gtest.h>
#include <tact/report_arrays.h>
#include <tact/world.h>

#include <algorithm>
#include <span>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

// Three balls in a row that reach into each other, and a cloth over them; the last ball then moves through the second.
struct ThreeBallsAndCloth {
  ThreeBallsAndCloth() : world({.threads = 1, .outputs = {.patches = true, .points = true}}) {
    for (int i = 0; i < 3; ++i) {
      const Mesh ball = translated(icosphere(2), {1.7 * i, 0.1, 0.2 * i});
      balls.push_back(world.add_body({.positions = ball.positions, .facets = ball.facets, .margin = 0.05}));
    }
    const Mesh cloth = translated(sheet(20, 20, 4.0, 4.0), {0.0, 0.0, 1.05});
    world.add_body({.positions = cloth.positions, .facets = cloth.facets, .surface = Surface::sheet, .margin = 0.05});
  }
  World world;
  std::vector<BodyId> balls;
};

template <class Number>
std::vector<Number> room(std::size_t rows, std::size_t width) {
  return std::vector<Number>(rows * width, Number(77));
}

TEST(ReportArrays, OfPointsHoldThoseOfTheContacts) {
  ThreeBallsAndCloth scene;
  const Report& report = scene.world.detect();
  const std::size_t rows = point_count(report);
  auto bodies = room<std::uint32_t>(rows, 2);
  auto contacts = room<int>(rows, 1), a_vertices = room<int>(rows, 3), b_vertices = room<int>(rows, 3);
  auto kinds = room<std::uint8_t>(rows, 1);
  auto a_weights = room<double>(rows, 3), b_weights = room<double>(rows, 3), normals = room<double>(rows, 3),
       gaps = room<double>(rows, 1);
  auto ids = room<std::uint64_t>(rows, 1), patch_ids = room<std::uint64_t>(rows, 1);
  copy_points(report,
              {bodies, contacts, kinds, a_vertices, b_vertices, a_weights, b_weights, normals, gaps, ids, patch_ids});
  std::size_t row = 0;
  for (std::size_t c = 0; c < report.contacts().size(); ++c) {
    const Contact& contact = report.contacts()[c];
    for (const ContactPoint& point : contact.points()) {
      EXPECT_EQ(bodies[2 * row], contact.a.index);
      EXPECT_EQ(bodies[2 * row + 1], contact.b.index);
      EXPECT_EQ(contacts[row], static_cast<int>(c));
      EXPECT_EQ(kinds[row], static_cast<std::uint8_t>(point.kind));
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(a_vertices[3 * row + k], point.a_vertices[k]);
        EXPECT_EQ(b_vertices[3 * row + k], point.b_vertices[k]);
        EXPECT_EQ(a_weights[3 * row + k], point.a_weights[k]);
        EXPECT_EQ(b_weights[3 * row + k], point.b_weights[k]);
        EXPECT_EQ(normals[3 * row + k], point.normal[static_cast<int>(k)]);
      }
      EXPECT_EQ(gaps[row], point.gap);
      EXPECT_EQ(ids[row], point.id);
      EXPECT_EQ(patch_ids[row], contact.patches()[static_cast<std::size_t>(point.patch)].id);
      ++row;
    }
  }
  EXPECT_EQ(row, rows);
  EXPECT_GT(rows, 50u);
}

TEST(ReportArrays, OfLabelsHoldThoseThatTheWorldTells) {
  ThreeBallsAndCloth scene;
  std::vector<std::uint32_t> facets(scene.world.facet_count(scene.balls[1])),
      vertices(scene.world.vertex_count(scene.balls[1]));
  for (std::size_t i = 0; i < facets.size(); ++i) facets[i] = 100 + static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = 5000 + static_cast<std::uint32_t>(i);
  scene.world.set_feature_settings(scene.balls[1], {.vertex_labels = vertices, .facet_labels = facets});
  const Report& report = scene.world.detect();
  const std::size_t rows = point_count(report);
  auto a_facets = room<std::uint32_t>(rows, 1), b_facets = a_facets;
  auto a_vertices = room<std::uint32_t>(rows, 3), b_vertices = a_vertices;
  copy_point_labels(scene.world, report, {a_facets, b_facets, a_vertices, b_vertices});
  std::size_t row = 0, labelled = 0;
  for (const Contact& contact : report.contacts()) {
    for (const ContactPoint& point : contact.points()) {
      const FeatureLabels a = scene.world.labels(contact.a, point.a_vertices),
                          b = scene.world.labels(contact.b, point.b_vertices);
      EXPECT_EQ(a_facets[row], a.facet);
      EXPECT_EQ(b_facets[row], b.facet);
      EXPECT_TRUE(std::equal(a.vertices.begin(), a.vertices.end(), &a_vertices[3 * row]));
      EXPECT_TRUE(std::equal(b.vertices.begin(), b.vertices.end(), &b_vertices[3 * row]));
      labelled += b.facet >= 100 && b.vertices[0] >= 5000 ? 1 : 0;
      ++row;
    }
  }
  EXPECT_GT(labelled, 5u);
  EXPECT_THROW(copy_point_labels(scene.world, report, {.a_facets = std::span(a_facets).first(1)}), Error);

  const Mesh smaller = icosphere(0);
  scene.world.set_facets(scene.balls[1], smaller.positions, smaller.facets,
                         std::vector<int>(static_cast<std::size_t>(smaller.positions.cols()), -1));
  EXPECT_TRUE(throws_error([&] { copy_point_labels(scene.world, report, {a_facets}); }, ErrorCode::wrong_order));
}

TEST(ReportArrays, OfFacetPairsHoldThoseOfTheContacts) {
  ThreeBallsAndCloth scene;
  const Report& report = scene.world.detect();
  const std::size_t rows = facet_pair_count(report);
  EXPECT_EQ(static_cast<std::int64_t>(rows), report.stats().facet_pairs);
  auto bodies = room<std::uint32_t>(rows, 2);
  auto facets = room<int>(rows, 2), contacts = room<int>(rows, 1);
  copy_facet_pairs(report, {.bodies = bodies, .contacts = contacts, .facets = facets});
  std::size_t row = 0;
  for (const Contact& contact : report.contacts())
    for (const FacetPair& pair : contact.facet_pairs()) {
      EXPECT_EQ(bodies[2 * row], contact.a.index);
      EXPECT_EQ(bodies[2 * row + 1], contact.b.index);
      EXPECT_EQ(&report.contacts()[static_cast<std::size_t>(contacts[row])], &contact);
      EXPECT_EQ((FacetPair{facets[2 * row], facets[2 * row + 1]}), pair);
      ++row;
    }
  EXPECT_EQ(row, rows);
  EXPECT_GT(rows, 50u);
}

TEST(ReportArrays, OfImpactsHoldThoseOfTheMotion) {
  ThreeBallsAndCloth scene;
  scene.world.detect();
  scene.world.set_positions(scene.balls[2], translated(icosphere(2), {0.5, 0.1, 0.4}).positions);
  const MotionReport& motion = scene.world.detect_motion();
  const std::size_t rows = motion.impacts().size();
  auto bodies = room<std::uint32_t>(rows, 2);
  auto kinds = room<std::uint8_t>(rows, 1);
  auto times = room<double>(rows, 1);
  auto a_vertices = room<int>(rows, 3), b_vertices = room<int>(rows, 3);
  auto stops = room<std::uint8_t>(rows, 1);
  copy_impacts(motion, {bodies, kinds, times, a_vertices, b_vertices, stops});
  for (std::size_t row = 0; row < rows; ++row) {
    const Impact& impact = motion.impacts()[row];
    EXPECT_EQ(bodies[2 * row], impact.a.index);
    EXPECT_EQ(bodies[2 * row + 1], impact.b.index);
    EXPECT_EQ(kinds[row], static_cast<std::uint8_t>(impact.kind));
    EXPECT_EQ(times[row], impact.time);
    EXPECT_EQ(stops[row], impact.stops ? 1 : 0);
    EXPECT_TRUE(std::equal(impact.a_vertices.begin(), impact.a_vertices.end(),
                           a_vertices.begin() + static_cast<std::ptrdiff_t>(3 * row)));
    EXPECT_TRUE(std::equal(impact.b_vertices.begin(), impact.b_vertices.end(),
                           b_vertices.begin() + static_cast<std::ptrdiff_t>(3 * row)));
  }
  EXPECT_GT(rows, 10u);
}

TEST(ReportArrays, OfAnotherSizeAreRefusedAndUntouched) {
  ThreeBallsAndCloth scene;
  const Report& report = scene.world.detect();
  auto gaps = room<double>(point_count(report), 1);
  auto ids = room<std::uint64_t>(point_count(report) - 1, 1);
  try {
    copy_points(report, {.gaps = gaps, .ids = ids});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::wrong_size);
    EXPECT_NE(std::string(error.what()).find("ids"), std::string::npos);
  }
  EXPECT_EQ(gaps[0], 77.0);
  copy_points(report, {});
}

}  // namespace
}  // namespace tact::tests
