// Sanitizer builds only: libraries stay loaded to the end of the program.
//
// The Vulkan loader closes its drivers with the last instance; to LeakSanitizer, what a driver's globals held
// then looks like a leak of this program, without a name to suppress it by.
int dlclose(void *handle);

int dlclose(void *handle) {
    (void)handle;
    return 0;
}
