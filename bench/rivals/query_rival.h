// Something that answers queries to one moving surface: tact, or a library it is held against.
#pragma once

#include <tact/queries.h>

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "bench/workloads/workloads.h"

namespace tact::bench {

struct QueryAnswer {
  int facet = -1;         // negative: nothing was found
  double distance = 0.0;  // metres; of a ray, from its beginning
};

class QueryRival {
 public:
  virtual ~QueryRival() = default;
  QueryRival() = default;
  QueryRival(const QueryRival&) = delete;
  QueryRival& operator=(const QueryRival&) = delete;

  // What is timed. All vertices have new positions, 3 x V metres, in memory that stays while queries are asked.
  virtual void refit(const Eigen::Matrix3Xd& positions) = 0;
  // The first facet that each ray meets. False if the library has no such query.
  virtual bool ask(std::span<const Ray> rays) = 0;
  // The nearest facet.
  virtual void ask(std::span<const PointQuery> points) = 0;

  // The answers to the queries that were asked last.
  virtual const std::vector<QueryAnswer>& answers() const = 0;
};

// The body outlives the rival. At most `threads` threads run.
std::unique_ptr<QueryRival> make_embree_queries(const WorkloadBody& body, int threads);
std::unique_ptr<QueryRival> make_fcl_queries(const WorkloadBody& body, int threads);

}  // namespace tact::bench
