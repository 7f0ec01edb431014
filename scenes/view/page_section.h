// A part of the page's data: bytes, compressed, as text in an element that the page looks up by its id.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace tact::scenes {

// Deflate with zlib's header (RFC 1950), then base64. Returns how many bytes were written.
std::int64_t write_packed_section(std::ostream& out, const std::string& id, std::string_view bytes);
// JSON, in which nothing can end the element. Returns how many bytes were written.
std::int64_t write_json_section(std::ostream& out, const std::string& id, std::string_view json);

}  // namespace tact::scenes
