#include "scenes/pictures/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <string>
#include <system_error>

#include "scenes/files/file_error.h"

namespace tact::scenes {
namespace {

// The simplified interface of libpng keeps its errors in the structure, without longjmp over our objects.
png_image image_of(int width, int height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  return image;
}

}  // namespace

static_assert(sizeof(Color) == 3, "rows of pixels are handed to libpng as they are");

void write_png(const std::filesystem::path& file, const Picture& picture) {
  png_image image = image_of(picture.width, picture.height);
  if (png_image_write_to_file(&image, file.c_str(), 0, picture.pixels.data(), 0, nullptr) != 0) return;
  std::error_code ignored;  // the first error is the one to report
  std::filesystem::remove(file, ignored);
  throw FileError(fmt::format("{}: cannot write the picture: {}", file.string(), image.message));
}

Picture read_png(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Picture picture;
  if (png_image_begin_read_from_file(&image, file.c_str()) != 0) {
    image.format = PNG_FORMAT_RGB;
    picture = Picture(static_cast<int>(image.width), static_cast<int>(image.height));
    const png_color black{};
    if (png_image_finish_read(&image, &black, picture.pixels.data(), 0, nullptr) != 0) return picture;
  }
  const std::string message = image.message;
  png_image_free(&image);
  throw FileError(fmt::format("{}: cannot read the picture: {}", file.string(), message));
}

}  // namespace tact::scenes
