// Pictures of the scenes, beside each other. Without the program's renderer (TACT_BUILD_PROGRAM=OFF) there are none.
#pragma once

#include <memory>
#include <string>

#include "scene.h"

namespace example {

class Film {
 public:
  explicit Film(const std::string& folder);  // empty: takes no pictures
  ~Film();

  void begin(const std::string& title);
  void look(const Scene& scene, int step);
  // Joins what was played, left to right, into FOLDER/film.webp and the sheet FOLDER/sheet.png.
  void end();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace example
