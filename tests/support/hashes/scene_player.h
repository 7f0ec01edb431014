// A world whose answers are hashed while it is played.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/generators/random.h"
#include "tests/support/hashes/answer_hash.h"
#include "tests/support/hashes/hash_scenes.h"
#include "tests/support/mesh.h"

namespace tact::tests {

struct SceneBody {
  Mesh mesh;
  Surface surface = Surface::closed;
  double margin = 0.0;
  bool self_contact = false;
  Motion motion = Motion::deformable;
  std::uint32_t layer = 1;
};

class ScenePlayer {
 public:
  explicit ScenePlayer(const Settings& settings) : world_(settings) {}

  BodyId add(const SceneBody& body);
  void add(std::span<const SceneBody> bodies);
  std::size_t size() const { return bodies_.size(); }
  BodyId id(std::size_t i) const { return ids_[i]; }
  // As they are now, but for those that poses moved.
  const Mesh& mesh(std::size_t i) const { return bodies_[i]; }

  void remove(std::size_t i);
  // Sets positions.
  void move(std::size_t i, const Mesh& mesh);
  void shift(std::size_t i, Vec3 by) { move(i, translated(bodies_[i], by)); }
  // Poses of all bodies that were added as rigid: each turned from its rest shape by the quaternion (1, turn) and
  // moved.
  void pose(std::span<const std::size_t> which, std::span<const Vec3> turns, std::span<const Vec3> moves);
  // All bodies but a quarter of them drift at random and tremble, those that are moving.
  void drift(double speed, Random& random);

  const Report& step();
  void find_impacts(Impacts wanted);

  tact::World& world() { return world_; }
  AnswerHash& hash() { return answers_; }
  SceneHashes hashes() const;

 private:
  tact::World world_;
  std::vector<BodyId> ids_;
  std::vector<Mesh> bodies_;
  std::vector<bool> moves_;
  AnswerHash answers_;
  std::uint64_t reports_ = 0, work_ = 0;
};

}  // namespace tact::tests
