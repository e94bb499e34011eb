#include "diag/codes/binding.h"
#include "grammar/ir_copies.h"
#include "parser/bind/say.h"
#include "parser/bind/visit.h"
#include "parser/stages/override.h"
#include "parser/tree/mend.h"

#include <string.h>

enum {
    SEARCHES_MAX = 50,
};

static struct arena *scratch(const struct override *o) {
    return &o->loader->scratch;
}

static struct diag_sink *sink(const struct override *o) {
    return o->loader->input->sink;
}

// The way to the row: the path as far as it has been followed.
static str path_before(const struct override *o, uint32_t step) {
    return step == 0 ? STR("") : str_slice(o->text, 0, o->steps[step - 1].end);
}

static str quoted_text(const struct override *o, str text) {
    return say_text(scratch(o), text);
}

// Messages.

// Whether the step is a word of other programs: then the help says what glint calls it or has instead.
static bool is_other_word(struct override *o, const struct schema_element *element,
                          const struct override_step *step, str snake) {
    int also = schema_find_also(element, snake, 0);
    const struct concept *concept = also < 0 ? concept_find(element, snake) : NULL;
    if (also >= 0 && !element->rows[also].key) {
        const char *right = schema_yaml_key(&element->rows[also]);
        diag_help(sink(o), "did you mean '%s'?", right);
        diag_fix(sink(o), false, step->at, str_from(right));
        return true;
    }
    if (concept)
        diag_help(sink(o), "%.*s", STR_ARG(say_concept(scratch(o), concept, false)));
    return concept != NULL;
}

static bool unknown_key(struct override *o, const struct bind_frame *frame,
                        const struct override_step *step) {
    struct mend_search search = mend_begin(sink(o), scratch(o), step->text);
    for (uint32_t i = 0; i < frame->schema->row_count; i++) {
        const struct schema_row *row = &frame->schema->rows[i];
        if (row->key)
            continue;
        mend_offer(&search, schema_yaml_key(row), (int)i);
        if (row->single)
            mend_offer(&search, row->name, (int)i);
    }
    diag_add(sink(o), override_code(o, DIAG_SET_PATH), step->at, "%.*s has no '%.*s'",
             STR_ARG(say_subject(scratch(o), bind_subject(frame, NULL))),
             STR_ARG(quoted_text(o, step->text)));
    bool misspelt = search.best && mend_is_safe(&search);
    if (!misspelt && is_other_word(o, frame->schema, step, search.snake))
        return false;
    if (search.best) {
        diag_help(sink(o), "did you mean '%s'?", search.best);
        diag_fix(sink(o), mend_is_safe(&search), step->at, str_from(search.best));
        return false;
    }
    str list = STR("");
    for (uint32_t i = 0; i < frame->schema->row_count; i++)
        if (!frame->schema->rows[i].key)
            list = arena_format(scratch(o), "%.*s%s%s", STR_ARG(list), list.len ? ", " : "",
                                schema_yaml_key(&frame->schema->rows[i]));
    diag_help(sink(o), "it can have: %.*s", STR_ARG(list));
    return false;
}

static bool unknown_index(struct override *o, const struct schema_row *row, const struct override_step *step,
                          uint32_t count) {
    diag_add(sink(o), override_code(o, DIAG_SET_PATH), step->at, "there is no '%s[%u]'", schema_yaml_key(row),
             step->index);
    if (count == 0)
        diag_help(sink(o), "there are no %s there", schema_yaml_key(row));
    else
        diag_help(sink(o), "counted from 0, the last one is %s[%u]", schema_yaml_key(row), count - 1);
    return false;
}

static str name_of(const struct schema_row *row, void *list, uint32_t index) {
    int name_row = row->many == SCHEMA_NAMED_MAP ? schema_key_row(row->child) : visit_name_row(row->child);
    if (name_row < 0)
        return STR("");
    void *item = bind_list_item(list, index, row->child->size);
    return *(const str *)schema_field_const(&row->child->rows[name_row], item);
}

// The first entry of the name; false: none, and *entry is the list's length.
static bool find_name(const struct override *o, const struct schema_row *row, void *list, str name,
                      uint32_t *entry) {
    const uint32_t count = bind_list_count(list);
    if (!o->index) {
        for (*entry = 0; *entry < count && !str_equal(name_of(row, list, *entry), name);)
            ++*entry;
        return *entry < count;
    }
    struct override_names *names = o->index->lists;
    while (names && names->list != list)
        names = names->next;
    if (!names) {
        names = ARENA_NEW(scratch(o), struct override_names);
        *names = (struct override_names){.list = list, .next = o->index->lists};
        str_map_init(&names->entries, scratch(o));
        for (uint32_t i = count; i-- > 0;)
            *str_map_at(&names->entries, name_of(row, list, i)) = i + 1;
        o->index->lists = names;
    }
    const uint32_t found = str_map_find(&names->entries, name);
    *entry = found ? found - 1 : count;
    return found > 0;
}

// spheres[pawn][3], spheres[pawn[3]]
static bool is_copy(struct override *o, const struct override_step *step) {
    diag_add(sink(o), override_code(o, DIAG_SET_PATH), step->at, "a copy has no values of its own");
    diag_help(sink(o), "%s the entry, or write an expression of its variables there",
              o->is_track ? "move" : "set");
    return false;
}

static bool unknown_name(struct override *o, const struct schema_row *row, void *list,
                         const struct override_step *step, str name) {
    struct mend_search search = mend_begin(sink(o), scratch(o), name);
    str names = STR("");
    diag_add(sink(o), override_code(o, DIAG_SET_PATH), step->at, "there is no %s '%.*s'", row->child->name,
             STR_ARG(quoted_text(o, name)));
    // Only as many names are compared with all others as are reported one by one.
    if (o->index && o->index->searches++ >= SEARCHES_MAX)
        return false;
    for (uint32_t i = 0; i < bind_list_count(list); i++) {
        str other = name_of(row, list, i);
        if (other.len == 0)
            continue;
        mend_offer_str(&search, other, (int)i);
        if (names.len < 100)
            names = arena_format(scratch(o), "%.*s%s%.*s", STR_ARG(names), names.len ? ", " : "",
                                 STR_ARG(quoted_text(o, other)));
    }
    if (search.best)
        diag_help(sink(o), "did you mean '%s'?", search.best);
    else if (names.len)
        diag_help(sink(o), "there are: %.*s", STR_ARG(names));
    else
        diag_help(sink(o), "the scene has no %s%s", schema_yaml_key(row),
                  row->many == SCHEMA_NAMED_MAP ? "" : " with a name");
    return false;
}

static bool ends_here(struct override *o, const struct bind_frame *frame, const struct schema_row *row,
                      const struct override_step *step) {
    struct bind_subject subject = bind_subject(frame, row);
    diag_add(sink(o), override_code(o, DIAG_SET_PATH), step->at,
             "%.*s is a single value; there is nothing below it", STR_ARG(say_subject(scratch(o), subject)));
    return false;
}

static bool not_written(struct override *o, const struct bind_frame *frame, const struct schema_row *row,
                        uint32_t step) {
    str subject = say_subject(scratch(o), bind_subject(frame, row));
    if (o->is_track) {
        diag_add(sink(o), DIAG_TRACK_TARGET, o->steps[step].at, "%.*s is not written", STR_ARG(subject));
        diag_help(sink(o), "write it where it belongs, so that a picture without frames has it too");
        return false;
    }
    diag_add(sink(o), DIAG_SET_PATH, o->steps[step].at, "%.*s is not written; it can only be set as a whole",
             STR_ARG(subject));
    str example = say_example(scratch(o), row, false);
    const char *colon = memchr(example.ptr, ':', example.len);
    str value = str_slice(example, (size_t)(colon - example.ptr) + 2, example.len);
    diag_help(sink(o), "for example %.*s=%.*s", STR_ARG(path_before(o, step)), STR_ARG(value));
    return false;
}

// Names.

struct users {
    const struct override *o;
    const struct ir_reference *self;
    const struct schema_element *target;
    uint32_t count;
};

static void note_user(void *context, struct visit_place place, struct ir_reference *reference) {
    struct users *users = context;
    bool same = place.schema->rows[place.row].child == users->target && reference != users->self &&
                str_equal(reference->name, users->self->name);
    if (!same || ++users->count > 3)
        return;
    const char *row = place.schema->rows[place.row].name;
    diag_note(sink(users->o),
              ir_place_value(&users->o->loader->output->origin, place.memory, place.schema, row),
              "it is used here too");
}

static bool through_reference(struct override *o, const struct bind_frame *frame,
                              const struct schema_row *row, const struct ir_reference *reference,
                              uint32_t step) {
    const struct schema_row *home = &SCHEMA_SCENE.rows[bind_home_row(row->child)];
    str name = quoted_text(o, reference->name);
    diag_add(sink(o), override_code(o, DIAG_SET_REFERENCE), o->steps[step - 1].at,
             "%.*s names the %s '%.*s'; a path cannot go through a name",
             STR_ARG(say_subject(scratch(o), bind_subject(frame, row))), row->child->name, STR_ARG(name));
    struct users users = {.o = o, .self = reference, .target = row->child};
    if (!o->index || o->index->searches++ < SEARCHES_MAX)
        visit_references(&SCHEMA_SCENE, o->scene, note_user, &users);
    if (users.count > 3)
        diag_note(sink(o), SPAN_NONE, "and by %u more", users.count - 3);
    str rest = str_slice(o->text, o->steps[step].begin, o->text.len);
    const char *point = o->steps[step].kind == OVERRIDE_KEY ? "." : "";
    diag_help(sink(o), "to change it wherever it is used: %s%s.%.*s%s%.*s", o->is_track ? "" : "--set ",
              schema_yaml_key(home), STR_ARG(name), point, STR_ARG(quoted_text(o, rest)));
    return false;
}

// Steps.

static struct bind_frame *descend(struct override *o, struct bind_frame *frame, const struct schema_row *row,
                                  void *memory, str name) {
    struct bind_frame *child = ARENA_NEW(scratch(o), struct bind_frame);
    *child = (struct bind_frame){
        .parent = frame, .schema = row->child, .via = row, .memory = memory, .name = name, .label = o->path};
    return child;
}

static bool is_taken(const struct bind_frame *frame, const struct schema_row *row) {
    // An element that has no meaning without one of its rows must be written.
    if (row->choice == 0 && row->kind == SCHEMA_ELEMENT &&
        row->child->choices[0].rule == SCHEMA_CHOICE_EXACTLY_ONE)
        return bind_head((struct bind_frame *)frame)->written &
               bind_bit((uint32_t)(row - frame->schema->rows));
    if (row->choice == 0)
        return true;
    unsigned tag;
    memcpy(&tag, (const char *)frame->memory + frame->schema->choices[row->choice - 1].tag_offset,
           sizeof tag);
    return tag == row->alternative;
}

// Finds the entry that a step after a list names. A new entry of a named map may be set as a whole.
static bool find_entry(struct override *o, struct override_target *target, uint32_t step, str name) {
    const struct schema_row *row = &target->frame->schema->rows[target->row];
    const struct override_step *s = &o->steps[step];
    void *list = schema_field(row, target->frame->memory);
    uint32_t count = bind_list_count(list);
    bool by_index = s->kind == OVERRIDE_INDEX && row->many == SCHEMA_SEQUENCE;
    target->kind = OVERRIDE_ENTRY;
    target->name = row->many == SCHEMA_NAMED_MAP ? name : STR("");
    if (s->kind == OVERRIDE_KEY && row->many == SCHEMA_SEQUENCE) {
        diag_add(sink(o), override_code(o, DIAG_SET_PATH), s->at,
                 "'%s' is a list; its entries are counted from 0 or named in brackets", schema_yaml_key(row));
        if (str_equal(name, STR("0")))
            diag_help(sink(o), "write %s[0]", schema_yaml_key(row));
        else
            diag_help(sink(o), "for example %s[0] or %s[%.*s]", schema_yaml_key(row), schema_yaml_key(row),
                      STR_ARG(quoted_text(o, name)));
        return false;
    }
    if (by_index) {
        target->entry = s->index;
        return s->index < count || unknown_index(o, row, s, count);
    }
    if (find_name(o, row, list, name, &target->entry))
        return true;
    const str base = ir_copies_base(name);
    if (base.len < name.len && find_name(o, row, list, base, &target->entry))
        return is_copy(o, s);
    // A new parameter would be used by nothing.
    bool may_be_new = row->many == SCHEMA_NAMED_MAP && !row->aside && step + 1 == o->step_count &&
                      str_trim(str_slice(o->text, o->value_begin, o->text.len)).len;
    return may_be_new || unknown_name(o, row, list, s, name);
}

struct bind_frame *override_enter(struct override *o, const struct override_target *target) {
    const struct schema_row *row = &target->frame->schema->rows[target->row];
    void *list = schema_field(row, target->frame->memory);
    void *item = bind_list_item(list, target->entry, row->child->size);
    return descend(o, target->frame, row, item, name_of(row, list, target->entry));
}

static bool find_component(struct override *o, struct override_target *target, uint32_t step) {
    const struct schema_row *row = &target->frame->schema->rows[target->row];
    const struct override_step *s = &o->steps[step];
    const char *const *names = schema_components(row->kind);
    target->kind = OVERRIDE_COMPONENT;
    for (uint32_t i = 0; names[i]; i++) {
        if (s->kind == OVERRIDE_INDEX ? s->index == i : str_equal_cstr(s->text, names[i])) {
            target->component = i;
            return true;
        }
    }
    if (!names[0])
        return ends_here(o, target->frame, row, s);
    str list = STR("");
    for (uint32_t i = 0; names[i]; i++)
        list = arena_format(scratch(o), "%.*s%s%s", STR_ARG(list), i ? ", " : "", names[i]);
    diag_add(sink(o), override_code(o, DIAG_SET_PATH), s->at, "%.*s has no '%.*s'; it has %.*s",
             STR_ARG(say_subject(scratch(o), bind_subject(target->frame, row))),
             STR_ARG(quoted_text(o, s->text)), STR_ARG(list));
    return false;
}

// One step below a row that is neither list nor element.
static bool step_into_value(struct override *o, struct override_target *target, uint32_t step) {
    const struct schema_row *row = &target->frame->schema->rows[target->row];
    const struct override_step *s = &o->steps[step];
    bool has_value = is_taken(target->frame, row) &&
                     (row->standard || (bind_head(target->frame)->written & bind_bit(target->row)));
    if (target->kind == OVERRIDE_COMPONENT && target->component != OVERRIDE_WHOLE_SLOT)
        return ends_here(o, target->frame, row, s);
    if (schema_components(row->kind)[0] && !has_value)
        return not_written(o, target->frame, row, step);
    if (row->many != SCHEMA_FIXED || target->slot >= 0)
        return find_component(o, target, step);
    if (s->kind != OVERRIDE_INDEX || s->index >= row->fixed_count) {
        diag_add(sink(o), override_code(o, DIAG_SET_PATH), s->at, "%.*s has the entries [0] to [%u]",
                 STR_ARG(say_subject(scratch(o), bind_subject(target->frame, row))), row->fixed_count - 1);
        return false;
    }
    target->kind = OVERRIDE_COMPONENT;
    target->slot = (int)s->index;
    target->component = OVERRIDE_WHOLE_SLOT;
    return true;
}

// The element that the next key belongs to; NULL: reported.
static struct bind_frame *element_below(struct override *o, const struct override_target *target,
                                        uint32_t step) {
    struct bind_frame *frame = target->frame;
    const struct schema_row *row = &frame->schema->rows[target->row];
    if (target->kind == OVERRIDE_ENTRY)
        return override_enter(o, target);
    if (row->kind == SCHEMA_ELEMENT) {
        if (is_taken(frame, row))
            return descend(o, frame, row, schema_field(row, frame->memory), STR(""));
        not_written(o, frame, row, step);
        return NULL;
    }
    struct ir_reference *reference = schema_field(row, frame->memory);
    if (reference->name.len) {
        through_reference(o, frame, row, reference, step);
        return NULL;
    }
    if (reference->index == IR_NO_INDEX) {
        not_written(o, frame, row, step);
        return NULL;
    }
    const struct schema_row *home = &SCHEMA_SCENE.rows[bind_home_row(row->child)];
    return descend(o, frame, row,
                   bind_list_item(schema_field(home, o->scene), reference->index, row->child->size), STR(""));
}

// A key of an element: a row, or a component of the row whose name may be left out.
static bool step_to_row(struct override *o, struct bind_frame *frame, uint32_t step,
                        struct override_target *target) {
    const struct override_step *s = &o->steps[step];
    bool single;
    *target = (struct override_target){.kind = OVERRIDE_ROW, .frame = frame, .slot = -1};
    int row = s->kind == OVERRIDE_KEY ? schema_find_yaml(frame->schema, s->text, &single) : -1;
    int bare = schema_short_row(frame->schema);
    if (row < 0 && bare >= 0 && schema_components(frame->schema->rows[bare].kind)[0]) {
        const char *const *names = schema_components(frame->schema->rows[bare].kind);
        for (uint32_t i = 0; names[i]; i++) {
            bool names_it = str_equal_cstr(s->text, names[i]) || (s->kind == OVERRIDE_INDEX && s->index == i);
            if (!names_it)
                continue;
            target->row = (uint32_t)bare;
            frame->bare = true;
            return step_into_value(o, target, step);
        }
    }
    if (row < 0 && s->kind == OVERRIDE_INDEX && schema_find_row(frame->schema, STR("for")) >= 0)
        return is_copy(o, s);
    if (row < 0)
        return unknown_key(o, frame, s);
    target->row = (uint32_t)row;
    if (single)
        return find_entry(o, target, step, str_from(frame->schema->rows[row].single));
    return true;
}

bool override_walk(struct override *o, struct override_target *target) {
    struct bind_frame *root = ARENA_NEW(scratch(o), struct bind_frame);
    *root = (struct bind_frame){.schema = &SCHEMA_SCENE, .memory = o->scene, .label = o->path};
    if (!step_to_row(o, root, 0, target))
        return false;
    for (uint32_t step = 1; step < o->step_count; step++) {
        const struct schema_row *row = &target->frame->schema->rows[target->row];
        if (row->child == &SCHEMA_INCLUDE)
            break;
        if (row->kind == SCHEMA_LIST && target->kind == OVERRIDE_ROW) {
            if (!find_entry(o, target, step, o->steps[step].text))
                return false;
            o->entry = step == 1 ? target->entry : o->entry;
        } else if (target->kind == OVERRIDE_ENTRY || row->kind == SCHEMA_ELEMENT ||
                   row->kind == SCHEMA_REFERENCE) {
            struct bind_frame *below = element_below(o, target, step);
            if (!below || !step_to_row(o, below, step, target))
                return false;
        } else if (!step_into_value(o, target, step)) {
            return false;
        }
    }
    if (target->frame->schema->rows[target->row].child != &SCHEMA_INCLUDE)
        return true;
    diag_add(sink(o), override_code(o, DIAG_SET_PATH), o->steps[0].at,
             "'%s' cannot be set: the files have already been read", o->steps[0].text.ptr ? "include" : "");
    diag_help(sink(o), "write a scene file that includes both");
    return false;
}
