/* tact for C99: the whole public interface, with the meaning that the headers of C++ give it (world.h, report.h).
 *
 *   tact_world world;
 *   if (tact_world_create(NULL, &world) != TACT_OK) puts(tact_last_error_message());
 *   tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
 *   ...
 *   tact_world_add_body(world, &definition, &body);
 *   tact_world_set_positions(world, body, &positions);
 *   tact_world_detect(world);
 *
 * Every function returns TACT_OK or an error, of which tact_last_error_message() then tells more; the world is as it
 * was before. A handle that was destroyed or never given out, a null pointer, a wrong size and calls of one world by
 * two threads at once are errors as well, not crashes. (Functions that only read may run at the same time.) Pointers
 * that point to nowhere cannot be told.
 *
 * Arrays that come back belong to the world: they are valid until its next tact_world_detect(),
 * tact_world_set_settings() or tact_world_destroy(). Lengths are metres.
 *
 * Structs begin with their size, by which the library knows which version of this header a program was compiled with:
 * always begin with the TACT_..._INIT of the struct. */
#ifndef TACT_C_H
#define TACT_C_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define TACT_C_API __attribute__((visibility("default")))
#else
#define TACT_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What a function returns. The numbers never change; new ones may come. */
typedef enum tact_error {
  TACT_OK = 0,
  TACT_ERROR_NON_FINITE_POSITION = 1,   /**< a coordinate is NaN or infinite */
  TACT_ERROR_POSITION_OUT_OF_RANGE = 2, /**< a coordinate is larger than 2^300 in size */
  TACT_ERROR_FACET_OUT_OF_RANGE = 3,    /**< a facet names a vertex that the body does not have */
  TACT_ERROR_WRONG_SIZE = 4,            /**< the number of positions is not the body's of vertices */
  TACT_ERROR_TOO_LARGE = 5,             /**< more than 2^29 - 1 vertices or facets, or 2^32 - 1 bodies */
  TACT_ERROR_STALE_BODY = 6,            /**< the body was removed, or was never given out */
  TACT_ERROR_FOREIGN_BODY = 7,          /**< the body is another world's */
  TACT_ERROR_FIXED_BODY = 8,            /**< positions or a pose were set on a body that is fixed */
  TACT_ERROR_BAD_SETTINGS = 9,          /**< a setting has no meaning; the message says which */
  TACT_ERROR_WRONG_ORDER = 10,          /**< a body named twice in one batch, or a report before the first step */
  TACT_ERROR_OUT_OF_MEMORY = 11,        /**< an allocation failed */
  TACT_ERROR_BACKEND_FAILURE = 12,      /**< Embree reported an error */
  TACT_ERROR_BAD_RECORDING = 13,        /**< bytes that are no recording, or one that does not play */
  TACT_ERROR_WRONG_MOTION = 14,         /**< positions were set on a rigid body, or a pose on one that is not */
  TACT_ERROR_NOT_A_ROTATION = 15,       /**< the matrix of a pose is not orthonormal to 1e-9, or mirrors */
  TACT_ERROR_INVALID_ARGUMENT = 16,     /**< an argument has no meaning, such as a negative margin */
  TACT_ERROR_INVALID_HANDLE = 100,      /**< the world was destroyed, or is none */
  TACT_ERROR_NULL_ARGUMENT = 101,       /**< a pointer is null that must not be */
  TACT_ERROR_WRONG_STRUCT_SIZE = 102,   /**< struct_size is not that of a version of this library */
  TACT_ERROR_BUSY = 103,                /**< another thread is in a function of the world */
  TACT_ERROR_INDEX_OUT_OF_RANGE = 104,  /**< an index is not below the count */
  TACT_ERROR_INTERNAL = 105,            /**< anything else; please report it */
  TACT_ERROR_FILE = 106                 /**< a file cannot be opened, read or written */
} tact_error;

/** The version of the library, such as "0.1.0". */
TACT_C_API const char* tact_version(void);
/** The name of an error, such as "stale_body"; "unknown" for a number that is none. */
TACT_C_API const char* tact_error_code_name(int error);
/** What went wrong in the last call of this thread that failed: body, vertex, facet, setting. Never null; valid until
 *  the thread's next call that fails. */
TACT_C_API const char* tact_last_error_message(void);

/** A set of bodies and the contacts among them. {0}: none. */
typedef struct tact_world {
  uint64_t handle;
} tact_world;

/** Names a body of one world; never given out twice. {0, 0, 0}: none. */
typedef struct tact_body {
  uint32_t index; /**< bodies of a report are ordered by it */
  uint32_t generation;
  uint32_t world;
} tact_body;

typedef enum tact_accuracy { TACT_ACCURACY_HULLS = 0, TACT_ACCURACY_PAPER = 1, TACT_ACCURACY_EXACT = 2 } tact_accuracy;
typedef enum tact_direction_policy { TACT_DIRECTION_CARRIED = 0, TACT_DIRECTION_SMALLEST = 1 } tact_direction_policy;
typedef enum tact_surface { TACT_SURFACE_CLOSED = 0, TACT_SURFACE_SHEET = 1 } tact_surface;
typedef enum tact_motion { TACT_MOTION_DEFORMABLE = 0, TACT_MOTION_FIXED = 1, TACT_MOTION_RIGID = 2 } tact_motion;
typedef enum tact_number_kind {
  TACT_FLOAT32 = 0,
  TACT_FLOAT64 = 1,
  TACT_INT32 = 2,
  TACT_UINT32 = 3,
  TACT_UINT16 = 4
} tact_number_kind;

/** `task(data, index)` is called once for each 0 <= index < count, on any threads; run() returns when all have
 * returned. See tact/executor.h. */
typedef void (*tact_task)(void* data, int index);
typedef struct tact_executor {
  void (*run)(void* user, int count, tact_task task, void* data); /**< null: OpenMP's threads */
  void* user;                                                     /**< outlives the world */
} tact_executor;

typedef enum tact_message_kind { TACT_MESSAGE_DIRECTION_LIMIT = 0, TACT_MESSAGE_GJK_LIMIT = 1 } tact_message_kind;

/** See tact::Message. */
typedef struct tact_message {
  int32_t kind; /**< tact_message_kind */
  tact_body a;  /**< the pair, where it is about one; else no body */
  tact_body b;
  const char* text; /**< valid during the call */
} tact_message;

/** Called at the end of tact_world_detect(), by its thread; must not call the world. */
typedef void (*tact_message_function)(void* user, const tact_message* message);

/** See tact::Settings. */
typedef struct tact_settings {
  uint32_t struct_size;
  int32_t threads;         /**< 0 to 1024; 0: as many as OpenMP would use */
  int32_t accuracy;        /**< tact_accuracy */
  int32_t direction;       /**< tact_direction_policy */
  double gjk_tolerance;    /**< 1e-15 to 0.1 */
  int32_t iteration_limit; /**< at least 1 */
  bool zones;              /**< outputs that are asked for */
  bool patches;
  bool trace;
  tact_executor executor;
  bool points;                      /**< contact points */
  tact_message_function on_message; /**< is told of each limit that a step reached; null: nobody */
  void* message_user;               /**< what it is called with */
} tact_settings;
#define TACT_SETTINGS_INIT                                                                                            \
  {                                                                                                                   \
    (uint32_t)sizeof(tact_settings), 0, TACT_ACCURACY_EXACT, TACT_DIRECTION_CARRIED, 1e-12, 100, false, false, false, \
        {NULL, NULL}, false, NULL, NULL                                                                               \
  }

/** `count` vertices or facets, three numbers each, that begin every `stride_bytes` from `first` on. Coordinates are
 *  float32 or float64, floats widen exactly; indices are int32, uint32 or uint16. Read where they are. */
typedef struct tact_columns {
  const void* first;
  size_t count;
  size_t stride_bytes;
  int32_t kind; /**< tact_number_kind */
} tact_columns;

/** See tact::BodyDefinition. */
typedef struct tact_body_definition {
  uint32_t struct_size;
  int32_t surface;        /**< tact_surface */
  tact_columns positions; /**< metres */
  tact_columns facets;    /**< indices of vertices, counter-clockwise seen from outside */
  int32_t motion;         /**< tact_motion */
  uint32_t layer;         /**< the layers this body is on, a bit each */
  uint32_t mask;          /**< the layers it is tested against */
  const char* name;       /**< for messages; null: "body <index>" */
  uint64_t external_id;   /**< the program's own; nothing depends on it */
  double margin;          /**< half a thickness, metres: surfaces closer than two margins are in contact */
  bool self_contact;      /**< is the body held against itself, too? */
  uint32_t group;         /**< bodies of one group are not tested against each other; 0: in none */
} tact_body_definition;
#define TACT_BODY_DEFINITION_INIT                                                                  \
  {                                                                                                \
    (uint32_t)sizeof(tact_body_definition), TACT_SURFACE_CLOSED, {NULL, 0, 24, TACT_FLOAT64},      \
        {NULL, 0, 12, TACT_INT32}, TACT_MOTION_DEFORMABLE, 1u, 0xffffffffu, NULL, 0, 0.0, false, 0 \
  }

/** New positions of one body. */
typedef struct tact_positions_update {
  tact_body body;
  tact_columns positions;
} tact_positions_update;

/** A new pose of a rigid body: see tact::PoseUpdate. */
typedef struct tact_pose_update {
  tact_body body;
  double rotation[9];    /**< row by row */
  double translation[3]; /**< metres */
} tact_pose_update;

/* The world. */

/** `settings` may be null: the default. */
TACT_C_API tact_error tact_world_create(const tact_settings* settings, tact_world* world);
TACT_C_API tact_error tact_world_destroy(tact_world world);
TACT_C_API tact_error tact_world_settings(tact_world world, tact_settings* settings);
TACT_C_API tact_error tact_world_set_settings(tact_world world, const tact_settings* settings);
TACT_C_API tact_error tact_world_add_body(tact_world world, const tact_body_definition* definition, tact_body* body);
TACT_C_API tact_error tact_world_remove_body(tact_world world, tact_body body);
TACT_C_API tact_error tact_world_set_positions(tact_world world, tact_body body, const tact_columns* positions);
/** Of many bodies, in parallel; all or none. */
TACT_C_API tact_error tact_world_set_positions_of_many(tact_world world, const tact_positions_update* updates,
                                                       size_t count);
/** Turns and moves a rigid body: see tact::World::set_pose(). `rotation` has 9 numbers, row by row, `translation` 3. */
TACT_C_API tact_error tact_world_set_pose(tact_world world, tact_body body, const double* rotation,
                                          const double* translation);
/** Of many bodies, in parallel; all or none. */
TACT_C_API tact_error tact_world_set_poses(tact_world world, const tact_pose_update* updates, size_t count);
TACT_C_API tact_error tact_world_set_layers(tact_world world, tact_body body, uint32_t layer, uint32_t mask);
TACT_C_API tact_error tact_world_set_group(tact_world world, tact_body body, uint32_t group);
/** Are two bodies left out, whatever their layers: the two sides of a joint, say? */
TACT_C_API tact_error tact_world_set_excluded(tact_world world, tact_body a, tact_body b, bool excluded);
TACT_C_API tact_error tact_world_set_motion(tact_world world, tact_body body, int32_t motion);
TACT_C_API tact_error tact_world_set_margin(tact_world world, tact_body body, double margin);
TACT_C_API tact_error tact_world_set_self_contact(tact_world world, tact_body body, bool wanted);
/** One step. The functions tact_report_... tell what it found. */
TACT_C_API tact_error tact_world_detect(tact_world world);
/** What meets between the positions of the last step and those set since; `wanted` is a tact_impacts. The functions
 *  tact_motion_... tell what it found. It changes nothing. */
TACT_C_API tact_error tact_world_detect_motion(tact_world world, int32_t wanted);

TACT_C_API tact_error tact_world_contains(tact_world world, tact_body body, bool* contains);
TACT_C_API tact_error tact_world_body_count(tact_world world, size_t* count);
/** Writes up to `capacity` bodies, in the order of their index, and how many there are. */
TACT_C_API tact_error tact_world_bodies(tact_world world, tact_body* bodies, size_t capacity, size_t* count);
/** Valid until the body is removed or the world destroyed. */
TACT_C_API tact_error tact_world_name(tact_world world, tact_body body, const char** name);
TACT_C_API tact_error tact_world_surface(tact_world world, tact_body body, tact_surface* surface);
TACT_C_API tact_error tact_world_motion(tact_world world, tact_body body, tact_motion* motion);
TACT_C_API tact_error tact_world_group(tact_world world, tact_body body, uint32_t* group);
TACT_C_API tact_error tact_world_excluded(tact_world world, tact_body a, tact_body b, bool* excluded);
TACT_C_API tact_error tact_world_layer(tact_world world, tact_body body, uint32_t* layer);
TACT_C_API tact_error tact_world_mask(tact_world world, tact_body body, uint32_t* mask);
TACT_C_API tact_error tact_world_external_id(tact_world world, tact_body body, uint64_t* external_id);
TACT_C_API tact_error tact_world_margin(tact_world world, tact_body body, double* margin);
TACT_C_API tact_error tact_world_self_contact(tact_world world, tact_body body, bool* wanted);
TACT_C_API tact_error tact_world_vertex_count(tact_world world, tact_body body, size_t* count);
TACT_C_API tact_error tact_world_facet_count(tact_world world, tact_body body, size_t* count);

/** A box, metres. */
typedef struct tact_bounds {
  double lower[3];
  double upper[3];
} tact_bounds;

/** The mesh as it was given, at the positions that were set last: three numbers a vertex or facet, into `room` numbers
 *  of the caller, as many as there are. A vertex that no facet uses has NaN for coordinates. */
TACT_C_API tact_error tact_world_copy_positions(tact_world world, tact_body body, double* coordinates, size_t room);
TACT_C_API tact_error tact_world_copy_facets(tact_world world, tact_body body, int* corners, size_t room);
/** With its margin; where the body has no facet, lower is above upper. */
TACT_C_API tact_error tact_world_bounds(tact_world world, tact_body body, tact_bounds* bounds);

/* Recordings: see tact/recording.h. */

/** Records everything that enters the world to the file `path`, from before its first body on; null ends it and tells
 *  whether the file holds all (TACT_ERROR_FILE). It also ends with the world. */
TACT_C_API tact_error tact_world_record(tact_world world, const char* path);

/** Runs a recording again. {0}: none. */
typedef struct tact_player {
  uint64_t handle;
} tact_player;

/** See tact::PlayedStep. */
typedef struct tact_played_step {
  uint32_t struct_size;
  int32_t number; /**< from 0 */
  size_t byte;    /**< where its hash stands in the recording */
  bool answered;  /**< did the step have an answer when it was recorded? */
  uint64_t recorded;
  uint64_t now; /**< hash of the report now */
} tact_played_step;
#define TACT_PLAYED_STEP_INIT \
  { (uint32_t)sizeof(tact_played_step), 0, 0, false, 0, 0 }

/** `threads` of -1: as many as the recording had. */
TACT_C_API tact_error tact_player_open(const char* path, int32_t threads, tact_player* player);
TACT_C_API tact_error tact_player_close(tact_player player);
/** Runs the next step; `played` is false at the end. */
TACT_C_API tact_error tact_player_next(tact_player player, tact_played_step* step, bool* played);
/** Was the recording cut off, and in the record that begins at which byte? Known at the end. */
TACT_C_API tact_error tact_player_cut_at(tact_player player, bool* cut, size_t* byte);
/** The world that the steps are made in, with the report of the last; valid until the player is closed. */
TACT_C_API tact_error tact_player_world(tact_player player, tact_world* world);
/** The version of tact that wrote the recording; valid until the player is closed. */
TACT_C_API tact_error tact_player_recorded_by(tact_player player, const char** version);

/* The report of the last step. */

typedef enum tact_direction_source {
  TACT_SOURCE_CARRIED = 0,
  TACT_SOURCE_FRESH = 1,
  TACT_SOURCE_SMALLEST = 2
} tact_direction_source;

/** See tact::Containment. */
typedef enum tact_containment {
  TACT_CONTAINMENT_NONE = 0,
  TACT_CONTAINMENT_A_IN_B = 1,
  TACT_CONTAINMENT_B_IN_A = 2
} tact_containment;

/** Facet `a` of the first body meets facet `b` of the second. */
typedef struct tact_facet_pair {
  int a;
  int b;
} tact_facet_pair;

typedef struct tact_zone_disk {
  double center[3]; /**< metres */
  double radius;    /**< metres; negative: none */
} tact_zone_disk;

/** See tact::Contact. */
typedef struct tact_contact {
  uint32_t struct_size;
  tact_body a; /**< a.index < b.index */
  tact_body b;
  double direction[3]; /**< unit, from a to b: move b by depth * direction to part the hulls */
  double depth;        /**< metres */
  int32_t source;      /**< tact_direction_source */
  int32_t iterations;
  bool limit_reached;
  bool touching; /**< does any facet of a meet one of b? */
  double plane_a;
  double plane_b;
  tact_zone_disk zone_a;
  tact_zone_disk zone_b;
  int64_t kept_facets_a;
  int64_t kept_facets_b;
  const tact_facet_pair* facet_pairs; /**< sorted; the world's */
  size_t facet_pair_count;
  size_t patch_count;  /**< see tact_contact_patch() */
  int32_t containment; /**< tact_containment: is one body wholly inside the other? */
} tact_contact;
#define TACT_CONTACT_INIT                                                                                          \
  {                                                                                                                \
    (uint32_t)sizeof(tact_contact), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, false, false, 0, 0, {{0, 0, 0}, -1}, \
        {{0, 0, 0}, -1}, 0, 0, NULL, 0, 0, 0                                                                       \
  }

/** See tact::Patch. */
typedef struct tact_patch {
  uint32_t struct_size;
  double point[3];
  double direction[3];
  double depth;           /**< metres */
  const int* facet_pairs; /**< indices into the contact's, ascending; the world's */
  size_t facet_pair_count;
  uint64_t id;       /**< lasts from step to step */
  double area;       /**< square metres */
  const int* points; /**< indices into the contact's, ascending; the world's */
  size_t point_count;
  int spanning[4]; /**< at most four of the points, the deepest first; -1 fills up */
} tact_patch;
#define TACT_PATCH_INIT                                                                               \
  {                                                                                                   \
    (uint32_t)sizeof(tact_patch), {0, 0, 0}, {0, 0, 0}, 0, NULL, 0, 0, 0, NULL, 0, { -1, -1, -1, -1 } \
  }

typedef enum tact_feature_pair { TACT_VERTEX_FACET = 0, TACT_FACET_VERTEX = 1, TACT_EDGE_EDGE = 2 } tact_feature_pair;

/** See tact::ContactPoint. */
typedef struct tact_contact_point {
  int32_t kind; /**< tact_feature_pair */
  int patch;
  int a_vertices[3]; /**< -1 fills up */
  int b_vertices[3];
  double a_weights[3]; /**< not negative; the sum is 1 */
  double b_weights[3];
  double normal[3]; /**< unit, from a to b */
  double gap;       /**< metres; negative where surfaces have crossed */
  uint64_t id;      /**< the same while these features are near each other */
} tact_contact_point;

/** Two bodies whose boxes overlap. */
typedef struct tact_candidate_pair {
  tact_body a;
  tact_body b;
  bool hulls_overlap;
} tact_candidate_pair;

/** Two bodies, or one twice, that began to touch, or ceased to. */
typedef struct tact_contact_event {
  tact_body a;
  tact_body b;
} tact_contact_event;

typedef enum tact_patch_event_kind {
  TACT_PATCH_BEGAN = 0,
  TACT_PATCH_SPLIT = 1,
  TACT_PATCH_MERGED = 2,
  TACT_PATCH_ENDED = 3
} tact_patch_event_kind;

/** See tact::PatchEvent. */
typedef struct tact_patch_event {
  tact_body a;
  tact_body b;
  int32_t kind; /**< tact_patch_event_kind */
  uint64_t patch;
  uint64_t other;
} tact_patch_event;

/** A count or a time of the step. */
typedef struct tact_statistic {
  const char* name;
  const char* text;
  bool is_time;
  int64_t count; /**< 0 if it is a time */
  double ms;     /**< 0 if it is a count */
} tact_statistic;

/** See tact::TraceEvent. Times are nanoseconds of the steady clock. */
typedef struct tact_trace_event {
  uint32_t struct_size;
  int32_t kind; /**< in the order of tact::TraceEvent::Kind */
  int32_t thread;
  int64_t begin_ns;
  int64_t end_ns;
  tact_body a;
  tact_body b;
  int64_t count;
} tact_trace_event;
#define TACT_TRACE_EVENT_INIT \
  { (uint32_t)sizeof(tact_trace_event), 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0 }

/** How many pairs of bodies have hulls that overlap. */
TACT_C_API tact_error tact_report_contacts(tact_world world, size_t* count);
/** The contact `index` of those, sorted by bodies. */
TACT_C_API tact_error tact_report_contact(tact_world world, size_t index, tact_contact* contact);
/** The index of the contact of two bodies, in either order; the number of contacts if their hulls are apart. */
TACT_C_API tact_error tact_report_find_contact(tact_world world, tact_body a, tact_body b, size_t* index);
/** The patch `patch` of the contact `index`. */
TACT_C_API tact_error tact_contact_patch(tact_world world, size_t index, size_t patch, tact_patch* result);
/** The points of the contact `index`, if they were asked for; the world's. */
TACT_C_API tact_error tact_contact_points(tact_world world, size_t index, const tact_contact_point** points,
                                          size_t* count);
TACT_C_API tact_error tact_report_candidate_pairs(tact_world world, const tact_candidate_pair** pairs, size_t* count);
/** Pairs that touch now and did not in the last step, and the opposite. */
TACT_C_API tact_error tact_report_began(tact_world world, const tact_contact_event** events, size_t* count);
TACT_C_API tact_error tact_report_ended(tact_world world, const tact_contact_event** events, size_t* count);
/** What became of patches, if they are asked for; the world's. */
TACT_C_API tact_error tact_report_patch_events(tact_world world, const tact_patch_event** events, size_t* count);
/** Writes up to `capacity` statistics, counts and then times, and how many there are. */
TACT_C_API tact_error tact_report_stats(tact_world world, tact_statistic* statistics, size_t capacity, size_t* count);
/** How many trace events there are, and each of them. */
TACT_C_API tact_error tact_report_trace(tact_world world, size_t* count);
TACT_C_API tact_error tact_report_trace_event(tact_world world, size_t index, tact_trace_event* event);
/** The number that two equal reports share, in C and C++. */
TACT_C_API tact_error tact_report_hash(tact_world world, uint64_t* hash);

/* What tact_world_detect_motion() found; valid until it is called again. */

typedef enum tact_impacts { TACT_IMPACTS_ALL = 0, TACT_IMPACTS_FIRST_OF_PAIR = 1, TACT_IMPACTS_FIRST = 2 } tact_impacts;

/** See tact::Impact. */
typedef struct tact_impact {
  tact_body a; /**< a.index <= b.index */
  tact_body b;
  int32_t kind;      /**< tact_feature_pair */
  double time;       /**< 0 to 1; never late */
  int a_vertices[3]; /**< -1 fills up */
  int b_vertices[3];
} tact_impact;

/** See tact::ImpactPair. */
typedef struct tact_impact_pair {
  uint32_t struct_size;
  tact_body a;
  tact_body b;
  double first_time;
  const tact_impact* impacts; /**< sorted by time; the world's */
  size_t impact_count;
} tact_impact_pair;
#define TACT_IMPACT_PAIR_INIT \
  { (uint32_t)sizeof(tact_impact_pair), {0, 0, 0}, {0, 0, 0}, 0, NULL, 0 }

/** See tact::MotionStats. */
typedef struct tact_motion_statistics {
  uint32_t struct_size;
  int64_t moved_bodies;
  int64_t body_pairs;
  int64_t cluster_pairs;
  int64_t candidates;
  int64_t searched;
  int64_t spans;
  int64_t impacts;
  double sweep_ms;
  double search_ms;
} tact_motion_statistics;
#define TACT_MOTION_STATISTICS_INIT \
  { (uint32_t)sizeof(tact_motion_statistics), 0, 0, 0, 0, 0, 0, 0, 0, 0 }

/** The earliest time of all; infinity if nothing meets. */
TACT_C_API tact_error tact_motion_first_time(tact_world world, double* time);
/** Sorted by bodies, then by time; the world's. */
TACT_C_API tact_error tact_motion_impacts(tact_world world, const tact_impact** impacts, size_t* count);
/** How many pairs of bodies meet, and each of them. */
TACT_C_API tact_error tact_motion_pairs(tact_world world, size_t* count);
TACT_C_API tact_error tact_motion_pair(tact_world world, size_t index, tact_impact_pair* pair);
TACT_C_API tact_error tact_motion_stats(tact_world world, tact_motion_statistics* statistics);

/* Queries to the surfaces where they are now. */

/** See tact::Ray. */
typedef struct tact_ray {
  double from[3]; /**< metres */
  double to[3];
  uint32_t layer; /**< bodies whose mask has one of these bits, */
  uint32_t mask;  /**< and whose layer has one of these */
} tact_ray;
#define TACT_RAY_INIT \
  { {0, 0, 0}, {0, 0, 0}, 0xffffffffu, 0xffffffffu }

typedef enum tact_ray_hits { TACT_RAY_FIRST = 0, TACT_RAY_ANY = 1 } tact_ray_hits;

/** See tact::RayHit. */
typedef struct tact_ray_hit {
  tact_body body;
  int facet;             /**< negative: nothing was hit */
  double fraction;       /**< from + fraction * (to - from) */
  double barycentric[3]; /**< of the facet's corners there */
} tact_ray_hit;

/** See tact::PointQuery. */
typedef struct tact_point_query {
  double point[3]; /**< metres */
  double within;   /**< metres */
  uint32_t layer;
  uint32_t mask;
} tact_point_query;
#define TACT_POINT_QUERY_INIT \
  { {0, 0, 0}, HUGE_VAL, 0xffffffffu, 0xffffffffu }

/** See tact::ClosestPoint. */
typedef struct tact_closest_point {
  tact_body body;
  int facet;       /**< negative: nothing is as near */
  double distance; /**< metres */
  double barycentric[3];
} tact_closest_point;

/** See tact::BoxQuery. */
typedef struct tact_box_query {
  double lower[3]; /**< metres */
  double upper[3];
  uint32_t layer;
  uint32_t mask;
} tact_box_query;
#define TACT_BOX_QUERY_INIT TACT_RAY_INIT

/** A facet of a body. */
typedef struct tact_facet_of_body {
  tact_body body;
  int facet;
} tact_facet_of_body;

/** `wanted` is a tact_ray_hits. */
TACT_C_API tact_error tact_world_cast_ray(tact_world world, const tact_ray* ray, int32_t wanted, tact_ray_hit* hit);
/** `count` rays and hits, on all threads. */
TACT_C_API tact_error tact_world_cast_rays(tact_world world, const tact_ray* rays, size_t count, int32_t wanted,
                                           tact_ray_hit* hits);
/** These three write up to `capacity` answers, sorted, and how many there are. */
TACT_C_API tact_error tact_world_cast_ray_all(tact_world world, const tact_ray* ray, tact_ray_hit* hits,
                                              size_t capacity, size_t* count);
TACT_C_API tact_error tact_world_overlap_box(tact_world world, const tact_box_query* query, tact_facet_of_body* facets,
                                             size_t capacity, size_t* count);
TACT_C_API tact_error tact_world_bodies_containing(tact_world world, const tact_point_query* query, tact_body* bodies,
                                                   size_t capacity, size_t* count);
/** `count` queries, on all threads. The answers follow each other: ends[i], one for each query, is where that to
 *  query i ends. Up to `capacity` are written; ends[count - 1] is how many there are. */
TACT_C_API tact_error tact_world_overlap_boxes(tact_world world, const tact_box_query* queries, size_t count,
                                               tact_facet_of_body* facets, size_t capacity, size_t* ends);
TACT_C_API tact_error tact_world_bodies_containing_each(tact_world world, const tact_point_query* queries, size_t count,
                                                        tact_body* bodies, size_t capacity, size_t* ends);
TACT_C_API tact_error tact_world_closest_point(tact_world world, const tact_point_query* query,
                                               tact_closest_point* answer);
TACT_C_API tact_error tact_world_closest_points(tact_world world, const tact_point_query* queries, size_t count,
                                                tact_closest_point* answers);

/* Drawing what a step found: see tact/debug_draw.h. */

/** Each 0 to 1. */
typedef struct tact_debug_color {
  float red;
  float green;
  float blue;
  float alpha;
} tact_debug_color;

/** Where it is drawn; positions are three metres each. */
typedef struct tact_debug_drawer {
  void (*line)(void* user, const double* from, const double* to, tact_debug_color color);
  void (*triangle)(void* user, const double* p, const double* q, const double* r, tact_debug_color color);
  void (*text)(void* user, const double* at, const char* words, tact_debug_color color);
  void* user;
} tact_debug_drawer;

/** See tact::DebugDrawOptions. */
typedef struct tact_debug_draw_options {
  uint32_t struct_size;
  bool surfaces;
  bool boxes;
  bool candidate_pairs;
  bool directions;
  bool planes;
  bool zones;
  bool kept_facets;
  bool facet_pairs;
  bool patches;
  bool points;
  bool names;
  tact_debug_color surface;
  tact_debug_color box;
  tact_debug_color moved_box;
  tact_debug_color candidate;
  tact_debug_color direction;
  tact_debug_color plane;
  tact_debug_color zone;
  tact_debug_color kept;
  tact_debug_color meeting;
  tact_debug_color patch;
  tact_debug_color point;
  tact_debug_color word;
} tact_debug_draw_options;

/** Fills in what is drawn, and in which colours, if nobody says otherwise; struct_size included. */
TACT_C_API tact_error tact_debug_draw_defaults(tact_debug_draw_options* options);
/** Draws what the last step found; `options` may be null: the default. */
TACT_C_API tact_error tact_world_debug_draw(tact_world world, const tact_debug_drawer* drawer,
                                            const tact_debug_draw_options* options);

#ifdef __cplusplus
}
#endif

#endif
