// What a file holds that is not what its name says.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tact::scenes {

// What `bytes`, a whole file, are by their first bytes: an archive, a page of the web, text in UTF-16, a mesh of
// another format and others that come in place of meshes and recordings, with what to do about it. Nothing if they are
// unknown.
std::optional<std::string> known_content(std::string_view bytes);

}  // namespace tact::scenes
