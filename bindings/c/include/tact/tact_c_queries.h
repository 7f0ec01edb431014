/* A part of tact_c.h: queries to the surfaces where they are now. */
#ifndef TACT_C_QUERIES_H
#define TACT_C_QUERIES_H

#include <tact/tact_c_world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Queries to the surfaces where they are now. */

/** A segment, ends included. */
typedef struct tact_ray {
  double from[3]; /**< metres */
  double to[3];   /**< metres */
  uint32_t layer; /**< the layers that the query is on */
  uint32_t mask;  /**< the layers that the query considers */
} tact_ray;
#define TACT_RAY_INIT \
  { {0, 0, 0}, {0, 0, 0}, 0xffffffffu, 0xffffffffu }

/** Which facet tact_world_cast_ray() returns. */
typedef enum tact_ray_hits {
  TACT_RAY_FIRST = 0, /**< the first facet on the way; of several at one place the least by body and facet */
  TACT_RAY_ANY = 1    /**< some facet on the way; faster */
} tact_ray_hits;

/** A facet that a ray meets. */
typedef struct tact_ray_hit {
  tact_body body;        /**< the body of the facet */
  int facet;             /**< negative: the ray meets nothing */
  double fraction;       /**< the place on the ray: from + fraction * (to - from) */
  double barycentric[3]; /**< the place on the facet: weights of its corners, not negative, with a sum of 1 */
} tact_ray_hit;

/** A point, and how far the answer may be away. */
typedef struct tact_point_query {
  double point[3]; /**< metres */
  double within;   /**< metres, at least 0 */
  uint32_t layer;  /**< the layers that the query is on */
  uint32_t mask;   /**< the layers that the query considers */
} tact_point_query;
#define TACT_POINT_QUERY_INIT \
  { {0, 0, 0}, HUGE_VAL, 0xffffffffu, 0xffffffffu }

/** The nearest place of all surfaces; of equally near ones the least by body and facet. */
typedef struct tact_closest_point {
  tact_body body;        /**< the body of the facet */
  int facet;             /**< negative: no facet is within reach */
  double distance;       /**< metres; infinity where no facet is within reach */
  double barycentric[3]; /**< the place on the facet: weights of its corners, not negative, with a sum of 1 */
} tact_closest_point;

/** A closed box. */
typedef struct tact_box_query {
  double lower[3]; /**< metres */
  double upper[3]; /**< metres, not below `lower` */
  uint32_t layer;  /**< the layers that the query is on */
  uint32_t mask;   /**< the layers that the query considers */
} tact_box_query;
#define TACT_BOX_QUERY_INIT TACT_RAY_INIT

/** A facet of a body. */
typedef struct tact_facet_of_body {
  tact_body body; /**< the body of the facet */
  int facet;      /**< counted from 0 */
} tact_facet_of_body;

/** Two bodies, and how far they may be apart. */
typedef struct tact_distance_query {
  tact_body a;   /**< the first body */
  tact_body b;   /**< another body */
  double within; /**< metres, at least 0: what is farther is not looked for */
} tact_distance_query;
#define TACT_DISTANCE_QUERY_INIT \
  { {0, 0, 0}, {0, 0, 0}, HUGE_VAL }

/** Which bodies are nearest to a body. */
typedef struct tact_nearest_bodies_query {
  tact_body body; /**< the body from which distances are measured */
  size_t count;   /**< how many bodies at most */
  double within;  /**< metres, at least 0 */
  uint32_t layer; /**< the layers that the query is on */
  uint32_t mask;  /**< the layers that the query considers */
} tact_nearest_bodies_query;
#define TACT_NEAREST_BODIES_QUERY_INIT \
  { {0, 0, 0}, 1, HUGE_VAL, 0xffffffffu, 0xffffffffu }

/** The least distance of the surfaces of two bodies, and where it is; of equally near facets the least of a, then of
 * b. */
typedef struct tact_body_distance {
  tact_body a; /**< the first body, as requested */
  tact_body b; /**< the second body */
  /** Metres: zero exactly where the surfaces share a point, else right to 1e-12 of both bodies' size; infinity where
   * they are farther apart than requested. */
  double distance;
  int a_facet;             /**< negative: farther apart than requested */
  int b_facet;             /**< likewise */
  double a_barycentric[3]; /**< the place on a's facet: weights of its corners; zero on a plane */
  double b_barycentric[3]; /**< the place on b's facet */
  int32_t containment;     /**< whether one lies wholly inside the other, whose surfaces are apart */
} tact_body_distance;

/** A way of a body as a whole: it goes straight and turns at the same time, both evenly. At fraction s a vertex at p is
 * at center + s * way + R * (p - center), where R turns about `axis` by s * angle. */
typedef struct tact_sweep {
  tact_body body;   /**< the body that is moved, from where it is now */
  double way[3];    /**< how far it goes, metres */
  double axis[3];   /**< what it turns about, of any length but zero */
  double center[3]; /**< a point of the axis where the way begins, metres */
  double angle;     /**< radians, at most 1000 in size; counter-clockwise about `axis` */
  uint32_t layer;   /**< the layers that the query is on */
  uint32_t mask;    /**< the layers that the query considers */
} tact_sweep;
#define TACT_SWEEP_INIT \
  { {0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0, 0xffffffffu, 0xffffffffu }

/** The first facet that a swept body meets; of equal fractions the least by body, then by facets. */
typedef struct tact_sweep_hit {
  tact_body body; /**< the body that is met */
  int facet;      /**< of the swept body; negative: it meets nothing */
  int other;      /**< the facet of `body` that it meets */
  /** The part of the way, 0 to 1, that is free: never later than the true one. Earlier by the time that the facets take
   * for the last 1e-13 of their size and way. */
  double fraction;
  double normal[3];            /**< unit vector from `facet` to `other`; zero if they meet at once */
  double barycentric[3];       /**< the place on `facet`: weights of its corners */
  double other_barycentric[3]; /**< the place on `other` */
} tact_sweep_hit;

/** What two closed bodies have in common. */
typedef struct tact_overlap {
  double volume; /**< cubic metres */
  double area;   /**< of its surface, square metres; zero where the bodies only touch */
} tact_overlap;

/** Gives the first facet that a ray meets, or any. `wanted` is a tact_ray_hits. */
TACT_C_API tact_error tact_world_cast_ray(tact_world world, const tact_ray* ray, int32_t wanted, tact_ray_hit* hit);
/** Answers many rays in parallel. */
TACT_C_API tact_error tact_world_cast_rays(tact_world world, const tact_ray* rays, size_t count, int32_t wanted,
                                           tact_ray_hit* hits);
/** Gives all facets that a ray meets, sorted by fraction, body and facet. Writes up to `capacity` of them, and how many
 * there are. */
TACT_C_API tact_error tact_world_cast_ray_all(tact_world world, const tact_ray* ray, tact_ray_hit* hits,
                                              size_t capacity, size_t* count);
/** Gives the facets that share a point with a box, decided exactly; sorted by body and facet. Writes up to `capacity`
 * of them, and how many there are. */
TACT_C_API tact_error tact_world_overlap_box(tact_world world, const tact_box_query* query, tact_facet_of_body* facets,
                                             size_t capacity, size_t* count);
/** Gives the closed bodies that contain a point or have it on their surface, decided exactly, at any `within`. Writes
 * up to `capacity` of them, and how many there are. */
TACT_C_API tact_error tact_world_bodies_containing(tact_world world, const tact_point_query* query, tact_body* bodies,
                                                   size_t capacity, size_t* count);
/** Finds the facets in many boxes in parallel. Answers follow each other: that of query
 * i ends at ends[i]. Up to `capacity` are written; ends[count - 1] is how many there are. */
TACT_C_API tact_error tact_world_overlap_boxes(tact_world world, const tact_box_query* queries, size_t count,
                                               tact_facet_of_body* facets, size_t capacity, size_t* ends);
/** Finds the bodies that contain many points in parallel. Laid out as by
 * tact_world_overlap_boxes(). */
TACT_C_API tact_error tact_world_bodies_containing_each(tact_world world, const tact_point_query* queries, size_t count,
                                                        tact_body* bodies, size_t capacity, size_t* ends);
/** Gives the nearest place of all surfaces to a point. */
TACT_C_API tact_error tact_world_closest_point(tact_world world, const tact_point_query* query,
                                               tact_closest_point* answer);
/** Finds the nearest places to many points in parallel. */
TACT_C_API tact_error tact_world_closest_points(tact_world world, const tact_point_query* queries, size_t count,
                                                tact_closest_point* answers);

/** Gives the nearest surface of closed bodies and planes; its distance is minus the depth where one contains the
 * point: the deepest, at any depth. */
TACT_C_API tact_error tact_world_signed_distance(tact_world world, const tact_point_query* query,
                                                 tact_closest_point* answer);
/** Finds the signed distances of many points in parallel. */
TACT_C_API tact_error tact_world_signed_distances(tact_world world, const tact_point_query* queries, size_t count,
                                                  tact_closest_point* answers);
/** Gives the least distance of two bodies. */
TACT_C_API tact_error tact_world_distance(tact_world world, const tact_distance_query* query,
                                          tact_body_distance* answer);
/** Finds the distances of many pairs of bodies in parallel. */
TACT_C_API tact_error tact_world_distances(tact_world world, const tact_distance_query* queries, size_t count,
                                           tact_body_distance* answers);
/** Gives the bodies nearest to one, sorted by distance and body. Writes up to `capacity` of them, and how many there
 * are. */
TACT_C_API tact_error tact_world_nearest_bodies(tact_world world, const tact_nearest_bodies_query* query,
                                                tact_body_distance* answers, size_t capacity, size_t* count);
/** Gives what a body meets first when it is moved straight or turned, all others standing still. */
TACT_C_API tact_error tact_world_sweep(tact_world world, const tact_sweep* sweep, tact_sweep_hit* hit);
/** Finds what many sweeps meet in parallel. */
TACT_C_API tact_error tact_world_sweeps(tact_world world, const tact_sweep* queries, size_t count,
                                        tact_sweep_hit* hits);
/** Gives volume and surface of what two closed bodies that do not cross themselves have in common. */
TACT_C_API tact_error tact_world_overlap(tact_world world, tact_body a, tact_body b, tact_overlap* overlap);

#ifdef __cplusplus
}
#endif

#endif
