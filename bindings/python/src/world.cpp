#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <tact/world.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "motion.h"
#include "shared_world.h"

namespace tact::python {

namespace {

using SharedPointer = std::shared_ptr<SharedWorld>;

BodyId add_body(SharedWorld& world, py::handle positions, py::handle facets, Surface surface, Motion motion,
                const std::string& name, std::uint32_t layer, std::uint32_t mask, double margin, bool self_contact,
                std::uint32_t group) {
  const PositionsArgument x(positions);
  const FacetsArgument f(facets);
  const BodyDefinition definition{.positions = x.columns(),
                                  .facets = f.columns(),
                                  .surface = surface,
                                  .motion = motion,
                                  .name = name,
                                  .layer = layer,
                                  .mask = mask,
                                  .group = group,
                                  .margin = margin,
                                  .self_contact = self_contact};
  BodyId added;
  world.compute([&](World& w) { added = w.add_body(definition); });
  return added;
}

void set_positions(SharedWorld& world, BodyId body, py::handle positions) {
  const PositionsArgument x(positions);
  world.compute([&](World& w) { w.set_positions(body, x.columns()); });
}

void set_many_positions(SharedWorld& world, const py::dict& positions) {
  std::vector<PositionsArgument> arguments;
  std::vector<PositionsUpdate> updates;
  arguments.reserve(positions.size());
  for (const auto& [body, array] : positions) {
    arguments.emplace_back(array);
    updates.push_back({py::cast<BodyId>(body), arguments.back().columns()});
  }
  world.compute([&](World& w) { w.set_positions(updates); });
}

void set_pose(SharedWorld& world, BodyId body, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  world.compute([&](World& w) { w.set_pose(body, rotation, translation); });
}

PoseUpdate pose_of(py::handle body, py::handle pose) {
  try {
    const auto [rotation, translation] = py::cast<std::pair<Eigen::Matrix3d, Eigen::Vector3d>>(pose);
    return {py::cast<BodyId>(body), rotation, translation};
  } catch (const py::cast_error&) {
    throw py::type_error("poses are not {body: (rotation of shape (3, 3), translation of shape (3,))}");
  }
}

void set_poses(SharedWorld& world, const py::dict& poses) {
  std::vector<PoseUpdate> updates;
  for (const auto& [body, pose] : poses) updates.push_back(pose_of(body, pose));
  world.compute([&](World& w) { w.set_poses(updates); });
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

void check_shape(const Numbers& array, const std::vector<py::ssize_t>& shape, const std::string& what) {
  if (std::equal(array.shape(), array.shape() + array.ndim(), shape.begin(), shape.end())) return;
  throw py::value_error(what + " has shape " + std::string(py::str(array.attr("shape"))) + ", not " +
                        std::string(py::str(py::tuple(py::cast(shape)))));
}

void set_pose_arrays(SharedWorld& world, const std::vector<BodyId>& bodies, const Numbers& rotations,
                     const Numbers& translations) {
  const auto count = static_cast<py::ssize_t>(bodies.size());
  check_shape(rotations, {count, 3, 3}, "rotations");
  check_shape(translations, {count, 3}, "translations");
  std::vector<PoseUpdate> updates;
  updates.reserve(bodies.size());
  const double *rotation = rotations.data(), *translation = translations.data();
  for (const BodyId& body : bodies) {
    updates.push_back({body, Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation),
                       Eigen::Map<const Eigen::Vector3d>(translation)});
    rotation += 9, translation += 3;
  }
  world.compute([&](World& w) { w.set_poses(updates); });
}

OfReport<Report> detect(const SharedPointer& world) {
  world->use();
  const std::uint64_t report = world->next_report();
  const Report* made = nullptr;
  world->compute([&](World& w) { made = &w.detect(); });
  return {world, report, made};
}

MotionArrays detect_motion(SharedWorld& world, Impacts wanted) {
  const MotionReport* made = nullptr;
  world.compute([&](World& w) { made = &w.detect_motion(wanted); });
  return motion_arrays(*made);
}

void set_settings(SharedWorld& world, const Settings& settings) {
  world.use().set_settings(settings);
  world.next_report();
}

std::string settings_text(const Settings& settings) {
  return "<tact.Settings threads=" + std::to_string(settings.threads) +
         ", accuracy=" + std::string(py::str(py::cast(settings.accuracy).attr("name"))) + ">";
}

Settings make_settings(int threads, Accuracy accuracy, DirectionPolicy direction, double gjk_tolerance,
                       int iteration_limit, bool zones, bool patches, bool points, MessageFunction on_message) {
  return {.threads = threads,
          .accuracy = accuracy,
          .direction = direction,
          .gjk_tolerance = gjk_tolerance,
          .iteration_limit = iteration_limit,
          .outputs = {.zones = zones, .patches = patches, .points = points},
          .on_message = std::move(on_message)};
}

template <bool Outputs::*kMember>
void output(py::class_<Settings>& settings, const char* name, const char* text) {
  settings.def_property(
      name, [](const Settings& s) { return s.outputs.*kMember; },
      [](Settings& s, bool wanted) { s.outputs.*kMember = wanted; }, text);
}

void define_messages(py::module_& module) {
  py::enum_<MessageKind>(module, "MessageKind", "What a message is about.")
      .value("direction_limit", MessageKind::direction_limit,
             "the search for the direction of a contact stopped at a limit")
      .value("gjk_limit", MessageKind::gjk_limit, "GJK stopped at its limit for pairs that are taken to be apart");
  py::class_<Message>(module, "Message", "A limit that a step reached. Valid during the call.")
      .def_readonly("kind", &Message::kind)
      .def_readonly("a", &Message::a, "the first body of the pair, or no body")
      .def_readonly("b", &Message::b)
      .def_property_readonly(
          "text", [](const Message& message) { return std::string(message.text); }, "one sentence")
      .def("__repr__", [](const Message& message) { return "<tact.Message: " + std::string(message.text) + ">"; });
}

// The mesh of a body as arrays of its own.
py::array_t<double> positions_of(SharedWorld& world, BodyId body) {
  const World& asked = world.use();
  py::array_t<double> rows({static_cast<py::ssize_t>(asked.vertex_count(body)), py::ssize_t{3}});
  asked.copy_positions(body, {rows.mutable_data(), static_cast<std::size_t>(rows.size())});
  return rows;
}

py::array_t<int> facets_of(SharedWorld& world, BodyId body) {
  const World& asked = world.use();
  py::array_t<int> rows({static_cast<py::ssize_t>(asked.facet_count(body)), py::ssize_t{3}});
  asked.copy_facets(body, {rows.mutable_data(), static_cast<std::size_t>(rows.size())});
  return rows;
}

std::pair<py::array_t<double>, py::array_t<double>> bounds_of(SharedWorld& world, BodyId body) {
  const Bounds bounds = world.use().bounds(body);
  return {py::array_t<double>(3, bounds.lower.data()), py::array_t<double>(3, bounds.upper.data())};
}

void define_settings(py::module_& module) {
  const Settings defaults;
  py::class_<Settings> settings(module, "Settings", "How a world works.");
  settings
      .def(py::init(&make_settings), py::kw_only(), py::arg("threads") = defaults.threads,
           py::arg("accuracy") = defaults.accuracy, py::arg("direction") = defaults.direction,
           py::arg("gjk_tolerance") = defaults.gjk_tolerance, py::arg("iteration_limit") = defaults.iteration_limit,
           py::arg("zones") = false, py::arg("patches") = false, py::arg("points") = false,
           py::arg("on_message") = py::none())
      .def_readwrite("threads", &Settings::threads, "0 to 1024; 0: as many as OpenMP would use")
      .def_readwrite("accuracy", &Settings::accuracy)
      .def_readwrite("direction", &Settings::direction)
      .def_readwrite("gjk_tolerance", &Settings::gjk_tolerance, "relative gap at which GJK stops, 1e-15 to 0.1")
      .def_readwrite("iteration_limit", &Settings::iteration_limit, "shifted calls of GJK a pair and step, at least 1")
      .def_readwrite("on_message", &Settings::on_message,
                     "called for each limit that a step reached; the report has the same as flags and counts. It must "
                     "not use the world")
      .def("__repr__", settings_text);
  output<&Outputs::zones>(settings, "zones", "compute Contact.zone_a and zone_b");
  output<&Outputs::points>(settings, "points", "compute Contact.points");
  output<&Outputs::patches>(settings, "patches", "compute Contact.patches");
}

// A function of World that takes a body and gives something of it.
template <auto kFunction>
auto of_body(SharedWorld& world, BodyId body) {
  return (world.use().*kFunction)(body);
}

}  // namespace

void define_world(py::module_& module) {
  define_messages(module);
  define_settings(module);
  WorldClass class_of_world(module, "World", "A set of bodies and the contacts among them.");
  class_of_world.def(py::init<const Settings&>(), py::arg("settings") = Settings{})
      .def_property_readonly(
          "settings", [](SharedWorld& world) { return world.use().settings(); }, "a copy; see set_settings()")
      .def("set_settings", set_settings, py::arg("settings"), "takes effect with the next step")
      .def("add_body", add_body, py::arg("positions"), py::arg("facets"), py::kw_only(),
           py::arg("surface") = Surface::closed, py::arg("motion") = Motion::deformable, py::arg("name") = "",
           py::arg("layer") = 1u, py::arg("mask") = 0xffffffffu, py::arg("margin") = 0.0,
           py::arg("self_contact") = false, py::arg("group") = 0u,
           "adds a body; copies its mesh and groups the facets into clusters. Positions: (V, 3) in metres; facets: (F, "
           "3), vertices counter-clockwise seen from outside")
      .def(
          "remove_body", [](SharedWorld& world, BodyId body) { world.use().remove_body(body); }, py::arg("body"))
      .def("set_positions", set_positions, py::arg("body"), py::arg("positions"), "positions: (V, 3) in metres")
      .def("set_positions", set_many_positions, py::arg("positions"),
           "{body: (V, 3) in metres}: all of them or, after an error, none")
      .def("set_pose", set_pose, py::arg("body"), py::arg("rotation"), py::arg("translation"),
           "places a rigid body: a vertex added at p stands at rotation * p + translation. (3, 3), and (3,) metres")
      .def("set_poses", set_poses, py::arg("poses"), "places many rigid bodies in parallel, all or none")
      .def("set_poses", set_pose_arrays, py::arg("bodies"), py::arg("rotations"), py::arg("translations"),
           "the same as arrays: N bodies, (N, 3, 3), and (N, 3) metres")
      .def(
          "set_layers",
          [](SharedWorld& world, BodyId body, std::uint32_t layer, std::uint32_t mask) {
            world.use().set_layers(body, layer, mask);
          },
          py::arg("body"), py::arg("layer"), py::arg("mask"))
      .def(
          "set_group", [](SharedWorld& world, BodyId body, std::uint32_t group) { world.use().set_group(body, group); },
          py::arg("body"), py::arg("group"), "sets the group of a body")
      .def(
          "set_excluded",
          [](SharedWorld& world, BodyId a, BodyId b, bool excluded) { world.use().set_excluded(a, b, excluded); },
          py::arg("a"), py::arg("b"), py::arg("excluded"),
          "sets whether two bodies are excluded from tests, whatever their layers: the two sides of a joint, say")
      .def(
          "excluded", [](SharedWorld& world, BodyId a, BodyId b) { return world.use().excluded(a, b); }, py::arg("a"),
          py::arg("b"))
      .def(
          "set_motion", [](SharedWorld& world, BodyId body, Motion motion) { world.use().set_motion(body, motion); },
          py::arg("body"), py::arg("motion"))
      .def("detect", detect, "one step: the contacts of the positions as they are now")
      .def(
          "detect_motion", [](SharedWorld& world, Impacts wanted) { return detect_motion(world, wanted); },
          py::arg("wanted") = Impacts::all,
          "finds what meets between the positions of the last detect() and the current ones, every vertex moving "
          "straight")
      .def(
          "contains", [](SharedWorld& world, BodyId body) { return world.use().contains(body); }, py::arg("body"))
      .def_property_readonly("body_count", [](SharedWorld& world) { return world.use().body_count(); })
      .def_property_readonly("bodies", [](SharedWorld& world) { return world.use().bodies(); })
      .def("name", of_body<&World::name>, py::arg("body"))
      .def("surface", of_body<&World::surface>, py::arg("body"))
      .def("motion", of_body<&World::motion>, py::arg("body"))
      .def("layer", of_body<&World::layer>, py::arg("body"))
      .def("mask", of_body<&World::mask>, py::arg("body"))
      .def("group", of_body<&World::group>, py::arg("body"))
      .def("margin", of_body<&World::margin>, py::arg("body"), "the margin of a body, metres")
      .def("self_contact", of_body<&World::self_contact>, py::arg("body"), "whether a body is tested against itself")
      .def(
          "set_margin", [](SharedWorld& world, BodyId body, double margin) { world.use().set_margin(body, margin); },
          py::arg("body"), py::arg("margin"))
      .def(
          "set_self_contact",
          [](SharedWorld& world, BodyId body, bool wanted) { world.use().set_self_contact(body, wanted); },
          py::arg("body"), py::arg("wanted"))
      .def("vertex_count", of_body<&World::vertex_count>, py::arg("body"))
      .def("facet_count", of_body<&World::facet_count>, py::arg("body"))
      .def("positions", positions_of, py::arg("body"),
           "a copy, (V, 3) in metres, as they were set last; NaN for a vertex that no facet uses")
      .def("facets", facets_of, py::arg("body"), "a copy, (F, 3), as it was given")
      .def("bounds", bounds_of, py::arg("body"),
           "the box of a body with its margin, metres; without a facet, lower is above upper. Two arrays, lower and "
           "upper")
      .def("__len__", [](SharedWorld& world) { return world.use().body_count(); })
      .def("__repr__", [](SharedWorld& world) {
        return "<tact.World of " + std::to_string(world.use().body_count()) + " bodies>";
      });
  define_queries(module, class_of_world);
  define_surface_check(module, class_of_world);
  define_recording(module, class_of_world);
  define_debug_draw(module, class_of_world);
}

}  // namespace tact::python
