// A hash of what a report says about the work behind it, which Report::hash() leaves out: it changes where more work is
// saved, so no constant is made of it. Worlds with the same calls have the same, for any number of threads.
#pragma once

#include <tact/report.h>

#include <bit>
#include <cstdint>

namespace tact::tests {

inline std::uint64_t work_hash(const Report& report) {
  std::uint64_t hash = 0x243f6a8885a308d3u;
  const auto add = [&](auto value) {
    hash = (std::rotl(hash, 23) ^ static_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15u;
  };
  for (const Contact& contact : report.contacts()) {
    add(contact.source);
    add(contact.iterations);
    add(contact.limit_reached);
    add(contact.point_limit_reached);
    add(contact.kept_facets_a);
    add(contact.kept_facets_b);
  }
  return hash;
}

}  // namespace tact::tests
