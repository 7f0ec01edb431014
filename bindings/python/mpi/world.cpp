#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <tact/mpi/world.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../src/arrays.h"
#include "../src/definitions.h"
#include "rank_world.h"

namespace tact::python {

namespace {

using Bytes = std::vector<std::byte>;

// mpi4py names a communicator to other languages by the number that Fortran has for it.
MPI_Comm communicator_of(py::handle given) {
  if (!py::hasattr(given, "py2f"))
    throw py::type_error("communicator: a " + type_name(given) + " is no communicator of mpi4py");
  return MPI_Comm_f2c(py::cast<MPI_Fint>(given.attr("py2f")()));
}

// Calls work() with the interpreter's lock; what Python raises goes through the engine as an exception of C++.
template <class Work>
auto in_python(const Work& work) {
  const py::gil_scoped_acquire lock;
  try {
    return work();
  } catch (const py::error_already_set& raised) {
    throw std::runtime_error(raised.what());
  }
}

Bytes bytes_of(const py::object& given) {
  if (!py::isinstance<py::bytes>(given))
    throw py::type_error("the function returned a " + type_name(given) + ", not bytes");
  const std::string_view view = py::cast<py::bytes>(given);
  const auto bytes = std::as_bytes(std::span(view));
  return {bytes.begin(), bytes.end()};
}

py::bytes python_bytes(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Copied and let go without the interpreter's lock, as the engine does: only the last copy takes it.
std::shared_ptr<const py::function> held(const py::function& function) {
  return {new py::function(function), [](const py::function* last) {
            const py::gil_scoped_acquire lock;
            delete last;
          }};
}

std::function<Bytes(std::uint64_t)> giving(const py::function& function) {
  return
      [function = held(function)](std::uint64_t key) { return in_python([&] { return bytes_of((*function)(key)); }); };
}

std::function<void(std::uint64_t, std::span<const std::byte>)> taking(const py::function& function) {
  return [function = held(function)](std::uint64_t key, std::span<const std::byte> bytes) {
    in_python([&] { (*function)(key, python_bytes(bytes)); });
  };
}

std::shared_ptr<RankWorld> make_world(py::handle communicator, const Settings& settings, mpi::Partitioner partitioner,
                                      double rebalance_above) {
  return std::make_shared<RankWorld>(
      communicator_of(communicator),
      mpi::Settings{.world = settings, .partitioner = partitioner, .rebalance_above = rebalance_above});
}

void set_many_positions(RankWorld& world, const py::dict& positions) {
  std::vector<PositionsArgument> arguments;
  std::vector<std::uint64_t> keys;
  for (const auto& [key, array] : items_of(positions)) {
    keys.push_back(py::cast<std::uint64_t>(key));
    arguments.emplace_back(array);
  }
  std::vector<mpi::PositionsUpdate> updates;
  for (std::size_t i = 0; i < keys.size(); ++i) updates.push_back({keys[i], arguments[i].columns()});
  world.use().set_positions(updates);
}

void set_pose(RankWorld& world, std::uint64_t key, py::handle rotation, py::handle translation) {
  const auto [turn, way] = pose_arguments(rotation, translation);
  world.use().set_pose(key, turn, way);
}

using PoseTuple = std::pair<py::object, py::object>;

void set_poses(RankWorld& world, const std::map<std::uint64_t, PoseTuple>& poses) {
  std::vector<mpi::PoseUpdate> updates;
  for (const auto& [key, pose] : poses) {
    const auto [turn, way] = pose_arguments(pose.first, pose.second);
    updates.push_back({key, turn, way});
  }
  world.use().set_poses(updates);
}

void set_pose_arrays(RankWorld& world, const std::vector<std::uint64_t>& keys, py::handle rotations,
                     py::handle translations) {
  std::vector<mpi::PoseUpdate> updates;
  for (const std::uint64_t key : keys) updates.push_back({.key = key});
  take_poses(updates, rotations, translations);
  world.use().set_poses(updates);
}

OfStep<mpi::Report> detect(RankWorld& world) {
  const mpi::Report* report = nullptr;
  world.together([&](mpi::World& w) { report = &w.detect(); });
  return {world.shared_from_this(), *report};
}

OfStep<mpi::MotionReport> detect_motion(RankWorld& world, Impacts wanted) {
  const mpi::MotionReport* report = nullptr;
  world.together([&](mpi::World& w) { report = &w.detect_motion(wanted); });
  return {world.shared_from_this(), *report};
}

void set_body_state(RankWorld& world, const py::function& pack, const py::function& unpack, const py::function& drop) {
  world.use().set_body_state({.pack = giving(pack),
                              .unpack = taking(unpack),
                              .drop = [drop = held(drop)](std::uint64_t key) { in_python([&] { (*drop)(key); }); }});
}

void exchange(RankWorld& world, const py::function& give, const py::function& take) {
  const auto giver = giving(give);
  const auto taker = taking(take);
  world.together([&](mpi::World& w) { w.exchange(giver, taker); });
}

py::bytes save(RankWorld& world) {
  Bytes bytes;
  world.together([&](mpi::World& w) { bytes = w.save(); });
  return python_bytes(bytes);
}

void restore(RankWorld& world, const std::vector<py::bytes>& shares) {
  std::vector<std::span<const std::byte>> given;
  for (const py::bytes& share : shares) {
    const std::string_view view = share;
    given.push_back(std::as_bytes(std::span(view)));
  }
  world.together([&](mpi::World& w) { w.restore(given); });
}

py::array_t<double> positions_of(RankWorld& world, std::uint64_t key) {
  const tact::World& local = world.read().local();
  const BodyId body = world.read().id(key);
  py::array_t<double> array({static_cast<py::ssize_t>(local.vertex_count(body)), py::ssize_t{3}});
  local.copy_positions(body, {array.mutable_data(), static_cast<std::size_t>(array.size())});
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// A function of World that ranks call together.
template <auto kFunction>
void together(RankWorld& world) {
  world.together([](mpi::World& w) { (w.*kFunction)(); });
}

using WorldClass = py::class_<RankWorld, std::shared_ptr<RankWorld>>;

// Which bodies there are, and where.
void define_bodies(WorldClass& world) {
  define_add_body<bool>(
      world,
      "adds a body of this rank, or, with `every_rank`, a fixed one that all ranks add. Positions: (V, 3) in metres; "
      "facets: (F, 3); edges: (E, 2); points: (P,)",
      [](RankWorld& w, const BodyDefinition& definition, bool every_rank) {
        w.use().add_body(definition, every_rank ? mpi::Holders::every_rank : mpi::Holders::this_rank);
      },
      py::arg("every_rank") = false);
  define_add_plane(world, "adds a half-space that all ranks add alike",
                   [](RankWorld& w, const PlaneDefinition& definition) { w.use().add_plane(definition); });
  world
      .def(
          "remove_body", [](RankWorld& w, std::uint64_t key) { w.use().remove_body(key); }, py::arg("key"))
      .def(
          "set_positions",
          [](RankWorld& w, std::uint64_t key, py::handle positions) {
            w.use().set_positions(key, PositionsArgument(positions).columns());
          },
          py::arg("key"), py::arg("positions"), "positions: (V, 3) in metres")
      .def("set_positions", set_many_positions, py::arg("positions"),
           "{key: (V, 3) in metres}: all of them or, after an error, none")
      .def(
          "set_facets",
          [](RankWorld& w, std::uint64_t key, py::handle positions, py::handle facets, py::handle vertex_map,
             py::handle edges, py::handle points, py::handle facet_map) {
            w.use().set_facets(key, MeshArguments(positions, facets, vertex_map, edges, points, facet_map).update());
          },
          py::arg("key"), py::arg("positions"), py::arg("facets"), py::arg("vertex_map"), py::kw_only(),
          py::arg("edges") = py::list(), py::arg("points") = py::list(), py::arg("facet_map") = py::list(),
          "gives a body other vertices and facets, as World.set_facets() does")
      .def("set_pose", set_pose, py::arg("key"), py::arg("rotation"), py::arg("translation"),
           "places a rigid body: (3, 3), and (3,) metres")
      .def("set_poses", set_poses, py::arg("poses"), "places many rigid bodies in parallel, all or none")
      .def("set_poses", set_pose_arrays, py::arg("keys"), py::arg("rotations"), py::arg("translations"),
           "the same as arrays: N keys, (N, 3, 3), and (N, 3) metres")
      .def(
          "owns", [](RankWorld& w, std::uint64_t key) { return w.read().owns(key); }, py::arg("key"))
      .def_property_readonly(
          "bodies", [](RankWorld& w) { return w.read().bodies(); }, "the keys of the bodies of this rank, ascending")
      .def_property_readonly("body_count", [](RankWorld& w) { return w.read().body_count(); })
      .def("positions", positions_of, py::arg("key"), "a copy, (V, 3) in metres, as they were set last")
      .def("__len__", [](RankWorld& w) { return w.read().body_count(); });
}

// Which of them are tested, and from what distance on.
void define_filters(WorldClass& world) {
  world
      .def(
          "set_layers",
          [](RankWorld& w, std::uint64_t key, std::uint32_t layer, std::uint32_t mask) {
            w.use().set_layers(key, layer, mask);
          },
          py::arg("key"), py::arg("layer"), py::arg("mask"))
      .def(
          "set_group", [](RankWorld& w, std::uint64_t key, std::uint32_t group) { w.use().set_group(key, group); },
          py::arg("key"), py::arg("group"))
      .def(
          "set_motion", [](RankWorld& w, std::uint64_t key, Motion motion) { w.use().set_motion(key, motion); },
          py::arg("key"), py::arg("motion"))
      .def(
          "set_margin", [](RankWorld& w, std::uint64_t key, double margin) { w.use().set_margin(key, margin); },
          py::arg("key"), py::arg("margin"))
      .def(
          "set_rest_offset",
          [](RankWorld& w, std::uint64_t key, std::optional<double> rest_offset) {
            w.use().set_rest_offset(key, rest_offset);
          },
          py::arg("key"), py::arg("rest_offset"))
      .def(
          "set_self_contact",
          [](RankWorld& w, std::uint64_t key, bool wanted) { w.use().set_self_contact(key, wanted); }, py::arg("key"),
          py::arg("wanted"))
      .def(
          "set_excluded",
          [](RankWorld& w, std::uint64_t key, std::uint64_t other, bool excluded) {
            w.use().set_excluded(key, other, excluded);
          },
          py::arg("key"), py::arg("other"), py::arg("excluded"), "one rank that owns one of them says so");
}

// The same of single vertices and facets.
void define_feature_settings(WorldClass& world) {
  world
      .def(
          "set_feature_settings",
          [](RankWorld& w, std::uint64_t key, py::handle rest_offsets, py::handle vertex_labels,
             py::handle facet_labels, py::handle vertex_layers, py::handle vertex_masks, py::handle facet_layers,
             py::handle facet_masks, py::handle margins) {
            const FeatureSettingsArgument given(rest_offsets, vertex_labels, facet_labels, vertex_layers, vertex_masks,
                                                facet_layers, facet_masks, margins);
            w.use().set_feature_settings(key, given.settings());
          },
          py::arg("key"), py::kw_only(), py::arg("rest_offsets") = py::list(), py::arg("vertex_labels") = py::list(),
          py::arg("facet_labels") = py::list(), py::arg("vertex_layers") = py::list(),
          py::arg("vertex_masks") = py::list(), py::arg("facet_layers") = py::list(),
          py::arg("facet_masks") = py::list(), py::arg("margins") = py::list())
      .def(
          "set_self_contact_filter",
          [](RankWorld& w, std::uint64_t key, int rings, double rest_distance, py::handle rest) {
            std::optional<PositionsArgument> given;
            if (!rest.is_none()) given.emplace(rest, "rest_positions");
            w.use().set_self_contact_filter(key, {.rings = rings,
                                                  .rest_distance = rest_distance,
                                                  .rest_positions = given ? given->columns() : Positions::none()});
          },
          py::arg("key"), py::kw_only(), py::arg("rings") = 0, py::arg("rest_distance") = 0.0,
          py::arg("rest_positions") = py::none())
      .def(
          "set_excluded_labels",
          [](RankWorld& w, std::uint64_t a, std::uint32_t label_a, std::uint64_t b, std::uint32_t label_b,
             bool excluded, LabelKind kind) {
            w.use().set_excluded_labels({a, label_a, b, label_b, kind}, excluded);
          },
          py::arg("a"), py::arg("label_a"), py::arg("b"), py::arg("label_b"), py::arg("excluded"), py::kw_only(),
          py::arg("kind") = LabelKind::facet, "one rank that owns one of them says so");
}

}  // namespace

void define_world(py::module_& module) {
  py::enum_<mpi::Partitioner>(module, "Partitioner", "How Zoltan cuts space into one part a rank.")
      .value("rcb", mpi::Partitioner::rcb, "by planes across the longest side, halving the work")
      .value("hsfc", mpi::Partitioner::hsfc, "along a Hilbert curve");
  WorldClass world(module, "World",
                   "Bodies that are spread over the ranks of an MPI communicator, each with a key of its own.");
  world
      .def(py::init(&make_world), py::arg("communicator"), py::arg("settings") = Settings{}, py::kw_only(),
           py::arg("partitioner") = mpi::Partitioner::rcb, py::arg("rebalance_above") = 0.0,
           "together; `communicator` is mpi4py's")
      .def_property_readonly("rank", [](RankWorld& w) { return w.read().rank(); })
      .def_property_readonly("rank_count", [](RankWorld& w) { return w.read().rank_count(); })
      .def_property_readonly(
          "settings", [](RankWorld& w) { return w.read().settings().world; }, "a copy; see set_settings()")
      .def(
          "set_settings",
          [](RankWorld& w, const Settings& settings) {
            w.together([&](mpi::World& all) {
              mpi::Settings changed = all.settings();
              changed.world = settings;
              all.set_settings(changed);
            });
          },
          py::arg("settings"), "together; takes effect with the next step")
      .def("detect", detect, "together; one step: the contacts of the positions as they are now")
      .def("detect_motion", detect_motion, py::arg("wanted") = Impacts::all,
           "together; what meets between the positions of the last detect() and the current ones")
      .def(
          "set_body_state", set_body_state, py::arg("pack"), py::arg("unpack"), py::arg("drop"),
          "the program's state that moves with bodies: pack(key) gives bytes, unpack(key, bytes) takes them on the new "
          "owner, drop(key) comes on the old one")
      .def(
          "save", save,
          "together; this rank's share of all that later answers depend on as bytes; the program's state of its bodies "
          "with them")
      .def("restore", restore, py::arg("shares"),
           "together; goes back to what all ranks saved. Each share is given to one rank, whichever, of as many ranks "
           "as there are")
      .def("rebalance", together<&mpi::World::rebalance>, "together; cuts space anew and moves bodies")
      .def(
          "set_owner", [](RankWorld& w, std::uint64_t key, int rank) { w.use().set_owner(key, rank); }, py::arg("key"),
          py::arg("rank"), "gives a body to another rank, in the next move_bodies()")
      .def("move_bodies", together<&mpi::World::move_bodies>, "together; moves the bodies that set_owner() named")
      .def("exchange", exchange, py::arg("give"), py::arg("take"),
           "together; sends the bytes give(key) of each body to the ranks with a body in contact with it, and calls "
           "take(key, bytes) for what comes")
      .def("__repr__", [](RankWorld& w) {
        return "<tact.mpi.World of " + std::to_string(w.read().body_count()) + " bodies on rank " +
               std::to_string(w.read().rank()) + " of " + std::to_string(w.read().rank_count()) + ">";
      });
  define_bodies(world);
  define_filters(world);
  define_feature_settings(world);
}

}  // namespace tact::python

PYBIND11_MODULE(_tact_mpi, module) {
  pybind11::module_::import("tact");  // whose types this one uses
  tact::python::define_report(module);
  tact::python::define_world(module);
}
