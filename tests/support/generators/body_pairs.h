// Pairs and crowds of bodies to be detected, by kind and seed.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <vector>

#include "tests/support/mesh.h"

namespace tact::tests {

// Meshes by kind: solids, sheets, needles, noise, and everything that a solver gone wrong makes of them.
struct BodyPairKind {
  const char* name;
  // The first and the second body for a seed; they overlap more often than not.
  std::vector<Mesh> (*make)(std::uint64_t seed);
};

inline void PrintTo(const BodyPairKind& kind, std::ostream* out) { *out << kind.name; }

std::span<const BodyPairKind> body_pair_kinds();

// Two small bodies that touch and no more, exactly, in no special position: a corner of one lies on a facet of the
// other, on an edge or on a corner; or it lies at the bottom of a pit, on a facet across the contact direction. Where
// a dot product decides what is apart, its rounding decides here.
std::vector<Mesh> kissing_bodies(std::uint64_t seed);

// `count` blobs of 80 facets in a box so tight that most meet several others.
std::vector<Mesh> crowd_of_blobs(int count, std::uint64_t seed);
// Solids, sheets, needles, soups, single facets and a body without facets, in one place.
std::vector<Mesh> mixed_crowd(int count, std::uint64_t seed);
// Bricks of whole numbers, face to face, in `courses` courses; every second course is shifted by half a brick.
std::vector<Mesh> brick_wall(int bricks_a_course, int courses);
// Spheres of growing radius around one centre: all boxes overlap, no facets meet.
std::vector<Mesh> nested_spheres(int count);

}  // namespace tact::tests
