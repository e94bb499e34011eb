// libFuzzer entry: any bytes as a YAML scene, and as the value of a --set option.
#include "fuzz_reader.h"
#include "fuzz_sample.h"

static bool read_value(const struct reader_context *context, uint32_t source, struct tree *tree) {
    return read_yaml_value(context, source, 0, tree);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_reader_run(read_yaml, true, data, size);
    if (fuzz_is_chosen((str){(const char *)data, size}, 1, 4))
        fuzz_reader_run(read_value, false, data, size);
    return 0;
}
