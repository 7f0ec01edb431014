// Bodies through the engine, and its answers in the oracle's form.
#pragma once

#include <gtest/gtest.h>
#include <tact/tact.h>

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "tests/support/checks/recorded_world.h"
#include "tests/support/mesh.h"
#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::tests {

// A test that fails leaves what entered its worlds.
using World = RecordedWorld;

// Adds the bodies in their order.
template <class AnyWorld>
std::vector<BodyId> add_bodies(AnyWorld& world, std::span<const Mesh> bodies) {
  std::vector<BodyId> ids;
  for (const Mesh& body : bodies) ids.push_back(world.add_body({.positions = body.positions, .facets = body.facets}));
  return ids;
}

// The pairs of `report` that touch; a body's number is its place in `ids`, whatever its id.
std::vector<MeetingBodies> meeting_bodies(const Report& report, std::span<const BodyId> ids);

// The same by a world of its own, in one step.
std::vector<MeetingBodies> meeting_bodies_by_engine(std::span<const Mesh> bodies, const Settings& settings = {});
std::vector<FacetPair> facet_pairs_by_engine(const Mesh& a, const Mesh& b, const Settings& settings = {});

// Are the sets equal? A failure names the first pairs that only one of them has, and how many there are.
::testing::AssertionResult same_facet_pairs(std::span<const FacetPair> expected, std::span<const FacetPair> found);
::testing::AssertionResult same_meeting_bodies(std::span<const MeetingBodies> expected,
                                               std::span<const MeetingBodies> found);

// The engine's answer for bodies at rest against the oracle's.
::testing::AssertionResult engine_agrees_with_oracle(std::span<const Mesh> bodies, const Settings& settings = {});
::testing::AssertionResult engine_agrees_with_oracle(const Mesh& a, const Mesh& b, const Settings& settings = {});

// Does `call` throw an Error of this code whose message holds every one of `words`?
template <class Call>
::testing::AssertionResult throws_error(const Call& call, ErrorCode code,
                                        std::initializer_list<const char*> words = {}) {
  try {
    call();
  } catch (const Error& error) {
    const std::string message = error.what();
    if (error.code() != code) {
      return ::testing::AssertionFailure()
             << "threw " << error_code_name(error.code()) << " instead of " << error_code_name(code) << ": " << message;
    }
    for (const char* word : words) {
      if (message.find(word) == std::string::npos) {
        return ::testing::AssertionFailure() << "the message lacks \"" << word << "\": " << message;
      }
    }
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "threw nothing";
}

}  // namespace tact::tests
