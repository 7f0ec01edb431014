#include "tests/support/checks/random_calls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/remeshed.h"

namespace tact::tests {
namespace {

constexpr std::size_t kMostBodies = 7;
constexpr double kRoom = 1.0;  // half edge of the cube that bodies are in, metres

// Adds up what is drawn.
class CountingDrawer : public DebugDrawer {
 public:
  void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const DebugColor&) override { add(from), add(to); }
  void triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                const DebugColor&) override {
    add(p), add(q), add(r);
  }
  void text(const Eigen::Vector3d& at, std::string_view words, const DebugColor&) override {
    add(at);
    hash_.add(words.size());
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  void add(const Eigen::Vector3d& p) {
    for (int axis = 0; axis < 3; ++axis) hash_.add(std::bit_cast<std::uint64_t>(p[axis]));
  }
  WordHash hash_;
};

// An error for want of memory is the fault of the test; any other one is an answer.
template <class Run>
void keep_refusal(Subject& subject, const Run& run) {
  try {
    run();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::out_of_memory) throw;
    subject.refused = error.code();
  }
}

Eigen::Matrix3d matrix(const Rotation& r) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) m.row(i) << r.row[i].x, r.row[i].y, r.row[i].z;
  return m;
}

Eigen::Vector3d vector(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

AnswerHashes state_of(const Subject& subject) {
  const tact::World& world = subject.world;
  AnswerHash hash;
  hash.add_feature(world.body_count());
  for (const BodyId id : subject.ids) {
    hash.add_feature(world.contains(id) ? 1 : 0);
    if (!world.contains(id)) continue;
    for (const std::uint64_t feature :
         {static_cast<std::uint64_t>(world.surface(id)), static_cast<std::uint64_t>(world.motion(id)),
          std::uint64_t{world.layer(id)}, std::uint64_t{world.mask(id)}, std::uint64_t{world.group(id)},
          world.external_id(id), std::uint64_t{world.self_contact(id)}, std::uint64_t{world.name(id).size()}})
      hash.add_feature(feature);
    std::vector<double> positions(3 * world.vertex_count(id));
    std::vector<int> corners(3 * world.facet_count(id));
    world.copy_positions(id, positions);
    for (double& x : positions) x = std::isnan(x) ? -1.0 : x;
    world.copy_facets(id, corners);
    hash.add(std::span<const double>(positions));
    for (const int corner : corners) hash.add_feature(static_cast<std::uint64_t>(corner));
    const Bounds bounds = world.bounds(id);
    hash.add(std::span<const double>(bounds.lower));
    hash.add(std::span<const double>(bounds.upper));
    hash.add(std::array{world.margin(id)});
    for (const BodyId other : subject.ids)
      hash.add_feature(world.contains(other) && other != id && world.excluded(id, other) ? 1 : 0);
  }
  return hash.hashes();
}

AnswerHashes answer_of(Subject& subject) {
  AnswerHash hash;
  hash.number_patches(subject.patches);
  if (subject.leaves_out_ids) hash.leave_out_ids();
  if (subject.refused) hash.add_feature(1 + static_cast<std::uint64_t>(*std::exchange(subject.refused, {})));
  if (const Report* const report = std::exchange(subject.report, nullptr)) {
    hash.add(*report);
    subject.last_report = report;
  }
  if (const MotionReport* const motion = std::exchange(subject.motion, nullptr)) hash.add(*motion);
  hash.add(std::span<const RayHit>(subject.hits));
  hash.add(std::span<const ClosestPoint>(subject.closest));
  hash.add(std::span<const FacetOfBody>(subject.facets));
  for (const auto& facets : subject.facets_of_each) hash.add(std::span<const FacetOfBody>(facets));
  hash.add(std::span<const BodyId>(subject.bodies));
  for (const auto& bodies : subject.bodies_of_each) hash.add(std::span<const BodyId>(bodies));
  hash.add_feature(std::exchange(subject.drawn, 0));
  subject.hits.clear(), subject.closest.clear(), subject.facets.clear(), subject.facets_of_each.clear();
  subject.bodies.clear(), subject.bodies_of_each.clear();
  return hash.hashes();
}

RandomCalls::RandomCalls(std::uint64_t seed) : random_(seed) {
  settings_.threads = 1;
  settings_.outputs = {.zones = random_.chance(0.3), .patches = true, .points = true, .within_reach = true};
  if (random_.chance(0.3)) settings_.direction = DirectionPolicy::smallest;
}

Settings RandomCalls::settings(int threads) const {
  Settings settings = settings_;
  settings.threads = threads;
  return settings;
}

BodyDefinition RandomCalls::Body::definition(Motion as) const {
  return {.positions = mesh.positions,
          .facets = mesh.facets,
          .surface = surface,
          .motion = as,
          .name = name,
          .layer = layer,
          .mask = mask,
          .group = group,
          .margin = margin,
          .self_contact = self_contact};
}

Mesh RandomCalls::shape() {
  const std::uint64_t seed = random_.bits();
  switch (random_.below(15)) {
    case 0: return icosphere(0, 0.5);
    case 1: return icosphere(1, 0.6);
    case 2: return blob(1, 0.6, 0.4, seed);
    case 3: return centered_box({0.5, 0.25, 0.75});
    case 4: return gridded_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 2);
    case 5: return sheet(3, 3, 1.5, 1.5);
    case 6: return wrinkled_sheet(5, 2.0, 0.6, seed);
    case 7: return pleated(sheet(8, 2, 1.0, 1.0), 2, 0.5, 0.07);
    case 8: return random_hull(12, seed);
    case 9: return soup(10, 0.6, seed);
    case 10: return lattice_soup(12, 1, seed);
    case 11: return needles(5, 1e-6, seed);
    case 12: return stretched(centered_box({0.4, 0.4, 0.4}), {1.0, 1.0, 0.0});
    case 13: return random_.chance(0.3) ? Mesh{} : torus(8, 4, 0.6, 0.2);
    default: return crumpled(icosphere(0), seed);
  }
}

// Often on a lattice, so that bodies touch exactly.
Vec3 RandomCalls::place() {
  const Vec3 p = random_.in_cube(kRoom);
  if (!random_.chance(0.3)) return p;
  return {std::round(4.0 * p.x) / 4.0, std::round(4.0 * p.y) / 4.0, std::round(4.0 * p.z) / 4.0};
}

std::optional<std::size_t> RandomCalls::any_body() {
  std::vector<std::size_t> used;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot].body) used.push_back(slot);
  }
  if (used.empty()) return {};
  return used[static_cast<std::size_t>(random_.below(static_cast<int>(used.size())))];
}

std::optional<std::size_t> RandomCalls::any_body(bool rigid, bool may_be_fixed) {
  for (int tries = 0; tries < 8; ++tries) {
    const auto slot = any_body();
    if (!slot) return {};
    const Body& body = *slots_[*slot].body;
    if (body.rigid == rigid && (may_be_fixed || body.motion != Motion::fixed)) return slot;
  }
  return {};
}

Mesh RandomCalls::moved(const Mesh& mesh) {
  const int kind = random_.below(12);
  const std::uint64_t seed = random_.bits();
  const Vec3 by = kind < 8 ? 0.15 * random_.in_ball() : place();
  if (kind == 0) return mesh;
  if (kind == 1) return crumpled(mesh, seed);
  if (kind == 2) return rotated(translated(mesh, by), random_.rotation());
  if (kind < 6) return jittered(translated(mesh, by), 1e-2, seed);
  return kind < 10 ? translated(mesh, by) : snapped(mesh, 0.25);
}

Call RandomCalls::next() {
  if (std::exchange(was_step_, false) && random_.chance(0.2)) return draw();
  const std::size_t bodies =
      static_cast<std::size_t>(std::ranges::count_if(slots_, [](const Slot& slot) { return slot.body.has_value(); }));
  if (bodies < 3) return add();
  switch (random_.below(27)) {
    case 0: return bodies < kMostBodies ? add() : remove();
    case 1: return remove();
    case 2:
    case 3:
    case 4:
    case 5: return move();
    case 6:
    case 7: return move_many();
    case 8:
    case 9: return pose(random_.chance(0.5));
    case 10:
    case 11: return set();
    case 12: return exclude();
    case 13: return random_.chance(0.3) ? set_settings() : refused();
    case 14: return query();
    case 15: return query_many();
    case 16:
    case 17: return detect_motion();
    case 18: return change_facets();
    default: return detect();
  }
}

Call RandomCalls::add() {
  const std::size_t slot = free_.empty() ? slots_.size() : free_.back();
  if (free_.empty()) {
    slots_.emplace_back();
  } else {
    free_.pop_back();
  }
  Body body;
  body.mesh = shape();
  const Vec3 at = place();  // first: the order of arguments is the compiler's
  body.mesh = translated(random_.chance(0.5) ? rotated(body.mesh, random_.rotation()) : body.mesh, at);
  body.first = body.mesh.positions;
  body.surface = random_.chance(0.4) ? Surface::sheet : Surface::closed;
  body.rigid = random_.chance(0.3);
  body.motion = body.rigid ? Motion::rigid : random_.chance(0.1) ? Motion::fixed : Motion::deformable;
  body.margin = random_.chance(0.5) ? 0.1 * random_.uniform() : 0.0;
  body.self_contact = random_.chance(0.4);
  body.name = random_.chance(0.5) ? "a body with a name too long for its own place" : "b";
  ++slots_[slot].generation;
  slots_[slot].body = body;
  const auto kept = std::make_shared<const Body>(std::move(body));
  const auto definition = std::make_shared<const BodyDefinition>(kept->definition(kept->motion));
  return {.name = "add",
          .run = [kept, definition](Subject& subject) { subject.added = subject.world.add_body(*definition); },
          .note =
              [slot](Subject& subject) {
                subject.ids.resize(std::max(subject.ids.size(), slot + 1));
                subject.ids[slot] = subject.added;
              }};
}

Call RandomCalls::remove() {
  const std::size_t slot = *any_body();
  slots_[slot].body.reset();
  free_.push_back(slot);
  std::erase_if(excluded_, [&](const auto& pair) { return pair.first == slot || pair.second == slot; });
  return {.name = "remove",
          .run = [slot](Subject& subject) { subject.world.remove_body(subject.ids[slot]); },
          .note = [slot](Subject& subject) { subject.ids[slot] = {}; }};
}

Call RandomCalls::move() {
  const auto slot = any_body(false, false);
  if (!slot) return detect();
  Mesh& mesh = slots_[*slot].body->mesh;
  mesh = moved(mesh);
  return {.name = "set_positions", .run = [slot = *slot, mesh](Subject& subject) {
            subject.world.set_positions(subject.ids[slot], mesh.positions);
          }};
}

Call RandomCalls::move_many() {
  struct Batch {
    std::vector<std::size_t> slots;
    std::vector<Mesh> meshes;
    std::vector<PositionsUpdate> updates;
  };
  const auto batch = std::make_shared<Batch>();
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    auto& body = slots_[slot].body;
    if (!body || body->rigid || body->motion == Motion::fixed || random_.chance(0.3)) continue;
    body->mesh = moved(body->mesh);
    batch->slots.push_back(slot);
    batch->meshes.push_back(body->mesh);
  }
  for (const Mesh& mesh : batch->meshes) batch->updates.push_back({{}, mesh.positions});
  return {.name = "set_positions of many", .run = [batch](Subject& subject) {
            for (std::size_t i = 0; i < batch->slots.size(); ++i) batch->updates[i].body = subject.ids[batch->slots[i]];
            subject.world.set_positions(batch->updates);
          }};
}

bool RandomCalls::any_renamed() const {
  return std::ranges::any_of(slots_, [](const Slot& slot) { return slot.body && slot.body->renamed; });
}

Call RandomCalls::change_facets() {
  const auto slot = any_body(false, true);
  if (!slot) return detect();
  Body& body = *slots_[*slot].body;
  const auto made = std::make_shared<Remeshed>(remeshed(body.mesh, random_));
  if (random_.chance(0.5)) made->mesh = moved(made->mesh);
  body.mesh = made->mesh;
  body.first = body.mesh.positions;
  body.renamed = true;
  return {.name = "set_facets", .run = [slot = *slot, made](Subject& subject) {
            subject.world.set_facets(subject.ids[slot], made->mesh.positions, made->mesh.facets, made->vertex_map);
          }};
}

PoseUpdate RandomCalls::any_pose() {
  const Vec3 at = random_.chance(0.5) ? 0.3 * random_.in_ball() : place();
  PoseUpdate update;
  if (random_.chance(0.5)) update.rotation = matrix(random_.rotation());
  update.translation = vector(at);
  return update;
}

Call RandomCalls::pose(bool many) {
  const auto updates = std::make_shared<std::vector<PoseUpdate>>();
  const auto slots = std::make_shared<std::vector<std::size_t>>();
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    auto& body = slots_[slot].body;
    if (!body || !body->rigid || body->motion == Motion::fixed) continue;
    if (!many && !updates->empty()) break;
    body->pose = any_pose();
    updates->push_back(*body->pose);
    slots->push_back(slot);
  }
  if (updates->empty()) return detect();
  return {.name = many ? "set_poses" : "set_pose", .run = [updates, slots, many](Subject& subject) {
            for (std::size_t i = 0; i < slots->size(); ++i) (*updates)[i].body = subject.ids[(*slots)[i]];
            const PoseUpdate& first = updates->front();
            many ? subject.world.set_poses(*updates)
                 : subject.world.set_pose(first.body, first.rotation, first.translation);
          }};
}

Call RandomCalls::set() {
  const std::size_t slot = *any_body();
  Body& body = *slots_[slot].body;
  switch (random_.below(5)) {
    case 0: {
      body.layer = 1u << random_.below(2), body.mask = random_.chance(0.7) ? ~0u : 1u;
      return {.name = "set_layers", .run = [slot, layer = body.layer, mask = body.mask](Subject& subject) {
                subject.world.set_layers(subject.ids[slot], layer, mask);
              }};
    }
    case 1: {
      body.group = static_cast<std::uint32_t>(std::max(0, random_.below(6) - 3));
      return {.name = "set_group", .run = [slot, group = body.group](Subject& subject) {
                subject.world.set_group(subject.ids[slot], group);
              }};
    }
    case 2: {
      body.motion = random_.chance(0.3) ? Motion::fixed : body.rigid ? Motion::rigid : Motion::deformable;
      return {.name = "set_motion", .run = [slot, motion = body.motion](Subject& subject) {
                subject.world.set_motion(subject.ids[slot], motion);
              }};
    }
    case 3: {
      body.margin = random_.chance(0.5) ? 0.2 * random_.uniform() : 0.0;
      return {.name = "set_margin", .run = [slot, margin = body.margin](Subject& subject) {
                subject.world.set_margin(subject.ids[slot], margin);
              }};
    }
    default: {
      body.self_contact = !body.self_contact;
      return {.name = "set_self_contact", .run = [slot, wanted = body.self_contact](Subject& subject) {
                subject.world.set_self_contact(subject.ids[slot], wanted);
              }};
    }
  }
}

Call RandomCalls::exclude() {
  const std::size_t first = *any_body(), second = *any_body();
  const std::pair pair = std::minmax(first, second);
  const bool excluded = random_.chance(0.6);
  if (first != second) {
    std::erase(excluded_, std::pair<std::size_t, std::size_t>(pair));
    if (excluded) excluded_.emplace_back(pair);
  }
  return {.name = "set_excluded", .run = [first, second, excluded](Subject& subject) {
            keep_refusal(subject,
                         [&] { subject.world.set_excluded(subject.ids[first], subject.ids[second], excluded); });
          }};
}

Call RandomCalls::set_settings() {
  settings_.accuracy = random_.chance(0.7) ? Accuracy::exact : random_.chance(0.5) ? Accuracy::paper : Accuracy::hulls;
  settings_.direction = random_.chance(0.6) ? DirectionPolicy::carried : DirectionPolicy::smallest;
  settings_.outputs = {.zones = random_.chance(0.3), .patches = random_.chance(0.7), .points = random_.chance(0.8)};
  return {.name = "set_settings", .run = [settings = settings_](Subject& subject) mutable {
            settings.threads = subject.threads;
            subject.world.set_settings(settings);
          }};
}

Call RandomCalls::refused() {
  const std::size_t slot = *any_body();
  const auto bad = std::make_shared<Remeshed>(unchanged(slots_[slot].body->mesh));
  Eigen::Matrix3Xd& positions = bad->mesh.positions;
  if (positions.cols() > 0) positions(1, positions.cols() - 1) = HUGE_VAL;
  const int kind = random_.below(10);
  return {.name = "refused " + std::to_string(kind), .run = [slot, bad, kind](Subject& subject) {
            const BodyId id = subject.ids[slot];
            BodyId gone = id;
            ++gone.generation;
            tact::World& world = subject.world;
            keep_refusal(subject, [&] {
              switch (kind) {
                case 0: return world.set_positions(id, bad->mesh.positions);
                case 1: return world.remove_body(gone);
                case 2: return world.set_margin(id, -1.0);
                case 3: return world.set_settings({.threads = -1});
                case 4: return world.set_pose(id, 2.0 * Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.0});
                case 5: return world.copy_positions(id, {});
                case 6: static_cast<void>(world.name(gone)); return;
                case 7: static_cast<void>(world.cast_ray({.from = {HUGE_VAL, 0.0, 0.0}})); return;
                case 8: return world.set_facets(id, bad->mesh.positions, bad->mesh.facets, bad->vertex_map);
                default: return world.set_motion(gone, Motion::fixed);
              }
            });
          }};
}

Call RandomCalls::query() {
  const Vec3 p = 2.0 * random_.in_cube(kRoom), q = 2.0 * random_.in_cube(kRoom), size = random_.in_cube(0.5);
  const Ray ray{.from = vector(p), .to = vector(q)};
  const PointQuery point{.point = vector(0.5 * p)};
  const BoxQuery box{.lower = vector(0.5 * p), .upper = vector(0.5 * p).array() + vector(size).norm()};
  const int kind = random_.below(7);
  const std::size_t slot = *any_body();
  Call call{.name = "query " + std::to_string(kind),
            .prepare = [](Subject& subject) { subject.hits.resize(1), subject.closest.resize(1); },
            .run =
                [=](Subject& subject) {
                  const tact::World& world = subject.world;
                  switch (kind) {
                    case 0: subject.hits[0] = world.cast_ray(ray); return;
                    case 1: subject.hits = world.cast_ray_all(ray); return;
                    case 2: subject.closest[0] = world.closest_point(point); return;
                    case 3: subject.facets = world.overlap_box(box); return;
                    case 4: subject.bodies = world.bodies_containing(point); return;
                    case 5: subject.drawn = world.check_surface(subject.ids[slot]).crossings.size(); return;
                    default: subject.bodies = world.bodies(); return;
                  }
                }};
  call.changes_nothing = true;
  return call;
}

Call RandomCalls::query_many() {
  struct Many {
    std::vector<Ray> rays;
    std::vector<PointQuery> points;
    std::vector<BoxQuery> boxes;
  };
  const auto many = std::make_shared<Many>();
  for (int i = random_.chance(0.5) ? 80 : 5; i > 0; --i) {
    const Vec3 p = 2.0 * random_.in_cube(kRoom), q = 2.0 * random_.in_cube(kRoom);
    many->rays.push_back({.from = vector(p), .to = vector(q)});
    many->points.push_back({.point = vector(0.5 * p)});
    many->boxes.push_back({.lower = vector(0.5 * p), .upper = vector(0.5 * p).array() + 0.3});
  }
  const int kind = random_.below(4);
  Call call{.name = "queries " + std::to_string(kind),
            .prepare =
                [count = many->rays.size()](Subject& subject) {
                  subject.hits.resize(count), subject.closest.resize(count);
                  subject.facets_of_each.resize(count), subject.bodies_of_each.resize(count);
                },
            .run =
                [many, kind](Subject& subject) {
                  const tact::World& world = subject.world;
                  switch (kind) {
                    case 0: return world.cast_rays(many->rays, subject.hits);
                    case 1: return world.closest_points(many->points, subject.closest);
                    case 2: return world.overlap_boxes(many->boxes, subject.facets_of_each);
                    default: return world.bodies_containing_each(many->points, subject.bodies_of_each);
                  }
                }};
  call.changes_nothing = true;
  return call;
}

Call RandomCalls::detect() {
  was_step_ = true;
  Call call{.name = "detect", .run = [](Subject& subject) { subject.report = &subject.world.detect(); }};
  call.is_step = true;
  return call;
}

Call RandomCalls::detect_motion() {
  const auto wanted = static_cast<Impacts>(random_.below(3));
  Call call{.name = "detect_motion",
            .run = [wanted](Subject& subject) { subject.motion = &subject.world.detect_motion(wanted); }};
  call.changes_nothing = true;
  return call;
}

// The step before, if it did not fail.
Call RandomCalls::draw() {
  Call call{.name = "draw", .run = [](Subject& subject) {
              if (subject.last_report == nullptr) return;
              CountingDrawer drawer;
              keep_refusal(subject, [&] {
                debug_draw(subject.world, *subject.last_report, drawer, {.surfaces = true, .planes = true});
                subject.drawn = drawer.value();
              });
            }};
  call.changes_nothing = true;
  return call;
}

void RandomCalls::build(Subject& subject) const {
  Mesh filler;
  filler.positions = Eigen::Matrix3Xd::Constant(3, 1, 50.0);
  subject.ids.assign(slots_.size(), {});
  tact::World& world = subject.world;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    const auto& [body, generation] = slots_[slot];
    for (int earlier = body ? 1 : 0; earlier < generation; ++earlier) {
      if (subject.ids[slot] != BodyId{}) world.remove_body(subject.ids[slot]);
      subject.ids[slot] = world.add_body({.positions = filler.positions, .facets = filler.facets});
    }
    if (!body) continue;
    if (subject.ids[slot] != BodyId{}) world.remove_body(subject.ids[slot]);
    BodyDefinition definition = body->definition(body->rigid ? Motion::rigid : Motion::deformable);
    definition.positions = body->first;
    const BodyId id = world.add_body(definition);
    subject.ids[slot] = id;
    if (!body->rigid) world.set_positions(id, body->mesh.positions);
    if (body->pose) world.set_pose(id, body->pose->rotation, body->pose->translation);
    if (body->motion == Motion::fixed) world.set_motion(id, Motion::fixed);
  }
  for (const std::size_t slot : free_) world.remove_body(std::exchange(subject.ids[slot], {}));
  for (const auto& [a, b] : excluded_) world.set_excluded(subject.ids[a], subject.ids[b], true);
}

}  // namespace tact::tests
