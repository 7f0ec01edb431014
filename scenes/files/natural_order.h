// The order of names with numbers in them.
#pragma once

#include <string_view>

namespace tact::scenes {

// Whether `a` comes before `b`: "frame_2" before "frame_10". Digits in a row are a number, however long; everything
// else, and names of equal numbers such as "1" and "01", go by bytes.
bool comes_before(std::string_view a, std::string_view b);

}  // namespace tact::scenes
