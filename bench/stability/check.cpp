#include "bench/stability/check.h"

#include <tact/world.h>

#include <algorithm>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/stability/shapes.h"
#include "engine/eigen_vectors.h"
#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::bench {
namespace {

constexpr double kDepthTolerance = 1e-12;     // of the pair's size
constexpr double kMinimumTolerance = 1e-12;   // of the pair's size
constexpr double kSmallestTolerance = 1e-10;  // of the pair's size
constexpr int kOtherDirections = 50;          // that the smallest one is held against

std::vector<BodyId> add_bodies(World& world, const StabilityCase& c) {
  std::vector<BodyId> ids;
  for (const StabilityBody& body : c.bodies) {
    ids.push_back(
        world.add_body({.positions = body.mesh.positions, .facets = body.mesh.facets, .surface = body.surface}));
  }
  return ids;
}

void note(StabilityFailures& failures, int StabilityFailures::*kind, const std::string& what) {
  ++(failures.*kind);
  if (failures.first.empty()) failures.first = what;
}

// The truth about the positions of one step.
struct Truth {
  std::vector<Mesh> meshes;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<FacetPair>> pairs;

  explicit Truth(std::vector<Mesh> bodies) : meshes(std::move(bodies)) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      for (std::size_t j = i + 1; j < meshes.size(); ++j) pairs[{i, j}] = facet_pairs_by_oracle(meshes[i], meshes[j]);
    }
  }
};

class Checker {
 public:
  Checker(const StabilityCase& c, DirectionPolicy policy, StabilityFailures& failures)
      : case_(c),
        policy_(policy),
        failures_(failures),
        one_({.threads = 1, .direction = policy}),
        two_({.threads = 2, .direction = policy}) {
    ids_ = add_bodies(one_, c);
    other_ids_ = add_bodies(two_, c);
  }

  void move(const std::vector<Eigen::Matrix3Xd>& moves) {
    ++step_;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (moves[i].cols() == 0) continue;
      one_.set_positions(ids_[i], moves[i]);
      two_.set_positions(other_ids_[i], moves[i]);
    }
  }

  void detect(const Truth& truth) {
    const Report& report = one_.detect();
    if (two_.detect().hash() != report.hash()) fail(&StabilityFailures::hashes, "other hash with 2 threads");
    check_facet_pairs(report, truth);
    check_hulls(report);
    for (const Contact& contact : report.contacts()) check_contact(contact, truth);
    const auto flagged = std::ranges::count_if(report.contacts(), &Contact::limit_reached);
    for (auto i = flagged; i < report.stats().limits_reached; ++i)
      fail(&StabilityFailures::limits, "limit reached, apart");
  }

 private:
  std::size_t number(BodyId id) const { return static_cast<std::size_t>(std::ranges::find(ids_, id) - ids_.begin()); }

  void fail(int StabilityFailures::*kind, const std::string& what) {
    note(failures_, kind,
         what + (policy_ == DirectionPolicy::carried ? ", carried" : ", smallest") + ", step " + std::to_string(step_));
  }

  void check_facet_pairs(const Report& report, const Truth& truth) {
    auto expected = truth.pairs;
    for (const Contact& contact : report.contacts()) {
      auto& pairs = expected[{number(contact.a), number(contact.b)}];
      const SetDifference off = difference(pairs, {contact.facet_pairs().begin(), contact.facet_pairs().end()});
      pairs.clear();
      if (!off.empty()) {
        fail(&StabilityFailures::facet_sets,
             std::to_string(off.missed) + " facet pairs missed, " + std::to_string(off.wrong) + " wrong");
      }
    }
    for (const auto& [bodies, pairs] : expected) {
      if (!pairs.empty())
        fail(&StabilityFailures::facet_sets, std::to_string(pairs.size()) + " facet pairs missed, no contact");
    }
  }

  void check_hulls(const Report& report) {
    if (!case_.hulls_overlap) return;
    const bool found =
        std::ranges::any_of(report.contacts(), [&](const Contact& c) { return c.a == ids_[0] && c.b == ids_[1]; });
    if (found != *case_.hulls_overlap) fail(&StabilityFailures::hulls, found ? "hulls overlap" : "hulls apart");
  }

  void check_contact(const Contact& contact, const Truth& truth) {
    const MinkowskiHeight w = height_of(truth.meshes[number(contact.a)], truth.meshes[number(contact.b)]);
    const long double height = w(from_eigen(contact.direction));
    const long double size = static_cast<long double>(w.size());
    if (contact.limit_reached) fail(&StabilityFailures::limits, "limit reached");
    const double length = contact.direction.norm();
    if (!(length > 1.0 - 1e-14 && length < 1.0 + 1e-14))
      fail(&StabilityFailures::directions, "direction of length " + std::to_string(length));
    const double off = static_cast<double>((static_cast<long double>(contact.depth) - std::max(0.0L, height)) /
                                           (size > 0.0L ? size : 1.0L));
    if (!(std::abs(off) <= kDepthTolerance))
      fail(&StabilityFailures::depths, "depth off by " + std::to_string(off * 1e12) + "e-12 sizes");
    if (height < -kDepthTolerance * size) fail(&StabilityFailures::hulls, "hulls that are apart in contact");
    if (!w.is_local_minimum(from_eigen(contact.direction), kMinimumTolerance * static_cast<double>(size)))
      fail(&StabilityFailures::directions, "no local minimum");
    if (policy_ == DirectionPolicy::smallest && !is_smallest(w, height - kSmallestTolerance * size))
      fail(&StabilityFailures::directions, "not the smallest");
  }

  // Is w nowhere less than `least`?
  static bool is_smallest(const MinkowskiHeight& w, long double least) {
    StabilityRandom random(1);
    for (int i = 0; i < kOtherDirections; ++i) {
      if (w(from_eigen(random.direction())) < least) return false;
    }
    return true;
  }

  const StabilityCase& case_;
  DirectionPolicy policy_;
  StabilityFailures& failures_;
  World one_, two_;
  std::vector<BodyId> ids_, other_ids_;
  int step_ = 0;
};

// A bad body must be refused by the right code, and the world answer as before.
void check_refusal(const StabilityCase& c, StabilityFailures& failures) {
  World world({.threads = 1});
  StabilityCase good = c;
  const StabilityBody bad = good.bodies.back();
  good.bodies.pop_back();
  good.bodies.push_back(good.bodies.front());
  const std::vector<BodyId> ids = add_bodies(world, good);
  const std::uint64_t before = world.detect().hash();
  const auto refuses = [&](const auto& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.code() == ErrorCode::position_out_of_range || error.code() == ErrorCode::non_finite_position;
    }
    return false;
  };
  if (!refuses([&] { world.add_body({.positions = bad.mesh.positions, .facets = bad.mesh.facets}); })) {
    note(failures, &StabilityFailures::exceptions, "bad positions were taken with a body");
  }
  Eigen::Matrix3Xd spoiled = c.bodies.front().mesh.positions;
  spoiled.col(0) = bad.mesh.positions.col(0);
  for (const auto p : bad.mesh.positions.colwise()) {
    if (!(p.array().abs() <= kLargestCoordinate).all()) spoiled.col(0) = p;
  }
  if (!refuses([&] { world.set_positions(ids[0], spoiled); })) {
    note(failures, &StabilityFailures::exceptions, "bad positions were set");
  }
  if (world.detect().hash() != before) note(failures, &StabilityFailures::hashes, "the world changed");
}

}  // namespace

void add(StabilityFailures& sum, const StabilityFailures& one) {
  sum.facet_sets += one.facet_sets;
  sum.hulls += one.hulls;
  sum.depths += one.depths;
  sum.directions += one.directions;
  sum.limits += one.limits;
  sum.exceptions += one.exceptions;
  sum.hashes += one.hashes;
  if (sum.first.empty()) sum.first = one.first;
}

StabilityFailures check_stability(const StabilityCase& c) {
  StabilityFailures failures;
  try {
    if (c.refused) {
      check_refusal(c, failures);
      return failures;
    }
    Checker carried(c, DirectionPolicy::carried, failures), smallest(c, DirectionPolicy::smallest, failures);
    std::vector<Mesh> meshes;
    for (const StabilityBody& body : c.bodies) meshes.push_back(body.mesh);
    const auto step = [&] {
      const Truth truth(meshes);
      carried.detect(truth);
      smallest.detect(truth);
    };
    step();
    for (const std::vector<Eigen::Matrix3Xd>& moves : c.moves) {
      for (std::size_t i = 0; i < moves.size(); ++i) {
        if (moves[i].cols() > 0) meshes[i].positions = moves[i];
      }
      carried.move(moves);
      smallest.move(moves);
      step();
    }
  } catch (const std::exception& error) {
    note(failures, &StabilityFailures::exceptions, error.what());
  }
  return failures;
}

}  // namespace tact::bench
