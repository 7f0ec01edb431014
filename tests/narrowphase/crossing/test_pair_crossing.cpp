#include <gtest/gtest.h>

#include <array>

#include "narrowphase/crossing/pair_crossing.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// Two flaps that hang through a sheet, and whose ends share a vertex below it: one crossing, though no facet that meets
// the sheet joins them.
TEST(PairCrossing, ThatIsConnectedPastASheetIsOnePatch) {
  Mesh flaps, sheet;
  flaps.positions.resize(3, 7);
  flaps.positions.transpose() << -1, 0, 0.5, -1, -0.1, -0.5, -1, 0.1, -0.5, 1, 0, 0.5, 1, -0.1, -0.5, 1, 0.1, -0.5,  //
      0, 0, -0.5;
  flaps.facets.resize(3, 4);
  flaps.facets.transpose() << 0, 1, 2, 3, 4, 5, 1, 6, 2, 4, 6, 5;
  sheet.positions.resize(3, 3);
  sheet.positions.transpose() << -10, -10, 0, 10, -10, 0, 0, 20, 0;
  sheet.facets = Eigen::Vector3i(0, 1, 2);
  const ClusteredMesh mesh_a = tests::clustered(flaps), mesh_b = tests::clustered(sheet);
  const Features of_a(mesh_a), of_b(mesh_b);
  const std::array<FacetPair, 2> pairs{{{0, 0}, {1, 0}}};
  PairCrossing crossing;
  const Cut& cut = crossing
                       .find({.a = {&mesh_a, &of_a},
                              .b = {&mesh_b, &of_b},
                              .surface_a = SurfaceKind::sheet,
                              .surface_b = SurfaceKind::sheet,
                              .direction = {0, 0, -1},
                              .depth = 1.0,
                              .facet_pairs = pairs,
                              .carried = {}})
                       .a()
                       .cut;
  EXPECT_EQ(cut.past().size(), 5u);
  EXPECT_EQ(cut.patch_count(), 1);
  for (int v = 0; v < 7; ++v) EXPECT_EQ(cut.patch_of(v), 0) << v;
}

}  // namespace
}  // namespace tact::narrowphase
