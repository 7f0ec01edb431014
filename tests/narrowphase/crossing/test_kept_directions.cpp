#include <gtest/gtest.h>

#include "narrowphase/crossing/pair_crossing.h"
#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// A plate, and a spike from above whose tip is in it.
class SpikeInPlate {
 public:
  explicit SpikeInPlate(double height_of_tip)
      : spike_(tests::translated(tests::spike({0, 0, -1}, 0.25), {0.1, 0.2, 1.0 + height_of_tip})) {
    for (int a = 0; a < plate_.facet_count(); ++a) {
      for (int b = 0; b < spike_.facet_count(); ++b) {
        PredicateCounts counts;
        if (triangle_triangle_meet(of_plate_.triangle(of_plate_.facet_of_source(a)),
                                   of_spike_.triangle(of_spike_.facet_of_source(b)), counts))
          pairs_.push_back({a, b});
      }
    }
  }

  const Crossing& with(const CarriedPoints& last) {
    return crossing_.find({.a = {&of_plate_, &features_of_plate_},
                           .b = {&of_spike_, &features_of_spike_},
                           .direction = {0, 0, 1},
                           .depth = 2.0,
                           .facet_pairs = pairs_,
                           .carried = last});
  }
  static constexpr int kTip = 3;  // vertex of the spike

 private:
  Mesh plate_ = tests::box({-2, -2, -0.125}, {2, 2, 0.125}), spike_;
  ClusteredMesh of_plate_ = tests::clustered(plate_), of_spike_ = tests::clustered(spike_);
  Features features_of_plate_{of_plate_}, features_of_spike_{of_spike_};
  std::vector<FacetPair> pairs_;
  PairCrossing crossing_;
};

// What the upper corners of the plate remember, which say down, and the tip.
struct Memory {
  double gap_of_corners, gap_of_tip;
};

Vec3 kept_by_tip(SpikeInPlate& meshes, const Memory& memory, double exit_along_z) {
  std::vector<CarriedNormal> corners, tip;
  for (const int corner : {4, 5, 6, 7}) corners.push_back({corner, {0, 0, -1}, memory.gap_of_corners});
  tip.push_back({SpikeInPlate::kTip, {0, 0, 1}, memory.gap_of_tip});
  const Crossing& crossing = meshes.with({.of_a = corners, .of_b = tip, .of_edges = {}});
  const NearestExit* const exit = crossing.b().exits.find(SpikeInPlate::kTip);
  EXPECT_NE(exit, nullptr);
  if (exit != nullptr) {
    EXPECT_NEAR(exit->direction.z, exit_along_z, 1e-12);
  }
  return crossing.b().kept_by(SpikeInPlate::kTip);
}

// Corners of the plate have come out downwards, and the tip comes in: it goes down, too, farther than up.
TEST(KeptDirections, AreOfCrossingsOfWhichNothingIsPastAnyMore) {
  SpikeInPlate meshes(0.0625);
  EXPECT_EQ(kept_by_tip(meshes, {.gap_of_corners = -0.5, .gap_of_tip = 0.01}, -1.0), (Vec3{0, 0, -1}));
}

TEST(KeptDirections, AreNoneWhereAVertexStaysOrNothingWasPast) {
  SpikeInPlate meshes(0.0625);
  EXPECT_EQ(kept_by_tip(meshes, {.gap_of_corners = -0.5, .gap_of_tip = -0.03}, 1.0), Vec3{});
  EXPECT_EQ(kept_by_tip(meshes, {.gap_of_corners = 0.5, .gap_of_tip = 0.01}, 1.0), Vec3{});
}

// A lower corner of the plate was in something, and is a corner of no facet that meets any more.
TEST(KeptDirections, OfEndedCrossingsAreWhereNewOnesCameFrom) {
  SpikeInPlate meshes(0.0625);
  const std::vector<CarriedNormal> corner = {{0, {0, 0, -1}, -0.5}};
  const Crossing& crossing = meshes.with({.of_a = corner, .of_b = {}, .of_edges = {}});
  CrossingGroups groups;
  groups.find(crossing);
  ASSERT_EQ(groups.count(), 1);
  KeptDirections directions;
  directions.find(crossing, groups);
  EXPECT_EQ(directions.came(0), (Vec3{0, 0, -1}));
  EXPECT_EQ(directions.kept(0), Vec3{});
}

}  // namespace
}  // namespace tact::narrowphase
