#include <pybind11/stl.h>
#include <tact/queries.h>

#include <limits>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "shared_world.h"

namespace tact::python {

namespace {

// A row an answer. They are copies.
struct HitArrays {
  py::array_t<std::int64_t> bodies;
  py::array_t<int> facets;
  py::array_t<double> fractions, barycentric;
};
struct ClosestArrays {
  py::array_t<std::int64_t> bodies;
  py::array_t<int> facets;
  py::array_t<double> distances, barycentric;
};

template <class Answer>
py::array_t<std::int64_t> body_column(std::span<const Answer> answers) {
  return column_of<std::int64_t>(answers, [](const Answer& answer) {
    return answer.facet < 0 ? std::int64_t{-1} : std::int64_t{answer.body.index};
  });
}
template <class Answer>
py::array_t<int> facet_column(std::span<const Answer> answers) {
  return column_of<int>(answers, [](const Answer& answer) { return answer.facet; });
}
HitArrays hit_arrays(std::span<const RayHit> hits) {
  return {body_column(hits), facet_column(hits),
          column_of<double>(hits, [](const RayHit& hit) { return hit.fraction; }),
          rows_of_three<double>(hits, &RayHit::barycentric)};
}

std::vector<Eigen::Vector3d> points_of(py::handle given, const char* what) {
  const PositionsArgument argument(given, what);
  const Positions columns = argument.columns();
  std::vector<Eigen::Vector3d> points;
  for (std::ptrdiff_t i = 0; i < columns.cols(); ++i) points.emplace_back(columns.column(i).data());
  return points;
}

std::vector<Ray> rays_of(py::handle from, py::handle to, const QueryFilter& filter) {
  const std::vector<Eigen::Vector3d> begin = points_of(from, "from_"), end = points_of(to, "to");
  if (begin.size() != end.size()) throw py::value_error("from_ and to have different lengths");
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < begin.size(); ++i) rays.push_back({begin[i], end[i], filter});
  return rays;
}

HitArrays cast_rays(SharedWorld& world, py::handle from, py::handle to, bool any, std::uint32_t layer,
                    std::uint32_t mask) {
  const std::vector<Ray> rays = rays_of(from, to, {layer, mask});
  std::vector<RayHit> hits(rays.size());
  world.ask([&](const World& w) { w.cast_rays(rays, hits, any ? RayHits::any : RayHits::first); });
  return hit_arrays(hits);
}

HitArrays cast_ray_all(SharedWorld& world, py::handle from, py::handle to, std::uint32_t layer, std::uint32_t mask) {
  const Ray ray{vector_argument(from, "from_"), vector_argument(to, "to"), {layer, mask}};
  std::vector<RayHit> hits;
  world.ask([&](const World& w) { hits = w.cast_ray_all(ray); });
  return hit_arrays(hits);
}

using FindPlaces = void (World::*)(std::span<const PointQuery>, std::span<ClosestPoint>) const;

template <FindPlaces kFind>
ClosestArrays places_of(SharedWorld& world, py::handle points, double within, std::uint32_t layer, std::uint32_t mask) {
  std::vector<PointQuery> queries;
  for (const Eigen::Vector3d& point : points_of(points, "points")) queries.push_back({point, within, {layer, mask}});
  std::vector<ClosestPoint> answers(queries.size());
  world.ask([&](const World& w) { (w.*kFind)(queries, answers); });
  const std::span<const ClosestPoint> all = answers;
  return {body_column(all), facet_column(all),
          column_of<double>(all, [](const ClosestPoint& one) { return one.distance; }),
          rows_of_three<double>(all, &ClosestPoint::barycentric)};
}

py::array_t<std::int64_t> facet_rows(const std::vector<FacetOfBody>& found) {
  return rows_of<std::int64_t>(std::span<const FacetOfBody>(found), 2, [](const FacetOfBody& one, std::int64_t* row) {
    row[0] = one.body.index;
    row[1] = one.facet;
  });
}

py::array_t<std::int64_t> overlap_box(SharedWorld& world, py::handle lower, py::handle upper, std::uint32_t layer,
                                      std::uint32_t mask) {
  const BoxQuery query{vector_argument(lower, "lower"), vector_argument(upper, "upper"), {layer, mask}};
  std::vector<FacetOfBody> found;
  world.ask([&](const World& w) { found = w.overlap_box(query); });
  return facet_rows(found);
}

std::vector<BodyId> bodies_containing(SharedWorld& world, py::handle point, std::uint32_t layer, std::uint32_t mask) {
  const PointQuery query{.point = vector_argument(point, "point"), .filter = {layer, mask}};
  std::vector<BodyId> found;
  world.ask([&](const World& w) { found = w.bodies_containing(query); });
  return found;
}

std::vector<py::array_t<std::int64_t>> overlap_boxes(SharedWorld& world, py::handle lower, py::handle upper,
                                                     std::uint32_t layer, std::uint32_t mask) {
  const std::vector<Eigen::Vector3d> low = points_of(lower, "lower"), high = points_of(upper, "upper");
  if (low.size() != high.size()) throw py::value_error("lower and upper have different lengths");
  std::vector<BoxQuery> queries;
  for (std::size_t i = 0; i < low.size(); ++i) queries.push_back({low[i], high[i], {layer, mask}});
  std::vector<std::vector<FacetOfBody>> found(queries.size());
  world.ask([&](const World& w) { w.overlap_boxes(queries, found); });
  std::vector<py::array_t<std::int64_t>> answers;
  for (const std::vector<FacetOfBody>& one : found) answers.push_back(facet_rows(one));
  return answers;
}

std::vector<std::vector<BodyId>> bodies_containing_each(SharedWorld& world, py::handle points, std::uint32_t layer,
                                                        std::uint32_t mask) {
  std::vector<PointQuery> queries;
  for (const Eigen::Vector3d& point : points_of(points, "points"))
    queries.push_back({.point = point, .filter = {layer, mask}});
  std::vector<std::vector<BodyId>> found(queries.size());
  world.ask([&](const World& w) { w.bodies_containing_each(queries, found); });
  return found;
}

}  // namespace

void define_queries(py::module_& module, WorldClass& world) {
  py::class_<HitArrays>(module, "RayHits", "Facets that rays meet, a row a hit.")
      .def_readonly("bodies", &HitArrays::bodies, "(N,) int64: BodyId.index; -1 where nothing was hit")
      .def_readonly("facets", &HitArrays::facets, "(N,) int32; -1 where nothing was hit")
      .def_readonly("fractions", &HitArrays::fractions, "(N,): the place on the ray: from_ + fraction * (to - from_)")
      .def_readonly("barycentric", &HitArrays::barycentric,
                    "(N, 3): the place on the facet: weights of its corners, not negative, with a sum of 1")
      .def("__len__", [](const HitArrays& hits) { return hits.facets.size(); });
  py::class_<ClosestArrays>(
      module, "ClosestPoints",
      "The nearest place of all surfaces; of equally near ones the least by body and facet. A row a point.")
      .def_readonly("bodies", &ClosestArrays::bodies, "(N,) int64: BodyId.index; -1 where nothing is as near")
      .def_readonly("facets", &ClosestArrays::facets, "(N,) int32; -1 where nothing is as near")
      .def_readonly("distances", &ClosestArrays::distances, "(N,): metres; infinity where no facet is within reach")
      .def_readonly("barycentric", &ClosestArrays::barycentric,
                    "(N, 3): the place on the facet: weights of its corners, not negative, with a sum of 1")
      .def("__len__", [](const ClosestArrays& points) { return points.facets.size(); });
  const auto layer = py::arg("layer") = 0xffffffffu;
  const auto mask = py::arg("mask") = 0xffffffffu;
  world
      .def("cast_rays", cast_rays, py::arg("from_"), py::arg("to"), py::kw_only(), py::arg("any") = false, layer, mask,
           "answers many rays in parallel. The first facet that each meets, or any; (N, 3) both, metres")
      .def("cast_ray_all", cast_ray_all, py::arg("from_"), py::arg("to"), py::kw_only(), layer, mask,
           "all facets that a ray meets, sorted by fraction, body and facet")
      .def("closest_points", places_of<&World::closest_points>, py::arg("points"), py::kw_only(),
           py::arg("within") = std::numeric_limits<double>::infinity(), layer, mask,
           "finds the nearest places to many points in parallel. (N, 3), metres")
      .def("signed_distances", places_of<&World::signed_distances>, py::arg("points"), py::kw_only(),
           py::arg("within") = std::numeric_limits<double>::infinity(), layer, mask,
           "finds the signed distances of many points in parallel. (N, 3), metres; negative inside closed bodies")
      .def("overlap_box", overlap_box, py::arg("lower"), py::arg("upper"), py::kw_only(), layer, mask,
           "the facets that share a point with a box, decided exactly; sorted by body and facet. (N, 2): BodyId.index "
           "and facet")
      .def("overlap_boxes", overlap_boxes, py::arg("lower"), py::arg("upper"), py::kw_only(), layer, mask,
           "finds the facets in many boxes in parallel. (N, 3) both; an array a box")
      .def("bodies_containing", bodies_containing, py::arg("point"), py::kw_only(), layer, mask,
           "the closed bodies that contain a point or have it on their surface, decided exactly, at any `within`")
      .def("bodies_containing_each", bodies_containing_each, py::arg("points"), py::kw_only(), layer, mask,
           "finds the bodies that contain many points in parallel. (N, 3); a list a "
           "point");
}

}  // namespace tact::python
