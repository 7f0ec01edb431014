#include <cstdio>

#include "film.h"

namespace example {

struct Film::Implementation {};

Film::Film(const std::string& folder) {
  if (!folder.empty()) std::fprintf(stderr, "no pictures: built without the program, which draws them\n");
}
Film::~Film() = default;
void Film::begin(const std::string&) {}
void Film::look(const Scene&, int) {}
void Film::end() {}

}  // namespace example
