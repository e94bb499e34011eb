# cmake --install: the program, its man pages and completions, schemas, what hooks and pipelines need, documents,
# licences, and the scenes of the tutorial. The program looks for none of them, so that the folder can be moved.
include(GNUInstallDirs)
set(GLINT_PACKAGE glint)
if(NOT GLINT_DEVICE)
  set(GLINT_PACKAGE glint-check)
endif()
set(GLINT_ZSH_DIR ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Where zsh looks for completions")
set(documents ${CMAKE_INSTALL_DATADIR}/doc/${GLINT_PACKAGE})

install(TARGETS glint RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES README.md CONTRIBUTING.md CHANGELOG.md DESTINATION ${documents})
install(DIRECTORY docs/ DESTINATION ${documents}/docs PATTERN "schema" EXCLUDE)
install(DIRECTORY scenes/tutorial DESTINATION ${documents}/examples)
install(DIRECTORY docs/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/glint)
install(DIRECTORY tools/ci DESTINATION ${CMAKE_INSTALL_DATADIR}/glint)
install(FILES .pre-commit-hooks.yaml DESTINATION ${CMAKE_INSTALL_DATADIR}/glint/hooks RENAME pre-commit-hooks.yaml)
# What the program itself writes.
install(CODE "
  set(SOURCE \"${CMAKE_SOURCE_DIR}\")
  set(PROGRAM \"${CMAKE_BINARY_DIR}/glint\")
  set(PREFIX \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
  set(MANUALS ${CMAKE_INSTALL_MANDIR}/man1)
  set(BASH ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  set(ZSH ${GLINT_ZSH_DIR})
  set(FISH ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  set(DOCUMENTS ${documents})
  include(\"${CMAKE_SOURCE_DIR}/packaging/install_written.cmake\")")
