// The two readers: text to neutral tree. They know syntax and no element's name.
//
// Input: a source that is already in the set. Output: a tree; diagnostics E1xx and limits (E5xx) in the
// sink. Text that libyaml or expat refuses ends the file, and everything before it is in the tree
// (tree.broken is set); mistakes that glint itself finds (tags, duplicate keys, tabs, text between elements
// ...) do not: they are overwritten in a copy of equal length, and the nodes they touch are marked TREE_BAD.
// Memory: when the arena runs out, the library is freed first; then the jump goes on to the caller, who must
// have guarded it. There is never a jump through a library's frames.
#ifndef GLINT_PARSER_TREE_READER_H
#define GLINT_PARSER_TREE_READER_H

#include "core/limits.h"
#include "diag/diag.h"
#include "parser/tree/tree.h"

// Takes the entries of the root's lists and named maps one by one as they are read, so that a large file
// needs no large tree. Taken entries are not in the tree: only the count of a YAML list, and the first key of
// each name of XML children, marked TREE_TAKEN.
struct reader_taker {
    // Whether entries must be taken: those of the list or map of the root's pair `key`, or, in XML, the
    // children of the root that have this key.
    bool (*wants)(struct reader_taker *taker, const struct tree *tree, tree_index key, enum tree_kind kind);
    // Takes an entry of the pair `list_key`: an item of a list, or a key with its value. The nodes are gone
    // afterwards. false: the file must be read whole. Does not jump.
    bool (*take)(struct reader_taker *taker, const struct tree *tree, tree_index list_key, tree_index entry);
};

struct reader_context {
    struct source_set *sources;
    struct diag_sink *sink;
    const struct limits *limits;
    struct arena *arena;        // for the tree; guarded by the caller
    struct reader_taker *taker; // NULL: the tree keeps everything. Else the file is not repaired, the reader
                                // stops (false) at the first diagnostic, and the file must be read again.
};

// Makes the checks that both spellings share (UTF-8, control characters, emptiness), then reads.
// false: nothing can be bound (a diagnostic says why).
bool read_yaml(const struct reader_context *context, uint32_t source, struct tree *tree);
bool read_xml(const struct reader_context *context, uint32_t source, struct tree *tree);
// A value of `--set` in YAML flow syntax; the tree's root is the value itself, of any kind.
bool read_yaml_value(const struct reader_context *context, uint32_t source, uint32_t begin,
                     struct tree *tree);
// By ending (.xml; .yaml .yml .json), else by the first character that is not a space ('<' is XML).
bool reader_is_xml(str path, str text);

#endif
