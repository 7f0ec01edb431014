#include "scenes/commands/scenes_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iostream>

#include "scenes/library/catalog.h"

namespace tact::scenes {

void list_scenes(std::ostream& out) {
  std::size_t width = 0;
  for (const SceneEntry& scene : scene_catalog()) width = std::max(width, scene.name.size());
  for (const SceneEntry& scene : scene_catalog()) {
    fmt::print(out, "{:<{}}  {}", scene.name, width, scene.summary);
    if (!scene.size_meaning.empty()) {
      fmt::print(out, "; --size: {}, {} to {}, {} if not given", scene.size_meaning, scene.smallest_size,
                 scene.largest_size, scene.default_size);
    }
    fmt::print(out, "\n");
  }
}

void add_scenes_command(CLI::App& program) {
  program.add_subcommand("scenes", "List the scenes that `tact run` plays")->callback([] { list_scenes(std::cout); });
}

}  // namespace tact::scenes
