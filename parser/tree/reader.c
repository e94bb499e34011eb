#include "parser/tree/reader.h"

bool reader_is_xml(str path, str text) {
    if (str_ends_with_nocase(path, ".xml"))
        return true;
    if (str_ends_with_nocase(path, ".yaml") || str_ends_with_nocase(path, ".yml") ||
        str_ends_with_nocase(path, ".json"))
        return false;
    text = str_trim(str_slice(text, str_skip_mark(text), text.len));
    return text.len > 0 && text.ptr[0] == '<';
}
