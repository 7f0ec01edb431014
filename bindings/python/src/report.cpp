#include <pybind11/stl.h>
#include <tact/report.h>
#include <tact/report_arrays.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "report_parts.h"
#include "shared_world.h"

namespace tact::python {

namespace {

using ReportHandle = OfReport<Report>;
using ContactHandle = OfReport<Contact>;

py::list events_of(std::span<const ContactEvent> events) {
  py::list list;
  for (const ContactEvent& event : events) list.append(py::make_tuple(event.a, event.b));
  return list;
}

py::dict stats_of(const Report& report) {
  py::dict stats;
  const auto add = [&](const char* name, const auto&, auto value) { stats[py::str(name)] = value; };
  for_each_count(report.stats(), add);
  for_each_time(report.stats(), add);
  return stats;
}

template <class Member>
auto contact_field(Member Contact::*member) {
  return [member](const ContactHandle& contact) { return (*contact.held()).*member; };
}

std::string contact_text(const ContactHandle& contact) {
  const auto c = contact.held();
  return "<tact.Contact of bodies " + std::to_string(c->a.index) + " and " + std::to_string(c->b.index) + ", depth " +
         std::string(py::str(py::float_(c->depth))) + ", " + std::to_string(c->facet_pairs().size()) + " facet pairs>";
}

void define_parts(py::module_& module) {
  py::class_<ZoneDisk>(module, "ZoneDisk", "The smallest disk around an impact zone, seen along the contact direction.")
      .def_property_readonly(
          "center", [](const ZoneDisk& zone) { return vector_of(zone.center); }, "(3,): metres")
      .def_readonly("radius", &ZoneDisk::radius, "metres; negative where no zone is computed or it is empty");
  py::class_<PatchArrays>(
      module, "Patch",
      "A connected set of facet pairs and contact points: a place where two bodies touch or nearly do.")
      .def_readonly(
          "id", &PatchArrays::id,
          "the same in the next step if both share most of their vertices; made from both keys, the step of its "
          "beginning and its place")
      .def_readonly("point", &PatchArrays::point,
                    "(3,): the middle of its points, or of the boxes that its facet pairs have in common; metres")
      .def_readonly(
          "direction", &PatchArrays::direction,
          "(3,): unit vector from a to b: the mean normal of its points, weighted by depth, or of its facets, by area")
      .def_readonly(
          "depth", &PatchArrays::depth,
          "metres: minus the smallest gap of its points, or how far b moves along `direction` to part its facet pairs")
      .def_readonly("area", &PatchArrays::area,
                    "the area of the convex hull of its points, seen along `direction`; square metres")
      .def_readonly("facet_pairs", &PatchArrays::facet_pairs, "indices into Contact.facet_pairs, ascending")
      .def_readonly("points", &PatchArrays::points, "indices into Contact.points, ascending")
      .def_readonly("spanning", &PatchArrays::spanning,
                    "at most four of `points`: the deepest, and those that span the most area; kept while they nearly "
                    "do. -1 fills up");
  py::enum_<PatchEvent::Kind>(module, "PatchEventKind", "What became of the patch.")
      .value("began", PatchEvent::Kind::began, "it is new")
      .value("split", PatchEvent::Kind::split, "it is new, and was a part of the patch `other`, which persists")
      .value("merged", PatchEvent::Kind::merged, "it became a part of the patch `other`")
      .value("ended", PatchEvent::Kind::ended, "it is gone");
  py::class_<PatchEvent>(module, "PatchEvent", "A change of a patch in this step.")
      .def_readonly("a", &PatchEvent::a)
      .def_readonly("b", &PatchEvent::b)
      .def_readonly("kind", &PatchEvent::kind)
      .def_readonly("patch", &PatchEvent::patch, "its id")
      .def_readonly("other", &PatchEvent::other, "the id of the other patch, or 0");
}

void define_points(py::module_& module) {
  py::enum_<FeaturePair> features(module, "FeaturePair",
                                  "The features of bodies a and b that are nearest, or that meet.");
  features.value("vertex_facet", FeaturePair::vertex_facet, "a vertex of a, a facet of b")
      .value("facet_vertex", FeaturePair::facet_vertex, "a facet of a, a vertex of b")
      .value("edge_edge", FeaturePair::edge_edge, "an edge of each")
      .value("vertex_edge", FeaturePair::vertex_edge, "a vertex of a, an edge of b")
      .value("edge_vertex", FeaturePair::edge_vertex, "an edge of a, a vertex of b")
      .value("vertex_vertex", FeaturePair::vertex_vertex, "a vertex of each")
      .value("vertex_plane", FeaturePair::vertex_plane, "a vertex of a, b is a plane")
      .value("plane_vertex", FeaturePair::plane_vertex, "a is a plane, a vertex of b");
  compare_with_numbers(features);
  py::class_<PointArrays>(module, "ContactPoints",
                          "A point on each of two surfaces, where features are nearest or have crossed. A row a point.")
      .def_readonly("kinds", &PointArrays::kinds, "(N,) uint8: values of FeaturePair")
      .def_readonly(
          "patches", &PointArrays::patches,
          "(N,): the number of its patch, counted from 0: an index into Contact.patches, if Settings.patches is set")
      .def_readonly("a_vertices", &PointArrays::a_vertices,
                    "(N, 3): vertices of the smallest feature of a that holds the point; -1 fills up")
      .def_readonly("b_vertices", &PointArrays::b_vertices, "(N, 3): the same of b")
      .def_readonly("a_weights", &PointArrays::a_weights,
                    "(N, 3): weights of the vertices of a, not negative, with a sum of 1")
      .def_readonly("b_weights", &PointArrays::b_weights, "(N, 3): the same of b")
      .def_readonly(
          "normals", &PointArrays::normals,
          "(N, 3): unit vector from the point of a to that of b; the normal of a facet where the two coincide")
      .def_readonly(
          "gaps", &PointArrays::gaps,
          "(N,): the distance of the two points along the normal, metres; negative where the surfaces have crossed")
      .def_readonly("ids", &PointArrays::ids,
                    "(N,): the same in every step in which these features are near: a key for impulses")
      .def_readonly("minima", &PointArrays::minima,
                    "(N,) bool: whether nothing beside it on either surface is nearer along its normal, which lies in "
                    "the normal cones of both features")
      .def("__len__", [](const PointArrays& points) { return points.gaps.size(); });
}

void define_curves(py::module_& module) {
  py::class_<CurveArrays>(module, "IntersectionCurve", "A polyline of points on both surfaces. A row a point.")
      .def_readonly("closed", &CurveArrays::closed, "whether the last point leads on to the first")
      .def_readonly("positions", &CurveArrays::positions, "(N, 3): metres; the exact place, rounded once")
      .def_readonly("fractions", &CurveArrays::fractions, "(N,): how far along the edge, 0 to 1")
      .def_readonly("edges", &CurveArrays::edges,
                    "(N, 2): the vertices of the edge, ascending. The second is -1 at a common vertex of two facets of "
                    "one body")
      .def_readonly("facets", &CurveArrays::facets, "(N,): the facet that the edge goes through; -1 at a common vertex")
      .def_readonly("facet_pairs", &CurveArrays::facet_pairs,
                    "(N,): the facets that hold the way to the next point: an index into Contact.facet_pairs. -1: no "
                    "way leads on")
      .def_readonly("edges_of_b", &CurveArrays::edges_of_b, "(N,) bool: whether the edge is of b, and the facet of a")
      .def("__len__", [](const CurveArrays& curve) { return curve.fractions.size(); });
}

void define_reach_pairs(py::module_& module) {
  py::class_<ReachPairs>(
      module, "ReachPairs",
      "A vertex and a facet, or two edges, that are nearer to each other than the sum of the margins. A row a pair.")
      .def_readonly("kinds", &ReachPairs::kinds, "(N,) uint8: values of FeaturePair")
      .def_readonly("a_vertices", &ReachPairs::a_vertices,
                    "(N, 3): vertices of the feature of a, each once; -1 fills up")
      .def_readonly("b_vertices", &ReachPairs::b_vertices, "(N, 3): the same of b")
      .def_readonly("a_weights", &ReachPairs::a_weights,
                    "(N, 3): weights, with a sum of 1, of the place of a nearest to b; above zero are those of the "
                    "closest vertex, edge or facet alone")
      .def_readonly("b_weights", &ReachPairs::b_weights, "(N, 3): the same of b")
      .def_readonly("normals", &ReachPairs::normals,
                    "(N, 3): unit vector from the place of a to that of b; zero where the two coincide")
      .def_readonly("distances", &ReachPairs::distances, "(N,): how far the two places are apart, metres")
      .def("__len__", [](const ReachPairs& pairs) { return pairs.distances.size(); });
}

// The points and pairs of a whole report. They are copies.
struct AllPoints {
  py::array_t<std::int64_t> bodies;
  py::array_t<int> contacts;
  py::array_t<std::uint8_t> kinds;
  py::array_t<int> a_vertices, b_vertices;
  py::array_t<double> a_weights, b_weights, normals, gaps;
  py::array_t<std::uint64_t> ids, patch_ids;
  py::array_t<std::uint8_t> minima;
};
struct AllFacetPairs {
  py::array_t<std::int64_t> bodies;
  py::array_t<int> contacts, facets;
};
struct AllReachPairs {
  py::array_t<std::int64_t> bodies;
  py::array_t<int> contacts;
  py::array_t<std::uint8_t> kinds;
  py::array_t<int> a_vertices, b_vertices;
  py::array_t<double> a_weights, b_weights, normals, distances;
};

template <class Number>
std::span<Number> all_of(py::array_t<Number>& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

template <class... Arrays>
void protect(Arrays&... arrays) {
  (arrays.attr("setflags")(py::arg("write") = false), ...);
}

// Indices of bodies are of 64 bits in Python, so that differences and -1 have their meaning.
void widen(std::span<const std::uint32_t> from, std::span<std::int64_t> to) { std::ranges::copy(from, to.begin()); }

AllPoints all_points(const ReportHandle& report) {
  const auto held = report.held();
  const std::size_t count = point_count(*held);
  const auto n = static_cast<py::ssize_t>(count);
  const std::array<py::ssize_t, 2> two{n, 2}, three{n, 3};
  std::vector<std::uint32_t> bodies(2 * count);
  AllPoints all{py::array_t<std::int64_t>(two), py::array_t<int>(n),           py::array_t<std::uint8_t>(n),
                py::array_t<int>(three),        py::array_t<int>(three),       py::array_t<double>(three),
                py::array_t<double>(three),     py::array_t<double>(three),    py::array_t<double>(n),
                py::array_t<std::uint64_t>(n),  py::array_t<std::uint64_t>(n), py::array_t<std::uint8_t>(n)};
  copy_points(*held, {.bodies = bodies,
                      .contacts = all_of(all.contacts),
                      .kinds = all_of(all.kinds),
                      .a_vertices = all_of(all.a_vertices),
                      .b_vertices = all_of(all.b_vertices),
                      .a_weights = all_of(all.a_weights),
                      .b_weights = all_of(all.b_weights),
                      .normals = all_of(all.normals),
                      .gaps = all_of(all.gaps),
                      .ids = all_of(all.ids),
                      .patch_ids = all_of(all.patch_ids),
                      .minima = all_of(all.minima)});
  widen(bodies, all_of(all.bodies));
  protect(all.bodies, all.contacts, all.kinds, all.a_vertices, all.b_vertices, all.a_weights, all.b_weights,
          all.normals, all.gaps, all.ids, all.patch_ids, all.minima);
  return all;
}

AllFacetPairs all_facet_pairs(const ReportHandle& report) {
  const auto held = report.held();
  const std::size_t count = facet_pair_count(*held);
  const auto n = static_cast<py::ssize_t>(count);
  const std::array<py::ssize_t, 2> two{n, 2};
  std::vector<std::uint32_t> bodies(2 * count);
  AllFacetPairs all{py::array_t<std::int64_t>(two), py::array_t<int>(n), py::array_t<int>(two)};
  copy_facet_pairs(*held, {.bodies = bodies, .contacts = all_of(all.contacts), .facets = all_of(all.facets)});
  widen(bodies, all_of(all.bodies));
  protect(all.bodies, all.contacts, all.facets);
  return all;
}

AllReachPairs all_reach_pairs(const ReportHandle& report) {
  const auto held = report.held();
  const std::size_t count = reach_pair_count(*held);
  const auto n = static_cast<py::ssize_t>(count);
  const std::array<py::ssize_t, 2> two{n, 2}, three{n, 3};
  std::vector<std::uint32_t> bodies(2 * count);
  AllReachPairs all{py::array_t<std::int64_t>(two), py::array_t<int>(n),        py::array_t<std::uint8_t>(n),
                    py::array_t<int>(three),        py::array_t<int>(three),    py::array_t<double>(three),
                    py::array_t<double>(three),     py::array_t<double>(three), py::array_t<double>(n)};
  copy_reach_pairs(*held, {.bodies = bodies,
                           .contacts = all_of(all.contacts),
                           .kinds = all_of(all.kinds),
                           .a_vertices = all_of(all.a_vertices),
                           .b_vertices = all_of(all.b_vertices),
                           .a_weights = all_of(all.a_weights),
                           .b_weights = all_of(all.b_weights),
                           .normals = all_of(all.normals),
                           .distances = all_of(all.distances)});
  widen(bodies, all_of(all.bodies));
  protect(all.bodies, all.contacts, all.kinds, all.a_vertices, all.b_vertices, all.a_weights, all.b_weights,
          all.normals, all.distances);
  return all;
}

void define_arrays_of_report(py::module_& module) {
  py::class_<AllPoints>(module, "PointArrays", "Arrays for the contact points of a whole report. A row a point.")
      .def_readonly("bodies", &AllPoints::bodies, "(N, 2) int64: the index of body a and of body b, 2 a point")
      .def_readonly("contacts", &AllPoints::contacts, "(N,): the number of its contact, counted from 0")
      .def_readonly("kinds", &AllPoints::kinds, "(N,) uint8: which features these are, as numbers")
      .def_readonly("a_vertices", &AllPoints::a_vertices, "(N, 3): vertices of a, 3 a point; -1 fills up")
      .def_readonly("b_vertices", &AllPoints::b_vertices, "(N, 3): vertices of b, 3 a point; -1 fills up")
      .def_readonly("a_weights", &AllPoints::a_weights, "(N, 3): weights of the vertices of a, 3 a point")
      .def_readonly("b_weights", &AllPoints::b_weights, "(N, 3): weights of the vertices of b, 3 a point")
      .def_readonly("normals", &AllPoints::normals, "(N, 3): unit vectors from a to b, 3 a point")
      .def_readonly("gaps", &AllPoints::gaps, "(N,): metres; negative where the surfaces have crossed")
      .def_readonly("ids", &AllPoints::ids, "(N,) uint64: the same in every step in which these features are near")
      .def_readonly("patch_ids", &AllPoints::patch_ids,
                    "(N,) uint64: ids of the patches, or 0 where patches are not requested")
      .def_readonly("minima", &AllPoints::minima,
                    "(N,) uint8: 1 if nothing beside it on either surface is nearer, else 0")
      .def("__len__", [](const AllPoints& points) { return points.gaps.size(); });
  py::class_<AllFacetPairs>(module, "FacetPairArrays", "Arrays for the facet pairs of a whole report. A row a pair.")
      .def_readonly("bodies", &AllFacetPairs::bodies, "(N, 2) int64: the index of body a and of body b, 2 a pair")
      .def_readonly("contacts", &AllFacetPairs::contacts, "(N,): the number of its contact, counted from 0")
      .def_readonly("facets", &AllFacetPairs::facets, "(N, 2): the facet of a and that of b, 2 a pair")
      .def("__len__", [](const AllFacetPairs& pairs) { return pairs.contacts.size(); });
  py::class_<AllReachPairs>(module, "ReachPairArrays",
                            "Arrays for the pairs within reach of a whole report. A row a pair.")
      .def_readonly("bodies", &AllReachPairs::bodies, "(N, 2) int64: the index of body a and of body b, 2 a pair")
      .def_readonly("contacts", &AllReachPairs::contacts, "(N,): the number of its contact, counted from 0")
      .def_readonly("kinds", &AllReachPairs::kinds, "(N,) uint8: which features these are, as numbers")
      .def_readonly("a_vertices", &AllReachPairs::a_vertices, "(N, 3): vertices of a, 3 a pair; -1 fills up")
      .def_readonly("b_vertices", &AllReachPairs::b_vertices, "(N, 3): vertices of b, 3 a pair; -1 fills up")
      .def_readonly("a_weights", &AllReachPairs::a_weights, "(N, 3): weights of the vertices of a, 3 a pair")
      .def_readonly("b_weights", &AllReachPairs::b_weights, "(N, 3): weights of the vertices of b, 3 a pair")
      .def_readonly("normals", &AllReachPairs::normals,
                    "(N, 3): unit vectors from a to b, 3 a pair; zero where the distance is")
      .def_readonly("distances", &AllReachPairs::distances, "(N,): metres")
      .def("__len__", [](const AllReachPairs& pairs) { return pairs.contacts.size(); });
}

void define_contact(py::module_& module) {
  py::class_<ContactHandle>(module, "Contact",
                            "Two bodies whose convex hulls overlap or touch, decided exactly, or are nearer than the "
                            "sum of the margins. Arrays that it gives stay valid.")
      .def_property_readonly("a", contact_field(&Contact::a))
      .def_property_readonly("b", contact_field(&Contact::b))
      .def_property_readonly(
          "direction", [](const ContactHandle& contact) { return vector_of(contact->direction); },
          "(3,): unit vector from a to b: moving b by depth * direction separates the hulls")
      .def_property_readonly(
          "depth", contact_field(&Contact::depth),
          "the overlap of the hulls along `direction`, metres; minus their distance where they are apart")
      .def_property_readonly("containment", contact_field(&Contact::containment),
                             "which body lies wholly inside the other, decided exactly; the direction leads out of it")
      .def_property_readonly("source", contact_field(&Contact::source))
      .def_property_readonly("iterations", contact_field(&Contact::iterations))
      .def_property_readonly("limit_reached", contact_field(&Contact::limit_reached))
      .def_property_readonly(
          "point_limit_reached", contact_field(&Contact::point_limit_reached),
          "whether a sheet crosses itself deeper than its crossing edges are long: vertices there have no point")
      .def_property_readonly("plane_a", contact_field(&Contact::plane_a),
                             "the farthest that a's hull reaches along `direction`, metres")
      .def_property_readonly("plane_b", contact_field(&Contact::plane_b),
                             "the nearest that b's hull reaches along `direction`, metres")
      .def_property_readonly("zone_a", contact_field(&Contact::zone_a))
      .def_property_readonly("zone_b", contact_field(&Contact::zone_b))
      .def_property_readonly("kept_facets_a", contact_field(&Contact::kept_facets_a))
      .def_property_readonly("kept_facets_b", contact_field(&Contact::kept_facets_b))
      .def_property_readonly(
          "facet_pairs", [](const ContactHandle& contact) { return facet_pair_array(contact->facet_pairs()); },
          "(N, 2): the facets that meet, sorted; empty at Accuracy.hulls")
      .def_property_readonly(
          "points", [](const ContactHandle& contact) { return point_arrays(contact->points()); },
          "the points, if Settings.points is set; sorted by kind, then by features")
      .def_property_readonly(
          "within_reach", [](const ContactHandle& contact) { return reach_pairs(contact->within_reach()); },
          "every vertex and facet, and every two edges, nearer than the sum of the margins, if Settings.within_reach "
          "is set; sorted by kind, then by features")
      .def_property_readonly(
          "touching", [](const ContactHandle& contact) { return contact->touching(); },
          "whether facets meet, or a point's gap is below the sum of the rest offsets")
      .def_property_readonly(
          "patches",
          [](const ContactHandle& contact) {
            py::list list;
            const auto held = contact.held();
            for (const Patch& patch : held->patches()) list.append(patch_arrays(patch));
            return list;
          },
          "the patches, if Settings.patches is set; sorted by first facet pair, then by first point")
      .def_property_readonly(
          "curves",
          [](const ContactHandle& contact) {
            py::list list;
            const auto held = contact.held();
            for (const IntersectionCurve& curve : held->curves()) list.append(curve_arrays(curve));
            return list;
          },
          "the curves in which the surfaces cross, if Settings.curves is set; sorted by their first facet pair")
      .def(
          "hash", [](const ContactHandle& contact) { return contact->hash(); },
          "a number made from every bit of the contact, its facet pairs, points, pairs within reach and patches, but "
          "for counts of work")
      .def("__repr__", contact_text);
}

py::list contacts_of(const ReportHandle& report) {
  py::list list;
  const auto held = report.held();
  for (const Contact& contact : held->contacts()) list.append(report.part(contact));
  return list;
}

py::object find_contact(const ReportHandle& report, BodyId a, BodyId b) {
  const Contact* contact = report->find_contact(a, b);
  return contact == nullptr ? py::object(py::none()) : py::cast(report.part(*contact));
}

py::list candidates_of(const ReportHandle& report) {
  py::list list;
  const auto held = report.held();
  for (const CandidatePair& pair : held->candidate_pairs())
    list.append(py::make_tuple(pair.a, pair.b, pair.hulls_overlap));
  return list;
}

ReportHandle keep(const ReportHandle& report, const std::optional<ReportHandle>& into) {
  if (into) into->world()->check_is_copy();
  if (into && into->world() == report.world()) {
    report.held();
    return report;
  }
  const std::shared_ptr<SharedWorld> kept = into ? into->world() : SharedWorld::for_copy();
  const auto held = report.held();
  const Report& copy = kept->keep(*held);
  return {kept, kept->last_report(), &copy};
}

std::string report_text(const ReportHandle& report) {
  return "<tact.Report of " + std::to_string(report->contacts().size()) + " contacts, " +
         std::to_string(report->stats().facet_pairs) + " facet pairs>";
}

}  // namespace

void define_report(py::module_& module) {
  define_parts(module);
  define_points(module);
  define_curves(module);
  define_reach_pairs(module);
  define_contact(module);
  define_arrays_of_report(module);
  py::class_<ReportHandle>(
      module, "Report", "What World.detect() found. It is valid until the next step; arrays that it gives stay valid.")
      .def_property_readonly("contacts", contacts_of, "the contacts, sorted by (a, b)")
      .def("find_contact", find_contact, py::arg("a"), py::arg("b"), "the contact of two bodies, or None")
      .def_property_readonly(
          "bodies",
          [](const ReportHandle& report) {
            return rows_of<std::int64_t>(report->contacts(), 2, [](const Contact& contact, std::int64_t* row) {
              row[0] = contact.a.index;
              row[1] = contact.b.index;
            });
          },
          "(C, 2) int64: BodyId.index of the bodies of each contact")
      .def_property_readonly(
          "directions",
          [](const ReportHandle& report) {
            return rows_of<double>(report->contacts(), 3, [](const Contact& contact, double* row) {
              Eigen::Vector3d::Map(row) = contact.direction;
            });
          },
          "(C, 3): the direction of each contact")
      .def_property_readonly(
          "depths",
          [](const ReportHandle& report) {
            return column_of<double>(report->contacts(), [](const Contact& contact) { return contact.depth; });
          },
          "(C,): the depth of each contact, metres")
      .def_property_readonly("points", all_points, "the points of all contacts, in their order")
      .def_property_readonly("facet_pairs", all_facet_pairs, "the facet pairs of all contacts, in their order")
      .def_property_readonly("within_reach", all_reach_pairs, "the pairs within reach of all contacts, in their order")
      .def_property_readonly("candidate_pairs", candidates_of, "the pairs whose boxes overlap, sorted by (a, b)")
      .def_property_readonly(
          "began", [](const ReportHandle& report) { return events_of(report->began()); },
          "pairs (a, b) that touch now and did not")
      .def_property_readonly(
          "ended", [](const ReportHandle& report) { return events_of(report->ended()); },
          "pairs (a, b) that touched and do not now")
      .def_property_readonly(
          "patch_events",
          [](const ReportHandle& report) {
            const auto held = report.held();
            const auto events = held->patch_events();
            return std::vector<PatchEvent>(events.begin(), events.end());
          },
          "the changes of patches, if Settings.patches is set; sorted by (a, b), ends before beginnings")
      .def_property_readonly(
          "stats", [](const ReportHandle& report) { return stats_of(*report.held()); },
          "counts and times of the step. By name, times in milliseconds")
      .def(
          "hash", [](const ReportHandle& report) { return report->hash(); },
          "a number made from every bit of candidate pairs, contacts, facet pairs, points and pairs within reach; "
          "bodies enter it by their keys")
      .def("keep", keep, py::arg("into") = py::none(),
           "copies a report. The copy stays valid, and any thread may read it while the next step runs. Its memory is "
           "that of `into`, an earlier copy, which is stale from then on: two in turns take no memory")
      .def("__len__", [](const ReportHandle& report) { return report->contacts().size(); })
      .def("__repr__", report_text);
}

}  // namespace tact::python
