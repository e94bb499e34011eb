// libFuzzer entry: any bytes as an OBJ mesh and, behind the first NUL byte, its material file own.mtl.
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const str all = {(const char *)data, size};
    const char *nul = memchr(all.ptr ? all.ptr : "", 0, size);
    const size_t cut = nul ? (size_t)(nul - all.ptr) : size;
    fuzz_mesh("/mesh.obj", str_slice(all, 0, cut), str_slice(all, nul ? cut + 1 : size, size));
    return 0;
}
