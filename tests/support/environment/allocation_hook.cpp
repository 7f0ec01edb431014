#include "tests/support/environment/allocation_hook.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// The C library of Windows has no std::aligned_alloc, and frees what is aligned by a function of its own.
#ifdef _WIN32
[[maybe_unused]] void* aligned_memory(std::size_t size, std::size_t alignment) {
  return _aligned_malloc(size, alignment);
}
[[maybe_unused]] void free_aligned(void* memory) { _aligned_free(memory); }
#else
[[maybe_unused]] void* aligned_memory(std::size_t size, std::size_t alignment) {
  return std::aligned_alloc(alignment, size);
}
[[maybe_unused]] void free_aligned(void* memory) { std::free(memory); }
#endif

constexpr long kNever = -1;
std::atomic<long> allocations{0};
std::atomic<long> until_failure{kNever};  // or the number of allocations that still succeed
std::atomic<bool> fail_for_good{false};
std::atomic<bool> has_failed{false};

[[maybe_unused]] void* allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (until_failure > kNever && until_failure.fetch_sub(1) <= 0) {
    until_failure = fail_for_good ? 0 : kNever;
    has_failed = true;
    throw std::bad_alloc();
  }
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = aligned_memory(rounded == 0 ? alignment : rounded, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// As the standard has it: a failure of the operator that throws is a null pointer here.
[[maybe_unused]] void* allocate_or_null(std::size_t size) noexcept {
  try {
    return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

#ifndef TACT_KEEP_OPERATOR_NEW
void* operator new(std::size_t size) { return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new[](std::size_t size) { return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
// std::stable_sort takes its memory so; a sanitizer's own would not know the operators below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate_or_null(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate_or_null(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { free_aligned(memory); }
void operator delete[](void* memory) noexcept { free_aligned(memory); }
void operator delete(void* memory, std::size_t) noexcept { free_aligned(memory); }
void operator delete[](void* memory, std::size_t) noexcept { free_aligned(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { free_aligned(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { free_aligned(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { free_aligned(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { free_aligned(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { free_aligned(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { free_aligned(memory); }
#endif

namespace tact::tests {

bool is_hooked() {
#ifdef TACT_KEEP_OPERATOR_NEW
  return false;
#else
  return true;
#endif
}

long allocation_count() { return allocations; }

void fail_allocation(long number, bool for_good) {
  has_failed = false;
  fail_for_good = for_good;
  until_failure = number;
}

bool stop_failing() {
  until_failure = kNever;
  return has_failed;
}

}  // namespace tact::tests
