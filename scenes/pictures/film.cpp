#include "scenes/pictures/film.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "scenes/files/file_error.h"
#include "scenes/pictures/program.h"

namespace tact::scenes {
namespace {

std::vector<std::string> ffmpeg_arguments(int frames, const std::string& output, const FilmSettings& settings) {
  // 4:2:0 needs even sizes; players want the index at the front.
  return {settings.ffmpeg,
          "-nostdin",
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-framerate",
          std::to_string(settings.frames_per_second),
          "-start_number",
          "0",
          "-i",
          "frame_%05d.png",
          "-frames:v",
          std::to_string(frames),
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-c:v",
          "libx264",
          "-preset",
          "medium",
          "-crf",
          "18",
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+faststart",
          output};
}

std::vector<std::string> img2webp_arguments(int frames, const std::string& output, const FilmSettings& settings) {
  std::vector<std::string> arguments{
      settings.img2webp,
      "-loop",
      "0",
      "-o",
      output,
      "-lossy",
      "-q",
      "85",
      "-d",
      std::to_string((1000 + settings.frames_per_second / 2) / settings.frames_per_second)};
  for (int frame = 0; frame < frames; ++frame) arguments.push_back(frame_file({}, frame).string());
  return arguments;
}

// Nothing if the program is missing.
std::optional<std::filesystem::path> encode(const std::vector<std::string>& arguments,
                                            const std::filesystem::path& folder, const std::filesystem::path& output) {
  const ProgramResult result = run_program(arguments, folder, output.string() + ".log");
  if (result.end == ProgramResult::End::missing) return std::nullopt;
  if (result.end == ProgramResult::End::failure) {
    throw FileError(fmt::format("{}: {} could not make the film: {}", output.string(), arguments[0], result.output));
  }
  return output;
}

}  // namespace

std::filesystem::path frame_file(const std::filesystem::path& folder, int frame) {
  return folder / fmt::format("frame_{:05}.png", frame);
}

std::filesystem::path make_film(const std::filesystem::path& folder, int frames, const std::filesystem::path& film,
                                const FilmSettings& settings) {
  if (frames < 1) throw FileError(fmt::format("{}: a film of no frames", film.string()));
  for (int frame = 0; frame < frames; ++frame) {
    if (!std::filesystem::exists(frame_file(folder, frame))) {
      throw FileError(fmt::format("{}: the frame is missing", frame_file(folder, frame).string()));
    }
  }
  // The encoders run in the folder of the frames.
  const auto output = [&](const char* extension) {
    return std::filesystem::absolute(film).replace_extension(extension);
  };
  const auto mp4 = output(".mp4");
  if (auto made = encode(ffmpeg_arguments(frames, mp4.string(), settings), folder, mp4)) return *made;
  const auto webp = output(".webp");
  if (auto made = encode(img2webp_arguments(frames, webp.string(), settings), folder, webp)) return *made;
  throw NoEncoder(
      fmt::format("no film: neither {} nor {} is installed (packages ffmpeg and webp); the {} frames are in {}",
                  settings.ffmpeg, settings.img2webp, frames, folder.string()));
}

}  // namespace tact::scenes
