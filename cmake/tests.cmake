# How a test is added. Every test runs under tests/limited.c: a process of it may take SECONDS of processor time,
# so that a loop without end is ended and a busy machine breaks nothing; what all of them took is kept in
# tests/processor_time.txt of the build folder. The time limit of ctest is only for what waits for ever: ten times what the longest
# take on two busy cores, and short enough that CI, which is stopped at 90 minutes, says which test it was.

# What the tests labelled `quick` run: `cmake --build build/dev --target quick && ctest --test-dir build/dev -L quick`.
add_custom_target(quick)
# Adds the programs of a command: targets, by their name or as $<TARGET_FILE:name>.
function(glint_quick)
  foreach(argument limited ${ARGN})
    string(REGEX REPLACE "^\\$<TARGET_FILE:(.*)>$" "\\1" program "${argument}")
    if(TARGET ${program})
      add_dependencies(quick ${program})
    endif()
  endforeach()
endfunction()

# glint_test(NAME [SECONDS n] [COST n] [RELEASE | WHOLE | BOTH] [QUICK] [IN folder] [ENVIRONMENT name=value ...] COMMAND ...)
#   SECONDS   of processor time that a process may take; 3600, ten times what the longest takes
#   COST      seconds of processor time that it takes where that is more than 5: the longest start first
#   RELEASE   only for a build without sanitizers, where ./check runs it: what is heavy and not about memory
#   WHOLE     the same, only in ./check --whole: what takes long because it tries all, where smaller tests try some
#   BOTH      ./check runs it in either build: the command is a smaller one with sanitizers
#   QUICK     has the label `quick`: what a change of the language can break, without a picture
# A command that ends with 77 cannot run here and is skipped.
function(glint_test name)
  cmake_parse_arguments(T "RELEASE;WHOLE;BOTH;QUICK" "SECONDS;COST;IN" "ENVIRONMENT;COMMAND" ${ARGN})
  if((T_RELEASE OR T_WHOLE) AND GLINT_SANITIZE)
    return()
  endif()
  if(NOT T_SECONDS)
    set(T_SECONDS 3600)
  endif()
  set(folder)
  if(T_IN)
    set(folder WORKING_DIRECTORY ${T_IN})
  endif()
  list(POP_FRONT T_COMMAND program)
  if(TARGET ${program})
    add_dependencies(${program} limited)
    set(program $<TARGET_FILE:${program}>)
  endif()
  add_test(NAME ${name} ${folder}
           COMMAND limited ${T_SECONDS} ${CMAKE_BINARY_DIR}/tests/processor_time.txt ${name} ${program} ${T_COMMAND})
  set(waits 900)
  if(T_COST GREATER 5)
    set(waits 2700)
  endif()
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT ${waits})
  if(T_COST)
    set_tests_properties(${name} PROPERTIES COST ${T_COST})
  endif()
  # Whether the sources are in a git work tree must not decide what a scene of a test may read.
  set_tests_properties(${name} PROPERTIES ENVIRONMENT
                       "GIT_CEILING_DIRECTORIES=${CMAKE_SOURCE_DIR}:${CMAKE_BINARY_DIR};${T_ENVIRONMENT}")
  if(T_RELEASE OR (T_BOTH AND NOT GLINT_SANITIZE))
    set_property(TEST ${name} APPEND PROPERTY LABELS release)
  endif()
  if(T_WHOLE)
    set_property(TEST ${name} APPEND PROPERTY LABELS whole)
  endif()
  if(T_QUICK)
    set_property(TEST ${name} APPEND PROPERTY LABELS quick)
    glint_quick(${program} ${T_COMMAND})
  endif()
endfunction()

# glint_scene_tests(NAME [COST n] SCENES scene... COMMAND program...): a test NAME/SCENE for each scene, which is the
# last argument. With sanitizers three scenes do, since no other takes another way through memory; ./check takes
# them all in the release build.
function(glint_scene_tests name)
  cmake_parse_arguments(T "" "COST" "SCENES;COMMAND" ${ARGN})
  set(options BOTH)
  if(T_COST)
    list(APPEND options COST ${T_COST})
  endif()
  if(GLINT_SANITIZE)
    list(FILTER T_SCENES INCLUDE REGEX "/(background_image|models|refraction)[.]")
  endif()
  foreach(scene ${T_SCENES})
    get_filename_component(stem ${scene} NAME_WE)
    glint_test(${name}/${stem} ${options} IN ${CMAKE_SOURCE_DIR} COMMAND ${T_COMMAND} ${scene})
  endforeach()
endfunction()
