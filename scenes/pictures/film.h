// Frames and films. A packaged encoder makes the film; it is run as a program, so that nothing depends on it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tact::scenes {

// Where frame number `frame` (from 0) of a film lies in `folder`: frame_00000.png and so on.
std::filesystem::path frame_file(const std::filesystem::path& folder, int frame);

struct FilmSettings {
  int frames_per_second = 30;         // 1 to 1000
  std::string ffmpeg = "ffmpeg";      // the programs to try: the first makes an MP4 file (H.264, 4:2:0),
  std::string img2webp = "img2webp";  // the second an animated WebP file
};

// There is no encoder; the message names the programs and what to install. The frames are there all the same.
class NoEncoder : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Makes a film of the frames 0 to `frames` - 1 in `folder` and returns its path: `film` with the extension .mp4, or
// .webp where ffmpeg is missing. An older film of that name is replaced. Errors: NoEncoder; FileError if a frame is
// missing or the encoder fails (the message holds its last lines).
std::filesystem::path make_film(const std::filesystem::path& folder, int frames, const std::filesystem::path& film,
                                const FilmSettings& settings = {});

}  // namespace tact::scenes
