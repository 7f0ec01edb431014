#include <gtest/gtest.h>
#include <tact/world.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "scenes/commands/report_json.h"
#include "scenes/export/contact_lines.h"
#include "scenes/pictures/contact_marks.h"
#include "tests/scenes/picture_bodies.h"

using namespace tact;
using namespace tact::scenes;
using tact::tests::two_cubes;

namespace {

World world_of(const PictureScene& scene, const Settings& settings = {}) {
  World world(settings);
  for (const PictureBody& body : scene.bodies) {
    world.add_body({.positions = body.positions, .facets = body.facets, .name = body.name});
  }
  return world;
}

}  // namespace

TEST(ContactMarks, MarksAreThoseOfTheReport) {
  PictureScene scene = two_cubes();
  World world = world_of(scene, {.outputs = {.zones = true}});
  const Report& report = world.detect();
  ASSERT_EQ(report.contacts().size(), 1u);
  const Contact& contact = report.contacts()[0];
  std::set<int> a, b;
  for (const FacetPair& pair : contact.facet_pairs()) {
    a.insert(pair.a);
    b.insert(pair.b);
  }
  ASSERT_FALSE(a.empty());
  mark_contacts(scene, report, {.zones = true});
  EXPECT_EQ(scene.bodies[0].meeting_facets, std::vector<int>(a.begin(), a.end()));
  EXPECT_EQ(scene.bodies[1].meeting_facets, std::vector<int>(b.begin(), b.end()));
  ASSERT_EQ(scene.arrows.size(), 1u);
  EXPECT_EQ(scene.arrows[0].direction, contact.direction);
  EXPECT_GE(scene.arrows[0].length, contact.depth);
  ASSERT_EQ(scene.disks.size(), 2u);
  EXPECT_EQ(scene.disks[0].radius, contact.zone_a.radius);
}

TEST(ContactMarks, NothingIsMarkedWhereNothingIsAskedFor) {
  PictureScene scene = two_cubes();
  World world = world_of(scene);
  mark_contacts(scene, world.detect(), {.facets = false, .directions = false});
  EXPECT_TRUE(scene.bodies[0].meeting_facets.empty());
  EXPECT_TRUE(scene.arrows.empty());
  EXPECT_TRUE(scene.disks.empty());
}

TEST(ContactMarks, ArrowsEndInThePicture) {
  constexpr int kWidth = 640, kHeight = 360;
  PictureScene scene = two_cubes();
  const Camera camera = framing(bounding_box(scene), scene.up, kWidth, kHeight);
  const Arrow out{.direction = Eigen::Vector3d::UnitY(), .length = 2.5}, in{.length = 0.01},
      gone{.start = {100.0, 0.0, 0.0}, .length = 1.0};
  scene.arrows = {out, in, gone};
  keep_arrows_in_picture(camera, kWidth, kHeight, scene);
  const Arrow& cut = scene.arrows[0];
  EXPECT_LT(cut.length, out.length);
  EXPECT_GT(project(camera, cut.start + cut.length * cut.direction, kWidth, kHeight).y, 0.0);
  EXPECT_EQ(scene.arrows[1].length, in.length);
  EXPECT_EQ(scene.arrows[2].length, gone.length);
}

TEST(ContactLines, ALineHoldsTheContactsOfAStep) {
  const PictureScene scene = two_cubes();
  World world = world_of(scene);
  const Report& report = world.detect();
  std::ostringstream out;
  write_contact_line(out, 12, 0.2, world, report);
  const std::string text = out.str();
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  const auto line = nlohmann::json::parse(text);
  EXPECT_EQ(line["frame"], 12);
  EXPECT_EQ(line["time"].get<double>(), 0.2);
  ASSERT_EQ(line["contacts"].size(), 1u);
  const auto& contact = line["contacts"][0];
  EXPECT_EQ(contact["names"], (nlohmann::json{"left", "right"}));
  EXPECT_EQ(contact["depth"].get<double>(), report.contacts()[0].depth);
  EXPECT_EQ(contact["source"], direction_source_name(report.contacts()[0].source));
  EXPECT_EQ(contact["facet_pairs"].size(), report.contacts()[0].facet_pairs().size());
}
