# From GLSL to C: compile, decorate (tools/spirv_exact), validate; pack all that a library has together, and embed.
if(GLINT_DEVICE)
  find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
  find_program(SPIRV_OPT spirv-opt REQUIRED)
  find_program(SPIRV_VAL spirv-val REQUIRED)
endif()

# glint_kernel(PREFIX NAME SOURCE.comp DEFINE...): compiles SOURCE, which sees shaders/, with the macros given. Appends
# to the lists PREFIX_NAMES and PREFIX_MODULES. If MAY_FUSE is one of the macros, the operations stay undecorated; if
# FETCH_TEXELS is, functions take by value what they only read.
function(glint_kernel prefix name source)
  if(NOT GLINT_DEVICE)
    set(${prefix}_NAMES ${${prefix}_NAMES} ${name} PARENT_SCOPE)
    return()
  endif()
  set(base ${CMAKE_CURRENT_BINARY_DIR}/${name})
  set(plain)
  set(fuses exact)
  set(values ${CMAKE_COMMAND} -E true)
  set(lean ${base}.plain.spv)
  if(FETCH_TEXELS IN_LIST ARGN)
    set(lean ${base}.values.spv)
    set(values spirv_values ${base}.plain.spv ${lean})
  endif()
  if(MAY_FUSE IN_LIST ARGN)
    set(plain plain)
    set(fuses plain)
  endif()
  list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE defines)
  # Ids that count up in the order in which they appear are what pack_kernels needs; spirv-opt changes nothing else.
  add_custom_command(
    OUTPUT ${base}.packed.spv
    BYPRODUCTS ${base}.spv
    DEPFILE ${base}.d
    DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source} spirv_exact spirv_values
    COMMAND ${GLSLANG_VALIDATOR} --quiet -g0 --target-env vulkan1.1 -S comp -I${CMAKE_SOURCE_DIR}/shaders ${defines}
            --depfile ${base}.d -o ${base}.plain.spv ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    COMMAND ${CMAKE_COMMAND} -DDEPFILE=${base}.d -DTARGET=${base}.packed.spv
            -P ${CMAKE_SOURCE_DIR}/cmake/retarget_depfile.cmake
    COMMAND ${values}
    COMMAND ${SPIRV_OPT} --target-env=vulkan1.1 --preserve-bindings --compact-ids ${lean} -o ${base}.packed.spv
    COMMAND spirv_exact ${base}.packed.spv ${base}.spv ${plain}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${base}.spv
    COMMENT "Compiling kernel ${name}"
    VERBATIM)
  set(${prefix}_NAMES ${${prefix}_NAMES} ${name} PARENT_SCOPE)
  set(${prefix}_MODULES ${${prefix}_MODULES} ${name} ${fuses} ${base}.packed.spv PARENT_SCOPE)
endfunction()

# glint_kernel_pair(PREFIX NAME SOURCE.comp DEFINE...): the kernel once for devices that fetch texels and once for
# those that read storage buffers.
macro(glint_kernel_pair prefix name source)
  glint_kernel(${prefix} ${name}_texels ${source} FETCH_TEXELS ${ARGN})
  glint_kernel(${prefix} ${name}_storage ${source} ${ARGN})
endmacro()

# glint_pack_kernels(PREFIX): what was appended to PREFIX_MODULES, as a C file that defines the struct kernel
# `kernel_NAME` of each; without devices, all of them empty. Sets PREFIX_SOURCES.
function(glint_pack_kernels prefix)
  if(NOT GLINT_DEVICE)
    list(TRANSFORM ${prefix}_NAMES PREPEND "kernel_" OUTPUT_VARIABLE empty)
    list(JOIN empty ",\n    " empty)
    file(CONFIGURE OUTPUT kernels.c CONTENT "#include \"shaders/kernel.h\"\n\nconst struct kernel @empty@;\n" @ONLY)
    set(${prefix}_SOURCES ${CMAKE_CURRENT_BINARY_DIR}/kernels.c PARENT_SCOPE)
    return()
  endif()
  set(modules ${${prefix}_MODULES})
  list(FILTER modules INCLUDE REGEX "\\.spv$")
  set(packed ${CMAKE_CURRENT_BINARY_DIR}/kernels.c)
  add_custom_command(
    OUTPUT ${packed}
    DEPENDS ${modules} pack_kernels
    COMMAND pack_kernels ${packed} ${${prefix}_MODULES}
    COMMENT "Packing kernels"
    VERBATIM)
  set(${prefix}_SOURCES ${packed} PARENT_SCOPE)
endfunction()
