// Memory that is taken before anything changes, so that what follows cannot fail.
#pragma once

#include <cstddef>
#include <vector>

namespace tact {

// Room for `count` entries; where there is none yet, for twice as many, so that bodies that come one by one copy each
// entry a few times at most.
template <class T>
void make_room(std::vector<T>& vector, std::size_t count) {
  if (vector.capacity() < count) vector.reserve(2 * count);
}

}  // namespace tact
