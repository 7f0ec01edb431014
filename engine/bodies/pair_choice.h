// Which pairs of bodies a world looks at that holds copies of bodies of others.
#pragma once

#include <cstdint>

namespace tact {

class PairChoice {
 public:
  virtual ~PairChoice() = default;
  /// Whether the pair in these two slots is looked at. Nothing is found of other pairs.
  virtual bool looks_at(std::uint32_t a, std::uint32_t b) const = 0;
};

}  // namespace tact
