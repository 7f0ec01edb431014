#include "scenes/view/page_section.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <zlib.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace tact::scenes {
namespace {

std::string deflated(std::string_view bytes) {
  // Level 4: of the positions of a pile 3 % larger than level 6, in half the time.
  constexpr int kLevel = 4;
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int problem = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), kLevel);
  if (problem == Z_MEM_ERROR) throw std::bad_alloc();
  if (problem != Z_OK) throw std::logic_error("zlib does not compress");
  packed.resize(size);
  return packed;
}

std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text.push_back(k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=');
  }
  return text;
}

std::int64_t write_section(std::ostream& out, std::string_view type, const std::string& id, std::string_view text) {
  const std::string begin = fmt::format("<script type=\"{}\" id=\"{}\">", type, id);
  constexpr std::string_view kEnd = "</script>\n";
  out << begin << text << kEnd;
  return static_cast<std::int64_t>(begin.size() + text.size() + kEnd.size());
}

}  // namespace

std::int64_t write_packed_section(std::ostream& out, const std::string& id, std::string_view bytes) {
  return write_section(out, "application/octet-stream", id, base64(deflated(bytes)));
}

std::int64_t write_json_section(std::ostream& out, const std::string& id, std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text.push_back(c);
    }
  }
  return write_section(out, "application/json", id, text);
}

}  // namespace tact::scenes
