// Real meshes, whole, broken and moving: the facet pairs are those of the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "tests/support/checks/contact_checks.h"
#include "tests/support/checks/detection.h"
#include "tests/support/data/data_sets.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::tests {
namespace {

constexpr const char* kFiles[] = {"spot.ply",
                                  "fish.obj",
                                  "dress.ply",
                                  "dense_sheet.obj",
                                  "cloth80x80.obj",
                                  "cloth_sphere.obj",
                                  "seq_cloth_on_sphere/cloth_045.obj",
                                  "seq_toy_poses/cheburashka-01.obj",
                                  "messy/cycloidal.ply",
                                  "messy/openscad-nonmanifold-crash.obj",
                                  "messy/l_tibia_SOMEINVERTEDFACES.obj",
                                  "messy/triple_vierbein.obj",
                                  "small_answers/two-cubes-close.ply",
                                  "small_answers/two-cubes-far.ply",
                                  "small_answers/two-cubes-intersecting.ply",
                                  "small_answers/two-layer-ball.ply",
                                  "small_answers/thick-cloth-t0.ply",
                                  "small_answers/thick-cloth-t1.ply"};
constexpr std::size_t kFirstMessy = 8;

std::vector<Mesh> all_files() {
  std::vector<Mesh> meshes;
  for (const char* name : kFiles) meshes.push_back(read_data(name));
  return meshes;
}

// Moved and scaled to the middle and the size of `other`, turned at random, then a little off.
Mesh placed_in(const Mesh& mesh, const Mesh& other, std::uint64_t seed) {
  Random random(seed);
  const double size = extent(other);
  const Mesh unit = scaled(translated(mesh, -centroid(mesh)), 0.8 * size / extent(mesh));
  return translated(rotated(unit, random.rotation()), centroid(other) + 0.3 * size * random.in_ball());
}

TEST(DataSets, VerticesAreReadAtMostOneAndAHalfTimes) {
  TACT_SKIP_WITHOUT_DATA();
  for (std::size_t i = 0; i < kFirstMessy; ++i) {
    const narrowphase::ClusteredMesh clusters = clustered(read_data(kFiles[i]));
    EXPECT_LE(clusters.vertex_reads(), 3 * clusters.vertex_count() / 2) << kFiles[i];
  }
}

// Calls check(a, b, names) for every pair of files, the second one placed in the first.
template <class Check>
void for_each_pair_of_files(const Check& check) {
  const std::vector<Mesh> meshes = all_files();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      check(meshes[j], placed_in(meshes[i], meshes[j], 100 * i + j), std::string(kFiles[j]) + ", " + kFiles[i]);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(DataSets, EveryFileMeetsEveryOtherAsTheOracleSays) {
  TACT_SKIP_WITHOUT_DATA();
  int meeting = 0;
  for_each_pair_of_files([&](const Mesh& a, const Mesh& b, const std::string& names) {
    const std::vector<FacetPair> expected = facet_pairs_by_oracle(a, b);
    ASSERT_TRUE(same_facet_pairs(expected, facet_pairs_by_engine(a, b))) << names;
    meeting += expected.empty() ? 0 : 1;
  });
  EXPECT_GT(meeting, 120);
}

TEST(DataSets, DirectionsAndDepthsOfEveryPairOfFilesAreSound) {
  TACT_SKIP_WITHOUT_DATA();
  int contacts = 0;
  for_each_pair_of_files([&](const Mesh& a, const Mesh& b, const std::string& names) {
    const std::optional<Contact> contact = contact_of(a, b);
    if (!contact) return;
    ++contacts;
    EXPECT_TRUE(is_sound(*contact, a, b)) << names;
  });
  EXPECT_GT(contacts, 120);
}

TEST(DataSets, AllFilesInOneWorldMeetAsTheOracleSays) {
  TACT_SKIP_WITHOUT_DATA();
  std::vector<Mesh> meshes = all_files();
  EXPECT_TRUE(engine_agrees_with_oracle(meshes)) << "as they are";
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Random random(i);
    const Mesh unit = scaled(translated(meshes[i], -centroid(meshes[i])), 1.0 / extent(meshes[i]));
    meshes[i] = translated(rotated(unit, random.rotation()), 0.8 * random.in_ball());
  }
  EXPECT_TRUE(engine_agrees_with_oracle(meshes)) << "in one heap";
}

// Coincident facets, shared edges and corners by the thousand, then near misses of a few units in the last place.
TEST(DataSets, MessyFilesMeetCopiesOfThemselves) {
  TACT_SKIP_WITHOUT_DATA();
  for (std::size_t i = kFirstMessy; i < std::size(kFiles); ++i) {
    const Mesh mesh = read_data(kFiles[i]);
    const double size = extent(mesh);
    for (const double shift : {0.0, 1e-15, 1e-9, 1e-3, 0.11, 0.7}) {
      const Mesh copy = translated(mesh, {shift * size, 0.0, 0.25 * shift * size});
      ASSERT_TRUE(engine_agrees_with_oracle(mesh, copy)) << kFiles[i] << ", shift " << shift;
    }
  }
}

TEST(DataSets, SoupsOfFarCoordinatesMeetAsTheOracleSays) {
  TACT_SKIP_WITHOUT_DATA();
  for (std::size_t i = kFirstMessy; i < std::size(kFiles); ++i) {
    const Mesh mesh = read_data(kFiles[i]);
    const Mesh far = translated(mesh, {1e4 * extent(mesh), -3e4 * extent(mesh), 0.0});
    const Mesh copy = translated(far, {0.11 * extent(mesh), 0.0, 0.0});
    ASSERT_TRUE(engine_agrees_with_oracle(far, copy)) << kFiles[i];
  }
}

std::size_t facet_pair_count(const std::vector<MeetingBodies>& meeting) {
  std::size_t count = 0;
  for (const MeetingBodies& pair : meeting) count += pair.facet_pairs.size();
  return count;
}

TEST(DataSets, ComponentsOfOneFileMeetAsTheOracleSays) {
  TACT_SKIP_WITHOUT_DATA();
  for (std::size_t i = kFirstMessy; i < std::size(kFiles); ++i) {
    const std::vector<Mesh> parts = components(read_data(kFiles[i]));
    EXPECT_TRUE(engine_agrees_with_oracle(parts)) << kFiles[i] << ", " << parts.size() << " parts";
  }
}

// The totals that the data's SOURCES.md gives, where no part meets itself.
TEST(DataSets, ComponentsMeetAsOftenAsTheirSourceSays) {
  TACT_SKIP_WITHOUT_DATA();
  const std::pair<const char*, std::size_t> totals[] = {{"two-cubes-far", 0},           {"two-cubes-close", 0},
                                                        {"two-cubes-intersecting", 96}, {"two-layer-ball", 0},
                                                        {"thick-cloth-t0", 0},          {"thick-cloth-t1", 46}};
  for (const auto& [name, expected] : totals) {
    const std::vector<Mesh> parts = components(read_data("small_answers/" + std::string(name) + ".ply"));
    EXPECT_EQ(parts.size(), 2u) << name;
    EXPECT_EQ(facet_pair_count(meeting_bodies_by_engine(parts)), expected) << name;
  }
}

// The sheet falls on the sphere and drapes it: hulls come to overlap, facets never meet, and the sheet is always pushed
// back to the side that it came from.
TEST(DataSets, FallingClothNeverMeetsTheSphere) {
  TACT_SKIP_WITHOUT_DATA();
  const Sequence cloth = read_data_sequence("seq_cloth_on_sphere");
  const Mesh sphere = read_data("cloth_sphere.obj");
  ASSERT_EQ(cloth.frames.size(), 60u);
  World world;
  const BodyId falling = world.add_body(
      {.positions = cloth.frames[0], .facets = cloth.facets, .surface = Surface::sheet, .name = "cloth"});
  world.add_body({.positions = sphere.positions, .facets = sphere.facets, .motion = Motion::fixed});
  const Vec3 down = normalized(centroid(sphere) - centroid({cloth.frames[0], cloth.facets}));
  int first_overlap = 60;
  for (int frame = 0; frame < 60; ++frame) {
    world.set_positions(falling, cloth.frames[frame]);
    const Report& report = world.detect();
    if (report.contacts().empty()) {
      ASSERT_EQ(first_overlap, 60) << "the hulls part again in frame " << frame;
      continue;
    }
    first_overlap = std::min(first_overlap, frame);
    const Contact& contact = report.contacts()[0];
    EXPECT_FALSE(contact.touching()) << "frame " << frame;
    EXPECT_GT(contact.direction.dot(Eigen::Vector3d(down.x, down.y, down.z)), 0.5) << "frame " << frame;
  }
  ASSERT_GT(first_overlap, 0);
  ASSERT_LT(first_overlap, 60);
  const std::vector<Vec3> points = used_points(sphere);
  for (const int frame : {first_overlap - 1, first_overlap}) {
    const Mesh sheet{cloth.frames[frame], cloth.facets};
    EXPECT_EQ(smallest_height(used_points(sheet), points, 0.0).height >= 0.0L, frame == first_overlap) << frame;
  }
}

TEST(DataSets, FallingClothMeetsTheGrownSphereAsTheOracleSays) {
  TACT_SKIP_WITHOUT_DATA();
  const Sequence cloth = read_data_sequence("seq_cloth_on_sphere");
  const Mesh original = read_data("cloth_sphere.obj");
  const Mesh sphere = scaled(original, 1.03, centroid(original));
  World world;
  const std::vector<BodyId> ids = add_bodies(world, std::array{Mesh{cloth.frames[0], cloth.facets}, sphere});
  std::size_t most = 0;
  for (std::size_t frame = 0; frame < cloth.frames.size(); ++frame) {
    world.set_positions(ids[0], cloth.frames[frame]);
    const std::vector<MeetingBodies> expected =
        meeting_bodies_by_oracle(std::array{Mesh{cloth.frames[frame], cloth.facets}, sphere});
    ASSERT_TRUE(same_meeting_bodies(expected, meeting_bodies(world.detect(), ids))) << "frame " << frame;
    most = std::max(most, facet_pair_count(expected));
  }
  EXPECT_GT(most, 5u);
}

// Two toys, one through the poses forwards, one backwards and beside it.
TEST(DataSets, InterpolatedToysMeetAsTheOracleSays) {
  TACT_SKIP_WITHOUT_DATA();
  const Sequence toy = read_data_sequence("seq_toy_poses");
  ASSERT_EQ(toy.frames.size(), 11u);
  const double size = extent({toy.frames[0], toy.facets});
  const auto pose = [&](double time) {
    const auto first = std::min(static_cast<std::size_t>(time), toy.frames.size() - 2);
    return Mesh{interpolated(toy.frames[first], toy.frames[first + 1], time - static_cast<double>(first)), toy.facets};
  };
  const auto toys_at = [&](double time) {
    return std::array{pose(time), translated(pose(10.0 - time), {0.35 * size, 0.05 * size, 0.02 * size * time})};
  };
  World world;
  const std::vector<BodyId> ids = add_bodies(world, toys_at(0.0));
  for (int step = 0; step <= 25; ++step) {
    const std::array toys = toys_at(0.4 * step);
    const std::array updates = {PositionsUpdate{ids[0], toys[0].positions}, PositionsUpdate{ids[1], toys[1].positions}};
    world.set_positions(updates);
    ASSERT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(toys), meeting_bodies(world.detect(), ids)))
        << "step " << step;
  }
}

// Points of a query of continuous collision, eight a query: four at the start of the motion, four at its end.
std::vector<std::array<Vec3, 4>> read_queries(const std::string& name) {
  std::ifstream file(data_folder() + "/ccd_unit_queries/" + name + ".csv");
  std::vector<std::array<Vec3, 4>> queries;
  std::string line;
  for (int row = 0; std::getline(file, line); ++row) {
    std::istringstream numbers(line);
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      double numerator = 0.0, denominator = 0.0;
      char comma;
      numbers >> numerator >> comma >> denominator >> comma;
      p[axis] = numerator / denominator;
    }
    if (row % 4 == 0) queries.emplace_back();
    queries.back()[row % 4] = p;
  }
  return queries;
}

Mesh facet(Vec3 p, Vec3 q, Vec3 r) {
  MeshBuilder builder;
  builder.triangle(p, q, r);
  return builder.mesh();
}

// Both poses of every query as bodies of one facet each: points, segments and triangles that touch, or nearly.
TEST(DataSets, PosesOfUnitQueriesMeetAsTheOracleSays) {
  TACT_SKIP_WITHOUT_DATA();
  int poses = 0, meeting = 0;
  for (const char* name : {"edge-edge_0", "edge-edge_1", "vertex-face_0", "vertex-face_1"}) {
    const bool edges = name[0] == 'e';
    for (const auto& [p, q, r, s] : read_queries(name)) {
      const Mesh a = edges ? facet(p, q, p) : facet(p, p, p);
      const Mesh b = edges ? facet(r, s, s) : facet(q, r, s);
      const std::vector<FacetPair> expected = facet_pairs_by_oracle(a, b);
      ASSERT_TRUE(same_facet_pairs(expected, facet_pairs_by_engine(a, b))) << name << ", pose " << poses;
      ++poses;
      meeting += expected.empty() ? 0 : 1;
    }
  }
  EXPECT_EQ(poses, 2 * (54 + 20 + 125 + 125));
  EXPECT_GT(meeting, 20);
}

}  // namespace
}  // namespace tact::tests
