#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "scenes/files/polygon.h"
#include "tests/scenes/mesh_bytes.h"

namespace tact::scenes {
namespace {

using tests::Corners;
using Integers = std::array<std::int64_t, 2>;  // a corner in a plane
using Outline = std::vector<Integers>;

std::vector<std::array<double, 3>> in_space(const Outline& outline) {
  std::vector<std::array<double, 3>> corners;
  for (const auto& [x, y] : outline) corners.push_back({static_cast<double>(x), static_cast<double>(y), 5.0});
  return corners;
}

// Twice the signed area.
std::int64_t area_of(const Integers& a, const Integers& b, const Integers& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
std::int64_t area_of(const Outline& outline) {
  std::int64_t area = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) area += area_of(outline[0], outline[i], outline[i + 1]);
  return area;
}

PolygonSplit::Kind kind_of(const Outline& outline) { return split_polygon(in_space(outline)).kind; }

// Every triangle turns as the outline, and together they have its area: so each place inside is covered once.
void expect_covered(const Outline& outline, const std::string& what) {
  const PolygonSplit split = split_polygon(in_space(outline));
  ASSERT_NE(split.kind, PolygonSplit::not_simple) << what;
  std::vector<std::array<std::size_t, 3>> triangles = split.triangles;
  if (split.kind == PolygonSplit::fan) {
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) triangles.push_back({0, i, i + 1});
  }
  ASSERT_EQ(triangles.size(), outline.size() - 2) << what;
  const std::int64_t area = area_of(outline), turning = area < 0 ? -1 : 1;
  std::int64_t sum = 0;
  std::map<std::array<std::size_t, 2>, int> edges;
  for (const auto& [a, b, c] : triangles) {
    const std::int64_t part = area_of(outline[a], outline[b], outline[c]);
    EXPECT_GE(part * turning, 0) << what;
    sum += part;
    for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) ++edges[edge];
  }
  EXPECT_EQ(sum, area) << what;
  for (std::size_t i = 0; i < outline.size(); ++i) EXPECT_EQ((edges[{i, (i + 1) % outline.size()}]), 1) << what;
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 1) << what;
}

// From every first corner, both ways round, in all three planes.
void expect_covered_from_all_corners(Outline outline, const std::string& what) {
  for (int turned = 0; turned < 2; ++turned) {
    for (std::size_t first = 0; first < outline.size(); ++first) {
      expect_covered(outline, what + ", first corner " + std::to_string(first));
      std::rotate(outline.begin(), outline.begin() + 1, outline.end());
    }
    std::reverse(outline.begin(), outline.end());
  }
}

TEST(Polygon, AFanThatIsRightStays) {
  EXPECT_EQ(kind_of({{0, 0}, {1, 0}, {0, 1}}), PolygonSplit::fan);
  EXPECT_EQ(kind_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}}), PolygonSplit::fan);
  EXPECT_EQ(kind_of({{1, 1}, {0, 4}, {0, 0}, {4, 0}}), PolygonSplit::fan) << "a dart from the corner that sees all";
  EXPECT_EQ(kind_of({{0, 4}, {0, 0}, {4, 0}, {1, 1}}), PolygonSplit::ears) << "the same from another";
  EXPECT_EQ(kind_of({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}), PolygonSplit::fan) << "a corner that is straight";
}

TEST(Polygon, WhatHasNoAreaKeepsItsFan) {
  EXPECT_EQ(kind_of({{0, 0}, {1, 1}, {2, 2}, {3, 3}}), PolygonSplit::fan);
  EXPECT_EQ(kind_of({{0, 0}, {0, 0}, {0, 0}, {0, 0}}), PolygonSplit::fan);
  EXPECT_EQ(kind_of({{0, 0}, {2, 0}, {0, 0}, {2, 0}}), PolygonSplit::fan);
  EXPECT_EQ(kind_of({{0, 0}, {2, 0}, {2, 0}, {0, 2}}), PolygonSplit::fan) << "a triangle with a corner twice";
}

TEST(Polygon, ConcaveOnesAreCovered) {
  expect_covered_from_all_corners({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}, "a notch");
  expect_covered_from_all_corners({{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 4}, {4, 4}, {4, 2}, {0, 2}}, "a C");
  expect_covered_from_all_corners(
      {{0, 0}, {9, 0}, {9, 7}, {2, 7}, {2, 3}, {5, 3}, {5, 5}, {4, 5}, {4, 4}, {3, 4}, {3, 6}, {8, 6}, {8, 1}, {0, 1}},
      "a spiral");
  expect_covered_from_all_corners({{0, 0}, {2, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 1}, {2, 1}, {0, 4}}, "corners twice");
  expect_covered_from_all_corners({{0, 0}, {2, 0}, {4, 0}, {6, 0}, {3, 5}, {3, 1}}, "straight corners");
}

// The outline goes to a hole and back on the same two corners.
TEST(Polygon, HolesAtTheEndOfABridgeAreNoCrossing) {
  expect_covered_from_all_corners({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}},
                                  "one hole");
  expect_covered_from_all_corners({{0, 0},
                                   {20, 0},
                                   {20, 9},
                                   {0, 9},
                                   {0, 0},
                                   {3, 3},
                                   {3, 6},
                                   {6, 6},
                                   {12, 6},
                                   {12, 7},
                                   {14, 7},
                                   {14, 2},
                                   {12, 6},
                                   {6, 6},
                                   {6, 3},
                                   {3, 3}},
                                  "two holes in a row");
  expect_covered_from_all_corners({{0, 0}, {4, 2}, {8, 0}, {8, 8}, {4, 2}, {0, 8}}, "a corner touched twice");
  expect_covered_from_all_corners({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 4}, {4, 2}}, "a hole in a corner");
}

TEST(Polygon, WhatIsNotSimpleIsRefused) {
  EXPECT_EQ(kind_of({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), PolygonSplit::not_simple) << "a bow tie";
  EXPECT_EQ(kind_of({{0, 0}, {4, 4}, {5, 0}, {0, 4}}), PolygonSplit::not_simple) << "one of two sizes";
  EXPECT_EQ(kind_of({{0, 0}, {2, 2}, {4, 4}, {4, 0}, {2, 2}, {0, 4}}), PolygonSplit::not_simple)
      << "one that crosses in a corner";
  EXPECT_EQ(kind_of({{0, 3}, {9, 6}, {3, -2}, {3, 8}, {9, 0}}), PolygonSplit::not_simple) << "a star in one line";
  EXPECT_EQ(kind_of({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 2}, {6, 2}, {6, 6}, {2, 6}, {2, 2}}),
            PolygonSplit::not_simple)
      << "a hole that turns as its outline";
  EXPECT_EQ(kind_of({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {4, 2}, {2, 4}}), PolygonSplit::not_simple)
      << "the same, at a corner";
  EXPECT_EQ(kind_of({{0, 0}, {8, 0}, {8, 8}, {4, 0}, {0, 8}}), PolygonSplit::not_simple) << "a corner on an edge";
  EXPECT_EQ(kind_of({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {8, 0}, {8, 8}, {0, 8}}), PolygonSplit::not_simple)
      << "twice round";
}

// Corners in any order become an outline without a crossing: as long as two edges cross, what is between them turns.
Outline random_outline(int corners, std::mt19937_64& random) {
  const std::int64_t size = 4 + static_cast<std::int64_t>(random() % 40);
  Outline outline;
  while (static_cast<int>(outline.size()) < corners) {
    const Integers corner{static_cast<std::int64_t>(random()) % size, static_cast<std::int64_t>(random()) % size};
    if (std::find(outline.begin(), outline.end(), corner) == outline.end()) outline.push_back(corner);
  }
  const auto sign = [](std::int64_t x) { return (x > 0) - (x < 0); };
  for (bool crossing = true; crossing;) {
    crossing = false;
    for (std::size_t i = 0; i + 2 < outline.size(); ++i) {
      for (std::size_t j = i + 2; j < outline.size(); ++j) {
        const Integers a = outline[i], b = outline[i + 1], c = outline[j], d = outline[(j + 1) % outline.size()];
        if (sign(area_of(a, b, c)) * sign(area_of(a, b, d)) >= 0 ||
            sign(area_of(c, d, a)) * sign(area_of(c, d, b)) >= 0)
          continue;
        std::reverse(outline.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     outline.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        crossing = true;
      }
    }
  }
  return outline;
}

// Corners on edges and edges on each other are what such outlines may still have: those are refused, none else.
bool touches_itself(const Outline& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Integers &a = outline[i], &b = outline[(i + 1) % n];
    for (std::size_t k = 0; k < n; ++k) {
      const Integers& p = outline[k];
      if (k == i || k == (i + 1) % n || area_of(a, b, p) != 0) continue;
      if (std::min(a, b) < p && p < std::max(a, b)) return true;
    }
  }
  return false;
}

TEST(Polygon, RandomOutlinesAreCoveredOrTouchThemselves) {
  std::mt19937_64 random(17);
  int ears = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const Outline outline = random_outline(4 + static_cast<int>(random() % 12), random);
    const std::string what = "seed 17, case " + std::to_string(i);
    const PolygonSplit::Kind kind = kind_of(outline);
    if (kind == PolygonSplit::not_simple) {
      EXPECT_TRUE(touches_itself(outline)) << what;
      ++refused;
    } else {
      expect_covered(outline, what);
      if (kind == PolygonSplit::fan) continue;
      EXPECT_FALSE(touches_itself(outline)) << what;
      ++ears;
    }
  }
  EXPECT_GT(ears, 1500);
  EXPECT_GT(refused, 100);
}

// The plane is that of the polygon, whatever its place and size.
TEST(Polygon, EveryPlaneAndSize) {
  const Outline dart{{0, 4}, {0, 0}, {4, 0}, {1, 1}};
  for (const double size : {0x1p-1060, 1e-200, 1.0, 0x1p290}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<std::array<double, 3>> corners;
      for (const auto& [x, y] : dart) {
        std::array<double, 3> corner;
        corner[axis] = size * static_cast<double>(x + y);
        corner[(axis + 1) % 3] = size * static_cast<double>(x);
        corner[(axis + 2) % 3] = size * static_cast<double>(y);
        corners.push_back(corner);
      }
      EXPECT_EQ(split_polygon(corners).kind, PolygonSplit::ears) << size << " " << axis;
    }
  }
}

// Before this all three were fans of their first corner, which cover the notch.
TEST(Polygon, AllReadersSplitByShape) {
  const std::vector<Corners> right{{3, 0, 1}, {3, 1, 2}};  // the corner in the notch is the last one
  const std::string obj = "v 0 4 0\nv 0 0 0\nv 4 0 0\nv 1 1 0\nf 1 2 3 4\n";
  const std::string off = "OFF\n4 1 0\n0 4 0\n0 0 0\n4 0 0\n1 1 0\n4 0 1 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 4 0\n0 0 0\n4 0 0\n1 1 0\n4 0 1 2 3\n";
  for (const auto& [format, bytes] :
       {std::pair{MeshFormat::obj, obj}, std::pair{MeshFormat::off, off}, std::pair{MeshFormat::ply, ply}}) {
    const MeshFile mesh = parse_mesh(format, bytes, "m");
    std::vector<Corners> facets = tests::facets_of(mesh);
    for (Corners& facet : facets) std::rotate(facet.begin(), std::max_element(facet.begin(), facet.end()), facet.end());
    std::sort(facets.begin(), facets.end());
    EXPECT_EQ(facets, right);
    EXPECT_EQ(mesh.fans.cols(), 2);
    EXPECT_EQ(tests::facets_of(parse_mesh(format, bytes, "m", Split::fans)),
              (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}));
  }
}

TEST(Polygon, AllReadersRefuseWhatIsNotSimpleNamingTheLine) {
  const std::string what =
      "the polygon of 4 corners crosses or touches itself, seen along its normal: it has more than "
      "one surface";
  EXPECT_EQ(tests::refusal(MeshFormat::obj, "v 0 0 0\nf 1 2 3 4\nf 1 2 4\nv 4 4 0\nv 4 0 0\nv 0 4 0\n"),
            "m:2: facet 0: " + what);
  EXPECT_EQ(tests::refusal(MeshFormat::off, "OFF\n4 2 0\n0 0 0\n4 4 0\n4 0 0\n0 4 0\n3 0 1 2\n4 0 1 2 3\n"),
            "m:8: facet 1: " + what);
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  std::string body;
  for (const float x : {0.f, 0.f, 0.f, 4.f, 4.f, 0.f, 4.f, 0.f, 0.f, 0.f, 4.f, 0.f}) body += tests::bytes_of(x);
  EXPECT_EQ(tests::refusal(MeshFormat::ply, head + body + std::string("\4\0\1\2\3", 5)),
            "m: byte " + std::to_string(head.size() + body.size() + 4) + ": facet 0: " + what);
}

}  // namespace
}  // namespace tact::scenes
