#include <pybind11/stl.h>
#include <tact/mpi/report.h>

#include <string>

#include "../src/arrays.h"
#include "../src/report_parts.h"
#include "rank_world.h"

namespace tact::python {

namespace {

using ReportHandle = OfStep<mpi::Report>;
using ContactHandle = OfStep<mpi::Contact>;
using MotionHandle = OfStep<mpi::MotionReport>;

py::dict stats_of(const mpi::Statistics& statistics) {
  py::dict stats;
  for (const auto& count : mpi::kStatisticsCounts) stats[count.name] = statistics.*count.value;
  stats["imbalance"] = statistics.imbalance;
  return stats;
}

// A property of the two bodies that every part of a report has.
template <class Class, class Member>
void bodies_property(Class& of_class, const char* name, Member mpi::BodyPair::*member, const char* text) {
  of_class.def_property_readonly(
      name, [member](const typename Class::type& shown) { return shown->bodies.*member; }, text);
}

template <class Class>
void define_bodies(Class& of_class) {
  bodies_property(of_class, "key_a", &mpi::BodyPair::key_a, "the key of body a, not above key_b");
  bodies_property(of_class, "key_b", &mpi::BodyPair::key_b, "the key of body b");
  bodies_property(of_class, "rank_a", &mpi::BodyPair::rank_a,
                  "the owner of a: this rank for a body that every rank holds; -1 if it was removed");
  bodies_property(of_class, "rank_b", &mpi::BodyPair::rank_b, "the owner of b");
  bodies_property(of_class, "counted", &mpi::BodyPair::counted,
                  "whether this rank counts them, in sums over all ranks");
}

template <class Value>
auto contact_field(Value tact::Contact::*member) {
  return [member](const ContactHandle& shown) { return shown->contact.*member; };
}

void define_contact(py::module_& module) {
  py::class_<ContactHandle> contact(module, "Contact", "A contact in which this rank owns a body.");
  define_bodies(contact);
  contact
      .def_property_readonly(
          "direction", [](const ContactHandle& shown) { return vector_of(shown->contact.direction); },
          "(3,): unit vector from a to b")
      .def_property_readonly("depth", contact_field(&tact::Contact::depth), "metres, along `direction`")
      .def_property_readonly("containment", contact_field(&tact::Contact::containment))
      .def_property_readonly("source", contact_field(&tact::Contact::source))
      .def_property_readonly(
          "touching", [](const ContactHandle& shown) { return shown->contact.touching(); },
          "whether facets meet, or a point's gap is below the sum of the rest offsets")
      .def_property_readonly(
          "facet_pairs", [](const ContactHandle& shown) { return facet_pair_array(shown->contact.facet_pairs()); },
          "(N, 2): the facets that meet, sorted")
      .def_property_readonly(
          "points", [](const ContactHandle& shown) { return point_arrays(shown->contact.points()); },
          "tact.ContactPoints, if Settings.points is set")
      .def_property_readonly(
          "patches",
          [](const ContactHandle& shown) {
            py::list list;
            for (const Patch& patch : shown->contact.patches()) list.append(patch_arrays(patch));
            return list;
          },
          "of tact.Patch, if Settings.patches is set")
      .def_property_readonly(
          "within_reach", [](const ContactHandle& shown) { return reach_pairs(shown->contact.within_reach()); },
          "tact.ReachPairs, if Settings.within_reach is set")
      .def_property_readonly(
          "curves",
          [](const ContactHandle& shown) {
            py::list list;
            for (const IntersectionCurve& curve : shown->contact.curves()) list.append(curve_arrays(curve));
            return list;
          },
          "of tact.IntersectionCurve, if Settings.curves is set")
      .def(
          "hash", [](const ContactHandle& shown) { return shown->contact.hash(); },
          "as tact.Contact.hash(): the same on every rank and on one machine")
      .def("__repr__", [](const ContactHandle& shown) {
        return "<tact.mpi.Contact of bodies " + std::to_string(shown->bodies.key_a) + " and " +
               std::to_string(shown->bodies.key_b) + ">";
      });
}

void define_events(py::module_& module) {
  py::class_<OfStep<mpi::ContactEvent>> event(module, "ContactEvent", "Two bodies that began or ceased to touch.");
  define_bodies(event);
  py::class_<OfStep<mpi::PatchEvent>> patch(module, "PatchEvent", "A change of a patch in this step.");
  define_bodies(patch);
  patch.def_property_readonly("kind", [](const OfStep<mpi::PatchEvent>& shown) { return shown->kind; })
      .def_property_readonly(
          "patch", [](const OfStep<mpi::PatchEvent>& shown) { return shown->patch; }, "its id")
      .def_property_readonly(
          "other", [](const OfStep<mpi::PatchEvent>& shown) { return shown->other; },
          "the id of the other patch, or 0");
  py::class_<OfStep<mpi::Impact>> impact(module, "Impact", "Two features that meet between two steps.");
  define_bodies(impact);
  impact
      .def_property_readonly(
          "time", [](const OfStep<mpi::Impact>& shown) { return shown->impact.time; }, "the part of the way, 0 to 1")
      .def_property_readonly(
          "stops", [](const OfStep<mpi::Impact>& shown) { return shown->impact.stops; },
          "False if they touch and part, or slide along each other")
      .def_property_readonly("kind", [](const OfStep<mpi::Impact>& shown) { return shown->impact.kind; })
      .def_property_readonly(
          "a_vertices", [](const OfStep<mpi::Impact>& shown) { return shown->impact.a_vertices; }, "-1 fills up")
      .def_property_readonly(
          "b_vertices", [](const OfStep<mpi::Impact>& shown) { return shown->impact.b_vertices; }, "-1 fills up");
}

// The parts of a report in a list.
template <class Handle, class Parts>
py::list list_of(const Handle& report, const Parts& parts) {
  py::list list;
  for (const auto& part : parts) list.append(report.part(part));
  return list;
}

}  // namespace

void define_report(py::module_& module) {
  define_contact(module);
  define_events(module);
  py::class_<ReportHandle>(module, "Report",
                           "What World.detect() found of the bodies of this rank, valid until the next call together.")
      .def_property_readonly(
          "contacts", [](const ReportHandle& report) { return list_of(report, report->contacts()); }, "sorted by keys")
      .def(
          "find_contact",
          [](const ReportHandle& report, std::uint64_t a, std::uint64_t b) {
            const mpi::Contact* found = report->find_contact(a, b);
            return found == nullptr ? py::object(py::none()) : py::cast(report.part(*found));
          },
          py::arg("a"), py::arg("b"), "the contact of two bodies, in either order, or None")
      .def_property_readonly(
          "began", [](const ReportHandle& report) { return list_of(report, report->began()); },
          "the contacts that touch now and did not")
      .def_property_readonly(
          "ended", [](const ReportHandle& report) { return list_of(report, report->ended()); },
          "the contacts that touched and do not now")
      .def_property_readonly(
          "patch_events", [](const ReportHandle& report) { return list_of(report, report->patch_events()); },
          "the changes of patches, sorted by keys, ends before beginnings")
      .def(
          "hash_sum", [](const ReportHandle& report) { return report->hash_sum(); },
          "the sum, modulo 2^64, of the hashes of the contacts that this rank counts")
      .def_property_readonly(
          "stats", [](const ReportHandle& report) { return stats_of(report->stats()); }, "counts of this rank, by name")
      .def("__len__", [](const ReportHandle& report) { return report->contacts().size(); })
      .def("__repr__", [](const ReportHandle& report) {
        return "<tact.mpi.Report of " + std::to_string(report->contacts().size()) + " contacts>";
      });
  py::class_<MotionHandle>(module, "MotionReport", "What World.detect_motion() found of the bodies of this rank.")
      .def_property_readonly(
          "first_time", [](const MotionHandle& report) { return report->first_time(); },
          "the earliest time of all ranks, 0 to 1; infinity if no impact stops")
      .def_property_readonly(
          "impacts", [](const MotionHandle& report) { return list_of(report, report->impacts()); },
          "sorted by keys, time and features")
      .def_property_readonly(
          "stats", [](const MotionHandle& report) { return stats_of(report->stats()); }, "counts of this rank, by name")
      .def("__len__", [](const MotionHandle& report) { return report->impacts().size(); });
}

}  // namespace tact::python
