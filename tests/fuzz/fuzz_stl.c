// libFuzzer entry: any bytes as an STL mesh.
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_mesh("/mesh.stl", (str){(const char *)data, size}, STR(""));
    return 0;
}
