#include "tests/support/hashes/scene_player.h"

#include <bit>

#include "tests/support/generators/bodies.h"
#include "tests/support/hashes/work_hash.h"

namespace tact::tests {
namespace {

std::uint64_t folded(std::uint64_t fold, std::uint64_t hash) {
  return std::rotl(fold, 17) * 0x9e3779b97f4a7c15u ^ hash;
}

}  // namespace

BodyId ScenePlayer::add(const SceneBody& body) {
  ids_.push_back(world_.add_body({.positions = body.mesh.positions,
                                  .facets = body.mesh.facets,
                                  .surface = body.surface,
                                  .motion = body.motion,
                                  .layer = body.layer,
                                  .margin = body.margin,
                                  .self_contact = body.self_contact}));
  bodies_.push_back(body.mesh);
  moves_.push_back(body.motion == Motion::deformable);
  return ids_.back();
}

void ScenePlayer::add(std::span<const SceneBody> bodies) {
  for (const SceneBody& body : bodies) add(body);
}

void ScenePlayer::move(std::size_t i, const Mesh& mesh) {
  bodies_[i] = mesh;
  world_.set_positions(ids_[i], mesh.positions);
}

void ScenePlayer::pose(std::span<const std::size_t> which, std::span<const Vec3> turns, std::span<const Vec3> moves) {
  std::vector<PoseUpdate> updates;
  for (std::size_t i = 0; i < which.size(); ++i) {
    const Rotation turn = rotation(1.0, turns[i].x, turns[i].y, turns[i].z);
    PoseUpdate& update = updates.emplace_back();
    update.body = ids_[which[i]];
    for (int row = 0; row < 3; ++row) update.rotation.row(row) << turn.row[row].x, turn.row[row].y, turn.row[row].z;
    update.translation << moves[i].x, moves[i].y, moves[i].z;
  }
  world_.set_poses(updates);
}

void ScenePlayer::drift(double speed, Random& random) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves_[i] || random.chance(0.25)) continue;
    const Mesh drifted = translated(bodies_[i], speed * random.in_ball());
    move(i, jittered(drifted, 0.1 * speed, random.bits()));
  }
}

const Report& ScenePlayer::step() {
  const Report& report = world_.detect();
  reports_ = folded(reports_, report.hash());
  work_ = folded(work_, work_hash(report));
  answers_.add(report);
  return report;
}

void ScenePlayer::remove(std::size_t i) {
  world_.remove_body(ids_[i]);
  moves_[i] = false;
}

void ScenePlayer::find_impacts(Impacts wanted) { answers_.add(world_.detect_motion(wanted)); }

SceneHashes ScenePlayer::hashes() const {
  const AnswerHashes answers = answers_.hashes();
  return {{reports_, answers.features, answers.numbers}, work_};
}

}  // namespace tact::tests
