// Any bytes are a state of a world that can be used, or are refused, and then the world is as it was. The checksum is
// mended first: else nothing but the checksum would be tried.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "tests/support/checks/mended_state.h"
#include "tests/support/checks/varied_calls.h"

namespace {

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  tact::tests::mend(bytes);
  tact::World world({.threads = 1});
  const std::vector<std::byte> before = world.save();
  try {
    world.restore(bytes);
  } catch (const tact::Error&) {
    require(world.save() == before, "a world that refuses bytes is as it was");
    return 0;
  }
  const std::vector<std::byte> taken = world.save();
  world.restore(taken);
  require(world.save() == taken, "a state that was taken is saved as it was taken");
  for (std::uint64_t step = 0; step < 2; ++step) {
    tact::tests::answers_of_step(world);
    tact::tests::change(world, step);
  }
  return 0;
}
