#include "scenes/pictures/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

namespace tact::scenes {
namespace {

// Where Debian, Fedora and Arch put the font.
constexpr std::array<const char*, 3> kFontFiles{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                                "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                                "/usr/share/fonts/TTF/DejaVuSans.ttf"};
constexpr char32_t kUnreadable = 0xfffd;

// Takes one character off the front of UTF-8 text; bytes that are not UTF-8 give kUnreadable.
char32_t take_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (first < 0x80) return first;
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  if (more == 0 || text.size() < static_cast<std::size_t>(more)) return kUnreadable;
  char32_t character = first & (0x3fu >> more);
  for (int i = 0; i < more; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xc0u) != 0x80u) return kUnreadable;
    character = character << 6 | (byte & 0x3fu);
  }
  text.remove_prefix(static_cast<std::size_t>(more));
  return character;
}

std::uint8_t blended(std::uint8_t below, std::uint8_t above, int cover) {
  return static_cast<std::uint8_t>((below * (255 - cover) + above * cover + 127) / 255);
}

}  // namespace

struct Font::Implementation {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  Implementation() {
    if (FT_Init_FreeType(&library) != 0) throw std::runtime_error("FreeType does not start");
    for (const char* file : kFontFiles) {
      if (std::filesystem::exists(file) && FT_New_Face(library, file, 0, &face) == 0) return;
    }
    FT_Done_FreeType(library);
    throw std::runtime_error(
        fmt::format("no font for the words on pictures: looked for {}; the package is fonts-dejavu-core",
                    fmt::join(kFontFiles, ", ")));
  }
  ~Implementation() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  // Calls visit(glyph, x) for each character, x being the pen's place in pixels; returns where the pen ends.
  template <class Visit>
  int walk(std::string_view text, int size, FT_Int32 flags, const Visit& visit) {
    FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size));
    FT_Pos pen = 0;  // 1/64 pixels
    FT_UInt last = 0;
    while (!text.empty()) {
      const FT_UInt index = FT_Get_Char_Index(face, take_character(text));
      FT_Vector kerning{};
      if (last != 0) FT_Get_Kerning(face, last, index, FT_KERNING_DEFAULT, &kerning);
      if (FT_Load_Glyph(face, index, flags) != 0) throw std::runtime_error("FreeType cannot draw a character");
      pen += kerning.x;
      visit(*face->glyph, static_cast<int>(pen >> 6));
      pen += face->glyph->advance.x;
      last = index;
    }
    return static_cast<int>(pen >> 6);
  }
};

Font::Font() : implementation_(std::make_unique<Implementation>()) {}
Font::~Font() = default;
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;

void Font::draw(Picture& picture, std::string_view text, int x, int y, int size, Color color) {
  implementation_->walk(text, size, FT_LOAD_RENDER, [&](const FT_GlyphSlotRec& glyph, int pen) {
    const FT_Bitmap& bitmap = glyph.bitmap;
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
      for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
        const int px = x + pen + glyph.bitmap_left + column;
        const int py = y - glyph.bitmap_top + row;
        if (px < 0 || py < 0 || px >= picture.width || py >= picture.height) continue;
        const int cover = bitmap.buffer[row * bitmap.pitch + column];
        Color& pixel = picture.at(px, py);
        pixel = {blended(pixel.red, color.red, cover), blended(pixel.green, color.green, cover),
                 blended(pixel.blue, color.blue, cover)};
      }
    }
  });
}

int Font::width(std::string_view text, int size) {
  return implementation_->walk(text, size, FT_LOAD_DEFAULT, [](const FT_GlyphSlotRec&, int) {});
}

}  // namespace tact::scenes
