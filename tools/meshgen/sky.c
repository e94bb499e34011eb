#include "tools/meshgen/generators.h"
#include <stdlib.h>
unsigned char *sky_generate(int width, int height) {
    return calloc((size_t)width * (size_t)height, 3);
}
