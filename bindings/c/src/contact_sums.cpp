#include <tact/contact_sums.h>

#include <cstddef>

#include "handles.h"

namespace tact::c {
namespace {

static_assert(sizeof(tact_vertex_of_body) == sizeof(VertexOfBody) &&
              offsetof(tact_vertex_of_body, vertex) == offsetof(VertexOfBody, vertex));

void put(const Eigen::Vector3d& from, double* to) { std::copy_n(from.data(), 3, to); }

tact_contact_sum for_c(const ContactSum& sum, const ContactSums& all) {
  tact_contact_sum result{};
  result.kind = static_cast<int>(sum.kind);
  result.a = body_of(sum.a);
  result.b = body_of(sum.b);
  result.patch = sum.patch;
  result.points = sum.points;
  result.area = sum.area;
  result.deepest_gap = sum.deepest_gap;
  result.mean_gap = sum.mean_gap;
  put(sum.center, result.center);
  put(sum.normal, result.normal);
  put(sum.force, result.force);
  put(sum.torque, result.torque);
  result.first_vertex = static_cast<size_t>(sum.vertices.data() - all.vertices.data());
  result.vertex_count = sum.vertices.size();
  return result;
}

}  // namespace

std::vector<PointImpulse> impulses_of(const tact_point_impulse* impulses, size_t count) {
  std::vector<PointImpulse> result;
  for (size_t i = 0; i < count; ++i) result.push_back({impulses[i].id, Eigen::Vector3d(impulses[i].impulse)});
  return result;
}

}  // namespace tact::c

using tact::c::check_not_null;

extern "C" tact_error tact_report_sum_contacts(tact_world world, const tact_point_impulse* impulses, size_t count,
                                               tact_contact_sums* sums) {
  return tact::c::reading(world, [&](const tact::c::WorldEntry& entry) {
    check_not_null(sums);
    if (count > 0) check_not_null(impulses);
    tact_contact_sums to = tact::c::read_struct(*sums, tact_contact_sums TACT_CONTACT_SUMS_INIT);
    if (to.sum_capacity > 0) check_not_null(to.sums);
    if (to.vertex_capacity > 0) check_not_null(to.vertices);
    const tact::ContactSums found =
        sum_contacts(entry.world, tact::c::report_of(entry), tact::c::impulses_of(impulses, count));
    to.sum_count = found.sums.size();
    to.vertex_count = found.vertices.size();
    for (size_t i = 0; i < std::min(to.sum_capacity, to.sum_count); ++i)
      to.sums[i] = tact::c::for_c(found.sums[i], found);
    for (size_t i = 0; i < std::min(to.vertex_capacity, to.vertex_count); ++i)
      to.vertices[i] = {tact::c::body_of(found.vertices[i].body), found.vertices[i].vertex};
    tact::c::write_struct(*sums, to);
  });
}
