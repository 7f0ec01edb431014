// Several pictures in one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/pictures/picture.h"
#include "scenes/pictures/text.h"

namespace tact::scenes {

struct SheetSettings {
  int columns = 3;
  int tile_width = 640;  // pixels; each picture is scaled down to it and keeps its proportions
  int gap = 12;          // pixels between and around the pictures
};

// `count` frames spread evenly over `frames`, the first and the last among them; all of them if there are no more.
std::vector<int> sheet_frames(int frames, int count = 6);

// The pictures in rows from the top left, each with its caption below. All pictures have the size of the first; there
// is a caption for each. Errors: std::runtime_error for no pictures, other sizes, other numbers of captions, no
// columns, or tiles wider than the pictures.
Picture contact_sheet(std::span<const Picture> pictures, std::span<const std::string> captions, Font& font,
                      const SheetSettings& settings = {});

}  // namespace tact::scenes
