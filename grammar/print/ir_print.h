// The IR as text: the canonical dump, and the writers of whole files. All of them walk the table.
//
// The writers write what the file wrote (head.written, poisoned rows too), in table order, lists in their own
// order; anonymous materials are written inside the body that uses them; a list or map without entries is not
// written. Numbers have the shortest digits that read back, one number replaces equal components of a colour
// or scale, and text that YAML 1.1 or 1.2 would read as something else is quoted. Errors: only lack of
// memory; check `out->failed` once at the end. Ownership: the caller's. Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_PRINT_IR_PRINT_H
#define GLINT_GRAMMAR_PRINT_IR_PRINT_H

#include "core/strbuf.h"
#include "diag/source.h"
#include "grammar/ir_origin.h"

struct ir_scene;

struct ir_write_options {
    uint32_t width; // columns to stay within if possible; 0: 100
    bool bare;      // only what is inside the root: no declaration, schema line, <Scene> or blank lines
};

// The meaning of a scene, as YAML in block style with one attribute per line: equal for two scenes exactly if
// the files wrote the same, in whichever spelling. No places, no comments. It reads back as a scene.
void ir_dump(const struct ir_scene *scene, struct strbuf *out);

// Whole files. `scene` is only one file (ir_file_origin.scene); `origin` and `sources` provide the comments
// before an entry and the editor's schema line, respelled where the other language spells them differently.
// Both may be NULL: then there are none.
void ir_write_yaml(const struct ir_scene *scene, const struct ir_origin *origin,
                   const struct source_set *sources, struct ir_write_options options, struct strbuf *out);
void ir_write_xml(const struct ir_scene *scene, const struct ir_origin *origin,
                  const struct source_set *sources, struct ir_write_options options, struct strbuf *out);

// A whole file in JSON, which reads back as YAML; JSON has no comments.
void ir_write_json(const struct ir_scene *scene, struct strbuf *out);

#endif
