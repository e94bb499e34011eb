# Writes what the sources say of themselves as C: cmake -DSOURCE=FOLDER -DOUT=FILE.c -P about.cmake
# The commit is GLINT_COMMIT of the environment, else git's; the day that of SOURCE_DATE_EPOCH, else of the commit.
set(commit "$ENV{GLINT_COMMIT}")
set(date "")
find_program(GIT git)
if(commit STREQUAL "" AND GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty=+ --exclude * --abbrev=12
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT} -C ${SOURCE} log -1 --format=%cd --date=format:%Y-%m-%d
                  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT "$ENV{SOURCE_DATE_EPOCH}" STREQUAL "")
  string(TIMESTAMP date "%Y-%m-%d" UTC) # which is that of SOURCE_DATE_EPOCH
endif()
set(text "#include \"cli/about/about.h\"\n
const char about_commit[] = \"${commit}\";\nconst char about_date[] = \"${date}\";\n")
set(now "")
if(EXISTS ${OUT})
  file(READ ${OUT} now)
endif()
if(NOT now STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
