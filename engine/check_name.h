// Values of enumerations, as a caller may cast them from anything.
#pragma once

#include <tact/error.h>

#include <string>

namespace tact {

// Refuses a `value` that its enumeration, the last name of which is `last`, does not have. `what` is the argument or
// setting of that value. Errors: `code`.
template <class Name>
void check_name(Name value, Name last, const std::string& what, ErrorCode code = ErrorCode::invalid_argument) {
  const int number = static_cast<int>(value);
  if (number >= 0 && number <= static_cast<int>(last)) return;
  throw Error(code, what + " is " + std::to_string(number) + ", an unknown value");
}

}  // namespace tact
