#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "scenes/files/file_error.h"
#include "scenes/pictures/film.h"
#include "scenes/pictures/png_file.h"
#include "scenes/pictures/program.h"
#include "tests/support/environment/temporary_folder.h"

using namespace tact::scenes;
using tact::tests::TemporaryFolder;

namespace {

void write_frames(const std::filesystem::path& folder, int count) {
  std::filesystem::create_directories(folder);
  for (int i = 0; i < count; ++i) {
    write_png(frame_file(folder, i), Picture(33, 21, {static_cast<std::uint8_t>(60 * i), 90, 30}));
  }
}

std::string first_bytes(const std::filesystem::path& file, std::size_t count) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(count, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  return bytes;
}

bool installed(const std::string& program) {
  const TemporaryFolder folder;
  return run_program({program, "-version"}, folder.path(), folder.path() / "log").end != ProgramResult::End::missing;
}

}  // namespace

TEST(Film, MissingEncodersAreNamed) {
  const TemporaryFolder folder;
  write_frames(folder.path(), 2);
  try {
    make_film(folder.path(), 2, folder.path() / "film", {.ffmpeg = "no-such-encoder", .img2webp = "nor-this-one"});
    FAIL() << "an encoder was found";
  } catch (const NoEncoder& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("no-such-encoder"), std::string::npos) << message;
    EXPECT_NE(message.find("nor-this-one"), std::string::npos) << message;
    EXPECT_NE(message.find(folder.path().string()), std::string::npos) << message;
  }
  EXPECT_TRUE(std::filesystem::exists(frame_file(folder.path(), 1)));
}

TEST(Film, FfmpegMakesAnMp4OfOddSizesAndOddNames) {
  if (!installed("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  const auto frames = folder.path() / "a folder; $(with) 100% 'names'";
  write_frames(frames, 4);
  const auto film = make_film(frames, 4, frames / "film");
  EXPECT_EQ(film.extension(), ".mp4");
  EXPECT_EQ(first_bytes(film, 8).substr(4), "ftyp");
  EXPECT_FALSE(std::filesystem::exists(film.string() + ".log"));
}

TEST(Film, WebpWhereFfmpegIsMissing) {
  if (!installed("img2webp")) GTEST_SKIP() << "img2webp is not installed";
  const TemporaryFolder folder;
  write_frames(folder.path(), 3);
  const auto film = make_film(folder.path(), 3, folder.path() / "film", {.ffmpeg = "no-such-encoder"});
  EXPECT_EQ(film.extension(), ".webp");
  EXPECT_EQ(first_bytes(film, 4), "RIFF");
}

TEST(Film, AFailingEncoderAndMissingFramesAreErrors) {
  const TemporaryFolder folder;
  write_frames(folder.path(), 2);
  EXPECT_THROW(make_film(folder.path(), 3, folder.path() / "film"), FileError);
  EXPECT_THROW(make_film(folder.path(), 0, folder.path() / "film"), FileError);
  EXPECT_THROW(make_film(folder.path(), 2, folder.path() / "film", {.ffmpeg = "false"}), FileError);
}

TEST(Program, OutputStatusAndFolder) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "log";
  const ProgramResult here = run_program({"pwd"}, folder.path(), log);
  EXPECT_EQ(here.end, ProgramResult::End::success);
  EXPECT_NE(here.output.find(folder.path().filename().string()), std::string::npos);
  EXPECT_EQ(run_program({"echo", "$HOME; ls"}, folder.path(), log).output, "$HOME; ls");
  EXPECT_EQ(run_program({"false"}, folder.path(), log).end, ProgramResult::End::failure);
  EXPECT_EQ(run_program({"no-such-program"}, folder.path(), log).end, ProgramResult::End::missing);
  EXPECT_FALSE(std::filesystem::exists(log));
}
