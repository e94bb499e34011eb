#include "parser/yaml/yaml_memory.h"

#include "core/heap.h"

bool yaml_memory_begin(yaml_parser_t *parser) {
    bool good = yaml_parser_initialize(parser) != 0;
    if (!good)
        heap_exhausted(0);
    return good;
}

bool yaml_memory_check(const yaml_parser_t *parser, int good) {
    if (!good && parser->error == YAML_MEMORY_ERROR)
        heap_exhausted(0);
    return good != 0;
}
