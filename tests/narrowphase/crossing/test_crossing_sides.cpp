#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "narrowphase/crossing/crossing_sides.h"

namespace tact::narrowphase {
namespace {

// Facets 1, 5, 3 and 8 meet in a row; 2 meets 9.
TEST(CrossingLines, HaveTwoLayersThatMeetEachOther) {
  const std::vector<FacetPair> pairs{{1, 5}, {2, 9}, {3, 5}, {3, 8}};
  CrossingLines lines;
  lines.find(pairs);
  EXPECT_EQ(lines.count(), 2u);
  for (const int facet : {1, 5, 3, 8}) EXPECT_EQ(lines.line_of(facet), 0) << facet;
  for (const int facet : {2, 9}) EXPECT_EQ(lines.line_of(facet), 1) << facet;
  for (const int facet : {1, 3, 2}) EXPECT_EQ(lines.layer_of(facet), 1.0) << facet;
  for (const int facet : {5, 8, 9}) EXPECT_EQ(lines.layer_of(facet), -1.0) << facet;
}

// Three layers through each other have none; another line keeps its two.
TEST(CrossingLines, HaveNoLayersWhereOneMeetsItself) {
  const std::vector<FacetPair> pairs{{0, 4}, {0, 7}, {1, 2}, {4, 7}, {7, 8}};
  CrossingLines lines;
  lines.find(pairs);
  EXPECT_EQ(lines.count(), 2u);
  for (const int facet : {0, 4, 7, 8}) EXPECT_EQ(lines.layer_of(facet), 0.0) << facet;
  EXPECT_EQ(lines.layer_of(1), 1.0);
  EXPECT_EQ(lines.layer_of(2), -1.0);
}

// A point with normals from a to b: the side of what is b's is along them, that of what is a's against them.
TEST(LastPoints, TellTheSideFromTheOtherToTheOwnFeature) {
  FeaturePoint point;
  point.a = {3, -1, -1};
  point.b = {5, 6, 7};
  point.normal = {0.0, 0.0, 1.0};
  LastPoints last;
  last.take({&point, 1});
  const std::array vertex{3};
  const std::array facet{5, 6, 7}, beyond{8, 9, 10};
  EXPECT_EQ(last.side(vertex, facet), (Vec3{0.0, 0.0, -1.0}));
  EXPECT_EQ(last.side(facet, vertex), (Vec3{0.0, 0.0, 1.0}));
  EXPECT_EQ(last.side(vertex, beyond), Vec3{});
}

}  // namespace
}  // namespace tact::narrowphase
