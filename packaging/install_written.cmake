# Installs what the built program writes (man pages, completions), and documents in the form in which Debian wants them.
# Of install.cmake: SOURCE, PROGRAM, PREFIX, and the folders MANUALS, BASH, ZSH, FISH and DOCUMENTS below PREFIX.

function(write folder name)
  file(MAKE_DIRECTORY ${PREFIX}/${folder})
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${PREFIX}/${folder}/${name} COMMAND_ERROR_IS_FATAL ANY)
  message(STATUS "Installing: ${PREFIX}/${folder}/${name}")
endfunction()

# Without name and time in it.
function(compress file)
  execute_process(COMMAND gzip -9nf ${PREFIX}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

write(${BASH} glint manual bash)
write(${ZSH} _glint manual zsh)
write(${FISH} glint.fish manual fish)

write(${MANUALS} glint.1 manual page)
file(STRINGS ${PREFIX}/${MANUALS}/glint.1 commands REGEX "^\\.BR glint\\\\-[a-z]+ \\(1\\)$")
list(TRANSFORM commands REPLACE "^\\.BR glint\\\\-([a-z]+) .*" "\\1")
list(REMOVE_DUPLICATES commands)
compress(${MANUALS}/glint.1)
foreach(command ${commands})
  write(${MANUALS} glint-${command}.1 manual page ${command})
  compress(${MANUALS}/glint-${command}.1)
endforeach()

file(READ ${SOURCE}/LICENSE licence)
string(REGEX REPLACE "^[^\n]*\n\n(Copyright [^\n]*)\n\n" "" terms "${licence}")
set(holder ${CMAKE_MATCH_1})
string(STRIP "${terms}" terms)
string(REPLACE "\n\n" "\n.\n" terms "${terms}")
string(REPLACE "\n" "\n " terms "${terms}")
string(REGEX REPLACE "^Copyright \\(c\\) " "" holder "${holder}")
file(WRITE ${PREFIX}/${DOCUMENTS}/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: glint

Files: *
Copyright: ${holder}
License: Expat

License: Expat
 ${terms}
")
# What a Debian package says of itself, where one is made; ours is CHANGELOG.md.
if(NOT "$ENV{SOURCE_DATE_EPOCH}" STREQUAL "")
  file(STRINGS ${SOURCE}/VERSION version LIMIT_COUNT 1)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  get_filename_component(package ${DOCUMENTS} NAME)
  file(WRITE ${PREFIX}/${DOCUMENTS}/changelog
"${package} (${version}) unstable; urgency=medium

  * CHANGELOG.md says what is new.

 -- the glint authors <glint@example.com>  ${date}
")
  compress(${DOCUMENTS}/changelog)
endif()
