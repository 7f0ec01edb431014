#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "scenes/pictures/camera.h"

using namespace tact;
using namespace tact::scenes;

namespace {

struct Extent {
  double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300, nearest = 1e300;
};

Extent seen(const Camera& camera, const Eigen::Matrix3Xd& points, int width, int height) {
  Extent extent;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const PicturePoint point = project(camera, points.col(i), width, height);
    extent = {std::min(extent.left, point.x), std::max(extent.right, point.x), std::min(extent.top, point.y),
              std::max(extent.bottom, point.y), std::min(extent.nearest, point.depth)};
  }
  return extent;
}

Eigen::Matrix3Xd corners(const base::Box& box) {
  Eigen::Matrix3Xd points(3, 8);
  for (int i = 0; i < 8; ++i) {
    points.col(i) << (i & 1 ? box.upper.x : box.lower.x), (i & 2 ? box.upper.y : box.lower.y),
        (i & 4 ? box.upper.z : box.lower.z);
  }
  return points;
}

}  // namespace

TEST(Camera, FramingHoldsAllCornersAndFillsOneSide) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-50.0, 50.0), log_size(-6.0, 6.0), turn(-180.0, 180.0),
      rise(-80.0, 80.0);
  for (int i = 0; i < 200; ++i) {
    base::Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = place(random);
      box.upper[axis] = box.lower[axis] + std::exp(log_size(random));
    }
    const View view{.azimuth = turn(random), .elevation = rise(random), .margin = 0.1};
    const UpAxis up = i % 2 == 0 ? UpAxis::y : UpAxis::z;
    const Extent extent = seen(framing(box, up, 1280, 720, view), corners(box), 1280, 720);
    SCOPED_TRACE("seed 7, case " + std::to_string(i));
    EXPECT_GT(extent.nearest, 0.0);
    EXPECT_GE(extent.left, 64.0 - 1e-6);
    EXPECT_LE(extent.right, 1216.0 + 1e-6);
    EXPECT_GE(extent.top, 36.0 - 1e-6);
    EXPECT_LE(extent.bottom, 684.0 + 1e-6);
    const bool fills_across = extent.left < 64.0 + 1e-6 && extent.right > 1216.0 - 1e-6;
    const bool fills_down = extent.top < 36.0 + 1e-6 && extent.bottom > 684.0 - 1e-6;
    EXPECT_TRUE(fills_across || fills_down);
  }
}

TEST(Camera, AxesAreOrthonormalAndUpIsUp) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    const Camera camera = framing(base::Box{{-1, -1, -1}, {1, 1, 1}}, up, 640, 480);
    Eigen::Matrix3d axes;
    axes << camera.right, camera.down, camera.forward;
    EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-12));
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
    EXPECT_LT(camera.down.dot(up_vector(up)), -0.5);
    EXPECT_LT(project(camera, up_vector(up), 640, 480).y, project(camera, -up_vector(up), 640, 480).y);
  }
}

TEST(Camera, NothingAndSinglePointsAreFramed) {
  const Eigen::Vector3d point(1e6, -2e6, 3.0);
  const Camera camera = framing(Eigen::Matrix3Xd(point), UpAxis::y, 100, 100);
  const PicturePoint middle = project(camera, point, 100, 100);
  EXPECT_NEAR(middle.x, 50.0, 10.0);
  EXPECT_NEAR(middle.y, 50.0, 10.0);
  EXPECT_GT(middle.depth, 0.0);
  const Camera none = framing(base::Box{}, UpAxis::y, 100, 100);
  EXPECT_NEAR(project(none, Eigen::Vector3d::Zero(), 100, 100).x, 50.0, 10.0);
}
