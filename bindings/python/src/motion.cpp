#include "motion.h"

#include <string>

#include "arrays.h"
#include "bindings.h"

namespace tact::python {

namespace {

py::dict stats_of(const MotionStats& stats) {
  py::dict dict;
  dict["moved_bodies"] = stats.moved_bodies;
  dict["body_pairs"] = stats.body_pairs;
  dict["cluster_pairs"] = stats.cluster_pairs;
  dict["candidates"] = stats.candidates;
  dict["searched"] = stats.searched;
  dict["spans"] = stats.spans;
  dict["impacts"] = stats.impacts;
  dict["sweep_ms"] = stats.sweep_ms;
  dict["search_ms"] = stats.search_ms;
  return dict;
}

py::dict bounds_of(const MotionReport& report, std::span<const BodyId> bodies) {
  py::dict dict;
  for (const BodyId body : bodies) {
    const std::span<const double> bounds = report.bounds(body);
    if (!bounds.empty()) dict[py::cast(body)] = column_of<double>(bounds, [](double bound) { return bound; });
  }
  return dict;
}

}  // namespace

MotionArrays motion_arrays(const MotionReport& report, std::span<const BodyId> bounded) {
  const std::span<const Impact> impacts = report.impacts();
  return {report.first_time(),
          rows_of<std::int64_t>(impacts, 2,
                                [](const Impact& impact, std::int64_t* row) {
                                  row[0] = impact.a.index;
                                  row[1] = impact.b.index;
                                }),
          column_of<std::uint8_t>(impacts, [](const Impact& impact) { return impact.kind; }),
          column_of<double>(impacts, [](const Impact& impact) { return impact.time; }),
          rows_of_three<int>(impacts, &Impact::a_vertices),
          rows_of_three<int>(impacts, &Impact::b_vertices),
          column_of<bool>(impacts, [](const Impact& impact) { return impact.stops; }),
          bounds_of(report, bounded),
          stats_of(report.stats()),
          {impacts.begin(), impacts.end()}};
}

void define_motion(py::module_& module) {
  py::enum_<Impacts>(module, "Impacts", "Which impacts World.detect_motion() finds.")
      .value("all", Impacts::all, "every pair of features that meets")
      .value("first_of_pair", Impacts::first_of_pair, "the earliest of each pair of bodies; faster")
      .value("first", Impacts::first, "the earliest of all; the fastest");
  py::class_<MotionArrays>(module, "MotionReport",
                           "What World.detect_motion() found. A row an impact, sorted by bodies and then by time.")
      .def_readonly("first_time", &MotionArrays::first_time,
                    "the earliest time of an impact that stops, 0 to 1; infinity if none does")
      .def_readonly("bodies", &MotionArrays::bodies, "(N, 2) int64: BodyId.index of the two bodies")
      .def_readonly("kinds", &MotionArrays::kinds, "(N,) uint8: values of FeaturePair")
      .def_readonly("times", &MotionArrays::times,
                    "(N,): the part of the way, 0 to 1, at which they first meet; never later than the true time")
      .def_readonly("a_vertices", &MotionArrays::a_vertices, "(N, 3): vertices of the feature of a; -1 fills up")
      .def_readonly("b_vertices", &MotionArrays::b_vertices, "(N, 3): vertices of the feature of b; -1 fills up")
      .def_readonly("stops", &MotionArrays::stops,
                    "(N,) bool: false if they touch and part, or slide along each other: the surfaces around them do "
                    "not cross there")
      .def_readonly("bounds", &MotionArrays::bounds,
                    "for each vertex of a body how far along its way it may go, 0 to 1, if bounds were requested. (V,) "
                    "by body that moved. All may go so far at once, and come through nothing")
      .def_readonly("stats", &MotionArrays::stats, "counts and times. By name, times in milliseconds")
      .def("__len__", [](const MotionArrays& motion) { return motion.times.size(); })
      .def("__repr__", [](const MotionArrays& motion) {
        return "<tact.MotionReport of " + std::to_string(motion.times.size()) + " impacts, first at " +
               std::string(py::str(py::float_(motion.first_time))) + ">";
      });
}

}  // namespace tact::python
