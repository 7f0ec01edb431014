#include <pybind11/stl.h>
#include <tact/body_queries.h>

#include <limits>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "distances.h"
#include "shared_world.h"

namespace tact::python {

namespace {

// A row an answer. They are copies.
struct SweepArrays {
  py::array_t<std::int64_t> bodies;
  py::array_t<int> facets, others;
  py::array_t<double> fractions, normals, barycentric, other_barycentric;
};

DistanceArrays distance_arrays(std::vector<BodyDistance> answers) {
  const std::span<const BodyDistance> all = answers;
  return {rows_of<std::int64_t>(all, 2,
                                [](const BodyDistance& one, std::int64_t* row) {
                                  row[0] = one.a.index;
                                  row[1] = one.b.index;
                                }),
          column_of<double>(all, [](const BodyDistance& one) { return one.distance; }),
          rows_of<int>(all, 2,
                       [](const BodyDistance& one, int* row) {
                         row[0] = one.a_facet;
                         row[1] = one.b_facet;
                       }),
          rows_of_three<double>(all, &BodyDistance::a_barycentric),
          rows_of_three<double>(all, &BodyDistance::b_barycentric),
          column_of<std::uint8_t>(all, [](const BodyDistance& one) { return one.containment; }),
          std::move(answers)};
}

DistanceArrays distances(SharedWorld& world, const std::vector<BodyId>& a, const std::vector<BodyId>& b,
                         double within) {
  if (a.size() != b.size()) throw py::value_error("a and b have different lengths");
  std::vector<DistanceQuery> queries;
  for (std::size_t i = 0; i < a.size(); ++i) queries.push_back({a[i], b[i], within});
  std::vector<BodyDistance> answers(queries.size());
  world.ask([&](const World& w) { w.distances(queries, answers); });
  return distance_arrays(std::move(answers));
}

DistanceArrays nearest_bodies(SharedWorld& world, BodyId body, std::size_t count, double within, std::uint32_t layer,
                              std::uint32_t mask) {
  const NearestBodiesQuery query{body, count, within, {layer, mask}};
  std::vector<BodyDistance> answers;
  world.ask([&](const World& w) { answers = w.nearest_bodies(query); });
  return distance_arrays(std::move(answers));
}

// Three numbers for each of `count` sweeps: an array of (count, 3), or None for `otherwise`.
std::vector<Eigen::Vector3d> vectors_of(py::handle given, const char* what, std::size_t count,
                                        const Eigen::Vector3d& otherwise) {
  if (given.is_none()) return std::vector<Eigen::Vector3d>(count, otherwise);
  const PositionsArgument argument(given, what);
  const Positions columns = argument.columns();
  if (columns.cols() != static_cast<std::ptrdiff_t>(count))
    throw py::value_error(std::string(what) + " does not have as many rows as there are bodies");
  std::vector<Eigen::Vector3d> vectors;
  for (std::ptrdiff_t i = 0; i < columns.cols(); ++i) vectors.emplace_back(columns.column(i).data());
  return vectors;
}

SweepArrays sweeps(SharedWorld& world, const std::vector<BodyId>& bodies, py::handle ways, py::handle axes,
                   py::handle centers, py::handle angles, std::uint32_t layer, std::uint32_t mask) {
  const std::size_t count = bodies.size();
  const auto way = vectors_of(ways, "ways", count, Eigen::Vector3d::Zero()),
             axis = vectors_of(axes, "axes", count, Eigen::Vector3d::UnitZ()),
             center = vectors_of(centers, "centers", count, Eigen::Vector3d::Zero());
  std::vector<Sweep> queries;
  for (std::size_t i = 0; i < count; ++i)
    queries.push_back({bodies[i], way[i], axis[i], center[i], 0.0, {layer, mask}});
  if (!angles.is_none()) {
    const py::array_t<double> turned = numbers_argument(angles, "angles", {static_cast<py::ssize_t>(count)});
    for (std::size_t i = 0; i < count; ++i) queries[i].angle = turned.data()[i];
  }
  std::vector<SweepHit> answers(count);
  world.ask([&](const World& w) { w.sweeps(queries, answers); });
  const std::span<const SweepHit> hits = answers;
  return {
      column_of<std::int64_t>(
          hits, [](const SweepHit& hit) { return hit.facet < 0 ? std::int64_t{-1} : std::int64_t{hit.body.index}; }),
      column_of<int>(hits, [](const SweepHit& hit) { return hit.facet; }),
      column_of<int>(hits, [](const SweepHit& hit) { return hit.other; }),
      column_of<double>(hits, [](const SweepHit& hit) { return hit.fraction; }),
      rows_of_three<double>(hits, &SweepHit::normal),
      rows_of_three<double>(hits, &SweepHit::barycentric),
      rows_of_three<double>(hits, &SweepHit::other_barycentric)};
}

Overlap overlap(SharedWorld& world, BodyId a, BodyId b) {
  Overlap found;
  world.ask([&](const World& w) { found = w.overlap(a, b); });
  return found;
}

void define_answers(py::module_& module) {
  py::class_<DistanceArrays>(module, "BodyDistances",
                             "The least distance of the surfaces of two bodies, and where it is; of equally near "
                             "facets the least of a, then of b. A row a pair.")
      .def_readonly("bodies", &DistanceArrays::bodies, "(N, 2) int64: BodyId.index of both bodies")
      .def_readonly("distances", &DistanceArrays::distances,
                    "(N,): metres: zero exactly where the surfaces share a point, else right to 1e-12 of both bodies' "
                    "size; infinity where they are farther apart than requested")
      .def_readonly("facets", &DistanceArrays::facets,
                    "(N, 2) int32: the facet of each; negative: farther apart than requested")
      .def_readonly("a_barycentric", &DistanceArrays::a_barycentric,
                    "(N, 3): the place on a's facet: weights of its corners; zero on a plane")
      .def_readonly("b_barycentric", &DistanceArrays::b_barycentric, "(N, 3): the place on b's facet")
      .def_readonly("containments", &DistanceArrays::containments,
                    "(N,): whether one lies wholly inside the other, whose surfaces are apart. Values of Containment")
      .def("__len__", [](const DistanceArrays& all) { return all.distances.size(); });
  py::class_<SweepArrays>(module, "SweepHits",
                          "The first facet that a swept body meets; of equal fractions the least by body, then by "
                          "facets. A row a sweep.")
      .def_readonly("bodies", &SweepArrays::bodies, "(N,) int64: BodyId.index; -1 where nothing is met")
      .def_readonly("facets", &SweepArrays::facets, "(N,): of the swept body; negative: it meets nothing")
      .def_readonly("others", &SweepArrays::others, "(N,): the facet of the body that is met")
      .def_readonly("fractions", &SweepArrays::fractions,
                    "(N,): the part of the way, 0 to 1, that is free: never later than the true one. Earlier by the "
                    "time that the facets take for the last 1e-13 of their size and way")
      .def_readonly("normals", &SweepArrays::normals,
                    "(N, 3): unit vector from `facet` to `other`; zero if they meet at once")
      .def_readonly("barycentric", &SweepArrays::barycentric, "(N, 3): the place on `facet`: weights of its corners")
      .def_readonly("other_barycentric", &SweepArrays::other_barycentric, "(N, 3): the place on `other`")
      .def("__len__", [](const SweepArrays& all) { return all.facets.size(); });
  py::class_<Overlap>(module, "Overlap", "What two closed bodies have in common.")
      .def_readonly("volume", &Overlap::volume, "cubic metres")
      .def_readonly("area", &Overlap::area, "of its surface, square metres; zero where the bodies only touch");
}

}  // namespace

void define_body_queries(py::module_& module, WorldClass& world) {
  define_answers(module);
  const auto layer = py::arg("layer") = 0xffffffffu;
  const auto mask = py::arg("mask") = 0xffffffffu;
  const auto within = py::arg("within") = std::numeric_limits<double>::infinity();
  world
      .def("distances", distances, py::arg("a"), py::arg("b"), py::kw_only(), within,
           "finds the distances of many pairs of bodies in parallel. Lists of one length")
      .def("nearest_bodies", nearest_bodies, py::arg("body"), py::kw_only(), py::arg("count") = 1, within, layer, mask,
           "the bodies nearest to one, sorted by distance and body")
      .def("sweeps", sweeps, py::arg("bodies"), py::arg("ways") = py::none(), py::kw_only(),
           py::arg("axes") = py::none(), py::arg("centers") = py::none(), py::arg("angles") = py::none(), layer, mask,
           "finds what many sweeps meet in parallel. A body each, (N, 3), metres; (N,), radians. Without axes they are "
           "z")
      .def("overlap", overlap, py::arg("a"), py::arg("b"),
           "volume and surface of what two closed bodies that do not cross themselves have in common");
}

}  // namespace tact::python
