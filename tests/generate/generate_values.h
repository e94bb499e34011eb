// Random numbers, names and texts for the generator (generate.h). Private to this folder.
//
// Thread safety: one generator belongs to one thread.
#ifndef GLINT_TESTS_GENERATE_GENERATE_VALUES_H
#define GLINT_TESTS_GENERATE_GENERATE_VALUES_H

#include "grammar/schema.h"
#include "tests/generate/generate.h"

struct ir_mesh;
struct ir_scene;

struct generator {
    uint64_t state;
    const struct generate_options *options;
    struct arena *arena;
    struct ir_scene *scene;
    // Names of bodies and lights, which are unique among each other.
    struct {
        str *items;
        uint32_t count, capacity;
    } names;
};

// splitmix64 (Steele, Lea, Flood 2014).
uint64_t generate_bits(struct generator *g);
uint32_t generate_below(struct generator *g, uint32_t count); // 0..count-1; count > 0
bool generate_chance(struct generator *g, uint32_t percent);
double generate_unit(struct generator *g); // 0 <= u < 1
double generate_between(struct generator *g, double least, double greatest);

// A number in the range, never 0 where the range is of a magnitude.
double generate_number(struct generator *g, enum schema_range range);
int32_t generate_integer(struct generator *g, enum schema_range range);
struct ir_color generate_color(struct generator *g, enum schema_range range);

// A valid name: of many scripts, or one that YAML would read as something else.
str generate_name(struct generator *g);
// Any text but the empty one, of one line.
str generate_foreign_name(struct generator *g);
str generate_target(struct generator *g);
str generate_moving(struct generator *g);
// Any text that both spellings can hold; may be empty or of several lines.
str generate_text(struct generator *g);

// Mends what the table cannot say (generate_rules.c).
void generate_mend(struct generator *g, struct ir_scene *scene);
// generate_formulas.c: has values of the scene computed, to be what they are.
void generate_formulas(struct generator *g, struct ir_scene *scene);
// generate_copies.c: has some bodies and lights copied; before generate_formulas.
void generate_copies(struct generator *g, struct ir_scene *scene);
// generate_objects.c: moves some bodies and lights into objects; before generate_copies.
void generate_objects(struct generator *g, struct ir_scene *scene);
// Whether a row is of objects or instances.
bool generate_is_of_objects(const struct schema_row *row);
// Whether a row says which copies there are.
bool generate_is_of_copies(const struct schema_row *row);
// generate_meshes.c: gives a mesh points and faces that make a body.
void generate_mend_mesh(struct generator *g, struct ir_mesh *mesh);

#endif
