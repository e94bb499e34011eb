# Packages: cpack -G DEB, cpack -G TXZ in a build folder. tools/release.sh makes all of them.
set(CPACK_PACKAGE_NAME ${GLINT_PACKAGE})
set(CPACK_PACKAGE_VENDOR "the glint authors")
set(CPACK_PACKAGE_CONTACT "the glint authors <glint@example.com>")
set(CPACK_PACKAGE_VERSION ${GLINT_VERSION})
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${GLINT_HOME})
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(scenes "Scenes are text, in YAML or XML. glint finds every mistake in them with its
line and column, writes reports for continuous integration, formats and
converts scenes, and serves editors by the Language Server Protocol.")
if(GLINT_DEVICE)
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "check and render scenes that are described in a text file
${scenes}
.
It renders pictures by Whitted ray tracing on any Vulkan device, the processor
included.")
  # The Vulkan loader is opened when it is needed; with Mesa's driver the processor is a device.
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libvulkan1, mesa-vulkan-drivers")
  set(other glint-check)
else()
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "check scenes that are described in a text file
${scenes}
.
This package draws pictures only by its reference, on the processor; the
package glint draws on Vulkan devices.")
  set(other glint)
endif()
set(CPACK_DEBIAN_PACKAGE_CONFLICTS ${other})
set(CPACK_DEBIAN_PACKAGE_REPLACES ${other})
include(CPack)
