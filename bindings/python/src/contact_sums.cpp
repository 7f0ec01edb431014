#include "contact_sums.h"

#include <tact/joined_minima.h>
#include <tact/report_arrays.h>

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "shared_world.h"

namespace tact::python {

namespace {

SumArrays arrays_of(ContactSums found) {
  auto kept = std::make_shared<const ContactSums>(std::move(found));
  const ContactSums& sums = *kept;
  const std::span<const ContactSum> all = sums.sums;
  std::vector<std::size_t> begin{0};
  for (const ContactSum& sum : all) begin.push_back(begin.back() + sum.vertices.size());
  const auto column = [&](auto member) {
    return column_of<double>(all, [member](const ContactSum& sum) { return sum.*member; });
  };
  return {column_of<std::uint8_t>(all, [](const ContactSum& sum) { return sum.kind; }),
          rows_of<std::int64_t>(all, 2,
                                [](const ContactSum& sum, std::int64_t* row) {
                                  row[0] = sum.a.index;
                                  row[1] = sum.kind == ContactSum::Kind::body ? -1 : std::int64_t{sum.b.index};
                                }),
          column_of<std::uint64_t>(all, [](const ContactSum& sum) { return sum.patch; }),
          column_of<int>(all, [](const ContactSum& sum) { return sum.points; }),
          column(&ContactSum::area),
          column(&ContactSum::deepest_gap),
          column(&ContactSum::mean_gap),
          rows_of_three<double>(all, &ContactSum::center),
          rows_of_three<double>(all, &ContactSum::normal),
          rows_of_three<double>(all, &ContactSum::force),
          rows_of_three<double>(all, &ContactSum::torque),
          column_of<std::int64_t>(std::span<const std::size_t>(begin), [](std::size_t at) { return at; }),
          rows_of<std::int64_t>(std::span<const VertexOfBody>(sums.vertices), 2,
                                [](const VertexOfBody& one, std::int64_t* row) {
                                  row[0] = one.body.index;
                                  row[1] = one.vertex;
                                }),
          std::move(kept)};
}

SumArrays sum_contacts_of(SharedWorld& world, const OfReport<Report>& report, py::handle given_ids,
                          py::handle given_impulses) {
  const py::array_t<std::uint64_t> ids = ids_argument(given_ids, "ids");
  const py::array_t<double> impulses = ids.size() == 0 && py::len(given_impulses) == 0
                                           ? py::array_t<double>(0)
                                           : numbers_argument(given_impulses, "impulses", {ids.size(), 3});
  std::vector<PointImpulse> given;
  for (py::ssize_t i = 0; i < ids.size(); ++i)
    given.push_back({ids.data()[i], Eigen::Map<const Eigen::Vector3d>(impulses.data() + 3 * i)});
  return arrays_of(sum_contacts(world.read(), *report.held(), given));
}

// The labels of what the points of a report name, a row a point. They are copies.
struct PointLabels {
  py::array_t<std::uint32_t> a_facets, b_facets, a_vertices, b_vertices;
};

PointLabels point_labels_of(SharedWorld& world, const OfReport<Report>& report) {
  const auto held = report.held();
  const auto n = static_cast<py::ssize_t>(point_count(*held));
  const std::array<py::ssize_t, 2> three{n, 3};
  PointLabels labels{py::array_t<std::uint32_t>(n), py::array_t<std::uint32_t>(n), py::array_t<std::uint32_t>(three),
                     py::array_t<std::uint32_t>(three)};
  const auto all_of = [](py::array_t<std::uint32_t>& array) {
    return std::span(array.mutable_data(), static_cast<std::size_t>(array.size()));
  };
  copy_point_labels(
      world.read(), *held,
      {all_of(labels.a_facets), all_of(labels.b_facets), all_of(labels.a_vertices), all_of(labels.b_vertices)});
  return labels;
}

py::array_t<bool> joined_minima_of(SharedWorld& world, const OfReport<Report>& report, double within,
                                   std::uint32_t layers) {
  std::vector<std::uint8_t> minima;
  const auto held = report.held();
  world.ask([&](const World& w) { minima = joined_minima(w, *held, {within, layers}); });
  return column_of<bool>(std::span<const std::uint8_t>(minima), [](std::uint8_t one) { return one != 0; });
}

}  // namespace

void define_contact_sums(py::module_& module, WorldClass& world) {
  py::enum_<ContactSum::Kind> kind(module, "SumKind", "What a sum is over.");
  kind.value("contact", ContactSum::Kind::contact, "two bodies, or one with itself")
      .value("patch", ContactSum::Kind::patch, "a patch of the contact before it")
      .value("body", ContactSum::Kind::body, "all contacts of `a`; `b` is no body");
  compare_with_numbers(kind);
  py::class_<SumArrays>(module, "ContactSums", "The sums of a step. A row a sum.")
      .def_readonly("kinds", &SumArrays::kinds, "(N,) uint8: values of SumKind")
      .def_readonly("bodies", &SumArrays::bodies, "(N, 2) int64: BodyId.index of a and b; -1 for no body")
      .def_readonly("patches", &SumArrays::patches, "(N,) uint64: the id of the patch, or 0")
      .def_readonly("points", &SumArrays::points, "(N,): the number of contact points")
      .def_readonly("areas", &SumArrays::areas,
                    "(N,): the areas of the patches, square metres; 0 where Settings.patches is not set")
      .def_readonly("deepest_gaps", &SumArrays::deepest_gaps, "(N,): the smallest gap, metres; infinity without points")
      .def_readonly("mean_gaps", &SumArrays::mean_gaps, "(N,): metres")
      .def_readonly("centers", &SumArrays::centers, "(N, 3): the mean place of its points, metres")
      .def_readonly("normals", &SumArrays::normals,
                    "(N, 3): the mean of the normals towards `b`, or towards the body of a sum over a body; shorter "
                    "than 1 where they differ")
      .def_readonly("forces", &SumArrays::forces, "(N, 3): the sum of the impulses on `b`, or on the body")
      .def_readonly("torques", &SumArrays::torques, "(N, 3): their moment about `center`")
      .def_readonly("first_vertices", &SumArrays::first_vertices,
                    "(N + 1,) int64: where the vertices of each sum begin in `vertices`, and the end")
      .def_readonly("vertices", &SumArrays::vertices,
                    "(M, 2) int64: BodyId.index and vertex, of each sum each once, in order")
      .def("__len__", [](const SumArrays& sums) { return sums.points.size(); });
  world.def("sum_contacts", sum_contacts_of, py::arg("report"), py::arg("ids") = py::tuple(),
            py::arg("impulses") = py::tuple(),
            "adds up the points of a world's last report, at the current positions. `ids` (N,) and `impulses` (N, 3) "
            "are of points");
  py::class_<PointLabels>(
      module, "PointLabelArrays",
      "Arrays for the labels of what the points of a whole report name; 0 where there is none. A row a point.")
      .def_readonly("a_facets", &PointLabels::a_facets,
                    "(N,) uint32: that of a's facet, or of the first that has the vertex or the edge")
      .def_readonly("b_facets", &PointLabels::b_facets, "(N,) uint32: the same of b")
      .def_readonly("a_vertices", &PointLabels::a_vertices, "(N, 3) uint32: those of a's vertices, 3 a point")
      .def_readonly("b_vertices", &PointLabels::b_vertices, "(N, 3) uint32: those of b's vertices, 3 a point")
      .def("__len__", [](const PointLabels& labels) { return labels.a_facets.size(); });
  world.def("point_labels", point_labels_of, py::arg("report"),
            "the labels of the points of all contacts of a world's last report, in their order");
  world.def(
      "joined_minima", joined_minima_of, py::arg("report"), py::kw_only(), py::arg("within") = 0.0,
      py::arg("layers") = 0u,
      "(N,) bool: for each contact point of a world's last report, in the order of Report.points, whether it is a "
      "minimum also of joined surfaces. Facets of one body are joined, whether or not they share vertices, bodies "
      "that are not tested against each other, and bodies on `layers`; `within` metres they are at one place");
}

}  // namespace tact::python
