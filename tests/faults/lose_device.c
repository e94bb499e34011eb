// The device of a running glint stops answering (VK_ERROR_DEVICE_LOST), by the library of tests/faults that
// it was started with. Usage: lose_device PLAN [now], which writes a plan without a fault, or makes every
// call fail from now on.
#include "faults.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    DEVICE_LOST = -4, // VK_ERROR_DEVICE_LOST (Vulkan 1.3, VkResult)
};

int main(int argc, char **argv) {
    const bool now = argc == 3 && strcmp(argv[2], "now") == 0;
    if (argc != 2 && !now)
        return 2;
    const int file = open(argv[1], now ? O_RDWR : O_RDWR | O_CREAT | O_TRUNC, 0666);
    if (file < 0 || (!now && ftruncate(file, sizeof(struct faults)) != 0)) {
        perror(argv[1]);
        return 1;
    }
    struct faults *plan = mmap(NULL, sizeof *plan, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (plan == MAP_FAILED)
        return 1;
    if (!now) {
        *plan = (struct faults){.kind = FAULTS_VULKAN, .error = DEVICE_LOST, .onward = true};
        return 0;
    }
    plan->number = atomic_load(&plan->seen) + 1;
    return 0;
}
