// Prints the hash of every scene of tests/support/hashes/hash_scenes.h and says whether it is the one that is expected:
// for builds of other types, compilers and machines than the one that runs the tests. Exit status 1 if one differs.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "tests/support/hashes/hash_scenes.h"

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 0;
  int different = 0;
  for (const tact::tests::HashScene& scene : tact::tests::hash_scenes()) {
    const std::uint64_t hash = scene.play(threads).answers;
    std::printf("%-16s 0x%016" PRIx64 "%s\n", scene.name, hash, hash == scene.expected ? "" : "  differs");
    different += hash == scene.expected ? 0 : 1;
  }
  return different == 0 ? 0 : 1;
}
