// Values of enumerations, as a caller may cast them from anything.
#pragma once

#include <tact/error.h>

#include <string>

namespace tact {

// Is `value` one of the names of its enumeration, the last of which is `last`? `what` is it of? Errors: bad_settings.
template <class Name>
void check_name(Name value, Name last, const std::string& what) {
  const int number = static_cast<int>(value);
  if (number >= 0 && number <= static_cast<int>(last)) return;
  throw Error(ErrorCode::bad_settings, what + " is " + std::to_string(number) + ", which is none of its names");
}

}  // namespace tact
