#include "cli/words.h"

const char *const cli_purpose =
    "Renders pictures that are described in a text file: scenes in YAML or XML, Whitted ray tracing on\n"
    "any Vulkan device, including the processor.\n";
const char *const cli_exits =
    "Exit status: 0 no error; 1 errors in the scene; 2 usage; 3 a file named on the command "
    "line cannot be\n"
    "read or written, or memory ran out; 4 no usable device;\n"
    "5 refused: a path that leads out, or more than --untrusted allows;\n"
    "75 stopped, and --resume goes on; 130 or 143 interrupted;\n"
    "141 the reader of standard output is gone.\n";
