#include "parser/reader.h"

bool reader_is_xml(str path, str text) {
    if (str_ends_with_nocase(path, ".xml"))
        return true;
    if (str_ends_with_nocase(path, ".yaml") || str_ends_with_nocase(path, ".yml") ||
        str_ends_with_nocase(path, ".json"))
        return false;
    if (str_starts_with(text, STR("\xEF\xBB\xBF")))
        text = str_slice(text, 3, text.len);
    text = str_trim(text);
    return text.len > 0 && text.ptr[0] == '<';
}
