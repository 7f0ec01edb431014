/* A part of tact_c.h: the report of the last step. */
#ifndef TACT_C_REPORT_H
#define TACT_C_REPORT_H

#include <tact/tact_c_world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The report of the last step. */

/** How a contact direction was found. */
typedef enum tact_direction_source {
  TACT_SOURCE_CARRIED = 0, /**< from the direction of the last step */
  TACT_SOURCE_FRESH = 1,   /**< from the direction that last separated the hulls */
  TACT_SOURCE_SMALLEST = 2 /**< as the smallest separation of the hulls */
} tact_direction_source;

/** Which of two bodies lies wholly inside the other, so that no facets meet. */
typedef enum tact_containment {
  TACT_CONTAINMENT_NONE = 0,   /**< neither, or TACT_ACCURACY_HULLS */
  TACT_CONTAINMENT_A_IN_B = 1, /**< a lies inside b, a closed body */
  TACT_CONTAINMENT_B_IN_A = 2  /**< b lies inside a, a closed body */
} tact_containment;

/**
 * Two facets that share at least one point. Facets of one body that name common vertices are a pair where they share
 * more than these vertices and the edge between them.
 */
typedef struct tact_facet_pair {
  int a; /**< facet of the first body */
  int b; /**< facet of the second */
} tact_facet_pair;

/** The smallest disk around an impact zone, seen along the contact direction. */
typedef struct tact_zone_disk {
  double center[3]; /**< metres */
  double radius;    /**< metres; negative where no zone is computed or it is empty */
} tact_zone_disk;

/** Two bodies whose convex hulls overlap or touch, decided exactly, or are nearer than the sum of the margins. */
typedef struct tact_contact {
  uint32_t struct_size;
  tact_body a;         /**< its key is below that of b; equal to b for a body with itself */
  tact_body b;         /**< the second body */
  double direction[3]; /**< unit vector from a to b: moving b by depth * direction separates the hulls */
  double depth;   /**< the overlap of the hulls along `direction`, metres; minus their distance where they are apart */
  int32_t source; /**< tact_direction_source */
  int32_t iterations;    /**< shifted calls of GJK that it took */
  bool limit_reached;    /**< whether GJK or the direction stopped at a limit, with the best direction found */
  bool touching;         /**< whether facets meet, or a point's gap is below the sum of the rest offsets */
  double plane_a;        /**< the contact plane direction * x = plane_a, the farthest that the hull of a reaches */
  double plane_b;        /**< the contact plane direction * x = plane_b, the nearest that the hull of b reaches */
  tact_zone_disk zone_a; /**< around the part of a between the planes */
  tact_zone_disk zone_b; /**< around the part of b between the planes */
  int64_t kept_facets_a; /**< facets of a left after the criteria */
  int64_t kept_facets_b; /**< facets of b left after the criteria */
  const tact_facet_pair* facet_pairs; /**< the facets that meet, sorted; empty at TACT_ACCURACY_HULLS */
  size_t facet_pair_count;
  size_t patch_count;  /**< see tact_contact_patch() */
  int32_t containment; /**< which body lies wholly inside the other, decided exactly; the direction leads out of it */
  /** whether a sheet crosses itself deeper than its crossing edges are long: vertices there have no point */
  bool point_limit_reached;
  size_t curve_count; /**< see tact_contact_curve() */
} tact_contact;
#define TACT_CONTACT_INIT                                                                                          \
  {                                                                                                                \
    (uint32_t)sizeof(tact_contact), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, false, false, 0, 0, {{0, 0, 0}, -1}, \
        {{0, 0, 0}, -1}, 0, 0, NULL, 0, 0, 0, false, 0                                                             \
  }

/** A connected set of facet pairs and contact points: a place where two bodies touch or nearly do. */
typedef struct tact_patch {
  uint32_t struct_size;
  double point[3];     /**< the middle of its points, or of the boxes that its facet pairs have in common; metres */
  double direction[3]; /**< unit vector from a to b: the mean normal of its points, weighted by depth, or of its facets,
                          by area */
  double depth; /**< metres: minus the smallest gap of its points, or how far b moves along `direction` to part its
                   facet pairs */
  const int* facet_pairs; /**< indices into tact_contact.facet_pairs, ascending */
  size_t facet_pair_count;
  uint64_t id; /**< the same in the next step if both share most of their vertices; made from both keys, the step of its
                  beginning and its place */
  double area; /**< the area of the convex hull of its points, seen along `direction`; square metres */
  const int* points; /**< indices into tact_contact_points(), ascending */
  size_t point_count;
  int spanning[4]; /**< at most four of `points`: the deepest, and those that span the most area; kept while they nearly
                      do. -1 fills up */
} tact_patch;
#define TACT_PATCH_INIT                                                                               \
  {                                                                                                   \
    (uint32_t)sizeof(tact_patch), {0, 0, 0}, {0, 0, 0}, 0, NULL, 0, 0, 0, NULL, 0, { -1, -1, -1, -1 } \
  }

/** The features of bodies a and b that are nearest, or that meet. Of the last five either feature is of no facet. */
typedef enum tact_feature_pair {
  TACT_VERTEX_FACET = 0,  /**< a vertex of a, a facet of b */
  TACT_FACET_VERTEX = 1,  /**< a facet of a, a vertex of b */
  TACT_EDGE_EDGE = 2,     /**< an edge of each */
  TACT_VERTEX_EDGE = 3,   /**< a vertex of a, an edge of b */
  TACT_EDGE_VERTEX = 4,   /**< an edge of a, a vertex of b */
  TACT_VERTEX_VERTEX = 5, /**< a vertex of each */
  TACT_VERTEX_PLANE = 6,  /**< a vertex of a, b is a plane */
  TACT_PLANE_VERTEX = 7   /**< a is a plane, a vertex of b */
} tact_feature_pair;

/** A point on each of two surfaces, where features are nearest or have crossed. */
typedef struct tact_contact_point {
  int32_t kind; /**< tact_feature_pair */
  int patch; /**< the number of its patch, counted from 0: an index into tact_contact_patch(), if tact_settings.patches
                is set */
  int a_vertices[3];   /**< vertices of the smallest feature of a that holds the point; -1 fills up */
  int b_vertices[3];   /**< the same of b */
  double a_weights[3]; /**< weights of the vertices of a, not negative, with a sum of 1 */
  double b_weights[3]; /**< the same of b */
  double normal[3]; /**< unit vector from the point of a to that of b; the normal of a facet where the two coincide */
  double gap;  /**< the distance of the two points along the normal, metres; negative where the surfaces have crossed */
  uint64_t id; /**< the same in every step in which these features are near: a key for impulses */
  bool minimum; /**< whether nothing beside it on either surface is nearer along its normal, which lies in the normal
                   cones of both features */
} tact_contact_point;

/** Where an edge of one surface goes through a facet of the other; a corner of an intersection curve. */
typedef struct tact_curve_point {
  double position[3]; /**< metres; the exact place, rounded once */
  double fraction;    /**< how far along the edge, 0 to 1 */
  int edge[2]; /**< the vertices of the edge, ascending. The second is -1 at a common vertex of two facets of one body
                */
  int facet;   /**< the facet that the edge goes through; -1 at a common vertex */
  int facet_pair; /**< the facets that hold the way to the next point: an index into tact_contact.facet_pairs. -1: no
                     way leads on */
  bool edge_of_b; /**< whether the edge is of b, and the facet of a */
} tact_curve_point;

/** A polyline of points on both surfaces. */
typedef struct tact_curve {
  uint32_t struct_size;
  bool closed;                    /**< whether the last point leads on to the first */
  const tact_curve_point* points; /**< in order */
  size_t point_count;
} tact_curve;
#define TACT_CURVE_INIT \
  { (uint32_t)sizeof(tact_curve), false, NULL, 0 }

/** A vertex and a facet, or two edges, that are nearer to each other than the sum of the margins. Of one body, features
 * without a common vertex. */
typedef struct tact_reach_pair {
  int32_t kind;        /**< tact_feature_pair */
  int a_vertices[3];   /**< vertices of the feature of a, each once; -1 fills up. Those of edges ascend */
  int b_vertices[3];   /**< the same of b */
  double a_weights[3]; /**< weights, with a sum of 1, of the place of a nearest to b; above zero are those of the
                          closest vertex, edge or facet alone */
  double b_weights[3]; /**< the same of b */
  double normal[3];    /**< unit vector from the place of a to that of b; zero where the two coincide */
  double distance;     /**< how far the two places are apart, metres */
} tact_reach_pair;

/** Two bodies whose boxes overlap. */
typedef struct tact_candidate_pair {
  tact_body a;        /**< its key is below that of b */
  tact_body b;        /**< the second body */
  bool hulls_overlap; /**< whether their hulls overlap or touch */
} tact_candidate_pair;

/** Two bodies, or one with itself, that began or ceased to touch in this step: see tact_contact.touching. */
typedef struct tact_contact_event {
  tact_body a; /**< its key is not above that of b */
  tact_body b; /**< the second body */
} tact_contact_event;

/** What became of the patch. */
typedef enum tact_patch_event_kind {
  TACT_PATCH_BEGAN = 0,  /**< it is new */
  TACT_PATCH_SPLIT = 1,  /**< it is new, and was a part of the patch `other`, which persists */
  TACT_PATCH_MERGED = 2, /**< it became a part of the patch `other` */
  TACT_PATCH_ENDED = 3   /**< it is gone */
} tact_patch_event_kind;

/** A change of a patch in this step. */
typedef struct tact_patch_event {
  tact_body a;    /**< its key is not above that of b */
  tact_body b;    /**< the second body */
  int32_t kind;   /**< tact_patch_event_kind */
  uint64_t patch; /**< its id */
  uint64_t other; /**< the id of the other patch, or 0 */
} tact_patch_event;

/** A count or a time of the step. */
typedef struct tact_statistic {
  const char* name;
  const char* text;
  bool is_time;
  int64_t count; /**< 0 if it is a time */
  double ms;     /**< 0 if it is a count */
} tact_statistic;

/** The work of an event: see tact_trace_event. */
typedef enum tact_trace_kind {
  TACT_TRACE_REFRESH = 0,      /**< stage 1: a call of tact_world_set_positions(), or grouping facets again */
  TACT_TRACE_DETECT = 1,       /**< tact_world_detect() without stage 1 */
  TACT_TRACE_SWEEP = 2,        /**< stage 2 */
  TACT_TRACE_NARROW_PHASE = 3, /**< stages 3 to 6 of all pairs, on the thread that called */
  TACT_TRACE_PAIR = 4,         /**< a pair that took 20 microseconds or more, with the four stages that follow */
  TACT_TRACE_HULLS = 5,        /**< stage 3 of a pair */
  TACT_TRACE_DIRECTION = 6,    /**< stage 4 of a pair */
  TACT_TRACE_CULL = 7,         /**< stage 5 of a pair */
  TACT_TRACE_CONFIRM = 8,      /**< stage 6 of a pair, or what was left of it for all large pairs */
  TACT_TRACE_RANGE = 9,        /**< the part of a thread in stage 6 of a large pair */
  TACT_TRACE_SMALL_PAIRS = 10, /**< pairs that took less, one after the other */
  TACT_TRACE_KDOP_SEPARATED_PAIRS = 11, /**< pairs that an axis of the 18-DOPs separates, on all threads */
  TACT_TRACE_CONTAINMENT = 12,          /**< bodies that are wholly inside others */
  TACT_TRACE_CURVES = 13,               /**< intersection curves */
  TACT_TRACE_POINTS = 14,               /**< contact points of pairs of bodies */
  TACT_TRACE_SELF_FACETS = 15,          /**< facet pairs of bodies with themselves */
  TACT_TRACE_SELF_POINTS = 16,          /**< contact points of bodies with themselves */
  TACT_TRACE_PATCHES = 17,              /**< patches */
  TACT_TRACE_REPORT = 18,               /**< stage 7 */
  TACT_TRACE_WITHIN_REACH = 19,         /**< pairs of features within reach */
} tact_trace_kind;

/** A part of one thread's work: see tact::TraceEvent. Times are nanoseconds of the steady clock. */
typedef struct tact_trace_event {
  uint32_t struct_size;
  int32_t kind; /**< tact_trace_kind */
  int32_t thread;
  int64_t begin_ns;
  int64_t end_ns;
  tact_body a;
  tact_body b;
  int64_t count;
} tact_trace_event;
#define TACT_TRACE_EVENT_INIT \
  { (uint32_t)sizeof(tact_trace_event), 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0 }

/** Gives the contacts, sorted by (a, b). `count` is their number; each of them is tact_report_contact(). */
TACT_C_API tact_error tact_report_contacts(tact_world world, size_t* count);
/** The contact `index` of those, sorted by bodies. */
TACT_C_API tact_error tact_report_contact(tact_world world, size_t index, tact_contact* contact);
/** Gives the contact of two bodies, in either order, if they have one. The number of contacts stands for none. */
TACT_C_API tact_error tact_report_find_contact(tact_world world, tact_body a, tact_body b, size_t* index);
/** The patch `patch` of the contact `index`. */
TACT_C_API tact_error tact_contact_patch(tact_world world, size_t index, size_t patch, tact_patch* result);
/** Gives the points, if tact_settings.points is set; sorted by kind, then by features. */
TACT_C_API tact_error tact_contact_points(tact_world world, size_t index, const tact_contact_point** points,
                                          size_t* count);
/** Gives one of the curves in which the surfaces cross, if tact_settings.curves is set; sorted by their first facet
 * pair. */
TACT_C_API tact_error tact_contact_curve(tact_world world, size_t index, size_t curve, tact_curve* result);
/** Gives every vertex and facet, and every two edges, nearer than the sum of the margins, if
 * tact_settings.within_reach is set; sorted by kind, then by features. Planes have none: they have points. */
TACT_C_API tact_error tact_contact_within_reach(tact_world world, size_t index, const tact_reach_pair** pairs,
                                                size_t* count);
/** Gives a number made from every bit of the contact, its facet pairs, points, pairs within reach and patches, but for
 * counts of work. Bodies enter it by their keys alone. */
TACT_C_API tact_error tact_contact_hash(tact_world world, size_t index, uint64_t* hash);
/** Gives the pairs whose boxes overlap, sorted by (a, b). */
TACT_C_API tact_error tact_report_candidate_pairs(tact_world world, const tact_candidate_pair** pairs, size_t* count);
/** Gives the contacts that touch now and did not in the last step, sorted by (a, b). */
TACT_C_API tact_error tact_report_began(tact_world world, const tact_contact_event** events, size_t* count);
/** Gives the contacts that touched in the last step and do not now, sorted by (a, b); ids of removed bodies are stale.
 */
TACT_C_API tact_error tact_report_ended(tact_world world, const tact_contact_event** events, size_t* count);
/** Gives the changes of patches, if tact_settings.patches is set; sorted by (a, b), ends before beginnings. */
TACT_C_API tact_error tact_report_patch_events(tact_world world, const tact_patch_event** events, size_t* count);
/** Gives counts and times of the step. Writes up to `capacity` of them, counts before times, and how many there are. */
TACT_C_API tact_error tact_report_stats(tact_world world, tact_statistic* statistics, size_t capacity, size_t* count);
/** Gives what each thread did, if tact_settings.trace is set; sorted by thread and time, outer events first. `count` is
 * their number; each of them is tact_report_trace_event(). */
TACT_C_API tact_error tact_report_trace(tact_world world, size_t* count);
TACT_C_API tact_error tact_report_trace_event(tact_world world, size_t index, tact_trace_event* event);
/** Gives a number made from every bit of candidate pairs, contacts, facet pairs, points and pairs within reach; bodies
 * enter it by their keys. */
TACT_C_API tact_error tact_report_hash(tact_world world, uint64_t* hash);
/** Copies a report; memory is reused. `kept` is zero, or of an earlier call; any thread may read it by
 * tact_report_...(), whatever the world does, until tact_world_destroy(). As a world it holds no bodies. */
TACT_C_API tact_error tact_report_keep(tact_world world, tact_world* kept);

/** Arrays for the contact points of a whole report. A null one is left out. */
typedef struct tact_point_arrays {
  uint32_t struct_size;
  uint32_t* bodies;    /**< the index of body a and of body b, 2 a point */
  int* contacts;       /**< the number of its contact, counted from 0 */
  uint8_t* kinds;      /**< which features these are, as numbers */
  int* a_vertices;     /**< vertices of a, 3 a point; -1 fills up */
  int* b_vertices;     /**< vertices of b, 3 a point; -1 fills up */
  double* a_weights;   /**< weights of the vertices of a, 3 a point */
  double* b_weights;   /**< weights of the vertices of b, 3 a point */
  double* normals;     /**< unit vectors from a to b, 3 a point */
  double* gaps;        /**< metres; negative where the surfaces have crossed */
  uint64_t* ids;       /**< the same in every step in which these features are near */
  uint64_t* patch_ids; /**< ids of the patches, or 0 where patches are not requested */
  uint8_t* minima;     /**< 1 if nothing beside it on either surface is nearer, else 0 */
} tact_point_arrays;
#define TACT_POINT_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_point_arrays), NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL }

/** Arrays for the labels of what the points of a whole report name; 0 where there is none. A null one is left out. */
typedef struct tact_point_label_arrays {
  uint32_t struct_size;
  uint32_t* a_facets;   /**< that of a's facet, or of the first that has the vertex or the edge */
  uint32_t* b_facets;   /**< the same of b */
  uint32_t* a_vertices; /**< those of a's vertices, 3 a point */
  uint32_t* b_vertices; /**< those of b's vertices, 3 a point */
} tact_point_label_arrays;
#define TACT_POINT_LABEL_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_point_label_arrays), NULL, NULL, NULL, NULL }

/** Arrays for the facet pairs of a whole report. A null one is left out. */
typedef struct tact_facet_pair_arrays {
  uint32_t struct_size;
  uint32_t* bodies; /**< the index of body a and of body b, 2 a pair */
  int* contacts;    /**< the number of its contact, counted from 0 */
  int* facets;      /**< the facet of a and that of b, 2 a pair */
} tact_facet_pair_arrays;
#define TACT_FACET_PAIR_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_facet_pair_arrays), NULL, NULL, NULL }

/** Arrays for the pairs within reach of a whole report. A null one is left out. */
typedef struct tact_reach_pair_arrays {
  uint32_t struct_size;
  uint32_t* bodies;  /**< the index of body a and of body b, 2 a pair */
  int* contacts;     /**< the number of its contact, counted from 0 */
  uint8_t* kinds;    /**< which features these are, as numbers */
  int* a_vertices;   /**< vertices of a, 3 a pair; -1 fills up */
  int* b_vertices;   /**< vertices of b, 3 a pair; -1 fills up */
  double* a_weights; /**< weights of the vertices of a, 3 a pair */
  double* b_weights; /**< weights of the vertices of b, 3 a pair */
  double* normals;   /**< unit vectors from a to b, 3 a pair; zero where the distance is */
  double* distances; /**< metres */
} tact_reach_pair_arrays;
#define TACT_REACH_PAIR_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_reach_pair_arrays), NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL }

/** Gives the number of contact points of all contacts. */
TACT_C_API tact_error tact_report_point_count(tact_world world, size_t* count);
/** Gives the number of pairs within reach of all contacts. */
TACT_C_API tact_error tact_report_reach_pair_count(tact_world world, size_t* count);
/** Gives the number of facet pairs of all contacts. */
TACT_C_API tact_error tact_report_facet_pair_count(tact_world world, size_t* count);
/** Fills arrays with the points of all contacts, in their order. `rows` is the number of points that they have room
 * for: tact_report_point_count(). */
TACT_C_API tact_error tact_report_copy_points(tact_world world, const tact_point_arrays* arrays, size_t rows);
/** Fills arrays with the labels of the points of all contacts of the last step, in their order. `rows` is
 * tact_report_point_count(). */
TACT_C_API tact_error tact_report_copy_point_labels(tact_world world, const tact_point_label_arrays* arrays,
                                                    size_t rows);
/** Fills arrays with the pairs within reach of all contacts, in their order. `rows` is tact_report_reach_pair_count().
 */
TACT_C_API tact_error tact_report_copy_reach_pairs(tact_world world, const tact_reach_pair_arrays* arrays, size_t rows);
/** Fills arrays with the facet pairs of all contacts, in their order. `rows` is tact_report_facet_pair_count(). */
TACT_C_API tact_error tact_report_copy_facet_pairs(tact_world world, const tact_facet_pair_arrays* arrays, size_t rows);

/** Which surfaces are one. Facets of one body are, whether or not they share vertices, and bodies that are not tested
 * against each other: fixed ones, those of one group or excluded. */
typedef struct tact_joined_surfaces {
  uint32_t struct_size;
  double within;   /**< metres, at least 0: facets that are no farther from a place are there, too */
  uint32_t layers; /**< bodies on these layers are one surface as well, though they are tested */
} tact_joined_surfaces;
#define TACT_JOINED_SURFACES_INIT \
  { (uint32_t)sizeof(tact_joined_surfaces), 0, 0 }

/** Gives for each contact point of the last step, in the order of tact_report_copy_points(), 1 if it is a minimum also
 * of joined surfaces, else 0. It is one if tact_contact_point.minimum is set, no joined facet at either of its places
 * leads nearer along its normal, and no joined body lies behind the facet. A normal across a facet of its own body is
 * kept whatever leads nearer. `joined` may be null: the default; `rows` is tact_report_point_count(). */
TACT_C_API tact_error tact_report_joined_minima(tact_world world, const tact_joined_surfaces* joined, uint8_t* minima,
                                                size_t rows);

/** A vertex of a body. */
typedef struct tact_vertex_of_body {
  tact_body body; /**< the body of the vertex */
  int vertex;     /**< counted from 0 */
} tact_vertex_of_body;

/** What a solver did at a contact point: an impulse in N s, or a force in N. */
typedef struct tact_point_impulse {
  uint64_t id;       /**< tact_contact_point.id */
  double impulse[3]; /**< on b; a has the opposite */
} tact_point_impulse;

/** What a sum is over. */
typedef enum tact_sum_kind {
  TACT_SUM_CONTACT = 0, /**< two bodies, or one with itself */
  TACT_SUM_PATCH = 1,   /**< a patch of the contact before it */
  TACT_SUM_BODY = 2     /**< all contacts of `a`; `b` is no body */
} tact_sum_kind;

/** The sum over the points of a contact, a patch or a body. */
typedef struct tact_contact_sum {
  int32_t kind;       /**< tact_sum_kind */
  tact_body a;        /**< the first body */
  tact_body b;        /**< the second body, which `normal` and `force` push */
  uint64_t patch;     /**< the id of the patch, or 0 */
  int points;         /**< the number of contact points */
  double area;        /**< the areas of the patches, square metres; 0 where tact_settings.patches is not set */
  double deepest_gap; /**< the smallest gap, metres; infinity without points */
  double mean_gap;    /**< metres */
  double center[3];   /**< the mean place of its points, metres */
  double normal[3];   /**< the mean of the normals towards `b`, or towards the body of a sum over a body; shorter than 1
                         where they differ */
  double force[3];    /**< the sum of the impulses on `b`, or on the body */
  double torque[3];   /**< their moment about `center` */
  size_t first_vertex; /**< where the vertices that its points name begin, each once, in order */
  size_t vertex_count;
} tact_contact_sum;

/** Room for what tact_report_sum_contacts() gives, and how much there is. */
typedef struct tact_contact_sums {
  uint32_t struct_size;
  tact_contact_sum* sums; /**< each contact with points, followed by its patches; then the bodies of these, in the order
                             of their index. May be null */
  size_t sum_capacity;
  size_t sum_count;
  tact_vertex_of_body* vertices; /**< those of all sums. May be null */
  size_t vertex_capacity;
  size_t vertex_count;
} tact_contact_sums;
#define TACT_CONTACT_SUMS_INIT \
  { (uint32_t)sizeof(tact_contact_sums), NULL, 0, 0, NULL, 0, 0 }

/** Adds up the points of the last step, at the current positions. Points without an impulse have none; impulses without
 * a point are left out. */
TACT_C_API tact_error tact_report_sum_contacts(tact_world world, const tact_point_impulse* impulses, size_t count,
                                               tact_contact_sums* sums);

#ifdef __cplusplus
}
#endif

#endif
