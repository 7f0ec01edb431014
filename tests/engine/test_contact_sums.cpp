// Sums of contact points against plain loops over the report.
#include <gtest/gtest.h>
#include <tact/contact_sums.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// Two balls on a floor that touch each other and a cloth, which touches itself.
struct SummedScene {
  SummedScene() : world({.threads = 1, .outputs = {.patches = true, .points = true}}) {
    add(translated(icosphere(2), {0.0, 0.0, 1.01}), Surface::closed, false);
    add(translated(icosphere(2), {2.01, 0.0, 1.01}), Surface::closed, false);
    add(translated(sheet(6, 6, 8.0, 8.0), {0.1, 0.2, 0.0}), Surface::sheet, false);
    const Mesh cloth = mapped(sheet(30, 30, 3.0, 3.0), [](Vec3 p) {
      return p.x > 1.0 ? Vec3{2.0 - p.x, p.y, 2.08} : Vec3{p.x, p.y, 2.04};
    });
    add(cloth, Surface::sheet, true);
    report = &world.detect();
    Random random(1);
    for (const Contact& contact : report->contacts())
      for (const ContactPoint& point : contact.points()) {
        const Vec3 d = random.direction();
        if (random.chance(0.8)) impulses.push_back({point.id, {d.x, d.y, d.z}});
      }
    impulses.push_back({42, {1.0, 2.0, 3.0}});  // of no point
  }
  void add(const Mesh& mesh, Surface surface, bool self) {
    meshes.push_back(mesh);
    world.add_body(
        {.positions = mesh.positions, .facets = mesh.facets, .surface = surface, .margin = 0.03, .self_contact = self});
  }
  Eigen::Vector3d place(BodyId body, const std::array<int, 3>& vertices, const std::array<double, 3>& weights) const {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      if (vertices[k] >= 0) p += weights[k] * meshes[body.index].positions.col(vertices[k]);
    return p;
  }
  Eigen::Vector3d impulse(std::uint64_t id) const {
    const auto found = std::ranges::find(impulses, id, &PointImpulse::id);
    return found == impulses.end() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : found->impulse;
  }
  World world;
  std::vector<Mesh> meshes;
  const Report* report = nullptr;
  std::vector<PointImpulse> impulses;
};

// The sum over some points as a loop makes it; `signs` tell which side a push counts for.
struct LoopedSum {
  int points = 0;
  double gaps = 0.0, deepest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d places = Eigen::Vector3d::Zero(), normals = places, force = places, moment = places;
  std::set<VertexOfBody> vertices;

  void add(const SummedScene& scene, const Contact& contact, const ContactPoint& point, double sign) {
    ++points;
    gaps += point.gap;
    deepest = std::min(deepest, point.gap);
    const Eigen::Vector3d place = 0.5 * (scene.place(contact.a, point.a_vertices, point.a_weights) +
                                         scene.place(contact.b, point.b_vertices, point.b_weights));
    places += place;
    normals += sign * point.normal;
    force += sign * scene.impulse(point.id);
    moment += sign * place.cross(scene.impulse(point.id));
  }
  void name(BodyId body, const std::array<int, 3>& of_point) {
    for (const int v : of_point)
      if (v >= 0) vertices.insert({body, v});
  }
  void expect_is(const ContactSum& sum) const {
    EXPECT_EQ(sum.points, points);
    EXPECT_EQ(sum.deepest_gap, deepest);
    EXPECT_NEAR(sum.mean_gap * points, gaps, 1e-12);
    EXPECT_LT((sum.center * points - places).norm(), 1e-10);
    EXPECT_LT((sum.normal * points - normals).norm(), 1e-10);
    EXPECT_LT((sum.force - force).norm(), 1e-10);
    EXPECT_LT((sum.torque - (moment - sum.center.cross(force))).norm(), 1e-10);
    EXPECT_TRUE(std::ranges::equal(sum.vertices, vertices));
  }
};

TEST(ContactSums, OfContactsAndPatchesAreThoseOfLoops) {
  const SummedScene scene;
  const ContactSums found = sum_contacts(scene.world, *scene.report, scene.impulses);
  std::size_t at = 0;
  for (const Contact& contact : scene.report->contacts()) {
    if (contact.points().empty()) continue;
    LoopedSum whole;
    for (const ContactPoint& point : contact.points()) {
      whole.add(scene, contact, point, 1.0);
      whole.name(contact.a, point.a_vertices);
      whole.name(contact.b, point.b_vertices);
    }
    const ContactSum& sum = found.sums[at++];
    EXPECT_EQ(sum.kind, ContactSum::Kind::contact);
    EXPECT_EQ(std::pair(sum.a, sum.b), std::pair(contact.a, contact.b));
    whole.expect_is(sum);
    double area = 0.0;
    for (const Patch& patch : contact.patches()) {
      LoopedSum part;
      for (const int p : patch.points) {
        const ContactPoint& point = contact.points()[static_cast<std::size_t>(p)];
        part.add(scene, contact, point, 1.0);
        part.name(contact.a, point.a_vertices);
        part.name(contact.b, point.b_vertices);
      }
      const ContactSum& of_patch = found.sums[at++];
      EXPECT_EQ(of_patch.kind, ContactSum::Kind::patch);
      EXPECT_EQ(of_patch.patch, patch.id);
      EXPECT_EQ(of_patch.area, patch.area);
      part.expect_is(of_patch);
      area += patch.area;
    }
    EXPECT_EQ(sum.area, area);
  }
  EXPECT_GT(at, 8u);
}

TEST(ContactSums, OfBodiesAreThoseOfLoopsAndInBalance) {
  const SummedScene scene;
  const ContactSums found = sum_contacts(scene.world, *scene.report, scene.impulses);
  std::map<BodyId, LoopedSum> bodies;
  for (const Contact& contact : scene.report->contacts())
    for (const ContactPoint& point : contact.points()) {
      bodies[contact.a].add(scene, contact, point, -1.0);
      bodies[contact.a].name(contact.a, point.a_vertices);
      bodies[contact.b].add(scene, contact, point, 1.0);
      bodies[contact.b].name(contact.b, point.b_vertices);
    }
  const auto first = std::ranges::find(found.sums, ContactSum::Kind::body, &ContactSum::kind);
  ASSERT_EQ(found.sums.end() - first, static_cast<std::ptrdiff_t>(bodies.size()));
  ASSERT_EQ(bodies.size(), 4u);
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  auto at = first;
  for (const auto& [body, expected] : bodies) {
    EXPECT_EQ(at->a, body);
    EXPECT_EQ(at->b, BodyId());
    expected.expect_is(*at);
    force += at->force;
    ++at;
  }
  EXPECT_LT(force.norm(), 1e-10) << "action is reaction";
}

TEST(ContactSums, RefuseAnIdTwice) {
  const SummedScene scene;
  std::vector<PointImpulse> twice{{.id = 7}, {.id = 3}, {.id = 7}};
  EXPECT_THROW(sum_contacts(scene.world, *scene.report, twice), Error);
  World empty({.threads = 1});
  EXPECT_TRUE(sum_contacts(empty, empty.detect()).sums.empty());
}

}  // namespace
}  // namespace tact::tests
