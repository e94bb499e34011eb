# Fails where a committed mesh differs from what the generator makes of it now.
execute_process(COMMAND ${PROGRAM} ${PRODUCT} ${MADE} COMMAND_ERROR_IS_FATAL ANY)
file(READ ${MADE} made)
file(READ ${COMMITTED} committed)
if(NOT made STREQUAL committed)
  message(FATAL_ERROR "${COMMITTED} is old: make it again with `glint-meshgen ${PRODUCT} ${COMMITTED}`")
endif()
