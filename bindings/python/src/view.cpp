#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tact/recording.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include "file_bindings.h"
#include "scenes/files/mapped_file.h"
#include "scenes/files/of_recording.h"
#include "scenes/view/view_page.h"
#include "shared_world.h"

namespace tact::python {
namespace {

scenes::ViewOptions options_of(int every, int from, std::optional<int> to, bool few_points) {
  scenes::ViewOptions options{.file = "-", .every = every, .from = from, .few_points = few_points};
  if (to) options.to = *to;
  return options;
}

// A world as it stands, as a page of one step. It is a copy that is stepped: the caller's world stays as it is, and
// what its last report did not compute, such as zones, is there all the same.
std::string page_of_world(SharedWorld& shared, const std::string& title) {
  std::ostringstream text;
  shared.ask([&](const World& world) {
    Settings settings = world.settings();
    settings.on_message = nullptr;
    World copy(settings);
    copy.restore(world.save());
    settings.outputs.zones = settings.outputs.patches = true;
    copy.set_settings(settings);
    scenes::ViewPage page(options_of(1, 0, std::nullopt, false), {.name = title, .kind = "meshes"}, text);
    page.add_step(0, std::nullopt, copy, copy.detect());
    page.finish(scenes::Ending::complete);
  });
  return text.str();
}

void check_steps(int every, int from, std::optional<int> to) {
  if (every < 1) throw py::value_error("every is " + std::to_string(every) + ", not at least 1");
  if (from < 0) throw py::value_error("start is " + std::to_string(from) + ", not at least 0");
  if (to && *to < from)
    throw py::value_error("stop is " + std::to_string(*to) + ", before start, " + std::to_string(from));
}

// The page that `tact view FILE` writes. Contact points and curves that were not recorded are found if they are wanted.
std::string page_of_recording(const std::filesystem::path& path, int every, int from, std::optional<int> to,
                              bool few_points, bool points, bool curves) {
  check_steps(every, from, to);
  const std::string name = path.string();
  const scenes::MappedFile file(path);
  std::ostringstream text;
  const scenes::ViewOptions options = options_of(every, from, to, few_points);
  scenes::ViewPage page(options, {.name = path.filename().string(), .kind = "recording"}, text);
  const Outputs outputs{.zones = true, .patches = true, .points = points, .curves = curves};
  RecordingPlayer player = scenes::open_recording(file.bytes(), name, {.threads = {}, .outputs = outputs});
  for (;;) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const std::optional<PlayedStep> step = scenes::of_recording(name, [&] { return player.next(); });
    if (!step || step->number > options.to) break;
    page.add_step(step->number, std::nullopt, player.world(), player.report());
  }
  page.finish(player.cut_at() ? scenes::Ending::interrupted : scenes::Ending::complete);
  return text.str();
}

}  // namespace

void define_view(py::module_& module) {
  module.def("_page_of_world", &page_of_world, py::arg("world"), py::arg("title"));
  module.def("_page_of_recording", &page_of_recording, py::arg("path"), py::kw_only(), py::arg("every"),
             py::arg("start"), py::arg("stop"), py::arg("few_points"), py::arg("points"), py::arg("curves"));
}

}  // namespace tact::python
