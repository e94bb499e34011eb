# A toolchain for 32 bits: the system's gcc with the libraries that tools/i386.sh puts into a folder, linked statically, so
# that the programs run wherever the kernel runs those of 32 bits.
# Usage: GLINT_I386=FOLDER cmake --preset check-only --toolchain cmake/i386.cmake -B BUILD
if(NOT DEFINED ENV{GLINT_I386} OR NOT EXISTS "$ENV{GLINT_I386}/root/usr/include")
  message(FATAL_ERROR "GLINT_I386 must name the folder that tools/i386.sh has made")
endif()
get_filename_component(folder $ENV{GLINT_I386} REALPATH)
set(root ${folder}/root)
set(libraries ${root}/usr/lib/i386-linux-gnu)
file(GLOB gcc ${root}/usr/lib/gcc/i686-linux-gnu/*)

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
set(CMAKE_C_COMPILER gcc)
# SSE2 computes in double precision, as everywhere else; x87 would keep more digits.
set(CMAKE_C_FLAGS_INIT "-m32 -march=i686 -msse2 -mfpmath=sse --sysroot=${root} -B${gcc} -B${libraries}")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -L${gcc} -L${libraries}")
set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
set(CMAKE_FIND_ROOT_PATH ${root})
set(CMAKE_LIBRARY_ARCHITECTURE i386-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${root})
set(ENV{PKG_CONFIG_LIBDIR} ${libraries}/pkgconfig)
