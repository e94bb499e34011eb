// The stages behind parser_load: files and their includes, merging, overrides, names, rules. Private to
// parser/. Thread safety: one loader belongs to one thread.
#ifndef GLINT_PARSER_STAGES_LOADER_H
#define GLINT_PARSER_STAGES_LOADER_H

#include "grammar/schema_index.h"
#include "parser/bind/bind_stream.h"
#include "parser/parser.h"
#include "parser/tree/tree.h"

struct loader_file {
    str path; // canonical
    uint32_t source;
    struct ir_scene *scene; // this file only; NULL: could not be read
    uint32_t parent;        // the file that includes it; its own index for the main scene
    span include;           // the path in the parent
    bool open;              // its includes are being read
};

struct loader {
    const struct parser_input *input;
    struct parser_output *output;
    struct arena scratch; // emptied between files
    struct arena steady;  // not emptied
    struct schema_index index;
    struct bind_texts texts; // see bind_context
    struct bind_stream stream;
    struct diag_sink trial; // for the attempt to bind entries while they are read
    struct {
        struct loader_file *items;
        uint32_t count, capacity;
    } files; // [0] is the main scene
    struct {
        uint32_t *items;
        uint32_t count, capacity;
    } order; // files whose includes are complete: each before the one that includes it
    struct {
        uint32_t count;
        span first;
    } refused;       // includes beyond the limit of files
    bool is_beside;  // the scene is that of objects that nothing shows (unshown.c)
    bool incomplete; // a file was not read to its end, or includes are unknown: names may be in the rest
};

// loader.c
// To bind a tree with what the loader has.
struct bind_context loader_binding(struct loader *loader, struct diag_sink *sink, const struct tree *tree);
// Reads and binds a source; returns its index in loader->files. The main scene has itself as its parent.
uint32_t loader_add_file(struct loader *loader, uint32_t source, uint32_t parent, span include);

// resolve.c
// Reads all that loader->files[file] includes.
void resolve_includes(struct loader *loader, uint32_t file);
// Adds a note at the place of the first include that could not be read.
void resolve_note_unread(struct loader *loader, span at, str message);
// Says for each included file, at its first diagnostic, where it is included.
void resolve_note_includes(struct loader *loader);

// merge.c
// All files in loader->order, as one scene.
struct ir_scene *merge_files(struct loader *loader);
// Gives `into` its own places: those of `from`, with the rows of `into`.
void merge_own_places(struct ir_origin *origin, struct ir_head *into, const struct ir_head *from);
// Gives an element its own copies of the lists inside it.
void merge_clone_lists(struct arena *arena, const struct schema_element *schema, void *memory);
// Removes anonymous elements that nothing uses any more.
void merge_compact(struct loader *loader, struct ir_scene *scene);

// override.c
// Applies the --set options, in order.
void override_apply(struct loader *loader, struct ir_scene *scene);

// animate.c
// Formulas get their values. If the animation names a frame, the scene gets its values in that frame and then
// has no animation. Else all frames are checked.
void animate_scene(struct loader *loader, struct ir_scene *scene);

// unshown.c
// The scene of objects, if there are any: from here on the loaded one changes. NULL: there are none to judge.
struct ir_scene *unshown_begin(const struct loader *loader, const struct ir_scene *scene);
// Judges the objects that nothing in the loaded scene shows; output->unshown.
void unshown_judge(struct loader *loader, struct ir_scene *scene);

// names.c
// Names are unique; references get their index.
void names_resolve(struct loader *loader, struct ir_scene *scene);

// validate.c
// The rules that a table cannot say.
void validate_scene(struct loader *loader, const struct ir_scene *scene);
// The rules of one camera, light or body, or of the image; the contents of loader->scratch stay.
void validate_element(struct loader *loader, const struct schema_element *schema, const void *memory);

#endif
