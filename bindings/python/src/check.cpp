#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tact/world.h>

#include <Eigen/Core>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "file_bindings.h"
#include "motion.h"
#include "scenes/commands/check_steps.h"
#include "scenes/commands/report_json.h"
#include "scenes/commands/usage_error.h"
#include "scenes/files/mesh_builder.h"
#include "scenes/files/named_files.h"
#include "scenes/files/weld_frames.h"
#include "shared_world.h"
#include "text.h"

namespace tact::python {
namespace {

using scenes::BodyFrames;

py::array_t<double> rows_of(const Eigen::Matrix3Xd& columns) {
  py::array_t<double> array({static_cast<py::ssize_t>(columns.cols()), py::ssize_t{3}});
  std::copy_n(columns.data(), columns.size(), array.mutable_data());
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::list frames_of(const BodyFrames& body) {
  py::list frames;
  for (const Eigen::Matrix3Xd& positions : body.positions) frames.append(rows_of(positions));
  return frames;
}

// The number of each vertex in the files.
py::array_t<int> vertices_of(const BodyFrames& body) {
  std::vector<int> numbers = body.vertices;
  if (numbers.empty()) {
    numbers.resize(static_cast<std::size_t>(body.positions.front().cols()));
    std::iota(numbers.begin(), numbers.end(), 0);
  }
  return py::array_t<int>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::array_t<int> facets_of(const BodyFrames& body) {
  py::array_t<int> array({static_cast<py::ssize_t>(body.facets.cols()), py::ssize_t{3}});
  std::copy_n(body.facets.data(), body.facets.size(), array.mutable_data());
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// A body of arrays: one frame stands still.
BodyFrames body_frames(const std::filesystem::path& given_name, const py::list& positions, py::handle facets,
                       py::handle vertices, std::vector<double> times, std::vector<std::filesystem::path> files) {
  const std::string name = given_name.string();
  const auto check_count = [&](std::size_t count, const char* what) {
    if (count != 0 && count != positions.size())
      throw py::value_error(name + ": " + std::to_string(count) + " " + what + " for " +
                            std::to_string(positions.size()) + " frames");
  };
  if (positions.empty()) throw py::value_error(name + ": it has no frames");
  check_count(times.size(), "times");
  check_count(files.size(), "files");
  BodyFrames body{.name = name, .files = std::move(files)};
  body.times = std::move(times);
  const py::array_t<int> numbers = indices_argument(vertices, "vertices");
  body.vertices.assign(numbers.data(), numbers.data() + numbers.size());
  body.short_name = std::filesystem::path(name).stem().string();
  body.moves = positions.size() > 1;
  for (const py::handle frame : positions) {
    const PositionsArgument given(frame);
    const Positions columns = given.columns();
    Eigen::Matrix3Xd& copy = body.positions.emplace_back(3, columns.cols());
    for (Eigen::Index v = 0; v < columns.cols(); ++v)
      copy.col(v) = Eigen::Map<const Eigen::Vector3d>(columns.column(v).data());
  }
  if (!body.vertices.empty() && std::ssize(body.vertices) != body.positions.front().cols())
    throw py::value_error(name + ": vertices has " + std::to_string(body.vertices.size()) + " numbers for " +
                          std::to_string(body.positions.front().cols()) + " vertices");
  const FacetsArgument given(facets);
  const Facets columns = given.columns();
  body.facets.resize(3, columns.cols());
  for (Eigen::Index f = 0; f < columns.cols(); ++f)
    body.facets.col(f) = Eigen::Map<const Eigen::Vector3i>(columns.column(f).data());
  return body;
}

std::vector<BodyFrames> read_bodies(const std::vector<std::filesystem::path>& paths, int most_frames,
                                    const py::object& progress) {
  return scenes::read_bodies(paths, most_frames, [&](int done, int all) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(done, all);
  });
}

// The polygons of `name`, of which each has `sizes` corners, as triangles: as the readers split them.
py::array_t<int> split_polygons(const std::string& name, py::handle positions, py::handle sizes, py::handle corners) {
  class Polygons final : public scenes::Source {
   public:
    using Source::Source;
    std::int64_t place() const override { return 0; }

   private:
    std::string place_text(std::int64_t) const override { return ""; }
  } source({}, name);
  scenes::MeshBuilder builder(source, scenes::Split::by_shape);
  const PositionsArgument given(positions);
  const Positions columns = given.columns();
  for (Eigen::Index v = 0; v < columns.cols(); ++v) {
    source.set_item("vertex", v);
    builder.add_vertex(columns.column(v));
  }
  const auto counts = indices_argument(sizes, "sizes"), indices = indices_argument(corners, "corners");
  std::vector<int> polygon;
  py::ssize_t at = 0;
  for (py::ssize_t i = 0; i < counts.size(); ++i) {
    source.set_item("facet", builder.facet_count());
    if (counts.at(i) < 0 || counts.at(i) > indices.size() - at) source.fail("its corners go beyond their array");
    polygon.clear();
    for (const py::ssize_t end = at + counts.at(i); at < end; ++at)
      polygon.push_back(builder.corner(indices.at(at), builder.vertex_count()));
    builder.add_polygon(polygon);
  }
  BodyFrames body;
  body.facets = builder.mesh().facets;
  return facets_of(body);
}

// What tact.check() steps through: the world, the bodies and, if wanted, the JSON of all frames.
class Steps {
 public:
  Steps(const Settings& settings, const std::vector<BodyFrames>& bodies, const scenes::BodyOptions& options, bool weld,
        bool impacts, bool json, const std::filesystem::path& json_file, bool surfaces,
        const std::filesystem::path& record)
      : world_(std::make_shared<SharedWorld>(std::make_shared<World>(settings))), impacts_(impacts) {
    std::vector<BodyFrames> frames = bodies;
    if (weld) std::for_each(frames.begin(), frames.end(), scenes::weld_frames);
    const auto excluded = scenes::apply_body_options(
        options, frames, {.sheet = "sheets", .margin = "margins", .self = "selves", .exclude = "exclude"});
    scenes::NamedFiles files;
    for (const BodyFrames& body : bodies)
      std::ranges::for_each(body.files, [&](const auto& file) { files.add_input(file); });
    files.add_output("json", json_file);
    files.add_output("record", record);
    if (!record.empty()) world_->record(record.string());
    world_->compute([&](World& world) { steps_.emplace(std::move(frames), excluded, world); });
    using Report = scenes::JsonReport;
    if (json) {
      report_.emplace(text_, world_->read(), Report::Outcomes::none,
                      surfaces ? Report::Surfaces::checked : Report::Surfaces::taken,
                      weld ? steps_->welds() : std::vector<scenes::Weld>());
    }
  }

  py::tuple step(int frame, std::optional<double> time) {
    const std::uint64_t number = world_->next_report();
    const Report* report = nullptr;
    const MotionReport* motion = nullptr;
    world_->compute([&](World&) {
      const scenes::CheckedFrame checked = steps_->step(frame, impacts_);
      report = &checked.report, motion = checked.motion;
      if (report_) report_->add_frame(frame, *report, motion, steps_->files_of(frame), time);
    });
    const py::object arrays = motion != nullptr ? py::cast(motion_arrays(*motion, {})) : py::none();
    return py::make_tuple(OfReport<Report>(world_, number, report), arrays);
  }

  std::string finish_json() {
    report_->finish();
    return text_.str();
  }
  const std::shared_ptr<SharedWorld>& world() const { return world_; }
  std::vector<BodyId> ids() const { return steps_->ids(); }
  const std::vector<BodyFrames>& bodies() const { return steps_->bodies(); }
  py::list files_of(int frame) const {
    py::list names;
    for (const std::string& file : steps_->files_of(frame)) names.append(name_of(file));
    return names;
  }

 private:
  std::shared_ptr<SharedWorld> world_;
  bool impacts_;
  std::optional<scenes::CheckSteps> steps_;
  std::ostringstream text_;
  std::optional<scenes::JsonReport> report_;
};

void raise_value_error(const char* text) { PyErr_SetObject(PyExc_ValueError, sentence(text).ptr()); }

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const scenes::FileError& error) {
    raise_value_error(error.what());
  } catch (const scenes::UsageError& error) {
    raise_value_error(error.what());
  }
}

}  // namespace

void define_check(py::module_& module) {
  py::register_exception_translator(translate);
  py::class_<BodyFrames>(module, "_BodyFrames", "A body as files give it.")
      .def(py::init(&body_frames), py::arg("name"), py::arg("positions"), py::arg("facets"), py::arg("vertices"),
           py::arg("times"), py::arg("files"))
      .def_property_readonly("name", [](const BodyFrames& body) { return name_of(body.name); })
      .def_readonly("times", &BodyFrames::times)
      .def_property_readonly("files",
                             [](const BodyFrames& body) {
                               py::list files;
                               for (const auto& file : body.files) files.append(name_of(file.string()));
                               return files;
                             })
      .def_property_readonly("warnings",
                             [](const BodyFrames& body) {
                               py::list warnings;
                               for (const std::string& warning : body.warnings) warnings.append(sentence(warning));
                               return warnings;
                             })
      .def_property_readonly("frame_count", [](const BodyFrames& body) { return body.positions.size(); })
      .def_property_readonly("moves", [](const BodyFrames& body) { return body.moves; })
      .def_property_readonly("positions", frames_of)
      .def_property_readonly("facets", facets_of)
      .def_property_readonly("vertices", vertices_of);
  module.def("_read_bodies", &read_bodies, py::arg("paths"), py::arg("most_frames"), py::arg("progress"));
  module.def("_split_polygons", &split_polygons, py::arg("name"), py::arg("positions"), py::arg("sizes"),
             py::arg("corners"));
  py::class_<Steps>(module, "_CheckSteps", "What tact.check() steps through.")
      .def(py::init([](const Settings& settings, const std::vector<BodyFrames>& bodies, std::vector<std::string> sheets,
                       std::optional<double> margin, std::vector<std::pair<std::string, double>> margins,
                       std::vector<std::string> selves, std::vector<std::pair<std::string, std::string>> excluded,
                       bool weld, bool impacts, bool json, const std::filesystem::path& json_file, bool surfaces,
                       const std::filesystem::path& record) {
             return std::make_unique<Steps>(settings, bodies,
                                            scenes::BodyOptions{.sheets = std::move(sheets),
                                                                .margin = margin,
                                                                .margins = std::move(margins),
                                                                .selves = std::move(selves),
                                                                .excluded = std::move(excluded)},
                                            weld, impacts, json, json_file, surfaces, record);
           }),
           py::arg("settings"), py::arg("bodies"), py::kw_only(), py::arg("sheets"), py::arg("margin"),
           py::arg("margins"), py::arg("selves"), py::arg("exclude"), py::arg("weld"), py::arg("impacts"),
           py::arg("json"), py::arg("json_file"), py::arg("surfaces"), py::arg("record"))
      .def("step", &Steps::step, py::arg("frame"), py::arg("time"))
      .def("finish_json", &Steps::finish_json)
      .def("files_of", &Steps::files_of, py::arg("frame"))
      .def_property_readonly("world", &Steps::world)
      .def_property_readonly("ids", &Steps::ids)
      .def_property_readonly("bodies", &Steps::bodies);
}

}  // namespace tact::python
