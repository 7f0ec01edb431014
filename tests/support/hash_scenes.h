// Small scenes whose whole answer is known as a number: on every machine, in every build, for any number of threads.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>

namespace tact::tests {

struct HashScene {
  const char* name;
  // Plays the scene and folds the hashes of its reports into one.
  std::uint64_t (*play)(int threads);
  // What play() returned when the scene was last looked at. A change of the engine that changes an answer on purpose,
  // or the number of iterations or kept facets, changes it: hash_program prints the new ones.
  std::uint64_t expected;
};

inline void PrintTo(const HashScene& scene, std::ostream* out) { *out << scene.name; }

std::span<const HashScene> hash_scenes();

}  // namespace tact::tests
