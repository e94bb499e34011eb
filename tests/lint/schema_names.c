// Prints every name of the scene language, one a line: elements, attributes, plurals, components, words.
#include "grammar/schema.h"

#include <stdio.h>

static void print(const char *name) {
    if (name)
        printf("%s\n", name);
}

static void print_all(const char *const *names) {
    for (; names && *names; names++)
        print(*names);
}

int main(void) {
    for (const struct schema_element *const *element = schema_elements; *element; element++) {
        print((*element)->name);
        print((*element)->element);
        for (uint32_t i = 0; i < (*element)->row_count; i++) {
            const struct schema_row *row = &(*element)->rows[i];
            print(row->name);
            print(row->element);
            print(row->plural);
            print(row->single);
            print_all(row->words);
        }
    }
    print_all(schema_components(SCHEMA_VECTOR));
    print_all(schema_components(SCHEMA_PAIR));
    print_all(schema_components(SCHEMA_POINT));
    print_all(schema_components(SCHEMA_QUAD));
    print_all(schema_components(SCHEMA_COLOR));
    print_all(schema_components(SCHEMA_WEIGHTS));
    return 0;
}
