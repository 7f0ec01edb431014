// JSON as files hold it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tact::scenes {

// Members stay in the order in which they were added.
using Json = nlohmann::ordered_json;

// On one line; a byte that is not UTF-8 becomes U+FFFD.
inline std::string json_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace tact::scenes
