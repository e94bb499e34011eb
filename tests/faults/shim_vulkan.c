// Calls of Vulkan, which fail as the plan says. glint opens the Vulkan loader at run time and asks it for
// every function by its name: the answers are exchanged.
#define _GNU_SOURCE

#include "faults.h"

#include <dlfcn.h>
#include <stddef.h>
#include <string.h>
#include <vulkan/vulkan_core.h>

#define EXPORTED __attribute__((visibility("default")))

// ---- the functions: the driver's behind each, and one that may fail in its place

#define CALL(name, parameters, arguments, ...)                                                               \
    static PFN_##name real_##name;                                                                           \
    static VKAPI_ATTR VkResult VKAPI_CALL try_##name parameters {                                            \
        return faults_strike(FAULTS_VULKAN, #name) ? (VkResult)faults->error : real_##name arguments;        \
    }
#include "vulkan_calls.def"

static PFN_vkVoidFunction exchange(const char *name, PFN_vkVoidFunction found) {
    if (!found)
        return NULL;
#define CALL(call, parameters, arguments, ...)                                                               \
    if (strcmp(name, #call) == 0) {                                                                          \
        real_##call = (PFN_##call)found;                                                                     \
        return (PFN_vkVoidFunction)try_##call;                                                               \
    }
#include "vulkan_calls.def"
    return found;
}

// ---- how they are found

static PFN_vkGetInstanceProcAddr of_instance;
static PFN_vkGetDeviceProcAddr of_device;

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL find_of_device(VkDevice device, const char *name) {
    return exchange(name, of_device(device, name));
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL find_of_instance(VkInstance instance, const char *name) {
    PFN_vkVoidFunction found = of_instance(instance, name);
    if (found && strcmp(name, "vkGetDeviceProcAddr") == 0) {
        of_device = (PFN_vkGetDeviceProcAddr)found;
        return (PFN_vkVoidFunction)find_of_device;
    }
    return exchange(name, found);
}

typedef void *find_symbol(void *library, const char *name);

// The system's own, which has another version on each machine.
static find_symbol *real_dlsym(void) {
    static const char *const versions[] = {"GLIBC_2.34", "GLIBC_2.17", "GLIBC_2.2.5"};
    static find_symbol *found;
    for (size_t i = 0; !found && i < sizeof versions / sizeof *versions; i++)
        found = (find_symbol *)dlvsym(RTLD_NEXT, "dlsym", versions[i]);
    return found;
}

EXPORTED void *dlsym(void *library, const char *name) {
    void *found = real_dlsym()(library, name);
    bool asked = faults && faults->kind == FAULTS_VULKAN && faults_is_program(__builtin_return_address(0));
    if (!asked || !found || strcmp(name, "vkGetInstanceProcAddr") != 0)
        return found;
    of_instance = (PFN_vkGetInstanceProcAddr)found;
    return (void *)find_of_instance;
}
