#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstring>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

// The table is made of pointers alone: a kernel that was added and not filled in is null.
TEST(KernelTable, NamesEveryKernelOfEveryInstructionSet) {
  for (const Kernels* kernels : tests::available_kernels()) {
    std::array<void*, sizeof(Kernels) / sizeof(void*)> entries;
    static_assert(sizeof entries == sizeof(Kernels));
    std::memcpy(entries.data(), static_cast<const void*>(kernels), sizeof entries);
    for (std::size_t i = 0; i < entries.size(); ++i) EXPECT_NE(entries[i], nullptr) << kernels->name << ", entry " << i;
  }
}

}  // namespace
}  // namespace tact::narrowphase
