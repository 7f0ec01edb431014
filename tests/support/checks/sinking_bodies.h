// Two closed bodies that sink into each other step by step, against brute force.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tact::tests {

// The bodies and their way are drawn from the seed. Each step's negative gaps are compared with brute force, which has
// the normals of the step before. Returns how many points were expected.
std::size_t sink_and_compare(std::uint64_t seed);

}  // namespace tact::tests
