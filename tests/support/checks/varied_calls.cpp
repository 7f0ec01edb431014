#include "tests/support/checks/varied_calls.h"

#include <bit>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {

namespace {

constexpr std::size_t kMostVaried = 9;

Mesh shape(std::uint64_t seed) {
  switch (seed % 6) {
    case 0: return icosphere(1, 0.7);
    case 1: return blob(1, 0.8, 0.3, seed);
    case 2: return gridded_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 4);  // of several clusters
    case 3: return wrinkled_sheet(7, 2.0, 0.6, seed);
    case 4: return lattice_soup(12, 1, seed);  // with vertices that no facet uses
    default: return sheet(9, 9, 2.0, 2.0);
  }
}

void add(tact::World& world, Random& random) {
  const std::uint64_t seed = random.bits();
  const Mesh mesh = translated(shape(seed), random.in_cube(0.8));
  const bool is_sheet = seed % 6 >= 3;
  BodyDefinition body{.positions = mesh.positions,
                      .facets = mesh.facets,
                      .surface = is_sheet ? Surface::sheet : Surface::closed,
                      .motion = random.chance(0.2)   ? Motion::rigid
                                : random.chance(0.1) ? Motion::fixed
                                                     : Motion::deformable,
                      .name = random.chance(0.5) ? "named" : "",
                      .group = static_cast<std::uint32_t>(random.below(6)) / 4,
                      .external_id = seed};
  body.margin = random.chance(0.6) ? 0.05 * random.uniform() : 0.0;
  body.self_contact = is_sheet && random.chance(0.6);
  if (random.chance(0.5)) body.key = 1000 + random.bits() % 100000;
  world.add_body(body);
}

// Positions as they are, which vertices without facets have none of.
Mesh mesh_of(const tact::World& world, BodyId body) {
  Mesh mesh;
  mesh.positions.resize(3, static_cast<Eigen::Index>(world.vertex_count(body)));
  world.copy_positions(body, {mesh.positions.data(), static_cast<std::size_t>(mesh.positions.size())});
  mesh.positions = mesh.positions.array().isNaN().select(0.0, mesh.positions.array());
  return mesh;
}

void move(tact::World& world, BodyId body, Random& random) {
  const Vec3 by = (random.chance(0.2) ? 0.5 : 0.08) * random.in_cube(1.0);
  const Rotation turn = random.rotation();
  switch (world.motion(body)) {
    case Motion::fixed: return;
    case Motion::rigid: {
      Eigen::Matrix3d rotation;
      for (int i = 0; i < 3; ++i) rotation.row(i) << turn.row[i].x, turn.row[i].y, turn.row[i].z;
      return world.set_pose(body, rotation, {by.x, by.y, by.z});
    }
    case Motion::deformable: break;
  }
  Mesh mesh = translated(mesh_of(world, body), by);
  if (random.chance(0.2)) mesh = jittered(mesh, 0.1, random.bits());
  if (random.chance(0.05)) mesh = crumpled(mesh, random.bits());
  world.set_positions(body, mesh.positions);
}

void set_settings(tact::World& world, Random& random) {
  Settings settings = world.settings();
  settings.direction = random.chance(0.5) ? DirectionPolicy::smallest : DirectionPolicy::carried;
  settings.accuracy = random.chance(0.2) ? Accuracy::paper : Accuracy::exact;
  settings.outputs.points = random.chance(0.9);
  settings.outputs.patches = random.chance(0.8);
  world.set_settings(settings);
}

void change_a_body(tact::World& world, Random& random, std::span<const BodyId> bodies) {
  const BodyId body = bodies[static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())))];
  const BodyId other = bodies[static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())))];
  switch (random.below(14)) {
    case 0: return world.remove_body(body);
    case 1: return world.set_margin(body, 0.1 * random.uniform());
    case 2: return world.set_self_contact(body, random.chance(0.5));
    case 3: return world.set_group(body, static_cast<std::uint32_t>(random.below(3)));
    case 4: return world.set_layers(body, 1u + static_cast<std::uint32_t>(random.below(3)), ~0u);
    case 5: return body != other ? world.set_excluded(body, other, random.chance(0.6)) : void();
    case 6: return world.motion(body) == Motion::deformable ? world.set_motion(body, Motion::fixed) : void();
    default: return move(world, body, random);
  }
}

}  // namespace

void change(tact::World& world, std::uint64_t seed) {
  Random random(seed);
  const int calls = random.below(6);
  for (int i = 0; i < calls; ++i) {
    const std::vector<BodyId> bodies = world.bodies();
    if (bodies.size() < 3 || (bodies.size() < kMostVaried && random.chance(0.2))) {
      try {
        add(world, random);
      } catch (const Error&) {  // by chance another has its key
      }
    } else if (random.chance(0.05)) {
      set_settings(world, random);
    } else {
      change_a_body(world, random, bodies);
    }
  }
}

std::vector<std::uint64_t> answers_of_step(tact::World& world) {
  std::vector<std::uint64_t> answers;
  const auto add = [&](auto... words) { answers.insert(answers.end(), {static_cast<std::uint64_t>(words)...}); };
  for (const Impact& impact : world.detect_motion().impacts())
    add(impact.a.index, impact.b.index, std::bit_cast<std::uint64_t>(impact.time));
  const Report& report = world.detect();
  add(report.hash(), report.contacts().size());
  for (const Contact& contact : report.contacts())
    add(contact.hash(), contact.iterations, contact.kept_facets_a, contact.kept_facets_b);
  for (const auto events : {report.began(), report.ended()}) {
    add(events.size());
    for (const ContactEvent& event : events) add(event.a.index, event.b.index);
  }
  for (const PatchEvent& event : report.patch_events())
    add(event.a.index, event.b.index, event.kind, event.patch, event.other);
  const RayHit hit = world.cast_ray({.from = {-3, 0.1, 0.2}, .to = {3, 0.1, -0.1}});
  add(hit.body.index, hit.facet, std::bit_cast<std::uint64_t>(hit.fraction));
  return answers;
}

}  // namespace tact::tests
