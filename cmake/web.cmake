# A toolchain for WebAssembly: Debian's emscripten with the libraries that tools/web.sh has built into a folder.
# Usage: [GLINT_WEB=FOLDER] cmake --preset web; the folder is build/web-root if none is named.
if(NOT DEFINED ENV{GLINT_WEB})
  get_filename_component(default ${CMAKE_CURRENT_LIST_DIR}/../build/web-root ABSOLUTE)
  set(GLINT_WEB ${default} CACHE PATH "What tools/web.sh has made")
  set(ENV{GLINT_WEB} ${GLINT_WEB}) # for the programs that CMake tries
else()
  set(GLINT_WEB $ENV{GLINT_WEB} CACHE PATH "What tools/web.sh has made")
endif()
if(NOT EXISTS "${GLINT_WEB}/root/lib/libyaml.a")
  message(FATAL_ERROR "GLINT_WEB must name the folder that tools/web.sh has made; '${GLINT_WEB}' is none")
endif()
get_filename_component(root ${GLINT_WEB}/root REALPATH)
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_FIND_ROOT_PATH ${root} ${CMAKE_FIND_ROOT_PATH})
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_PREFIX_PATH ${root})
set(PKG_CONFIG_EXECUTABLE /usr/bin/pkg-config)
set(ENV{PKG_CONFIG_LIBDIR} ${root}/lib/pkgconfig)
set(ENV{PKG_CONFIG_PATH} ${root}/lib/pkgconfig)
# Where Debian keeps what emscripten needs of node, of whichever package node itself is.
set(CMAKE_C_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs)
