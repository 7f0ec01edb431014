// Small scenes whose whole answer is known as numbers: on every machine, in every build, for any number of threads.
// Bodies come from generators that use +, -, *, / and the square root alone: bodies.h, body_pairs.h and random.h. Sines
// and the like of the C library are in folds.h, fans.h, known_shapes.h and hostile_hulls.h.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>

namespace tact::tests {

/// Hashes of all answers of a scene. Where rounding alone changes, `reports` and `numbers` do and `features` does not.
struct SceneAnswers {
  std::uint64_t reports = 0;   ///< Report::hash() of every step, folded into one
  std::uint64_t features = 0;  ///< answer_hash.h, of steps, motions and queries: which features, ids, signs of gaps
  std::uint64_t numbers = 0;   ///< the same: all doubles
  friend bool operator==(const SceneAnswers&, const SceneAnswers&) = default;
};

inline void PrintTo(const SceneAnswers& answers, std::ostream* out) {
  *out << std::hex << "reports 0x" << answers.reports << ", features 0x" << answers.features << ", numbers 0x"
       << answers.numbers << std::dec;
}

struct SceneHashes {
  SceneAnswers answers;
  std::uint64_t work = 0;  ///< work_hash(): the same for any number of threads; changes where more work is saved
  friend bool operator==(const SceneHashes&, const SceneHashes&) = default;
};

inline void PrintTo(const SceneHashes& hashes, std::ostream* out) {
  PrintTo(hashes.answers, out);
  *out << std::hex << ", work 0x" << hashes.work << std::dec;
}

struct HashScene {
  const char* name;
  SceneHashes (*play)(int threads);
  /// The answers when the scene was last looked at. Only a change that alters an answer on purpose changes them:
  /// hash_program prints the new ones.
  SceneAnswers expected;
};

inline void PrintTo(const HashScene& scene, std::ostream* out) { *out << scene.name; }

std::span<const HashScene> hash_scenes();

}  // namespace tact::tests
