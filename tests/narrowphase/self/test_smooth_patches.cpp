#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "narrowphase/mesh/refit.h"
#include "narrowphase/self/smooth_patches.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/oracles/facet_pair_oracle.h"
#include "tests/support/oracles/point_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// What is proved of all pairs of clusters of a mesh.
class Verdicts {
 public:
  explicit Verdicts(const Mesh& mesh) : Verdicts(mesh, mesh) {}
  // Of a mesh that was clustered as `source`, and has moved since.
  Verdicts(const Mesh& source, const Mesh& mesh)
      : mesh_(tests::clustered(source)), features_(mesh_), neighbors_(mesh_, features_) {
    refit(mesh_, mesh.positions.data(), {});
    patches_.begin(mesh_, neighbors_);
    for (int c = 0; c < mesh_.cluster_count(); ++c) patches_.look_at(mesh_, neighbors_, c);
    all_.assign(static_cast<std::size_t>(mesh_.cluster_count() * mesh_.cluster_count()), SelfVerdict::open);
    for (int a = 0; a < mesh_.cluster_count(); ++a) {
      for (int b = a; b < mesh_.cluster_count(); ++b) {
        const int both[] = {a, b};
        take(std::span(both).first(a == b ? 1 : 2));
      }
      take(neighbors_.around(a));
    }
    for (int corner = 0; corner < neighbors_.corner_count(); ++corner) {
      if (patches_.never_meet_at(mesh_, neighbors_, corner))
        note(neighbors_.clusters_at(corner), SelfVerdict::never_meet);
    }
  }

  SelfVerdict of(int cluster_a, int cluster_b) const { return all_[place(cluster_a, cluster_b)]; }
  int cluster_of_facet(int source_facet) const { return mesh_.facet_of_source(source_facet) / kClusterSize; }
  // Those of all facets that name all these vertices.
  std::vector<int> clusters_of(const std::array<int, 3>& source_vertices) const {
    std::vector<int> clusters;
    for (int f = 0; f < mesh_.facet_count(); ++f) {
      const Corners corners = mesh_.corners(f);
      const auto has = [&](int v) {
        return v < 0 || std::ranges::any_of(corners, [&](int corner) { return mesh_.source_vertex(corner) == v; });
      };
      if (std::ranges::all_of(source_vertices, has)) clusters.push_back(f / kClusterSize);
    }
    return clusters;
  }
  // The part of the pairs of clusters around each other of which at least this is proved.
  double part(SelfVerdict least) const {
    int pairs = 0, proved = 0;
    for (int a = 0; a < mesh_.cluster_count(); ++a) {
      for (const int b : neighbors_.around(a)) {
        ++pairs;
        proved += of(a, b) >= least ? 1 : 0;
      }
    }
    return static_cast<double>(proved) / pairs;
  }

 private:
  std::size_t place(int a, int b) const { return static_cast<std::size_t>(a * mesh_.cluster_count() + b); }
  void take(std::span<const int> clusters) { note(clusters, judge_(patches_, mesh_, neighbors_, clusters)); }
  void note(std::span<const int> clusters, SelfVerdict verdict) {
    for (const int a : clusters) {
      for (const int b : clusters) all_[place(a, b)] = std::max(all_[place(a, b)], verdict);
    }
  }

  ClusteredMesh mesh_;
  Features features_;
  ClusterNeighbors neighbors_;
  SmoothPatches patches_;
  SmoothPatches::Judge judge_;
  std::vector<SelfVerdict> all_;
};

// No facets meet of clusters that are said never to. Returns how many do of others.
std::size_t expect_no_meeting_denied(const Mesh& mesh, const Verdicts& verdicts, const std::string& what) {
  const auto pairs = tests::self_facet_pairs_by_oracle(mesh);
  for (const FacetPair& pair : pairs) {
    const int a = verdicts.cluster_of_facet(pair.a), b = verdicts.cluster_of_facet(pair.b);
    EXPECT_EQ(verdicts.of(a, b), SelfVerdict::open) << what << ", facets " << pair.a << ' ' << pair.b;
  }
  return pairs.size();
}

TEST(SmoothPatches, DenyNoFacetsThatMeet) {
  std::size_t meetings = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const auto& [name, mesh] : tests::folded_meshes(24, seed))
      meetings += expect_no_meeting_denied(mesh, Verdicts(mesh), name + ", seed " + std::to_string(seed));
  }
  EXPECT_GT(meetings, 5000u);
}

TEST(SmoothPatches, DenyNoneInBrokenMeshes) {
  std::size_t meetings = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    for (const auto& [name, whole] : tests::folded_meshes(24, seed)) {
      const Mesh mesh = tests::broken(whole, seed);
      meetings += expect_no_meeting_denied(mesh, Verdicts(mesh), "broken " + name + ", seed " + std::to_string(seed));
    }
    const Mesh soup = tests::lattice_soup(600, 4, seed);
    meetings += expect_no_meeting_denied(soup, Verdicts(soup), "soup, seed " + std::to_string(seed));
  }
  EXPECT_GT(meetings, 5000u);
}

// No contact point lies between clusters that are said to have none, at any distance, and whatever the way along the
// surface: the theorem speaks of neither. Returns how many lie between others.
std::size_t expect_no_point_denied(const Mesh& mesh, const std::string& what) {
  const Verdicts verdicts(mesh);
  const double size = tests::extent(mesh);
  std::size_t points = 0;
  for (const auto& [key, point] : tests::points_by_brute_force(mesh, mesh, 4 * size, 1e-12 * size)) {
    const auto& [kind, a, b] = key;
    const bool share = std::ranges::any_of(a, [&b = b](int v) { return v >= 0 && std::ranges::find(b, v) != b.end(); });
    if (share || !point.certain || kind == FeaturePair::facet_vertex || b < a) continue;
    ++points;
    for (const int cluster_a : verdicts.clusters_of(a)) {
      for (const int cluster_b : verdicts.clusters_of(b))
        EXPECT_NE(verdicts.of(cluster_a, cluster_b), SelfVerdict::never_contact)
            << what << ", kind " << static_cast<int>(kind) << ", vertices " << a[0] << ' ' << a[1] << ' ' << a[2]
            << " and " << b[0] << ' ' << b[1] << ' ' << b[2];
    }
  }
  return points;
}

TEST(SmoothPatches, DenyNoContactPoint) {
  std::size_t points = 0;
  for (std::uint64_t seed = 0; seed < 1; ++seed) {
    for (const auto& [name, mesh] : tests::folded_meshes(12, seed))
      points += expect_no_point_denied(mesh, name + ", seed " + std::to_string(seed));
  }
  EXPECT_GT(points, 1000u);
}

TEST(SmoothPatches, DenyNoContactPointInBays) {
  std::size_t points = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    points += expect_no_point_denied(tests::comb(12, 1 + static_cast<int>(seed) % 6, 0.05, 0.0, seed), "comb");
  EXPECT_GT(points, 1000u);
}

// Of two slopes that rise at more than 45 degrees from a valley, each sees the other.
TEST(SmoothPatches, DenyNoContactPointInSteepValleys) {
  const auto across = [](double angle) {
    const Mesh mesh = tests::fan_fold(48, 48, 2, angle);
    const Verdicts verdicts(mesh);
    std::array<int, 3> count{};  // of pairs of facets, by what is proved
    for (int k = 0; k < 48; ++k) {
      const int left = verdicts.cluster_of_facet(2 * (48 * k + 20)),
                right = verdicts.cluster_of_facet(2 * (48 * k + 27));
      ++count[static_cast<std::size_t>(verdicts.of(left, right))];
    }
    return count;
  };
  EXPECT_GT(across(0.75)[2], 24);
  EXPECT_EQ(across(0.80)[2], 0);
  EXPECT_EQ(across(0.80)[1], 48);
}

// A sheet folded over itself and back again, flat: seen from above one layer in three shows its back, and the boundary
// is that of a sheet that is not folded.
TEST(SmoothPatches, DenyNoFacetsThatMeetInAFlatFold) {
  for (const double back : {0.02, 0.1, 0.3}) {
    const Mesh mesh = tests::mapped(tests::sheet(64, 32, 1.0, 0.5), [&](Vec3 p) {
      const double x = p.x < 0.0 ? p.x : p.x < back ? -p.x : p.x - 2 * back;
      return Vec3{x, p.y, 0.0};
    });
    EXPECT_GT(expect_no_meeting_denied(mesh, Verdicts(mesh), "flat fold"), 1000u);
  }
}

TEST(SmoothPatches, DenyNoFacetsThatMeetInCombsAndOverhangs) {
  std::size_t meetings = 0;
  for (int waves = 1; waves < 9; ++waves) {
    for (const double overhang : {4.0, 6.0, 9.0}) {
      const Mesh wave = tests::overhanging_wave(48, 24, waves, overhang);
      meetings += expect_no_meeting_denied(wave, Verdicts(wave), "waves " + std::to_string(waves));
    }
  }
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Mesh comb = tests::comb(10 + static_cast<int>(seed) % 20, 1 + static_cast<int>(seed) % 7, 0.2, 0.0, seed);
    meetings += expect_no_meeting_denied(comb, Verdicts(comb), "comb " + std::to_string(seed));
  }
  EXPECT_GT(meetings, 5000u);
}

// All normals point up, and each place is covered twice or more: only the boundary tells.
TEST(SmoothPatches, NormalsAloneProveNothing) {
  for (const Mesh& mesh : {tests::winding_stairs(64, 4, 1.3, 0.0), tests::winding_stairs(24, 2, 1.9, 0.0),
                           tests::double_disk(32, 8, 0.0), tests::comb(24, 8, 0.5, 0.0, 1)}) {
    EXPECT_GT(expect_no_meeting_denied(mesh, Verdicts(mesh), "all normals up"), 10u);
  }
}

TEST(SmoothPatches, ProveAlmostAllOfWhatIsSmooth) {
  const auto proved = [](const Mesh& mesh, SelfVerdict least) { return Verdicts(mesh).part(least); };
  EXPECT_GT(proved(tests::sheet(64, 64, 1.0, 1.0), SelfVerdict::never_contact), 0.95);
  EXPECT_GT(proved(tests::jittered(tests::sheet(64, 64, 1.0, 1.0), 1e-3, 1), SelfVerdict::never_contact), 0.95);
  EXPECT_GT(proved(tests::icosphere(5), SelfVerdict::never_contact), 0.9);
  EXPECT_GT(proved(tests::wrinkled_sheet(64, 1.0, 0.05, 1), SelfVerdict::never_meet), 0.9);
  EXPECT_GT(proved(tests::rolled_sheet(200, 40, 0.9, 1.0, 0.05), SelfVerdict::never_contact), 0.9);
}

// So tightly that all clusters around a cluster leave every half space; those at a corner do not.
TEST(SmoothPatches, ProveAlmostAllOfATightTurn) {
  const Mesh sheet = tests::sheet(64, 64, 1.0, 1.0);
  const Mesh rolled = tests::mapped(sheet, [](Vec3 p) {
    const double turn = 12.0 * (p.x + 0.5), r = 0.06 + 0.006 * turn;
    return Vec3{r * std::cos(turn), p.y, r * std::sin(turn)};
  });
  const Verdicts verdicts(sheet, rolled);
  EXPECT_GT(verdicts.part(SelfVerdict::never_meet), 0.9);
  EXPECT_LT(verdicts.part(SelfVerdict::never_contact), 0.3);
  EXPECT_EQ(expect_no_meeting_denied(rolled, verdicts, "tight turn"), 0u);
}

// A strip bent in its plane until it lies on itself, as flat as a ring or nearly so: normals point up, and the lines
// around its corners come back to where they were.
TEST(SmoothPatches, LinesThatCrossThemselvesProveNothing) {
  tests::Random random(7);
  std::size_t meetings = 0;
  double proved = 0.0;
  for (int round = 0; round < 16; ++round) {
    const int across = 3 + random.below(6);
    const Mesh strip = tests::sheet(24 + random.below(16), across, 1.0, 0.2);
    const double turns = random.uniform(0.5, 4.0), inner = random.uniform(0.3, 1.0), rise = round % 3 == 0 ? 1e-3 : 0.0,
                 wave = random.uniform(0.0, 0.3);
    const Mesh bent = tests::rotated(tests::mapped(strip,
                                                   [&](Vec3 p) {
                                                     const double turn = 2.0 * std::numbers::pi * turns * (p.x + 0.5);
                                                     const double r = inner + 0.1 - p.y + wave * std::sin(3.0 * turn);
                                                     return Vec3{r * std::cos(turn), r * std::sin(turn), rise * turn};
                                                   }),
                                     random.rotation());
    const Verdicts verdicts(strip, bent);
    meetings += expect_no_meeting_denied(bent, verdicts, "strip " + std::to_string(round));
    proved += verdicts.part(SelfVerdict::never_meet) / 16;
  }
  EXPECT_GT(meetings, 5000u);
  EXPECT_GT(proved, 0.1);
}

// At any size and place, also far from the origin, with margins for rounding that grow as they must.
TEST(SmoothPatches, HoldAtAnySizeAndPlace) {
  const Mesh sheet = tests::rotated(tests::sheet(32, 32, 1.0, 1.0), tests::Random(1).rotation());
  for (const double scale : {0x1p-60, 1.0, 0x1p60})
    EXPECT_GT(Verdicts(tests::scaled(sheet, scale)).part(SelfVerdict::never_contact), 0.9) << scale;
  EXPECT_GT(Verdicts(tests::translated(sheet, {1e6, -1e6, 1e6})).part(SelfVerdict::never_contact), 0.9);
  for (const double scale : {0x1p-290, 0x1p290}) {
    const Mesh crossing = tests::scaled(tests::winding_stairs(64, 4, 1.3, 0.0), scale);
    expect_no_meeting_denied(crossing, Verdicts(crossing), "size " + std::to_string(scale));
  }
}

}  // namespace
}  // namespace tact::narrowphase
