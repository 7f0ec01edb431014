// A small world that many tests begin with.
#pragma once

#include <gtest/gtest.h>
#include <tact/tact.h>

#include <cstdint>
#include <string>
#include <utility>

#include "tests/support/generators/bodies.h"

namespace tact::tests {

inline BodyDefinition definition(const Mesh& mesh, std::string name = {}) {
  return {.positions = mesh.positions, .facets = mesh.facets, .name = std::move(name)};
}

// A world with two spheres that meet and a fixed box that both rest on.
class WorldOfThree : public ::testing::Test {
 protected:
  WorldOfThree() {
    left_ = world_.add_body(definition(left_mesh_, "left"));
    right_ = world_.add_body(definition(right_mesh_, "right"));
    BodyDefinition floor = definition(floor_mesh_, "floor");
    floor.motion = Motion::fixed;
    floor_ = world_.add_body(floor);
  }

  // The hash of a new look at every pair, so that a body whose copy was spoiled would show. The look before it settles
  // how the directions are found.
  std::uint64_t hash() {
    world_.detect();
    world_.set_settings(world_.settings());
    return world_.detect().hash();
  }

  Mesh left_mesh_ = icosphere(2);
  Mesh right_mesh_ = translated(icosphere(2), {1.5, 0.1, 0.2});
  Mesh floor_mesh_ = box({-3.0, -3.0, -2.0}, {3.0, 3.0, -0.7});
  World world_;
  BodyId left_;
  BodyId right_;
  BodyId floor_;
};

}  // namespace tact::tests
