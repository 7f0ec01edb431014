// Worlds of C for tests, and how a failure looks.
#pragma once

#include <gtest/gtest.h>
#include <tact/tact_c.h>

#include <string>

#include "tests/c/mesh_for_c.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {

// A world of C that ends with the test.
struct WorldOfC {
  explicit WorldOfC(const tact_settings* settings = nullptr) {
    EXPECT_EQ(tact_world_create(settings, &world), TACT_OK) << tact_last_error_message();
  }
  ~WorldOfC() { tact_world_destroy(world); }
  tact_body add(const Mesh& mesh) {
    const tact_body_definition definition = definition_of(mesh);
    tact_body body{};
    EXPECT_EQ(tact_world_add_body(world, &definition, &body), TACT_OK) << tact_last_error_message();
    return body;
  }
  tact_world world{};
};

inline void expect_failure(tact_error error, tact_error expected, const std::string& text) {
  EXPECT_EQ(error, expected) << tact_error_code_name(error);
  EXPECT_NE(std::string(tact_last_error_message()).find(text), std::string::npos) << tact_last_error_message();
}

// Two bodies that touch, and one of which nothing is near.
struct Three : WorldOfC {
  explicit Three(const tact_settings* settings = nullptr) : WorldOfC(settings) {
    a = add(mesh), b = add(translated(mesh, {1.5, 0.1, 0.2})), far = add(translated(mesh, {9.0, 0.0, 0.0}));
  }
  Mesh mesh = icosphere(1);
  tact_body a{}, b{}, far{};
};

}  // namespace tact::tests
