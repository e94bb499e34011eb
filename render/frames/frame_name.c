#include "render/frames/frame_name.h"

#include <stdlib.h>

const char *frame_name_number(const char *word, int32_t number, struct strbuf *out) {
    char *end;
    const long width = strtol(word, &end, 10);
    if (*end != 'd' || width < 0 || width > 9 || *word == ' ' || *word == '+' || *word == '-')
        return NULL;
    strbuf_format(out, "%0*d", (int)width, (int)number);
    return end + 1;
}

bool frame_name(const char *pattern, int32_t frame, struct strbuf *out) {
    for (const char *p = pattern; p && *p;) {
        if (*p != '%') {
            strbuf_char(out, *p++);
        } else if (p[1] == '%') {
            strbuf_char(out, '%');
            p += 2;
        } else {
            p = frame_name_number(p + 1, frame, out);
            if (!p)
                return false;
        }
    }
    return true;
}
