/* A drop falls through a floor: the README's program in C99. Vertices are floats of 32 bytes, as an engine has them. */
#include <stdio.h>
#include <tact/tact_c.h>

typedef struct vertex {
  float position[3];
  float normal[3];
  float uv[2];
} vertex;

static int check(tact_error error) {
  if (error != TACT_OK) fprintf(stderr, "%s: %s\n", tact_error_code_name(error), tact_last_error_message());
  return error == TACT_OK;
}

int main(void) {
  const double floor_positions[] = {-5, -5, 0, 5, -5, 0, 0, 5, 0};
  const uint16_t floor_facets[] = {0, 1, 2};
  vertex drop[4] = {{{0, 0, 1}, {0}, {0}}, {{1, 0, 1}, {0}, {0}}, {{0, 1, 1}, {0}, {0}}, {{0, 0, 2}, {0}, {0}}};
  const uint16_t drop_facets[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const tact_columns drop_positions = {drop, 4, sizeof(vertex), TACT_FLOAT32};
  tact_world world;
  tact_body floor_body, drop_body;
  tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
  int step;

  if (!check(tact_world_create(NULL, &world))) return 1;
  definition.positions.first = floor_positions;
  definition.positions.count = 3;
  definition.facets.first = floor_facets;
  definition.facets.count = 1;
  definition.facets.stride_bytes = 3 * sizeof(uint16_t);
  definition.facets.kind = TACT_UINT16;
  definition.surface = TACT_SURFACE_SHEET;
  definition.name = "floor";
  if (!check(tact_world_add_body(world, &definition, &floor_body))) return 1;
  definition.positions = drop_positions;
  definition.facets.first = drop_facets;
  definition.facets.count = 4;
  definition.surface = TACT_SURFACE_CLOSED;
  definition.name = "drop";
  if (!check(tact_world_add_body(world, &definition, &drop_body))) return 1;

  for (step = 0; step < 20; ++step) {
    size_t count, i;
    for (i = 0; i < 4; ++i) drop[i].position[2] -= 0.1f; /* it falls through the floor */
    if (!check(tact_world_set_positions(world, drop_body, &drop_positions))) return 1;
    if (!check(tact_world_detect(world)) || !check(tact_report_contacts(world, &count))) return 1;
    for (i = 0; i < count; ++i) {
      tact_contact contact = TACT_CONTACT_INIT;
      if (!check(tact_report_contact(world, i, &contact))) return 1;
      printf("step %d: depth %.1f m, %u facet pairs\n", step, contact.depth, (unsigned)contact.facet_pair_count);
    }
  }
  return check(tact_world_destroy(world)) ? 0 : 1;
}
