# From GLSL to C: compile, decorate and deflate (tools/spirv_exact), validate, embed.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# glint_kernel(OUT NAME SOURCE.comp DEFINE...): compiles SOURCE, which sees shaders/, with the macros given, and appends the C
# file that defines the struct kernel `kernel_NAME` to the list OUT. If MAY_FUSE is one of the macros, the
# operations stay undecorated; if FETCH_TEXELS is, functions take by value what they only read.
function(glint_kernel out name source)
  set(base ${CMAKE_CURRENT_BINARY_DIR}/${name})
  set(wishes)
  if(MAY_FUSE IN_LIST ARGN)
    set(wishes plain)
  endif()
  if(FETCH_TEXELS IN_LIST ARGN)
    list(APPEND wishes values)
  endif()
  list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE defines)
  add_custom_command(
    OUTPUT ${base}.c
    DEPFILE ${base}.d
    DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source} spirv_exact
    COMMAND ${GLSLANG_VALIDATOR} --quiet -g0 --target-env vulkan1.1 -S comp -I${CMAKE_SOURCE_DIR}/shaders ${defines}
            --depfile ${base}.d -o ${base}.plain.spv ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    COMMAND ${CMAKE_COMMAND} -DDEPFILE=${base}.d -DTARGET=${base}.c
            -P ${CMAKE_SOURCE_DIR}/cmake/retarget_depfile.cmake
    COMMAND spirv_exact ${base}.plain.spv ${base}.spv ${base}.c kernel_${name} ${wishes}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${base}.spv
    COMMENT "Compiling kernel ${name}"
    VERBATIM)
  set(${out} ${${out}} ${base}.c PARENT_SCOPE)
endfunction()

# glint_kernel_pair(PREFIX NAME SOURCE.comp DEFINE...): the kernel once for devices that fetch texels and once for
# those that read storage buffers. Appends to the lists PREFIX_SOURCES and PREFIX_NAMES.
macro(glint_kernel_pair prefix name source)
  glint_kernel(${prefix}_SOURCES ${name}_texels ${source} FETCH_TEXELS ${ARGN})
  glint_kernel(${prefix}_SOURCES ${name}_storage ${source} ${ARGN})
  list(APPEND ${prefix}_NAMES ${name}_texels ${name}_storage)
endmacro()
