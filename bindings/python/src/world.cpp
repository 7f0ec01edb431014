#include <pybind11/stl.h>
#include <tact/world.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "definitions.h"
#include "messages.h"
#include "motion.h"
#include "shared_world.h"
#include "text.h"

namespace tact::python {

namespace {

BodyId body_of(py::handle given, const std::string& what) {
  if (!py::isinstance<BodyId>(given))
    throw py::type_error(what + " " + std::string(py::repr(given)) + " is a " + type_name(given) +
                         ", not a tact.BodyId, which add_body() gives");
  return py::cast<BodyId>(given);
}

template <class Add>
BodyId added(SharedWorld& world, const Add& add) {
  BodyId body;
  world.compute([&](World& w) { body = add(w); });
  return body;
}

void set_positions(SharedWorld& world, BodyId body, py::handle positions) {
  const PositionsArgument x(positions);
  world.compute([&](World& w) { w.set_positions(body, x.columns()); });
}

void set_many_positions(SharedWorld& world, const py::dict& positions) {
  std::vector<PositionsArgument> arguments;
  std::vector<PositionsUpdate> updates;
  for (const auto& [body, array] : items_of(positions)) {
    const BodyId id = body_of(body, "positions: the key");
    try {
      arguments.emplace_back(array);
    } catch (const py::value_error& error) {
      throw py::value_error(std::string(py::repr(body)) + ": " + error.what());
    } catch (const py::type_error& error) {
      throw py::type_error(std::string(py::repr(body)) + ": " + error.what());
    }
    updates.push_back({id, arguments.back().columns()});
  }
  world.compute([&](World& w) { w.set_positions(updates); });
}

void set_facets(SharedWorld& world, BodyId body, py::handle positions, py::handle facets, py::handle vertex_map,
                py::handle edges, py::handle points, py::handle facet_map) {
  const MeshArguments mesh(positions, facets, vertex_map, edges, points, facet_map);
  world.compute([&](World& w) { w.set_facets(body, mesh.update()); });
}

PoseUpdate pose_of(BodyId body, py::handle rotation, py::handle translation) {
  const auto [turn, way] = pose_arguments(rotation, translation);
  return {body, turn, way};
}

void set_pose(SharedWorld& world, BodyId body, py::handle rotation, py::handle translation) {
  const PoseUpdate pose = pose_of(body, rotation, translation);
  world.compute([&](World& w) { w.set_pose(body, pose.rotation, pose.translation); });
}

void set_poses(SharedWorld& world, const py::dict& poses) {
  std::vector<PoseUpdate> updates;
  for (const auto& [body, pose] : items_of(poses)) {
    const BodyId id = body_of(body, "poses: the key");
    const bool is_pair = py::isinstance<py::sequence>(pose) && py::len(pose) == 2;
    if (!is_pair)
      throw py::type_error("poses: the pose of " + std::string(py::repr(body)) + " is a " + type_name(pose) +
                           ", not (rotation of shape (3, 3), translation of shape (3,))");
    const py::sequence parts(pose);
    updates.push_back(pose_of(id, py::object(parts[0]), py::object(parts[1])));
  }
  world.compute([&](World& w) { w.set_poses(updates); });
}

void set_pose_arrays(SharedWorld& world, const py::iterable& bodies, py::handle rotations, py::handle translations) {
  std::vector<PoseUpdate> updates;
  for (const py::handle body : bodies) updates.push_back({.body = body_of(body, "bodies:")});
  take_poses(updates, rotations, translations);
  world.compute([&](World& w) { w.set_poses(updates); });
}

OfReport<Report> detect(SharedWorld& world) {
  world.use();
  const std::uint64_t report = world.next_report();
  const Report* made = nullptr;
  world.compute([&](World& w) { made = &w.detect(); });
  return {world.shared_from_this(), report, made};
}

MotionArrays detect_motion(SharedWorld& world, const MotionOptions& options) {
  const MotionReport* made = nullptr;
  world.compute([&](World& w) { made = &w.detect_motion(options); });
  const SharedWorld::Reading reading(world);
  return motion_arrays(*made, options.bounds ? world.read().bodies() : std::vector<BodyId>{});
}

py::bytes save(SharedWorld& world) {
  std::vector<std::byte> bytes;
  world.ask([&](const World& w) { bytes = w.save(); });
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void restore(SharedWorld& world, const py::bytes& bytes) {
  const std::string_view view = bytes;
  world.compute([&](World& w) { w.restore(std::as_bytes(std::span(view))); });
  world.next_report();
}

void set_settings(SharedWorld& world, const Settings& settings) {
  const MessageFunction last = world.read().settings().on_message;  // what it holds is let go when all is set
  world.use().set_settings(settings);
  world.next_report();
}

std::string settings_text(const Settings& settings) {
  return "<tact.Settings threads=" + std::to_string(settings.threads) +
         ", accuracy=" + std::string(py::str(py::cast(settings.accuracy).attr("name"))) + ">";
}

Settings make_settings(int threads, Accuracy accuracy, DirectionPolicy direction, double gjk_tolerance,
                       int iteration_limit, bool zones, bool patches, bool points, bool curves,
                       const py::object& on_message, bool within_reach) {
  return {
      .threads = threads,
      .accuracy = accuracy,
      .direction = direction,
      .gjk_tolerance = gjk_tolerance,
      .iteration_limit = iteration_limit,
      .outputs = {.zones = zones, .patches = patches, .points = points, .curves = curves, .within_reach = within_reach},
      .on_message = message_function(on_message)};
}

template <bool Outputs::*kMember>
void output(py::class_<Settings>& settings, const char* name, const char* text) {
  settings.def_property(
      name, [](const Settings& s) { return s.outputs.*kMember; },
      [](Settings& s, bool wanted) { s.outputs.*kMember = wanted; }, text);
}

// The mesh of a body as arrays of its own.
py::array_t<double> positions_of(SharedWorld& world, BodyId body) {
  const World& asked = world.read();
  py::array_t<double> rows({static_cast<py::ssize_t>(asked.vertex_count(body)), py::ssize_t{3}});
  asked.copy_positions(body, {rows.mutable_data(), static_cast<std::size_t>(rows.size())});
  return rows;
}

py::array_t<int> facets_of(SharedWorld& world, BodyId body) {
  const World& asked = world.read();
  py::array_t<int> rows({static_cast<py::ssize_t>(asked.facet_count(body)), py::ssize_t{3}});
  asked.copy_facets(body, {rows.mutable_data(), static_cast<std::size_t>(rows.size())});
  return rows;
}

py::array_t<int> edges_of(SharedWorld& world, BodyId body) {
  const World& asked = world.read();
  py::array_t<int> rows({static_cast<py::ssize_t>(asked.edge_count(body)), py::ssize_t{2}});
  asked.copy_edges(body, {rows.mutable_data(), static_cast<std::size_t>(rows.size())});
  return rows;
}

py::array_t<int> points_of(SharedWorld& world, BodyId body) {
  const World& asked = world.read();
  py::array_t<int> vertices(static_cast<py::ssize_t>(asked.point_count(body)));
  asked.copy_points(body, {vertices.mutable_data(), static_cast<std::size_t>(vertices.size())});
  return vertices;
}

std::optional<std::pair<py::array_t<double>, double>> plane_of(SharedWorld& world, BodyId body) {
  const std::optional<Plane> plane = world.read().plane(body);
  if (!plane) return {};
  return std::pair{vector_of(plane->normal), plane->offset};
}

std::pair<py::array_t<double>, py::array_t<double>> bounds_of(SharedWorld& world, BodyId body) {
  const Bounds bounds = world.read().bounds(body);
  return {py::array_t<double>(3, bounds.lower.data()), py::array_t<double>(3, bounds.upper.data())};
}

void define_settings(py::module_& module) {
  const Settings defaults;
  py::class_<Settings> settings(module, "Settings", "How a world works.");
  settings
      .def(py::init(&make_settings), py::kw_only(), py::arg("threads") = defaults.threads,
           py::arg("accuracy") = defaults.accuracy, py::arg("direction") = defaults.direction,
           py::arg("gjk_tolerance") = defaults.gjk_tolerance, py::arg("iteration_limit") = defaults.iteration_limit,
           py::arg("zones") = false, py::arg("patches") = false, py::arg("points") = false, py::arg("curves") = false,
           py::arg("on_message") = py::none(), py::arg("within_reach") = false)
      .def_readwrite("threads", &Settings::threads, "0 to 1024; 0: as many as the machine offers")
      .def_readwrite("accuracy", &Settings::accuracy)
      .def_readwrite("direction", &Settings::direction)
      .def_readwrite("gjk_tolerance", &Settings::gjk_tolerance, "relative gap at which GJK stops, 1e-15 to 0.1")
      .def_readwrite("iteration_limit", &Settings::iteration_limit, "shifted calls of GJK a pair and step, at least 1")
      .def_property(
          "on_message", [](const Settings& s) { return python_function(s.on_message); },
          [](Settings& s, const py::object& function) { s.on_message = message_function(function); },
          "called for each limit that a step reached, and for each body that was added as closed and is not. The "
          "report has limits as flags and counts. The world refuses its calls; what it raises comes out of detect(), "
          "after the step")
      .def("__repr__", settings_text);
  output<&Outputs::zones>(settings, "zones", "compute Contact.zone_a and zone_b");
  output<&Outputs::points>(settings, "points", "compute Contact.points");
  output<&Outputs::curves>(settings, "curves", "compute Contact.curves");
  output<&Outputs::patches>(settings, "patches", "compute Contact.patches");
  output<&Outputs::within_reach>(settings, "within_reach", "compute Contact.within_reach");
}

// A function of World that takes a body and gives something of it.
template <auto kFunction>
auto of_body(SharedWorld& world, BodyId body) {
  return (world.read().*kFunction)(body);
}

// Which bodies there are, and where.
void define_bodies(WorldClass& world) {
  define_add_body(world,
                  "adds a body; copies its mesh and groups the facets into clusters. Positions: (V, 3) in metres; "
                  "facets: (F, 3), vertices counter-clockwise seen from outside; edges: (E, 2); points: (P,)",
                  [](SharedWorld& w, const BodyDefinition& definition) {
                    return added(w, [&](World& changed) { return changed.add_body(definition); });
                  });
  define_add_plane(world,
                   "adds a half-space, which is fixed and has no vertices: exact at any distance, and without a mesh",
                   [](SharedWorld& w, const PlaneDefinition& definition) {
                     return added(w, [&](World& changed) { return changed.add_plane(definition); });
                   });
  world
      .def(
          "remove_body", [](SharedWorld& w, BodyId body) { w.use().remove_body(body); }, py::arg("body"))
      .def("set_positions", set_positions, py::arg("body"), py::arg("positions"), "positions: (V, 3) in metres")
      .def("set_positions", set_many_positions, py::arg("positions"),
           "{body: (V, 3) in metres}: all of them or, after an error, none")
      .def("set_facets", set_facets, py::arg("body"), py::arg("positions"), py::arg("facets"), py::arg("vertex_map"),
           py::kw_only(), py::arg("edges") = py::list(), py::arg("points") = py::list(),
           py::arg("facet_map") = py::list(),
           "gives a body other vertices and facets; `vertex_map` tells of each new vertex which old one it was, or -1. "
           "(V, 3) in metres, (F, 3), and (V,); edges: (E, 2); points: (P,); facet_map: (F,), the old facet whose "
           "label, layer and mask each has, or -1")
      .def("set_pose", set_pose, py::arg("body"), py::arg("rotation"), py::arg("translation"),
           "places a rigid body: a vertex added at p stands at rotation * p + translation. (3, 3), and (3,) metres")
      .def("set_poses", set_poses, py::arg("poses"), "places many rigid bodies in parallel, all or none")
      .def("set_poses", set_pose_arrays, py::arg("bodies"), py::arg("rotations"), py::arg("translations"),
           "the same as arrays: N bodies, (N, 3, 3), and (N, 3) metres")
      .def(
          "contains", [](SharedWorld& w, BodyId body) { return w.read().contains(body); }, py::arg("body"))
      .def_property_readonly("body_count", [](SharedWorld& w) { return w.read().body_count(); })
      .def_property_readonly("bodies", [](SharedWorld& w) { return w.read().bodies(); })
      .def("__len__", [](SharedWorld& w) { return w.read().body_count(); })
      .def("__repr__",
           [](SharedWorld& w) { return "<tact.World of " + std::to_string(w.read().body_count()) + " bodies>"; });
}

// Which of them are tested, and from what distance on.
void define_filters(WorldClass& world) {
  world
      .def(
          "set_layers",
          [](SharedWorld& w, BodyId body, std::uint32_t layer, std::uint32_t mask) {
            w.use().set_layers(body, layer, mask);
          },
          py::arg("body"), py::arg("layer"), py::arg("mask"))
      .def(
          "set_group", [](SharedWorld& w, BodyId body, std::uint32_t group) { w.use().set_group(body, group); },
          py::arg("body"), py::arg("group"), "sets the group of a body")
      .def(
          "set_excluded",
          [](SharedWorld& w, BodyId a, BodyId b, bool excluded) { w.use().set_excluded(a, b, excluded); }, py::arg("a"),
          py::arg("b"), py::arg("excluded"),
          "sets whether two bodies are excluded from tests, whatever their layers: the two sides of a joint, say")
      .def(
          "excluded", [](SharedWorld& w, BodyId a, BodyId b) { return w.read().excluded(a, b); }, py::arg("a"),
          py::arg("b"))
      .def(
          "set_motion", [](SharedWorld& w, BodyId body, Motion motion) { w.use().set_motion(body, motion); },
          py::arg("body"), py::arg("motion"))
      .def(
          "set_margin", [](SharedWorld& w, BodyId body, double margin) { w.use().set_margin(body, margin); },
          py::arg("body"), py::arg("margin"))
      .def(
          "set_self_contact", [](SharedWorld& w, BodyId body, bool wanted) { w.use().set_self_contact(body, wanted); },
          py::arg("body"), py::arg("wanted"));
}

// What a body is, as it was given.
void define_properties(WorldClass& world) {
  world
      .def(
          "name", [](SharedWorld& w, BodyId body) { return name_of(w.read().name(body)); }, py::arg("body"))
      .def("surface", of_body<&World::surface>, py::arg("body"))
      .def("motion", of_body<&World::motion>, py::arg("body"))
      .def("layer", of_body<&World::layer>, py::arg("body"))
      .def("mask", of_body<&World::mask>, py::arg("body"))
      .def("group", of_body<&World::group>, py::arg("body"))
      .def("key", of_body<&World::key>, py::arg("body"), "the key of a body: given, or its index")
      .def("margin", of_body<&World::margin>, py::arg("body"), "the margin of a body, metres")
      .def("self_contact", of_body<&World::self_contact>, py::arg("body"), "whether a body is tested against itself")
      .def("vertex_count", of_body<&World::vertex_count>, py::arg("body"))
      .def("facet_count", of_body<&World::facet_count>, py::arg("body"))
      .def("edge_count", of_body<&World::edge_count>, py::arg("body"))
      .def("point_count", of_body<&World::point_count>, py::arg("body"))
      .def("plane", plane_of, py::arg("body"),
           "the half-space of a body that add_plane() added; none for any other: (normal, offset)")
      .def("positions", positions_of, py::arg("body"),
           "a copy, (V, 3) in metres, as they were set last; NaN for a vertex that no facet, edge or point uses")
      .def("facets", facets_of, py::arg("body"), "a copy, (F, 3), as it was given")
      .def("edges", edges_of, py::arg("body"), "a copy, (E, 2), as it was given")
      .def("points", points_of, py::arg("body"), "a copy, (P,), as it was given")
      .def("bounds", bounds_of, py::arg("body"),
           "the box of a body with its margin, metres; that of a plane is infinite. Without a facet, edge or point, "
           "lower is above upper. Two arrays, lower and upper");
}

void define_steps(WorldClass& world) {
  world.def(py::init<const Settings&>(), py::arg("settings") = Settings{})
      .def_property_readonly(
          "settings", [](SharedWorld& w) { return w.read().settings(); }, "a copy; see set_settings()")
      .def("set_settings", set_settings, py::arg("settings"), "takes effect with the next step")
      .def("detect", detect, "one step: the contacts of the positions as they are now")
      .def(
          "detect_motion",
          [](SharedWorld& w, Impacts wanted, std::optional<double> distance, bool bounds) {
            return detect_motion(w, {.wanted = wanted, .distance = distance, .bounds = bounds});
          },
          py::arg("wanted") = Impacts::all, py::arg("distance") = py::none(), py::arg("bounds") = false,
          "finds what meets between the positions of the last detect() and the current ones, every vertex moving "
          "straight")
      .def("save", save, "all that later answers depend on as bytes: settings, bodies, histories")
      .def("restore", restore, py::arg("bytes"),
           "goes back to the state of `bytes`, of this world or another: later calls answer as after save(), bit for "
           "bit");
}

}  // namespace

void define_world(py::module_& module) {
  define_messages(module);
  define_settings(module);
  WorldClass world(module, "World", "A set of bodies and the contacts among them.");
  define_steps(world);
  define_bodies(world);
  define_filters(world);
  define_properties(world);
  define_contact_sums(module, world);
  define_feature_settings(module, world);
  define_queries(module, world);
  define_body_queries(module, world);
  define_surface_check(module, world);
  define_recording(module, world);
  define_debug_draw(module, world);
}

}  // namespace tact::python
