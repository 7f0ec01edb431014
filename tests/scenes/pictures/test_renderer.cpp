#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "scenes/pictures/renderer.h"
#include "tests/scenes/picture_bodies.h"

using namespace tact::scenes;
using tact::tests::cube;
using tact::tests::two_cubes;

namespace {

constexpr RenderSettings kSmall{.width = 160, .height = 90, .quality = Quality::fine, .threads = 1};

int count_pixels(const Picture& picture, const std::function<bool(Color)>& is) {
  int count = 0;
  for (const Color& pixel : picture.pixels) count += is(pixel) ? 1 : 0;
  return count;
}

bool reddish(Color color) { return color.red > 150 && color.red > 2 * color.green && color.red > 2 * color.blue; }
bool bluish(Color color) { return color.blue > 60 && color.blue > color.red + color.red / 2; }

int differing_pixels(const Picture& a, const Picture& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] == b.pixels[i] ? 0 : 1;
  return count;
}

}  // namespace

TEST(Renderer, SameBytesForAnyNumberOfThreads) {
  PictureScene scene = two_cubes();
  scene.bodies[0].meeting_facets = {2, 3, 7};
  scene.bodies[1].opacity = 0.4;
  scene.arrows.push_back({.start = {0.5, 0.5, 0.5}, .direction = Eigen::Vector3d::UnitY(), .length = 0.8});
  scene.disks.push_back({.center = {0.5, 0.5, 0.5}, .normal = Eigen::Vector3d::UnitY(), .radius = 0.6});
  scene.title = "two cubes";
  for (const Quality quality : {Quality::draft, Quality::fine}) {
    RenderSettings settings = kSmall;
    settings.quality = quality;
    const Picture one = Renderer(settings).render(scene);
    for (const int threads : {2, 8}) {
      settings.threads = threads;
      EXPECT_EQ(differing_pixels(one, Renderer(settings).render(scene)), 0) << threads << " threads";
    }
  }
}

TEST(Renderer, BodiesHaveTheirColors) {
  PictureScene scene;
  scene.bodies.push_back(cube({0, 0, 0}, 1.0, body_color(0)));
  const Picture blue = Renderer(kSmall).render(scene);
  EXPECT_GT(count_pixels(blue, bluish), 1000);
  scene.bodies[0].color = {200, 40, 30};
  const Picture red = Renderer(kSmall).render(scene);
  EXPECT_EQ(count_pixels(red, bluish), 0);
  EXPECT_GT(count_pixels(red, reddish), 500);
}

TEST(Renderer, MeetingFacetsAreMarkedAndShineThrough) {
  PictureScene scene = two_cubes();
  const Picture plain = Renderer(kSmall).render(scene);
  EXPECT_EQ(count_pixels(plain, reddish), 0);
  // The side of the left cube that faces the camera.
  scene.bodies[0].meeting_facets = {2, 3};
  const Picture marked = Renderer(kSmall).render(scene);
  EXPECT_GT(count_pixels(marked, reddish), 100);
  // Far sides, which the cube itself hides.
  scene.bodies[0].meeting_facets = {0, 1};
  EXPECT_GT(differing_pixels(plain, Renderer(kSmall).render(scene)), 100);
}

TEST(Renderer, ArrowsAndDisksAreSeenThroughBodies) {
  PictureScene scene = two_cubes();
  const Camera camera = framing(bounding_box(scene), scene.up, kSmall.width, kSmall.height);
  const Picture plain = Renderer(kSmall).render(scene, camera);
  scene.arrows.push_back({.start = {0.2, 0.5, 0.5}, .direction = Eigen::Vector3d::UnitX(), .length = 0.5});
  const Picture arrow = Renderer(kSmall).render(scene, camera);
  EXPECT_GT(differing_pixels(plain, arrow), 30);
  scene.arrows.clear();
  scene.disks.push_back({.center = {0.5, 0.5, 0.5}, .normal = Eigen::Vector3d::UnitX(), .radius = 0.3});
  EXPECT_GT(differing_pixels(plain, Renderer(kSmall).render(scene, camera)), 50);
  scene.disks[0].radius = 0.0;
  scene.arrows.push_back({.start = {0.2, 0.5, 0.5}, .direction = Eigen::Vector3d::UnitX(), .length = 0.0});
  EXPECT_EQ(differing_pixels(plain, Renderer(kSmall).render(scene, camera)), 0);
}

TEST(Renderer, APictureOfOneSceneHoldsItsMarks) {
  PictureScene scene = two_cubes();
  scene.disks.push_back({.center = {0.5, 0.5, 0.5}, .normal = Eigen::Vector3d::UnitX(), .radius = 5.0});
  const Camera camera = framing(shown_points(scene), scene.up, kSmall.width, kSmall.height);
  const PicturePoint top = project(camera, {0.5, 5.5, 0.5}, kSmall.width, kSmall.height);
  EXPECT_GT(top.y, 0.0);
  EXPECT_LT(top.y, 20.0);
}

TEST(Renderer, BodiesCastShadowsOnTheGround) {
  PictureScene scene = two_cubes();
  const Camera camera = framing(bounding_box(scene), scene.up, kSmall.width, kSmall.height);
  const auto dark_grey = [](Color c) { return std::abs(c.red - c.blue) < 40 && c.red < 165 && c.red > 60; };
  const int with_ground = count_pixels(Renderer(kSmall).render(scene, camera), dark_grey);
  scene.ground.reset();
  EXPECT_GT(with_ground, count_pixels(Renderer(kSmall).render(scene, camera), dark_grey) + 200);
}

TEST(Renderer, SeeThroughBodiesShowWhatLiesBehind) {
  PictureScene scene;
  scene.bodies.push_back(cube({0.3, 0.3, 0.3}, 0.4, {200, 40, 30}));
  scene.bodies.push_back(cube({0, 0, 0}, 1.0, body_color(5)));
  EXPECT_EQ(count_pixels(Renderer(kSmall).render(scene), [](Color c) { return c.red > c.blue + 30; }), 0);
  scene.bodies[1].opacity = 0.3;
  EXPECT_GT(count_pixels(Renderer(kSmall).render(scene), [](Color c) { return c.red > c.blue + 30; }), 100);
}

TEST(Renderer, EmptyScenesAndEmptyBodiesGiveTheBackdrop) {
  PictureScene scene;
  const Picture empty = Renderer(kSmall).render(scene);
  scene.bodies.emplace_back();
  EXPECT_EQ(empty, Renderer(kSmall).render(scene));
  EXPECT_EQ(empty.width, 160);
  EXPECT_EQ(empty.height, 90);
}

TEST(Renderer, FarFromTheOriginAndTinyLooksTheSame) {
  PictureScene scene;
  scene.bodies.push_back(cube({0, 0, 0}, 1.0, body_color(2)));
  const Picture near = Renderer(kSmall).render(scene);
  scene.bodies[0] = cube({4096.0, -8192.0, 1024.0}, 0x1p-10, body_color(2));
  const Picture far = Renderer(kSmall).render(scene);
  int apart = 0;
  for (std::size_t i = 0; i < near.pixels.size(); ++i) {
    apart += std::abs(near.pixels[i].green - far.pixels[i].green) > 12 ? 1 : 0;
  }
  EXPECT_LT(apart, 60);
}

TEST(Renderer, SizesThatAreNotPositiveAreRefused) {
  EXPECT_THROW(Renderer({.width = 0, .height = 10}), std::runtime_error);
  EXPECT_THROW(Renderer({.width = 10, .height = -1}), std::runtime_error);
}
