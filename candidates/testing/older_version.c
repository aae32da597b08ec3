/* A plug-in made with VERSION 3 or 4 of candidate.h, for a test: its declarations as they were. It
 * answers with the threshold and the parameter, and dies of being asked about a convex body. */
#include <stdlib.h>

#if VERSION >= 4
#define CONTEXT __attribute__((unused)) void *context,
#define CONTEXT_TYPE void*,
#else
#define CONTEXT
#define CONTEXT_TYPE
#endif
#define TEXT_OF(number) #number
#define NAME_OF(number, rest) "old-" TEXT_OF(number) rest
#define NAME(rest) NAME_OF(VERSION, rest)

typedef int ts_shape_kind;
typedef struct {
  ts_shape_kind kind;
  double size[4];
} ts_shape;
typedef struct {
  double position[3], orientation[4];
} ts_pose;
typedef struct {
  double position[3], normal[3], depth;
} ts_point;
typedef struct {
  int status;
  double normal[3], signed_distance;
  int point_count;
  ts_point points[16];
} ts_answer;
typedef struct {
  const char* meaning;
  double least, most, usual;
  int whole, bare;
} ts_parameter;
typedef struct {
  double threshold, parameter;
} ts_prepared;
typedef struct {
  const char *name, *version, *settings, *models;
  const ts_parameter* parameter;
  int (*supports)(CONTEXT_TYPE ts_shape_kind other);
  ts_prepared* (*prepare)(CONTEXT_TYPE const ts_shape* a, const ts_shape* b, double threshold,
                          double parameter);
  void (*query)(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double* previous,
                ts_answer* answer);
  void (*release)(ts_prepared* prepared);
  double (*model_distance)(ts_prepared* prepared, const ts_pose* a, const ts_pose* b);
#if VERSION >= 4
  void* context;
#endif
} ts_candidate;
typedef struct {
  int interface_version, count;
  const ts_candidate* candidates;
#if VERSION >= 4
  void (*after_fork)(void);
  int unforked;
#endif
} ts_plugin;

static int supports(CONTEXT ts_shape_kind other) {
  if (other > 4) abort();
  return other == 2;
}

static ts_prepared* prepare(CONTEXT const ts_shape* a, const ts_shape* b, double threshold,
                            double parameter) {
  ts_prepared* const prepared = malloc(sizeof *prepared);
  (void)a;
  (void)b;
  prepared->threshold = threshold;
  prepared->parameter = parameter;
  return prepared;
}

static void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double* previous,
                  ts_answer* answer) {
  (void)a;
  (void)b;
  (void)previous;
  answer->status = 0;
  answer->normal[2] = 1;
  answer->signed_distance = -prepared->threshold - prepared->parameter;
  answer->point_count = 0;
}

static void release(ts_prepared* prepared) { free(prepared); }

static const ts_parameter parameter = {"number", 1, 9, 3, 0, 0};
static const ts_candidate candidates[] = {{.name = NAME("-one"),
                                           .version = "1",
                                           .settings = "first",
                                           .parameter = &parameter,
                                           .supports = supports,
                                           .prepare = prepare,
                                           .query = query,
                                           .release = release},
                                          {.name = NAME("-two"),
                                           .version = "2",
                                           .settings = "second",
                                           .supports = supports,
                                           .prepare = prepare,
                                           .query = query,
                                           .release = release}};

__attribute__((visibility("default"))) const ts_plugin* touchstone_plugin(void) {
  static const ts_plugin plugin = {
      .interface_version = VERSION, .count = 2, .candidates = candidates};
  return &plugin;
}
