// What the manual's page on concepts shows, each part between two marks. Leaves with status 1 if something is not as
// the page says.
#include <tact/tact.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>
#include <vector>

namespace {

int failures = 0;

void expect(bool is_so, const char* what) {
  if (is_so) return;
  std::printf("not so: %s\n", what);
  ++failures;
}

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

struct Mesh {
  Eigen::Matrix3Xd positions;
  Eigen::Matrix3Xi facets;
};

Mesh cube(double side, const Eigen::Vector3d& corner) {
  Mesh mesh{Eigen::Matrix3Xd(3, 8), Eigen::Matrix3Xi(3, 12)};
  for (int i = 0; i < 8; ++i) mesh.positions.col(i) = corner + side * Eigen::Vector3d(i & 1, i >> 1 & 1, i >> 2);
  mesh.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,             //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return mesh;
}

Mesh square(double side, double height) {
  Mesh mesh{Eigen::Matrix3Xd(3, 4), Eigen::Matrix3Xi(3, 2)};
  mesh.positions << -side, side, side, -side, -side, -side, side, side, height, height, height, height;
  mesh.facets << 0, 0, 1, 2, 2, 3;
  return mesh;
}

void direction_and_slab() {
  const Mesh low = cube(1.0, {0, 0, 0}), high = cube(1.0, {0.2, 0.1, 0.75});
  // [part direction]
  tact::World world;
  world.add_body({.positions = low.positions, .facets = low.facets});
  const tact::BodyId b = world.add_body({.positions = high.positions, .facets = high.facets});
  const tact::Contact contact = world.detect().contacts()[0];

  // Moving b out: along the direction, by the depth. Then the hulls only touch.
  const Eigen::Vector3d way = contact.depth * contact.direction;
  world.set_positions(b, high.positions.colwise() + way);
  // [part direction]
  expect(near(contact.depth, 0.25) && near(contact.direction.z(), 1.0), "the cubes part upward by 0.25 m");
  expect(near(contact.plane_a, 1.0) && near(contact.plane_b, 0.75), "the slab lies from 0.75 m to 1 m");
  const tact::Report& after = world.detect();
  expect(after.contacts().empty() || after.contacts()[0].depth < 1e-9, "moved by the depth they only touch");
}

void zones_and_patches() {
  const Mesh low = cube(1.0, {0, 0, 0}), high = cube(0.5, {0.2, 0.1, 0.9});
  // [part zones]
  tact::Settings settings;
  settings.outputs.zones = true;
  settings.outputs.patches = true;
  tact::World world(settings);
  // [part zones]
  world.add_body({.positions = low.positions, .facets = low.facets});
  world.add_body({.positions = high.positions, .facets = high.facets});
  const tact::Contact contact = world.detect().contacts()[0];
  expect(near(contact.zone_b.radius, std::sqrt(0.125)), "the zone of the small cube is its lower face's disk");
  expect(contact.patches().size() == 1, "they touch in one patch");
  // [part patches]
  for (const tact::Patch& patch : contact.patches()) {
    std::printf("patch at %.2f %.2f %.2f, %.2f m deep\n", patch.point.x(), patch.point.y(), patch.point.z(),
                patch.depth);
  }
  // [part patches]
}

void points_and_margins() {
  const Mesh sheet = square(2.0, 1.006), floor = cube(1.0, {0, 0, 0});
  // [part points]
  tact::Settings settings;
  settings.outputs.points = true;
  tact::World world(settings);
  world.add_body({.positions = floor.positions, .facets = floor.facets, .margin = 0.005});
  world.add_body({.positions = sheet.positions,
                  .facets = sheet.facets,
                  .surface = tact::Surface::sheet,
                  .margin = 0.005,  // two add up: points are seen from 0.01 m above the floor on
                  .self_contact = true});
  for (const tact::Contact& contact : world.detect().contacts()) {
    for (const tact::ContactPoint& point : contact.points()) {
      std::printf("gap %.4f m along %.1f %.1f %.1f\n", point.gap, point.normal.x(), point.normal.y(), point.normal.z());
    }
  }
  // [part points]
  const tact::Contact contact = world.detect().contacts()[0];
  expect(contact.facet_pairs().empty(), "no facets meet: the surfaces are 6 mm apart");
  expect(contact.points().size() >= 4, "the four upper corners of the cube are near the sheet");
  for (const tact::ContactPoint& point : contact.points()) expect(near(point.gap, 0.006), "the gap is 6 mm");
}

void curves() {
  const Mesh sheet = square(2.0, 0.1), post = cube(0.5, {0.1, 0.2, 0.0});
  // [part curves]
  tact::Settings settings;
  settings.outputs.curves = true;
  tact::World world(settings);
  world.add_body({.positions = sheet.positions, .facets = sheet.facets, .surface = tact::Surface::sheet});
  world.add_body({.positions = post.positions, .facets = post.facets});
  for (const tact::Contact& contact : world.detect().contacts()) {
    for (const tact::IntersectionCurve& curve : contact.curves()) {
      std::printf("%s curve of %zu points\n", curve.closed ? "a closed" : "an open", curve.points.size());
      for (const tact::CurvePoint& point : curve.points)
        std::printf("  %.2f %.2f %.2f\n", point.position.x(), point.position.y(), point.position.z());
    }
  }
  // [part curves]
  const tact::Contact contact = world.detect().contacts()[0];
  expect(contact.curves().size() == 1 && contact.curves()[0].closed, "the cube makes one hole");
  for (const tact::CurvePoint& point : contact.curves()[0].points)
    expect(near(point.position.z(), 0.1), "the curve lies in the sheet");
}

void motion() {
  const Mesh sheet = square(2.0, 0.0);
  Mesh bullet = cube(0.1, {0, 0, 1.0});
  // [part motion]
  tact::World world;
  world.add_body({.positions = sheet.positions, .facets = sheet.facets, .surface = tact::Surface::sheet});
  const tact::BodyId body = world.add_body({.positions = bullet.positions, .facets = bullet.facets});
  world.detect();  // motion is looked at from here

  const Eigen::Matrix3Xd start = bullet.positions;
  const Eigen::Matrix3Xd target = start.colwise() - Eigen::Vector3d(0, 0, 4);  // through the sheet, in one step
  world.set_positions(body, target);
  const double first = world.detect_motion(tact::Impacts::first).first_time();
  const double free = std::min(1.0, 0.999 * first);  // infinity where nothing meets
  world.set_positions(body, start + free * (target - start));
  // [part motion]
  expect(std::abs(first - 0.25) < 1e-6, "they meet after a quarter of the way");
  expect(world.detect().stats().facet_pairs == 0, "stopped before, they do not meet");
}

void bounds() {
  const Mesh sheet = square(2.0, 0.0);
  const Mesh bullet = cube(0.1, {0, 0, 1.0});
  tact::World world;
  world.add_body({.positions = sheet.positions, .facets = sheet.facets, .surface = tact::Surface::sheet});
  const tact::BodyId body = world.add_body({.positions = bullet.positions, .facets = bullet.facets});
  world.detect();
  const Eigen::Matrix3Xd start = bullet.positions;
  const Eigen::Matrix3Xd target = start.colwise() - Eigen::Vector3d(0, 0, 4);
  // [part bounds]
  world.set_positions(body, target);
  const tact::MotionReport& motion = world.detect_motion({.distance = 0.0, .bounds = true});
  Eigen::Matrix3Xd free = target;
  for (Eigen::Index v = 0; v < free.cols(); ++v) {
    const double bound = motion.bounds(body)[static_cast<std::size_t>(v)];
    if (bound < 1.0) free.col(v) = start.col(v) + bound * (target.col(v) - start.col(v));
  }
  world.set_positions(body, free);
  // [part bounds]
  expect(world.detect_motion().first_time() > 1.0, "nothing meets on the way");
  expect(free != start, "the bullet moves");
}

void queries() {
  const Mesh mesh = cube(1.0, {0, 0, 0});
  // [part queries]
  tact::World world;
  world.add_body({.positions = mesh.positions, .facets = mesh.facets});
  const tact::RayHit hit = world.cast_ray({.from = {0.3, 0.4, 5}, .to = {0.3, 0.4, -5}});
  const tact::ClosestPoint closest = world.closest_point({.point = {0.3, 0.4, 1.2}});
  const bool is_inside = !world.bodies_containing({.point = {0.5, 0.5, 0.5}}).empty();
  // [part queries]
  expect(near(hit.fraction, 0.4), "the ray meets the top after 4 of 10 metres");
  expect(near(closest.distance, 0.2), "the point is 0.2 m above the cube");
  expect(is_inside, "the middle is inside");
}

void changed_facets() {
  Mesh sheet = square(1.0, 0.0);
  const Mesh ground = square(4.0, -0.01);
  tact::Settings settings;
  settings.outputs.points = true;
  tact::World world(settings);
  const tact::BodyId cloth = world.add_body(
      {.positions = sheet.positions, .facets = sheet.facets, .surface = tact::Surface::sheet, .margin = 0.01});
  world.add_body(
      {.positions = ground.positions, .facets = ground.facets, .surface = tact::Surface::sheet, .margin = 0.01});
  std::set<std::uint64_t> before, after;
  for (const tact::ContactPoint& point : world.detect().contacts()[0].points()) before.insert(point.id);
  // [part facets]
  // Along the edge of its two facets the sheet is cut: vertices 0 and 2 have doubles, 4 and 5.
  const std::vector<int> vertex_map{0, 1, 2, 3, 0, 2};
  Eigen::Matrix3Xd positions(3, 6);
  for (int v = 0; v < 6; ++v) positions.col(v) = sheet.positions.col(vertex_map[v]);
  Eigen::Matrix3Xi facets(3, 2);
  facets << 0, 4, 1, 5, 2, 3;
  world.set_facets(cloth, positions, facets, vertex_map);
  // [part facets]
  const tact::Report& report = world.detect();
  expect(report.began().empty() && report.ended().empty(), "what touches goes on touching");
  for (const tact::ContactPoint& point : report.contacts()[0].points()) after.insert(point.id);
  expect(std::includes(after.begin(), after.end(), before.begin(), before.end()), "what is still there keeps its id");
  expect(after.size() > before.size(), "the doubles have points of their own");
}

void rest_offsets_and_labels() {
  const Mesh sheet = square(1.0, 0.003);
  tact::Settings settings;
  settings.outputs.points = true;
  tact::World world(settings);
  const tact::BodyId floor = world.add_plane({.normal = {0.0, 0.0, 1.0}, .margin = 0.004, .rest_offset = 0.0});
  // [part rest_offsets]
  const tact::BodyId cloth = world.add_body({.positions = sheet.positions,
                                             .facets = sheet.facets,
                                             .surface = tact::Surface::sheet,
                                             .margin = 0.006,         // seen from here on
                                             .rest_offset = 0.001});  // half of the cloth's thickness
  const bool touches_at_1_mm = world.detect().find_contact(cloth, floor)->touching();
  world.set_rest_offset(cloth, 0.0035);
  const bool touches_at_3_5_mm = world.detect().find_contact(cloth, floor)->touching();
  world.set_rest_offset(cloth, std::nullopt);  // the margin again
  // [part rest_offsets]
  expect(!touches_at_1_mm && touches_at_3_5_mm, "the cloth is 3 mm above the floor");
  // [part labels]
  const std::vector<std::uint32_t> strands{11, 12, 13, 14}, materials{7, 8};  // one a vertex, one a facet
  world.set_feature_settings(cloth, {.vertex_labels = strands, .facet_labels = materials});
  for (const tact::ContactPoint& point : world.detect().contacts()[0].points()) {
    const tact::FeatureLabels labels = world.labels(cloth, point.b_vertices);
    std::printf("strand %u of material %u\n", labels.vertices[0], labels.facet);
  }
  // [part labels]
  expect(world.labels(cloth, {3, -1, -1}).vertices[0] == 14, "a vertex has its label");
}

void excluded_labels() {
  const Mesh low = square(1.0, 0.0), high = square(1.0, 0.003);
  tact::Settings settings;
  settings.outputs.points = true;
  tact::World world(settings);
  const auto add = [&](const Mesh& mesh) {
    return world.add_body({.positions = mesh.positions,
                           .facets = mesh.facets,
                           .surface = tact::Surface::sheet,
                           .margin = 0.006,
                           .rest_offset = 0.001});
  };
  const tact::BodyId body = add(low), collar = add(high);
  const std::size_t before = world.detect().contacts()[0].points().size();
  // [part excluded_labels]
  const std::vector<std::uint32_t> skin{5, 5}, seam{7, 8};  // one a facet: the first of the collar is sewn on
  world.set_feature_settings(body, {.facet_labels = skin});
  world.set_feature_settings(collar, {.facet_labels = seam});
  world.set_excluded_labels({.a = collar, .label_a = 7, .b = body, .label_b = 5}, true);
  // [part excluded_labels]
  expect(world.detect().contacts()[0].points().size() < before, "a seam does not meet what it is sewn to");
}

void saved_states() {
  const Mesh low = cube(1.0, {0, 0, 0}), high = cube(1.0, {0.2, 0.1, 0.75});
  const auto step = [&](tact::World& of, tact::BodyId moved, double down) {
    of.set_positions(moved, high.positions.colwise() - Eigen::Vector3d(0, 0, down));
    return of.detect().hash();
  };
  // [part saved]
  tact::World world;
  world.add_body({.positions = low.positions, .facets = low.facets});
  const tact::BodyId b = world.add_body({.positions = high.positions, .facets = high.facets});
  step(world, b, 0.1);
  const std::vector<std::byte> bytes = world.save();
  const std::uint64_t once = step(world, b, 0.2);

  world.restore(bytes);  // back: b is the same body
  const std::uint64_t again = step(world, b, 0.2);

  tact::World branch;  // another world in the same state: ids are its own, the order of bodies() is the same
  branch.restore(bytes);
  const std::uint64_t there = step(branch, branch.bodies()[1], 0.2);
  // [part saved]
  expect(once == again && once == there, "a restored world answers as the one that went on");
}

void errors() {
  Mesh mesh = cube(1.0, {0, 0, 0});
  tact::World world;
  const tact::BodyId body = world.add_body({.positions = mesh.positions, .facets = mesh.facets, .name = "jelly"});
  mesh.positions(1, 5) = std::nan("");
  bool refused = false;
  // [part errors]
  try {
    world.set_positions(body, mesh.positions);
  } catch (const tact::Error& error) {  // the world is as it was before the call
    std::printf("%s\n", error.what());
    refused = error.code() == tact::ErrorCode::non_finite_position;
  }
  // [part errors]
  expect(refused, "a position that is no number is refused");
}

}  // namespace

int main() {
  direction_and_slab();
  zones_and_patches();
  points_and_margins();
  curves();
  motion();
  bounds();
  queries();
  changed_facets();
  rest_offsets_and_labels();
  excluded_labels();
  saved_states();
  errors();
  return failures == 0 ? 0 : 1;
}
