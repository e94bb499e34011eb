# Fails where a committed file differs from what the generator makes of it now.
execute_process(COMMAND ${PROGRAM} ${PRODUCT} ${MADE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${MADE} ${COMMITTED} RESULT_VARIABLE differs)
if(differs)
  message(FATAL_ERROR "${COMMITTED} is old: make it again with `glint-meshgen ${PRODUCT} ${COMMITTED}`")
endif()
