// Words on pictures.
#pragma once

#include <memory>
#include <string_view>

#include "scenes/pictures/picture.h"

namespace tact::scenes {

// DejaVu Sans as FreeType draws it. A font may be used by one thread at a time.
class Font {
 public:
  // Errors: std::runtime_error that names the places looked at and the package to install.
  Font();
  ~Font();
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;

  // Draws one line of UTF-8 text whose baseline starts at (x, y), with letters of `size` pixels from line to line. What
  // leaves the picture is cut off; a character that the font lacks is drawn as a box.
  void draw(Picture& picture, std::string_view text, int x, int y, int size, Color color);
  // The width of `text` in pixels.
  int width(std::string_view text, int size);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tact::scenes
