// libFuzzer entry: any bytes as an XML scene.
#include "fuzz_reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_reader_run(read_xml, true, data, size);
    return 0;
}
