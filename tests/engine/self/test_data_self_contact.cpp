// Real meshes with themselves, whole, crushed, broken and moving: the facet pairs are those of CGAL.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/checks/detection.h"
#include "tests/support/data/data_sets.h"
#include "tests/support/generators/folds.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// Every mesh file of the folder, sorted; of the sequences a frame each.
std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data_folder())) {
    const auto type = entry.path().extension();
    const std::string name = std::filesystem::relative(entry.path(), data_folder()).string();
    const bool is_later = name.starts_with("seq_") && name.find("_045.") == name.npos && name.find("-01.") == name.npos;
    if ((type == ".obj" || type == ".ply") && !is_later) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

class FileWithItself {
 public:
  explicit FileWithItself(const Mesh& mesh)
      : id_(world_.add_body({.positions = mesh.positions, .facets = mesh.facets, .self_contact = true})) {}
  std::vector<FacetPair> at(const Eigen::Matrix3Xd& positions) {
    world_.set_positions(id_, positions);
    return facet_pairs();
  }
  std::vector<FacetPair> facet_pairs() {
    const Report& report = world_.detect();
    if (report.contacts().empty()) return {};
    const auto pairs = report.contacts()[0].facet_pairs();
    return {pairs.begin(), pairs.end()};
  }

 private:
  World world_;
  BodyId id_;
};

// Pressed flat in some direction, so that its layers come to lie in each other.
Mesh crushed(const Mesh& mesh, std::uint64_t seed) {
  Mesh flat = rotated(mesh, Random(seed).rotation());
  flat.positions.row(2) *= 0.05;
  return flat;
}

TEST(DataSelfContact, FacetPairsOfEveryFileAreThoseOfCgal) {
  TACT_SKIP_WITHOUT_DATA();
  int held_by_cgal = 0;
  for (const std::string& name : all_names()) {
    const Mesh mesh = read_data(name);
    const std::vector<FacetPair> found = FileWithItself(mesh).facet_pairs();
    ASSERT_TRUE(same_facet_pairs(self_facet_pairs_by_oracle(mesh), found)) << name;
    if (const auto expected = self_facet_pairs_by_cgal(mesh)) {
      ASSERT_TRUE(same_facet_pairs(*expected, found)) << name;
      ++held_by_cgal;
    }
  }
  EXPECT_GT(held_by_cgal, 10);
}

TEST(DataSelfContact, FacetPairsOfCrushedAndBrokenFilesAreThoseOfCgal) {
  TACT_SKIP_WITHOUT_DATA();
  std::size_t pairs = 0;
  std::uint64_t seed = 0;
  for (const std::string& name : all_names()) {
    const Mesh mesh = read_data(name);
    if (mesh.facet_count() > 8000) continue;  // CGAL would take half a minute
    const Mesh flat = crushed(mesh, ++seed);
    const auto expected = self_facet_pairs_by_oracle(flat);
    ASSERT_TRUE(same_facet_pairs(expected, FileWithItself(flat).facet_pairs())) << "crushed " << name;
    if (const auto by_cgal = self_facet_pairs_by_cgal(flat)) {
      ASSERT_TRUE(same_facet_pairs(*by_cgal, expected)) << "crushed " << name;
    }
    const Mesh worse = broken(flat, seed);
    ASSERT_TRUE(same_facet_pairs(self_facet_pairs_by_oracle(worse), FileWithItself(worse).facet_pairs()))
        << "broken " << name;
    pairs += expected.size();
  }
  EXPECT_GT(pairs, 100u);
}

// Whether two facets have no common vertex.
bool are_apart(const Mesh& mesh, const FacetPair& pair) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.facets(i, pair.a) == mesh.facets(k, pair.b)) return false;
    }
  }
  return true;
}

// Counts as SOURCES.md gives them, which are of facets without a common vertex.
TEST(DataSelfContact, PosesOfAToyHaveTheKnownNumberOfPairs) {
  TACT_SKIP_WITHOUT_DATA();
  const Sequence toy = read_data_sequence("seq_toy_poses");
  const std::vector<std::ptrdiff_t> known = {117, 46, 41, 41, 0, 84, 0, 100, 4, 73, 93};
  ASSERT_EQ(toy.frames.size(), known.size());
  Mesh pose{toy.frames[0], toy.facets};
  FileWithItself world(pose);
  for (std::size_t frame = 0; frame < known.size(); ++frame) {
    pose.positions = toy.frames[frame];
    const std::vector<FacetPair> pairs = world.at(pose.positions);
    EXPECT_EQ(std::ranges::count_if(pairs, [&](const FacetPair& pair) { return are_apart(pose, pair); }), known[frame])
        << "pose " << frame + 1;
  }
}

// In one world, so that clusters are those of the first frame; every frame is pressed flat, too.
TEST(DataSelfContact, FacetPairsOfMovingFilesAreThoseOfCgal) {
  TACT_SKIP_WITHOUT_DATA();
  for (const char* folder : {"seq_cloth_on_sphere", "seq_toy_poses"}) {
    const Sequence moving = read_data_sequence(folder);
    FileWithItself world({moving.frames[0], moving.facets});
    for (std::size_t frame = 0; frame < moving.frames.size(); frame += 5) {
      const Mesh mesh{moving.frames[frame], moving.facets};
      for (const Mesh& one : {mesh, crushed(mesh, frame)}) {
        ASSERT_TRUE(same_facet_pairs(self_facet_pairs_by_oracle(one), world.at(one.positions)))
            << folder << ", frame " << frame;
      }
    }
  }
}

}  // namespace
}  // namespace tact::tests
