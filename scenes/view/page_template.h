// The page that shows runs, as viewer/ builds it: a part of the program.
#pragma once

#include <string_view>

namespace tact::scenes {

// What stands before and after the data.
struct PageTemplate {
  std::string_view before;
  std::string_view after;
};
PageTemplate page_template();

}  // namespace tact::scenes
