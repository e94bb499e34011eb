// For a module that draws by WebGPU: JavaScript gets main() by its table entry, whatever the linker calls it,
// to run it where it can be suspended (gpu/library.js).
extern void gpuweb_take_main(int (*run)(int, char **));
extern int main(int, char **);

__attribute__((constructor)) static void give_main(void) {
    gpuweb_take_main(main);
}
