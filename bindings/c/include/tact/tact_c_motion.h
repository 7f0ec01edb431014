/* A part of tact_c.h: what tact_world_detect_motion() found. */
#ifndef TACT_C_MOTION_H
#define TACT_C_MOTION_H

#include <tact/tact_c_world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What tact_world_detect_motion() found; valid until it is called again. */

/** Which impacts tact_world_detect_motion() finds. */
typedef enum tact_impacts {
  TACT_IMPACTS_ALL = 0,           /**< every pair of features that meets */
  TACT_IMPACTS_FIRST_OF_PAIR = 1, /**< the earliest of each pair of bodies; faster */
  TACT_IMPACTS_FIRST = 2          /**< the earliest of all; the fastest */
} tact_impacts;

/** A vertex and a facet, or two edges, that meet between the last step and now. */
typedef struct tact_impact {
  tact_body a;       /**< its key is below that of b; equal to b for a body with itself */
  tact_body b;       /**< the second body */
  int32_t kind;      /**< tact_feature_pair */
  double time;       /**< the part of the way, 0 to 1, at which they first meet; never later than the true time */
  int a_vertices[3]; /**< vertices of the feature of a; -1 fills up */
  int b_vertices[3]; /**< vertices of the feature of b; -1 fills up */
  /** False if they touch and part, or slide along each other: the surfaces around them do not cross there. */
  bool stops;
} tact_impact;

/** Two bodies, or one with itself, with at least one impact. */
typedef struct tact_impact_pair {
  uint32_t struct_size;
  tact_body a;                /**< its key is not above that of b */
  tact_body b;                /**< the second body */
  double first_time;          /**< the earliest time of the impacts that stop; infinity if none does */
  const tact_impact* impacts; /**< sorted by time; valid as long as the report */
  size_t impact_count;
} tact_impact_pair;
#define TACT_IMPACT_PAIR_INIT \
  { (uint32_t)sizeof(tact_impact_pair), {0, 0, 0}, {0, 0, 0}, 0, NULL, 0 }

/** Counts and times, milliseconds, of tact_world_detect_motion(). */
typedef struct tact_motion_statistics {
  uint32_t struct_size;
  int64_t moved_bodies;  /**< bodies with other positions than in the last step */
  int64_t body_pairs;    /**< pairs of bodies whose boxes come near on their way, and bodies with themselves */
  int64_t cluster_pairs; /**< pairs of clusters whose boxes come near on their way */
  int64_t candidates;    /**< pairs of features whose boxes come near on their way */
  int64_t searched;      /**< candidates that the filter left undecided */
  int64_t spans;         /**< parts of the way that the search looked at */
  int64_t impacts;
  double sweep_ms;  /**< the search for bodies that pass each other */
  double search_ms; /**< all other work */
} tact_motion_statistics;
#define TACT_MOTION_STATISTICS_INIT \
  { (uint32_t)sizeof(tact_motion_statistics), 0, 0, 0, 0, 0, 0, 0, 0, 0 }

/** Gives the earliest time of an impact that stops, 0 to 1; infinity if none does. */
TACT_C_API tact_error tact_motion_first_time(tact_world world, double* time);
/** Gives the impacts, sorted by (a, b), time and features. */
TACT_C_API tact_error tact_motion_impacts(tact_world world, const tact_impact** impacts, size_t* count);
/** Gives the pairs of bodies that meet, sorted by (a, b). `count` is their number; each of them is tact_motion_pair().
 */
TACT_C_API tact_error tact_motion_pairs(tact_world world, size_t* count);
TACT_C_API tact_error tact_motion_pair(tact_world world, size_t index, tact_impact_pair* pair);
/** Gives for each vertex of a body how far along its way it may go, 0 to 1, if bounds were requested. All may go so
 * far at once, and come through nothing. It is empty for a body that did not move. */
TACT_C_API tact_error tact_motion_bounds(tact_world world, tact_body body, const double** bounds, size_t* count);
/** Gives counts and times. */
TACT_C_API tact_error tact_motion_stats(tact_world world, tact_motion_statistics* statistics);

/** Arrays for the impacts of a motion report. A null one is left out. */
typedef struct tact_impact_arrays {
  uint32_t struct_size;
  uint32_t* bodies; /**< the index of body a and of body b, 2 an impact */
  uint8_t* kinds;   /**< which features meet, as numbers */
  double* times;    /**< the parts of the way, 0 to 1, at which they first meet */
  int* a_vertices;  /**< vertices of a, 3 an impact; -1 fills up */
  int* b_vertices;  /**< vertices of b, 3 an impact; -1 fills up */
  uint8_t* stops;   /**< 0 where they part or slide along each other, else 1 */
} tact_impact_arrays;
#define TACT_IMPACT_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_impact_arrays), NULL, NULL, NULL, NULL, NULL, NULL }

/** Fills arrays with the impacts of a motion report, in their order. `rows` is the count that tact_motion_impacts()
 * gives. */
TACT_C_API tact_error tact_motion_copy_impacts(tact_world world, const tact_impact_arrays* arrays, size_t rows);

#ifdef __cplusplus
}
#endif

#endif
