# Options and helpers that every folder uses.

set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

option(GLINT_WERROR "Treat warnings as errors" OFF)
option(GLINT_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(GLINT_FUZZ "Build the libFuzzer targets (clang only)" OFF)

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes
                    -Wpointer-arith -Wwrite-strings -Wformat=2)
# The numbers of a picture must not depend on what the C compiler fuses.
add_compile_options(-ffp-contract=off)
add_compile_definitions(_POSIX_C_SOURCE=200809L _DEFAULT_SOURCE _FILE_OFFSET_BITS=64)
if(GLINT_WERROR)
  add_compile_options(-Werror)
endif()
if(GLINT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Overruns of arena allocations are to be seen: each is a block of its own, or, where speed counts, has
  # poisoned bytes behind it.
  if(GLINT_FUZZ)
    add_compile_definitions(GLINT_ARENA_REDZONES=1)
  else()
    add_compile_definitions(GLINT_ARENA_EXACT=1)
  endif()
endif()

if(GLINT_FUZZ)
  # All code reports its coverage; the targets that fuzz link libFuzzer itself.
  # Compared values are not reported, which would halve the speed: the dictionary knows the words.
  add_compile_options(-fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp)
endif()

# glint_include_paths(TARGET FOLDER...): the folders whose headers TARGET may include, and no others.
# A folder of links stands in for the source root, so that `#include "parser/tree.h"` compiles only
# where the architecture allows it.
function(glint_include_paths target)
  set(root ${CMAKE_BINARY_DIR}/include/${target})
  file(MAKE_DIRECTORY ${root})
  foreach(folder ${ARGN})
    get_filename_component(parent ${root}/${folder} DIRECTORY)
    file(MAKE_DIRECTORY ${parent})
    if(NOT EXISTS ${root}/${folder})
      file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${folder} ${root}/${folder} SYMBOLIC)
    endif()
  endforeach()
  target_include_directories(${target} PRIVATE ${root})
endfunction()

# glint_library(NAME SOURCES a.c b.c FOLDERS core grammar LIBS glint_core ...)
# A static library `glint_NAME` that may include the headers of FOLDERS alone.
function(glint_library name)
  cmake_parse_arguments(L "" "" "SOURCES;FOLDERS;LIBS" ${ARGN})
  add_library(glint_${name} STATIC ${L_SOURCES})
  glint_include_paths(glint_${name} ${L_FOLDERS})
  target_link_libraries(glint_${name} PUBLIC ${L_LIBS})
endfunction()
