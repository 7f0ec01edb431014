// STL, text and binary.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>
#include <vector>

#include "scenes/files/binary_reader.h"
#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kHeadSize = 84;   // 80 bytes of anything, then the number of facets
constexpr std::size_t kFacetSize = 50;  // normal, three corners, two bytes of attributes

using PositionBits = std::array<std::uint64_t, 3>;

struct PositionHash {
  std::size_t operator()(const PositionBits& bits) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : bits) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

// Some programs write the words of a text in capitals.
bool same_word(std::string_view text, std::string_view lower_case) {
  return std::equal(text.begin(), text.end(), lower_case.begin(), lower_case.end(),
                    [](char t, char c) { return t == c || (t >= 'A' && t <= 'Z' && t - 'A' + 'a' == c); });
}

// Gives corners with equal bits one vertex; the numbers follow the file, so the order within the map never shows.
class CornerMerger {
 public:
  explicit CornerMerger(MeshBuilder& builder) : builder_(builder) {}

  int vertex(const std::array<double, 3>& position) {
    const auto bits = std::bit_cast<PositionBits>(position);
    const auto [entry, is_new] = numbers_.try_emplace(bits, builder_.vertex_count());
    if (is_new) builder_.add_vertex(position);
    return entry->second;
  }

 private:
  MeshBuilder& builder_;
  std::unordered_map<PositionBits, int, PositionHash> numbers_;
};

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

MeshFile parse_binary(std::string_view bytes, const std::string& file) {
  if (bytes.size() < kHeadSize) {
    throw FileError(
        fmt::format("{}: byte {}: neither text that begins with solid nor the {} bytes that begin binary STL", file,
                    bytes.size(), kHeadSize));
  }
  BinaryReader binary(bytes, file, kHeadSize - 4, std::endian::little);
  const std::uint32_t count = binary.read<std::uint32_t>();
  if (binary_size(bytes, file) != bytes.size()) {
    binary.fail(fmt::format("promises {} facets, which take {} bytes, but the file has {}", count,
                            binary_size(bytes, file), bytes.size()));
  }
  MeshBuilder builder(binary);
  CornerMerger merger(builder);
  std::vector<int> corners(3);
  for (std::uint32_t i = 0; i < count; ++i) {
    binary.set_item("facet", i);
    binary.skip(12);  // the normal
    for (int& corner : corners) {
      std::array<double, 3> position;
      for (double& value : position) value = static_cast<double>(binary.read<float>());
      corner = merger.vertex(position);
    }
    builder.add_polygon(corners);
    binary.skip(2);  // attributes
  }
  return builder.mesh();
}

// The words of a text may be spread over lines in any way.
class TextStl {
 public:
  TextStl(std::string_view bytes, const std::string& file)
      : text_(bytes, file, {}), builder_(text_), merger_(builder_), corners_(3) {}

  MeshFile read() {
    while (text_.seek_token()) {
      expect("solid");
      text_.skip_line();
      while (same_word(next_word("facet or endsolid"), "facet")) read_facet();
      if (!same_word(word_, "endsolid")) text_.fail_expected("facet or endsolid", word_);
      text_.skip_line();
    }
    return builder_.mesh();
  }

 private:
  // After the word facet.
  void read_facet() {
    text_.set_item("facet", builder_.facet_count());
    expect("normal");
    for (int i = 0; i < 3; ++i) next_word("three numbers after normal");  // often nan where a facet has no area
    expect("outer");
    expect("loop");
    for (int& corner : corners_) {
      expect("vertex");
      std::array<double, 3> position;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        text_.seek_token();
        position[axis] = text_.number("a number", std::string_view("xyz").substr(axis, 1));
      }
      corner = merger_.vertex(position);
    }
    expect("endloop");
    expect("endfacet");
    builder_.add_polygon(corners_);
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

  TextReader text_;
  MeshBuilder builder_;
  CornerMerger merger_;
  std::vector<int> corners_;
  std::string_view word_;
};

}  // namespace

MeshFile parse_stl(std::string_view bytes, const std::string& file) {
  return is_text(bytes, file) ? TextStl(bytes, file).read() : parse_binary(bytes, file);
}

}  // namespace tact::scenes
