// add_body(), add_plane() and poses, as the worlds of all modules take them.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <tact/world.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"

namespace tact::python {

namespace py = pybind11;

/// Keys and values as they are now: what reads them may run Python, which may change the dict.
inline std::vector<std::pair<py::object, py::object>> items_of(const py::dict& dict) {
  std::vector<std::pair<py::object, py::object>> items;
  for (const auto& [key, value] : dict)
    items.emplace_back(py::reinterpret_borrow<py::object>(key), py::reinterpret_borrow<py::object>(value));
  return items;
}

/// A rotation of shape (3, 3) and a translation of shape (3,).
inline std::pair<Eigen::Matrix3d, Eigen::Vector3d> pose_arguments(py::handle rotation, py::handle translation) {
  const py::array_t<double> turn = numbers_argument(rotation, "rotation", {3, 3});
  return {Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(turn.data()),
          vector_argument(translation, "translation")};
}

/// Gives N updates their poses: (N, 3, 3), and (N, 3) metres.
template <class PoseUpdate>
void take_poses(std::vector<PoseUpdate>& updates, py::handle rotations, py::handle translations) {
  const auto count = static_cast<py::ssize_t>(updates.size());
  const py::array_t<double> turns = numbers_argument(rotations, "rotations", {count, 3, 3}),
                            moves = numbers_argument(translations, "translations", {count, 3});
  const double *rotation = turns.data(), *translation = moves.data();
  for (PoseUpdate& update : updates) {
    update.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation);
    update.translation = Eigen::Map<const Eigen::Vector3d>(translation);
    rotation += 9, translation += 3;
  }
}

/// Defines add_body() as add(world, definition, more...); `text` is its documentation, `names` are those of `more`.
template <class... More, class World, class Add, class... Names>
void define_add_body(py::class_<World, std::shared_ptr<World>>& of, const char* text, const Add& add,
                     const Names&... names) {
  of.def(
      "add_body",
      [add](World& world, py::handle positions, py::handle facets, Surface surface, Motion motion,
            const std::string& name, std::uint32_t layer, std::uint32_t mask, double margin, bool self_contact,
            std::uint32_t group, std::optional<std::uint64_t> key, py::handle edges, py::handle points,
            std::optional<double> rest_offset, More... more) {
        const PositionsArgument x(positions);
        const FacetsArgument f(facets);
        const EdgesArgument e(edges);
        const py::array_t<int> p = indices_argument(points, "points");
        const BodyDefinition definition{.positions = x.columns(),
                                        .facets = f.columns(),
                                        .edges = e.columns(),
                                        .points = {p.data(), static_cast<std::size_t>(p.size())},
                                        .surface = surface,
                                        .motion = motion,
                                        .name = name,
                                        .layer = layer,
                                        .mask = mask,
                                        .group = group,
                                        .key = key,
                                        .margin = margin,
                                        .self_contact = self_contact,
                                        .rest_offset = rest_offset};
        return add(world, definition, more...);
      },
      py::arg("positions"), py::arg("facets") = py::list(), py::kw_only(), py::arg("surface") = Surface::closed,
      py::arg("motion") = Motion::deformable, py::arg("name") = "", py::arg("layer") = 1u,
      py::arg("mask") = 0xffffffffu, py::arg("margin") = 0.0, py::arg("self_contact") = false, py::arg("group") = 0u,
      py::arg("key") = py::none(), py::arg("edges") = py::list(), py::arg("points") = py::list(),
      py::arg("rest_offset") = py::none(), names..., text);
}

/// The same of add_plane().
template <class World, class Add>
void define_add_plane(py::class_<World, std::shared_ptr<World>>& of, const char* text, const Add& add) {
  of.def(
      "add_plane",
      [add](World& world, py::handle normal, double offset, const std::string& name, std::uint32_t layer,
            std::uint32_t mask, double margin, std::uint32_t group, std::optional<std::uint64_t> key,
            std::optional<double> rest_offset) {
        return add(world, PlaneDefinition{.normal = vector_argument(normal, "normal"),
                                          .offset = offset,
                                          .name = name,
                                          .layer = layer,
                                          .mask = mask,
                                          .group = group,
                                          .key = key,
                                          .margin = margin,
                                          .rest_offset = rest_offset});
      },
      py::arg("normal"), py::arg("offset") = 0.0, py::kw_only(), py::arg("name") = "", py::arg("layer") = 1u,
      py::arg("mask") = 0xffffffffu, py::arg("margin") = 0.0, py::arg("group") = 0u, py::arg("key") = py::none(),
      py::arg("rest_offset") = py::none(), text);
}

}  // namespace tact::python
