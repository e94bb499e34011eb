// What becomes of copies once all values are in their places: their formulas, what was in place in entries,
// warnings, and what cameras are focused on.
#include "diag/codes/binding.h"
#include "diag/codes/reference.h"
#include "parser/stages/objects.h"

#include "parser/bind/visit.h"

#include <string.h>

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

void copies_finish(struct evaluation *e) {
    for (uint32_t i = 0; e->copying && i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        const struct copied_list *list = &e->copying->lists[i];
        const struct ir_any_list items = ir_walk_list(row, e->scene);
        for (uint32_t k = 0; list->made && k < items.count; k++)
            if (list->made[k].places || list->made[k].instance || row->child == &SCHEMA_INSTANCE)
                ir_formulas_forget(row->child, ir_walk_item(row, items, k));
        for (uint32_t k = list->own; list->is_replaced && k < items.count; k++)
            ir_formulas_forget(row->child, ir_walk_item(row, items, k));
    }
}

static void tell_unused(const struct evaluation *e, const struct copy_entry *entry) {
    for (uint32_t i = 0; i < entry->variable_count; i++) {
        if (entry->used >> i & 1)
            continue;
        const str name = entry->variables[i].ir->name;
        diag_add(sink(e), DIAG_VARIABLE_UNUSED,
                 ir_place_value(&e->loader->output->origin, &entry->variables[i].ir->head, &SCHEMA_VARIABLE,
                                "name"),
                 "nothing uses '%.*s', so that its copies are in the same place", STR_ARG(name));
        diag_help(sink(e), "use it in an expression of this entry, or remove it");
    }
}

void copies_tell_unused(const struct evaluation *e) {
    for (uint32_t i = 0; e->copying && i < SCHEMA_SCENE.row_count; i++) {
        const struct copied_list *list = &e->copying->lists[i];
        for (uint32_t k = 0; k < list->written; k++)
            if (list->entries[k] && list->entries[k]->is_good && list->entries[k]->count > 1)
                tell_unused(e, list->entries[k]);
    }
    objects_tell_unused(e);
}

// ---- what cameras are focused on

static const struct copy_entry *find_entry(const struct evaluation *e, str name) {
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct copied_list *list = &e->copying->lists[i];
        for (uint32_t k = 0; k < list->written; k++)
            if (list->entries[k] && str_equal(list->entries[k]->frame->name, name))
                return list->entries[k];
    }
    return NULL;
}

static bool has_body(const struct evaluation *e, str name, str *similar) {
    const str base = ir_copies_base(name);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        const struct ir_any_list list = ir_walk_list(row, e->scene);
        const int name_row = copies_may(row) ? visit_name_row(row->child) : -1;
        for (uint32_t k = 0; name_row >= 0 && k < list.count; k++) {
            const str other =
                *(const str *)schema_field_const(&row->child->rows[name_row], ir_walk_item(row, list, k));
            if (str_equal(other, name))
                return true;
            if (!similar->len && str_equal(ir_copies_base(other), base))
                *similar = other;
        }
    }
    return false;
}

void copies_check_focus(struct evaluation *e) {
    const struct ir_cameras *cameras = &e->scene->cameras;
    for (uint32_t i = 0; e->copying && i < cameras->count; i++) {
        const str name = cameras->items[i].focus_on;
        const struct copy_entry *entry = name.len ? find_entry(e, ir_copies_base(name)) : NULL;
        const bool is_inside = name.len && memchr(name.ptr, '/', name.len);
        str similar = STR("");
        if (is_inside ? e->loader->incomplete || sink(e)->errors || has_body(e, name, &similar)
                      : !entry || !entry->is_good || has_body(e, name, &similar))
            continue;
        const span at =
            ir_place_value(&e->loader->output->origin, &cameras->items[i].head, &SCHEMA_CAMERA, "focus_on");
        if (is_inside)
            diag_add(sink(e), DIAG_UNKNOWN_BODY, at, "there is no body '%.*s'", STR_ARG(name));
        else if (entry->count)
            diag_add(sink(e), DIAG_UNKNOWN_BODY, at, "there is no body '%.*s': of '%.*s' there %s %llu cop%s",
                     STR_ARG(name), STR_ARG(entry->frame->name), entry->count == 1 ? "is" : "are",
                     (unsigned long long)entry->count, entry->count == 1 ? "y" : "ies");
        else
            diag_add(sink(e), DIAG_UNKNOWN_BODY, at,
                     "there is no body '%.*s': 'for' and 'if' make nothing of it", STR_ARG(name));
        if (similar.len)
            diag_help(sink(e), "one of them is '%.*s'", STR_ARG(similar));
    }
}
