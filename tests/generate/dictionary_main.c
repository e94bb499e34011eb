// Writes the fuzzer's dictionary to standard output; the target `emitted` writes it to where it is committed.
#include "tests/generate/dictionary.h"

#include <stdio.h>

int main(void) {
    struct strbuf out;
    strbuf_init(&out);
    dictionary_write(&out);
    bool failed = out.failed || fwrite(out.data, 1, out.len, stdout) != out.len || fflush(stdout) != 0;
    strbuf_finish(&out);
    return failed ? 3 : 0;
}
