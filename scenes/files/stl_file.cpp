// STL, text and binary.
#include <fmt/format.h>
#include <tact/weld.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <utility>

#include "scenes/commands/counted.h"
#include "scenes/files/binary_reader.h"
#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kHeadSize = 84;   // 80 bytes of anything, then the number of facets
constexpr std::size_t kFacetSize = 50;  // normal, three corners, two bytes of attributes

// Some programs write the words of a text in capitals.
bool same_word(std::string_view text, std::string_view lower_case) {
  return std::equal(text.begin(), text.end(), lower_case.begin(), lower_case.end(),
                    [](char t, char c) { return t == c || (t >= 'A' && t <= 'Z' && t - 'A' + 'a' == c); });
}

// Every corner is a vertex of its own, until the end: of the last three.
void add_facet(MeshBuilder& builder) {
  const int end = builder.vertex_count();
  builder.add_polygon({end - 3, end - 2, end - 1});
}

MeshFile welded(MeshFile mesh) {
  WeldedMesh welded = weld(mesh.positions, mesh.facets);
  mesh.positions = std::move(welded.positions);
  mesh.facets = std::move(welded.facets);
  return mesh;
}

std::uint64_t binary_size(std::string_view bytes, const std::string& file) {
  BinaryReader head(bytes, file, kHeadSize - 4, std::endian::little);
  return kHeadSize + kFacetSize * std::uint64_t{head.read<std::uint32_t>()};
}

// Text begins with "solid", but so do some binary files. The size tells them apart: a text's bytes 80 to 83, taken as a
// number of facets, promise gigabytes. What fits neither is the one that its first bytes look like.
bool is_text(std::string_view bytes, const std::string& file) {
  if (bytes.size() >= kHeadSize && binary_size(bytes, file) == bytes.size()) return false;
  const std::string_view start = bytes.substr(0, 512);
  const bool printable = std::all_of(start.begin(), start.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 || (byte >= '\t' && byte <= '\r');
  });
  if (!printable) return false;  // before a word is looked for, which may be gigabytes of zeros
  TextReader text(bytes, file, {});
  const auto first = text.seek_token() ? text.token() : std::nullopt;
  return first && same_word(*first, "solid");
}

// How many facets follow the head. Streaming programs leave a count of 0 or 2^32 - 1.
std::uint64_t count_facets(std::string_view bytes, BinaryReader& binary) {
  const std::uint64_t promised = binary.read<std::uint32_t>(), room = bytes.size() - kHeadSize;
  const std::uint64_t whole = room / kFacetSize, surplus = room % kFacetSize;
  if (promised * kFacetSize == room) return promised;
  const auto is_zero = [](char c) { return c == '\0'; };
  const std::string_view first = bytes.substr(kHeadSize, kFacetSize);
  if ((promised == 0 || promised == std::numeric_limits<std::uint32_t>::max()) && whole > 0 && surplus == 0 &&
      !std::all_of(first.begin(), first.end(), is_zero)) {
    binary.warn(fmt::format("promises {} facets; all {} that follow are read", promised, whole));
    return whole;
  }
  if (promised > 0 && promised <= whole && surplus > 0) {
    binary.warn(fmt::format("promises {}, and {} follow them: not read",
                            counted(static_cast<std::int64_t>(promised), "facet"),
                            counted(static_cast<std::int64_t>(room - promised * kFacetSize), "more byte")));
    return promised;
  }
  binary.fail(fmt::format("promises {} facets, which take {} bytes, but the file has {}", promised,
                          kHeadSize + promised * kFacetSize, bytes.size()));
}

MeshFile parse_binary(std::string_view bytes, const std::string& file) {
  if (bytes.size() < kHeadSize) {
    throw FileError(
        fmt::format("{}: byte {}: neither text that begins with solid nor the {} bytes that begin binary STL", file,
                    bytes.size(), kHeadSize));
  }
  BinaryReader binary(bytes, file, kHeadSize - 4, std::endian::little);
  const std::uint64_t count = count_facets(bytes, binary);
  MeshBuilder builder(binary, Split::fans);
  for (std::uint64_t i = 0; i < count; ++i) {
    binary.set_item("facet", static_cast<std::int64_t>(i));
    binary.skip(12);  // the normal
    for (int corner = 0; corner < 3; ++corner) {
      std::array<double, 3> position;
      for (double& value : position) value = static_cast<double>(binary.read<float>());
      builder.add_vertex(position);
    }
    add_facet(builder);
    binary.skip(2);  // attributes
  }
  return welded(builder.mesh());
}

// The words of a text may be spread over lines in any way, all on one line included; what is usually one word, such as
// endfacet, may be two.
class TextStl {
 public:
  TextStl(std::string_view bytes, const std::string& file) : text_(bytes, file, {}), builder_(text_, Split::fans) {}

  MeshFile read() {
    text_.seek_token();
    text_.token();  // solid
    for (bool more = true; more;) more = read_solid();
    return welded(builder_.mesh());
  }

 private:
  // What comes after the word solid, and the next such word, if there is one.
  bool read_solid() {
    skip_name();
    const int facets_before = builder_.facet_count();
    for (;;) {
      if (!text_.seek_token()) {
        if (builder_.facet_count() == facets_before) text_.fail_expected("facet or endsolid", std::nullopt);
        text_.warn("the file ends without endsolid: it may have been cut");
        return false;
      }
      next_word("facet or endsolid");
      if (same_word(word_, "facet")) {
        read_facet();
      } else if (same_word(word_, "color")) {
        text_.skip_numbers();
      } else if (same_word(word_, "solid")) {
        text_.warn("a solid begins before the endsolid of the last one");
        return true;
      } else if (is_end_of("solid")) {
        return seek_solid();
      } else {
        text_.fail_expected("facet or endsolid", word_);
      }
    }
  }

  // The name of a solid ends with its line, or where its first facet stands on the same line.
  void skip_name() {
    const TextReader::Mark line = text_.mark();
    for (TextReader::Mark before = line; const auto word = text_.token(); before = text_.mark()) {
      if (!same_word(*word, "facet")) continue;
      const TextReader::Mark after = text_.mark();
      const auto next = text_.token();
      const bool is_facet = next && (same_word(*next, "outer") || (same_word(*next, "normal") && begins_normal()));
      if (is_facet) return text_.go_back(before);
      text_.go_back(after);
    }
    text_.go_back(line);
    text_.skip_line();
  }

  bool begins_normal() {
    const auto word = text_.token();
    return word && (parse_number(*word) || same_word(*word, "outer"));
  }

  // After endsolid and a name: the word solid on this line, if a facet stands there, too, or on the next one that has
  // words, if any.
  bool seek_solid() {
    while (const auto word = text_.token()) {
      if (!same_word(*word, "solid")) continue;
      const TextReader::Mark here = text_.mark();
      skip_name();
      if (text_.token()) {
        text_.go_back(here);
        return true;
      }
    }
    if (!text_.seek_token()) return false;
    expect("solid");
    return true;
  }

  // After the word facet. The normal is often nan where a facet has no area, and may be missing.
  void read_facet() {
    text_.set_item("facet", builder_.facet_count());
    next_word("normal or outer");
    if (same_word(word_, "normal")) {
      next_word("three numbers after normal");
      for (int i = 0; i < 3 && !same_word(word_, "outer"); ++i) next_word("three numbers after normal, and outer");
    }
    if (!same_word(word_, "outer")) text_.fail_expected("outer", word_);
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      std::array<double, 3> position;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        text_.seek_token();
        position[axis] = text_.number("a number", std::string_view("xyz").substr(axis, 1));
      }
      builder_.add_vertex(position);
    }
    expect_end_of("loop");
    expect_end_of("facet");
    add_facet(builder_);
    text_.clear_item();
  }

  std::string_view next_word(std::string_view what) {
    text_.seek_token();
    word_ = text_.expect_token(what);
    return word_;
  }
  void expect(std::string_view word) {
    if (!same_word(next_word(word), word)) text_.fail_expected(word, word_);
  }
  // Whether the last word is "end" and `what` in one, or in two.
  bool is_end_of(std::string_view what) {
    if (same_word(word_, "end")) return same_word(next_word(what), what);
    return word_.size() > 3 && same_word(word_.substr(0, 3), "end") && same_word(word_.substr(3), what);
  }
  void expect_end_of(std::string_view what) {
    const std::string word = "end" + std::string(what);
    next_word(word);
    if (!is_end_of(what)) text_.fail_expected(word, word_);
  }

  TextReader text_;
  MeshBuilder builder_;
  std::string_view word_;
};

}  // namespace

MeshFile parse_stl(std::string_view bytes, const std::string& file) {
  return is_text(bytes, file) ? TextStl(bytes, file).read() : parse_binary(bytes, file);
}

}  // namespace tact::scenes
