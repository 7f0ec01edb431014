// Sequences of calls made by RapidCheck, which shrinks one that fails to the few calls that matter: whatever a world
// has been through, its facet pairs are those of a fresh one, and so is its depth where the smallest is asked for.
//   RC_PARAMS  RapidCheck's, such as "seed=7 max_success=10000"; seed=1 if not set
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {

enum class Call { add, remove, move, move_many, teleport, crumple, smallest, carried, refused, detect };

constexpr const char* kCallNames[] = {"add",     "remove",   "move",    "move_many", "teleport",
                                      "crumple", "smallest", "carried", "refused",   "detect"};

// A call, on body number `body` modulo the bodies that there are; `seed` tells which shape and where to.
struct Change {
  Call call;
  int body;
  int seed;
};

void showValue(const Change& change, std::ostream& out) {
  out << kCallNames[static_cast<int>(change.call)] << " " << change.body << " " << change.seed;
}

}  // namespace tact::tests

template <>
struct rc::Arbitrary<tact::tests::Change> {
  static rc::Gen<tact::tests::Change> arbitrary() {
    using tact::tests::Call;
    return rc::gen::construct<tact::tests::Change>(rc::gen::weightedElement<Call>({{5, Call::add},
                                                                                   {1, Call::remove},
                                                                                   {5, Call::move},
                                                                                   {2, Call::move_many},
                                                                                   {2, Call::teleport},
                                                                                   {1, Call::crumple},
                                                                                   {1, Call::smallest},
                                                                                   {1, Call::carried},
                                                                                   {1, Call::refused},
                                                                                   {3, Call::detect}}),
                                                   rc::gen::inRange(0, 12), rc::gen::inRange(0, 10000));
  }
};

namespace tact::tests {
namespace {

Mesh shape(std::uint64_t seed) {
  switch (seed % 8) {
    case 0: return icosphere(1);
    case 1: return blob(1, 1.0, 0.4, seed);
    case 2: return gridded_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 2);
    case 3: return wrinkled_sheet(5, 2.0, 0.5, seed);
    case 4: return sheet(4, 4, 2.0, 2.0);
    case 5: return lattice_soup(20, 1, seed);
    case 6: return soup(20, 1.0, seed);
    default: return random_hull(10, seed);
  }
}

struct BodyAndMesh {
  BodyId id;
  Mesh mesh;
};

// A world and what it should hold.
class Model {
 public:
  explicit Model(const base::Tuning& tuning) { world_.set_tuning(tuning); }

  void apply(const Change& change) {
    Random random(static_cast<std::uint64_t>(change.seed));
    const Vec3 by = random.in_cube(1.0);  // first: the order of arguments is the compiler's
    BodyAndMesh* body = bodies_.empty() ? nullptr : &bodies_[static_cast<std::size_t>(change.body) % bodies_.size()];
    switch (change.call) {
      case Call::add: return add(translated(shape(random.bits()), by));
      case Call::smallest: return set_direction(DirectionPolicy::smallest);
      case Call::carried: return set_direction(DirectionPolicy::carried);
      case Call::detect: return detect();
      case Call::move_many: return move_many(random);
      default: break;
    }
    if (body == nullptr) return;
    switch (change.call) {
      case Call::remove: return remove(*body);
      case Call::teleport: return move(*body, rotated(translated(body->mesh, by), random.rotation()));
      case Call::crumple: return move(*body, crumpled(body->mesh, random.bits()));
      case Call::refused: return be_refused(*body);
      default: return move(*body, translated(body->mesh, 0.1 * by));
    }
  }

  void detect() {
    World fresh({.threads = 1, .direction = direction_});
    std::vector<BodyId> ids, fresh_ids;
    for (const BodyAndMesh& body : bodies_) {
      ids.push_back(body.id);
      fresh_ids.push_back(fresh.add_body({.positions = body.mesh.positions, .facets = body.mesh.facets}));
    }
    const Report &report = world_.detect(), &expected = fresh.detect();
    const auto same = same_meeting_bodies(meeting_bodies(expected, fresh_ids), meeting_bodies(report, ids));
    if (!same) RC_FAIL(std::string(same.message()));
    RC_ASSERT(report.contacts().size() == expected.contacts().size());
    if (direction_ == DirectionPolicy::smallest)
      RC_ASSERT(std::abs(sum_of_depths(report) - sum_of_depths(expected)) < 1e-9);
  }

 private:
  // Bodies of the two worlds have other numbers, and so the pairs another order.
  static double sum_of_depths(const Report& report) {
    double sum = 0.0;
    for (const Contact& contact : report.contacts()) sum += contact.depth;
    return sum;
  }

  void add(const Mesh& mesh) {
    if (bodies_.size() < 12)
      bodies_.push_back({world_.add_body({.positions = mesh.positions, .facets = mesh.facets}), mesh});
  }

  void remove(const BodyAndMesh& body) {
    world_.remove_body(body.id);
    bodies_.erase(bodies_.begin() + (&body - bodies_.data()));
  }

  void move(BodyAndMesh& body, Mesh to) {
    body.mesh = std::move(to);
    world_.set_positions(body.id, body.mesh.positions);
  }

  void move_many(Random& random) {
    std::vector<PositionsUpdate> updates;
    for (BodyAndMesh& body : bodies_) {
      if (random.chance(0.3)) continue;
      body.mesh = translated(body.mesh, 0.1 * random.in_ball());
      updates.push_back({body.id, body.mesh.positions});
    }
    world_.set_positions(updates);
  }

  void set_direction(DirectionPolicy direction) {
    direction_ = direction;
    world_.set_settings({.threads = 1, .direction = direction});
  }

  void be_refused(const BodyAndMesh& body) {
    Eigen::Matrix3Xd bad = 2.0 * body.mesh.positions;
    bad(1, bad.cols() - 1) = HUGE_VAL;
    RC_ASSERT_THROWS_AS(world_.set_positions(body.id, bad), Error);
    RC_ASSERT_THROWS_AS(world_.set_settings({.threads = -1}), Error);
    RC_ASSERT_THROWS_AS(world_.remove_body({}), Error);
  }

  RecordedWorld world_{{.threads = 1}};
  DirectionPolicy direction_ = DirectionPolicy::carried;
  std::vector<BodyAndMesh> bodies_;
};

TEST(CallSequences, LeaveAWorldThatAnswersAsAFreshOne) {
  setenv("RC_PARAMS", "seed=1 max_success=400 max_size=100", 0);
  EXPECT_TRUE(rc::check("after any calls a world answers as a fresh one", [](const std::vector<Change>& changes) {
    constexpr std::array kWays{base::kTuning, kPlain, base::kTuning, kForced};
    Model model(kWays[*rc::gen::inRange<std::size_t>(0, kWays.size())]);
    for (const Change& change : changes) model.apply(change);
    model.detect();
  }));
}

}  // namespace
}  // namespace tact::tests
