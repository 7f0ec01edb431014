#include "tests/support/generators/fans.h"

#include <cmath>
#include <numbers>

#include "tests/support/generators/random.h"

namespace tact::tests {

namespace {

Vec3 on_circle(int i, int count, double radius, double z) {
  const double angle = 2.0 * std::numbers::pi * i / count;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

Mesh fan_cone(int count, double height) {
  MeshBuilder builder;
  const int tip = builder.vertex({0.0, 0.0, 0.0}), middle = builder.vertex({0.0, 0.0, height});
  for (int i = 0; i < count; ++i) builder.vertex(on_circle(i, count, 1.0, height));
  for (int i = 0; i < count; ++i) {
    const int here = middle + 1 + i, next = middle + 1 + (i + 1) % count;
    builder.facet(tip, next, here);
    builder.facet(middle, here, next);
  }
  return builder.mesh();
}

Mesh star(int count, std::uint64_t seed) {
  constexpr double kWidth = 0.01;
  Random random(seed);
  MeshBuilder builder;
  const int middle = builder.vertex({0.0, 0.0, 0.0});
  for (int i = 0; i < count; ++i) {
    const Vec3 end = random.direction();
    const int tip = builder.vertex(end);
    builder.facet(middle, tip, builder.vertex(end + kWidth * random.in_ball()));
  }
  return builder.mesh();
}

Mesh open_book(int count) {
  MeshBuilder builder;
  const int bottom = builder.vertex({0.0, 0.0, 0.0}), top = builder.vertex({0.0, 0.0, 1.0});
  for (int i = 0; i < count; ++i) builder.facet(bottom, top, builder.vertex(on_circle(i, count, 1.0, 0.5)));
  return builder.mesh();
}

Mesh sliver_tube(int count, double radius, double length) {
  MeshBuilder builder;
  for (int i = 0; i < count; ++i) {
    builder.vertex(on_circle(i, count, radius, 0.0));
    builder.vertex(on_circle(i, count, radius, length));
  }
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    builder.quad(2 * i, 2 * next, 2 * next + 1, 2 * i + 1);
  }
  return builder.mesh();
}

}  // namespace tact::tests
