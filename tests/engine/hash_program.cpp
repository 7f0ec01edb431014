// hash_program [THREADS] [--only TEXT]: prints the hashes of every scene of tests/support/hashes/hash_scenes.h, or of
// those whose name holds the text, and says which of them differ from what is expected: for builds of other types,
// compilers and machines than the one that runs the tests. The last line has one number for all of them. Exit status 1
// if one differs, 2 if no scene is played.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/support/hashes/hash_scenes.h"

int main(int argc, char** argv) {
  int threads = 0;
  const char* only = "";
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) {
      only = argv[++i];
    } else {
      threads = std::atoi(argv[i]);
    }
  }
  int played = 0, different = 0;
  std::uint64_t all = 0;
  std::printf("%-20s %-18s %-18s %-18s\n", "scene", "reports", "features", "numbers");
  for (const tact::tests::HashScene& scene : tact::tests::hash_scenes()) {
    if (std::strstr(scene.name, only) == nullptr) continue;
    const tact::tests::SceneAnswers &found = scene.play(threads).answers, &expected = scene.expected;
    std::printf(
        "%-20s 0x%016" PRIx64 " 0x%016" PRIx64 " 0x%016" PRIx64 "%s%s%s%s\n", scene.name, found.reports, found.features,
        found.numbers, found == expected ? "" : "  other", found.reports == expected.reports ? "" : " reports",
        found.features == expected.features ? "" : " features", found.numbers == expected.numbers ? "" : " numbers");
    std::fflush(stdout);
    for (const std::uint64_t one : {found.reports, found.features, found.numbers}) all = (all ^ one) * 0x100000001b3;
    ++played;
    different += found == expected ? 0 : 1;
  }
  if (played == 0) {
    std::fprintf(stderr, "hash_program: no scene's name holds '%s'\n", only);
    return 2;
  }
  std::printf("%d scenes, %d other than expected; all in one: 0x%016" PRIx64 "\n", played, different, all);
  return different == 0 ? 0 : 1;
}
