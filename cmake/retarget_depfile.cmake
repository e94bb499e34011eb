# glslangValidator writes the name of its own output as the target of a depfile; the build system knows
# the step by the C file that it makes last. Usage: cmake -DDEPFILE=F -DTARGET=T -P retarget_depfile.cmake
file(READ ${DEPFILE} text)
string(REGEX REPLACE "^[^:]*:" "${TARGET}:" text "${text}")
file(WRITE ${DEPFILE} "${text}")
