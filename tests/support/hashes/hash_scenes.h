// Small scenes whose whole answer is known as a number: on every machine, in every build, for any number of threads.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>

namespace tact::tests {

/// Hashes of all reports of a scene, folded into one.
struct SceneHashes {
  std::uint64_t answers = 0;  ///< Report::hash()
  std::uint64_t work = 0;     ///< work_hash(): the same for any number of threads; changes where more work is saved
  friend bool operator==(const SceneHashes&, const SceneHashes&) = default;
};

struct HashScene {
  const char* name;
  SceneHashes (*play)(int threads);
  /// The answers when the scene was last looked at. Only a change that alters an answer on purpose changes it:
  /// hash_program prints the new ones.
  std::uint64_t expected;
};

inline void PrintTo(const HashScene& scene, std::ostream* out) { *out << scene.name; }

std::span<const HashScene> hash_scenes();

}  // namespace tact::tests
