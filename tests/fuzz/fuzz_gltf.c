// libFuzzer entry: any bytes as a glTF file: GLB where they begin so, else JSON and, behind the first NUL
// byte, the file own.mtl, which a buffer or an image may name.
#include "fuzz_mesh.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const str all = {(const char *)data, size};
    if (str_starts_with(all, STR("glTF"))) {
        fuzz_mesh("/mesh.glb", all, STR(""));
        return 0;
    }
    const char *nul = size ? memchr(all.ptr, 0, size) : NULL;
    const size_t cut = nul ? (size_t)(nul - all.ptr) : size;
    fuzz_mesh("/mesh.gltf", str_slice(all, 0, cut), str_slice(all, nul ? cut + 1 : size, size));
    return 0;
}
