#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tact/recording.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "bindings.h"
#include "shared_world.h"

namespace tact::python {

namespace {

// OSError as open() has it: of what the system said last.
[[noreturn]] void refuse_file(const std::string& path) {
  if (errno == 0) errno = EIO;
  PyErr_SetFromErrnoWithFilename(PyExc_OSError, path.c_str());
  throw py::error_already_set();
}

}  // namespace

void SharedWorld::record(const std::string& path) {
  World& world = use();
  WorldObserver trial;
  world.set_observer(&trial);  // a refused call empties no file
  world.set_observer(recording_ == nullptr ? nullptr : &recording_->recorder);
  errno = 0;
  auto recording = std::make_unique<FileRecording>(path);
  if (!recording->file) refuse_file(path);
  world.set_observer(&recording->recorder);
  recording_ = std::move(recording);
}

void SharedWorld::stop_recording() {
  use().set_observer(nullptr);
  if (recording_ == nullptr) return;
  recording_->file.close();
  const bool whole = recording_->file.good();
  recording_.reset();
  if (whole) return;
  PyErr_SetString(PyExc_OSError, "the recording could not be written whole");
  throw py::error_already_set();
}

namespace {

std::string bytes_of_file(const std::filesystem::path& path) {
  std::error_code not_there;
  if (std::filesystem::is_directory(path, not_there)) {
    PyErr_SetString(PyExc_IsADirectoryError, ("the recording is a folder: " + path.string()).c_str());
    throw py::error_already_set();
  }
  errno = 0;
  try {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (file) return bytes;
  } catch (const std::ios_base::failure&) {  // the iterator lets errors of reading through
  }
  refuse_file(path.string());
}

// A player, the bytes that it plays, and its world as Python has it.
class Player {
 public:
  Player(const std::filesystem::path& path, std::optional<int> threads)
      : held_(std::make_shared<Held>(bytes_of_file(path), threads)),
        world_(std::make_shared<SharedWorld>(std::shared_ptr<World>(held_, &held_->player.world()))) {}

  std::optional<PlayedStep> next() {
    world_->use();
    world_->next_report();
    std::optional<PlayedStep> step;
    world_->compute([&](World&) { step = held_->player.next(); });
    return step;
  }
  const std::shared_ptr<SharedWorld>& world() const { return world_; }
  std::optional<std::size_t> cut_at() const {
    world_->read();  // refused while another thread plays
    return held_->player.cut_at();
  }
  const std::string& recorded_by() const { return held_->player.recorded_by(); }

 private:
  struct Held {
    Held(std::string given, std::optional<int> threads)
        : bytes(std::move(given)), player(bytes, {.threads = threads, .outputs = {}}) {}
    std::string bytes;
    RecordingPlayer player;
  };
  std::shared_ptr<Held> held_;
  std::shared_ptr<SharedWorld> world_;
};

std::string text_of(const PlayedStep& step) {
  return "<tact.PlayedStep " + std::to_string(step.number) + (step.same() ? ", same>" : ", different>");
}

}  // namespace

void define_recording(py::module_& module, WorldClass& world) {
  world
      .def(
          "record", [](SharedWorld& w, const std::filesystem::path& path) { w.record(path.string()); }, py::arg("path"),
          "writes all that enters the world to a file that `tact replay` runs again; before the first body is added")
      .def("stop_recording", &SharedWorld::stop_recording, "closes the file; OSError if it does not hold all");
  py::class_<PlayedStep>(module, "PlayedStep", "A step that was run again.")
      .def_readonly("number", &PlayedStep::number, "from 0")
      .def_readonly("byte", &PlayedStep::byte, "where its hash stands in the recording")
      .def_readonly("recorded", &PlayedStep::recorded,
                    "the hash of the recorded report. None if the step failed or the program ended in it")
      .def_readonly("now", &PlayedStep::now, "hash of the report now")
      .def_property_readonly("same", &PlayedStep::same)
      .def("__repr__", text_of);
  py::class_<Player>(module, "RecordingPlayer", "Runs a recording again, step by step. Iterate over its steps.")
      .def(py::init<const std::filesystem::path&, std::optional<int>>(), py::arg("path"), py::kw_only(),
           py::arg("threads") = std::nullopt, "threads: None for as many as the recording had")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__",
           [](Player& player) {
             const std::optional<PlayedStep> step = player.next();
             if (!step) throw py::stop_iteration();
             return *step;
           })
      .def_property_readonly("world", &Player::world, "the world that the steps are made in")
      .def_property_readonly("cut_at", &Player::cut_at,
                             "the byte of the record that the end of the recording cuts off. Known at the end")
      .def_property_readonly("recorded_by", &Player::recorded_by, "the version of tact that wrote it");
}

}  // namespace tact::python
