# Options and helpers that every folder uses.

set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

# Where ccache is installed, a tree that was built before is built again in a minute.
find_program(GLINT_CCACHE ccache)
if(GLINT_CCACHE AND NOT CMAKE_C_COMPILER_LAUNCHER AND NOT EMSCRIPTEN)
  set(CMAKE_C_COMPILER_LAUNCHER ${GLINT_CCACHE})
endif()

option(GLINT_WERROR "Treat warnings as errors" OFF)
option(GLINT_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(GLINT_DEVICE "Draw on devices; without it glint checks, and draws by the reference, and needs neither Vulkan nor glslang" ON)
option(GLINT_WEBGPU "In a page: draw by WebGPU, without Vulkan; by emscripten, and not with GLINT_DEVICE" OFF)
# Known at compile time, so that a linker that looks into functions leaves out what only devices reach.
add_compile_definitions(CLI_HAS_DEVICES=$<OR:$<BOOL:${GLINT_DEVICE}>,$<BOOL:${GLINT_WEBGPU}>>)
# Reports link to docs/codes.md below it. There is no copy of glint that all know: whoever publishes one names it here.
set(GLINT_HOME "https://example.com/glint" CACHE STRING "Address of this copy of glint, for links in reports; empty: no links")
option(GLINT_FUZZ "Build the libFuzzer targets (clang only)" OFF)

option(GLINT_STATIC "Link everything into the program, libc too" OFF)
if(GLINT_STATIC)
  set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  add_link_options(-static-pie)
endif()

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes
                    -Wpointer-arith -Wwrite-strings -Wformat=2
                    -Werror=switch) # a switch without default lists what a new enumerator lacks
# What is released names no folder of the machine that built it, and two folders build the same bytes.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  add_compile_options(-ffile-prefix-map=${CMAKE_BINARY_DIR}/= -ffile-prefix-map=${CMAKE_SOURCE_DIR}/=)
  # C has no exceptions: tables to unwind the stack by are 0.23 MB for debuggers, which -g gives tables of their own.
  add_compile_options(-fno-asynchronous-unwind-tables)
endif()
# The numbers of a picture must not depend on what the C compiler fuses.
add_compile_options(-ffp-contract=off)
add_compile_definitions(_POSIX_C_SOURCE=200809L _DEFAULT_SOURCE _FILE_OFFSET_BITS=64)
if(GLINT_WERROR)
  add_compile_options(-Werror)
endif()
if(GLINT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Overruns of arena allocations must show: each is a block of its own, or, where speed counts, has poisoned
  # bytes after it.
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

# ---- rooms: cmake/rooms.txt says who may include whom

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/rooms.txt)
file(STRINGS ${CMAKE_SOURCE_DIR}/cmake/rooms.txt ROOM_LINES REGEX "^[a-z]")
set(ROOMS)
foreach(line ${ROOM_LINES})
  string(REGEX MATCH "^([^:]+):(.*)$" line "${line}")
  set(room ${CMAKE_MATCH_1})
  separate_arguments(MAY_${room} UNIX_COMMAND "${CMAKE_MATCH_2}")
  if(NOT room STREQUAL core)
    list(PREPEND MAY_${room} core) # which all may include
  endif()
  list(APPEND ROOMS ${room})
endforeach()

# A folder inside a room belongs to it, unless it is a room itself. Takes the files of those out of the list.
function(glint_outside_rooms out room)
  set(files ${${out}})
  foreach(other ${ROOMS})
    if(other MATCHES "^${room}/")
      list(FILTER files EXCLUDE REGEX "^${other}/")
    endif()
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# Each room has an include folder of its own in the build tree, which holds links to its headers and nothing
# else, so that `#include "parser/tree/tree.h"` compiles only where the table allows it. A room that has rooms
# inside is linked header by header, as are the tables in .def files that headers and sources include.
foreach(room ${ROOMS})
  set(inside ${ROOMS})
  list(FILTER inside INCLUDE REGEX "^${room}/")
  set(folder ${CMAKE_BINARY_DIR}/include/${room}/at)
  get_filename_component(parent ${folder}/${room} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  # The other way around, the folder that held the links takes the place of the link.
  if(NOT inside AND IS_DIRECTORY ${folder}/${room} AND NOT IS_SYMLINK ${folder}/${room})
    file(REMOVE_RECURSE ${folder}/${room})
  endif()
  if(NOT inside)
    file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${room} ${folder}/${room} SYMBOLIC)
    continue()
  endif()
  # A build tree may be older than the rooms inside: through its link to the folder, links to the headers would
  # take the place of the headers.
  if(IS_SYMLINK ${folder}/${room})
    file(REMOVE ${folder}/${room})
  endif()
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/${room}/*.h
       ${CMAKE_SOURCE_DIR}/${room}/*.def)
  glint_outside_rooms(headers ${room})
  foreach(header ${headers})
    get_filename_component(parent ${folder}/${header} DIRECTORY)
    file(MAKE_DIRECTORY ${parent})
    file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${header} ${folder}/${header} SYMBOLIC)
  endforeach()
endforeach()

# What a room's files see: what it may include, and what that includes in turn.
function(glint_room_closure out room)
  set(seen)
  set(next ${room})
  while(next)
    list(POP_FRONT next one)
    if(NOT one IN_LIST seen)
      list(APPEND seen ${one})
      list(APPEND next ${MAY_${one}})
    endif()
  endwhile()
  set(${out} ${seen} PARENT_SCOPE)
endfunction()

function(glint_room_includes target room)
  glint_room_closure(seen ${room})
  foreach(one ${seen})
    if(one MATCHES "\\.h$") # a single header of a room
      set(folder ${CMAKE_BINARY_DIR}/include/single/${one})
      get_filename_component(parent ${folder}/${one} DIRECTORY)
      file(MAKE_DIRECTORY ${parent})
      file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${one} ${folder}/${one} SYMBOLIC)
      target_include_directories(${target} PRIVATE ${folder})
    else()
      target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/include/${one}/at)
    endif()
  endforeach()
endfunction()

# glint_room([FAST|SMALL] [EXCEPT file.c ...] [SOURCES generated.c ...] [LIBS external ...]): the library of the room in this
# folder: `glint_` and its path with underscores. It holds every C file of the folder, and of folders inside that are
# no rooms, except those of the names after EXCEPT. FAST: where time is spent, a tenth of it is worth more text.
# SMALL: what runs once for a command line or a key that is pressed.
function(glint_room)
  cmake_parse_arguments(R "FAST;SMALL" "" "EXCEPT;SOURCES;LIBS" ${ARGN})
  file(RELATIVE_PATH room ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE "/" "_" name glint_${room})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*.c)
  glint_outside_rooms(sources ${room})
  foreach(left_out ${R_EXCEPT})
    list(FILTER sources EXCLUDE REGEX "/${left_out}$")
  endforeach()
  list(TRANSFORM sources PREPEND ${CMAKE_SOURCE_DIR}/)
  set(libs ${MAY_${room}})
  list(FILTER libs EXCLUDE REGEX "\\.h$")
  list(TRANSFORM libs REPLACE "/" "_")
  list(TRANSFORM libs PREPEND "glint_")
  if(NOT sources AND NOT R_SOURCES)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${libs} ${R_LIBS})
    return()
  endif()
  add_library(${name} STATIC ${sources} ${R_SOURCES})
  glint_room_includes(${name} ${room})
  if(R_FAST AND NOT EMSCRIPTEN)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O3>)
  endif()
  if(R_SMALL AND NOT EMSCRIPTEN)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-Os>)
  endif()
  target_link_libraries(${name} PUBLIC ${libs} ${R_LIBS})
endfunction()

# For tests, benches and tools, which may include everything.
function(glint_include_all target)
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR})
endfunction()

# glint_embed(OUT NAME FILE): a C file, whose path OUT is set to, that defines `const char NAME[]`, the bytes of FILE and a
# zero after them.
function(glint_embed out name file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "(................................................................................)" "\\1\n    "
         bytes "${bytes}")
  set(made ${CMAKE_CURRENT_BINARY_DIR}/${name}.c)
  file(CONFIGURE OUTPUT ${made} CONTENT "extern const char ${name}[];\nconst char ${name}[] = {\n    @bytes@0};\n" @ONLY)
  set(${out} ${made} PARENT_SCOPE)
endfunction()
