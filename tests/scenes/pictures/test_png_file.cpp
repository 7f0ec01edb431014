#include <gtest/gtest.h>

#include <random>
#include <string>

#include "scenes/files/file_error.h"
#include "scenes/pictures/png_file.h"
#include "tests/support/environment/temporary_folder.h"

using namespace tact::scenes;
using tact::tests::TemporaryFolder;

namespace {

Picture noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Picture picture(width, height);
  for (Color& pixel : picture.pixels) {
    pixel = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
             static_cast<std::uint8_t>(random())};
  }
  return picture;
}

}  // namespace

TEST(PngFile, RoundTrip) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 33}}) {
    const Picture picture = noise(width, height, 5);
    write_png(folder.path() / "a.png", picture);
    EXPECT_EQ(read_png(folder.path() / "a.png"), picture) << width << " x " << height;
  }
}

TEST(PngFile, EqualPicturesGiveEqualBytesWithoutTime) {
  const TemporaryFolder folder;
  const Picture picture = noise(40, 30, 1);
  write_png(folder.path() / "a.png", picture);
  write_png(folder.path() / "b.png", picture);
  const std::string bytes = tact::tests::contents(folder.path() / "a.png");
  EXPECT_EQ(bytes, tact::tests::contents(folder.path() / "b.png"));
  EXPECT_EQ(bytes.find("tIME"), std::string::npos);
}

TEST(PngFile, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  const auto message = [](auto&& act) {
    try {
      act();
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto nowhere = folder.path() / "no" / "such.png";
  EXPECT_NE(message([&] { write_png(nowhere, noise(2, 2, 1)); }).find("such.png"), std::string::npos);
  EXPECT_NE(message([&] { read_png(nowhere); }).find("such.png"), std::string::npos);
  const auto text = folder.write("text.png", "not a picture");
  EXPECT_NE(message([&] { read_png(text); }).find("text.png"), std::string::npos);
}
