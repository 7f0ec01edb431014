// Random calls of every kind, for worlds that each make the same ones and must answer the same.
#pragma once

#include <tact/debug_draw.h>
#include <tact/tact.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/generators/random.h"
#include "tests/support/hashes/answer_hash.h"
#include "tests/support/mesh.h"

namespace tact::tests {

// A world, what names its bodies, and what its last call answered. A call writes here, so that it takes no memory but
// its own.
struct Subject {
  explicit Subject(const Settings& settings) : world(settings), threads(settings.threads) {}

  tact::World world;
  int threads;                  // of this world: no answer depends on them
  std::vector<BodyId> ids;      // by slot; no body's where there is none
  bool leaves_out_ids = false;  // of points, in answers
  AnswerHash::PatchNumbers patches;

  BodyId added;
  std::optional<ErrorCode> refused;
  const Report* report = nullptr;
  const Report* last_report = nullptr;  // of the last call, if it was a step
  const MotionReport* motion = nullptr;
  std::vector<RayHit> hits;
  std::vector<ClosestPoint> closest;
  std::vector<FacetOfBody> facets;
  std::vector<std::vector<FacetOfBody>> facets_of_each;
  std::vector<BodyId> bodies;
  std::vector<std::vector<BodyId>> bodies_of_each;
  std::uint64_t drawn = 0;
};

// What the world holds: every setting and position.
AnswerHashes state_of(const Subject& subject);
// What the last call answered; forgets it.
AnswerHashes answer_of(Subject& subject);

struct Call {
  std::string name;
  // Makes room for answers.
  std::function<void(Subject&)> prepare = [](Subject&) {};
  // Errors are kept as an answer, but for those of memory.
  std::function<void(Subject&)> run;
  // Notes what a successful run() means: ids.
  std::function<void(Subject&)> note = [](Subject&) {};
  bool changes_nothing = false;
  bool is_step = false;
};

// Makes calls, and knows what a world that has made them holds.
class RandomCalls {
 public:
  explicit RandomCalls(std::uint64_t seed);

  Call next();
  // Makes what the others hold, anew: ids are the same but for the number of the world, and those that come next.
  void build(Subject& subject) const;
  Settings settings(int threads) const;
  // Whether facets of a body have changed: ids of its points are not those of a body that is added with them.
  bool any_renamed() const;

 private:
  struct Body {
    Mesh mesh;               // where it is; of a rigid body where it rests
    Eigen::Matrix3Xd first;  // where it was when it got its facets, which tells whether it has an inside
    Surface surface = Surface::closed;
    Motion motion = Motion::deformable;
    bool rigid = false;
    std::optional<PoseUpdate> pose = {};
    std::uint32_t layer = 1, mask = ~0u, group = 0;
    double margin = 0.0;
    bool self_contact = false;
    std::string name = {};
    bool renamed = false;
    BodyDefinition definition(Motion as) const;
  };
  struct Slot {
    std::optional<Body> body;
    int generation = 0;
  };

  Mesh shape();
  Vec3 place();
  std::optional<std::size_t> any_body();
  std::optional<std::size_t> any_body(bool rigid, bool may_be_fixed);
  Mesh moved(const Mesh& mesh);
  Call add();
  Call remove();
  Call move();
  Call move_many();
  Call pose(bool many);
  Call change_facets();
  Call set();
  Call exclude();
  Call set_settings();
  Call refused();
  Call query();
  Call query_many();
  Call detect();
  Call detect_motion();
  Call draw();
  PoseUpdate any_pose();

  Random random_;
  std::vector<Slot> slots_;
  std::vector<std::size_t> free_;
  std::vector<std::pair<std::size_t, std::size_t>> excluded_;
  Settings settings_;
  bool was_step_ = false;
};

}  // namespace tact::tests
