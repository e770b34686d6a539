# What `cmake --install` and `cpack -G DEB` put where.
include(CMakePackageConfigHelpers)
set(KOSHI_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/koshi)

install(TARGETS koshi EXPORT koshiTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS koshi_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/koshi TYPE INCLUDE)
install(FILES README.md README.ja.md LICENSE CITATION.cff CHANGELOG.md TYPE DOC)
install(FILES LICENSE TYPE DOC RENAME copyright)
install(DIRECTORY examples TYPE DOC PATTERN __pycache__ EXCLUDE)

# Man page, from the program's own help, and completion.
install(FILES apps/koshi/koshi.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME koshi)
find_program(HELP2MAN help2man)
if(HELP2MAN)
  set(page ${PROJECT_BINARY_DIR}/koshi.1.gz)
  add_custom_command(OUTPUT ${page}
    COMMAND ${PROJECT_SOURCE_DIR}/scripts/man_page.sh $<TARGET_FILE:koshi_app> | gzip -9n > ${page}
    DEPENDS koshi_app scripts/man_page.sh COMMENT "Making the man page" VERBATIM)
  add_custom_target(koshi_man ALL DEPENDS ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# find_package(koshi) gives koshi::koshi and finds the libraries behind it.
install(EXPORT koshiTargets NAMESPACE koshi:: DESTINATION ${KOSHI_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/koshiConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/koshiConfig.cmake cmake/KoshiDependencies.cmake ${PROJECT_BINARY_DIR}/koshiConfigVersion.cmake
  DESTINATION ${KOSHI_CMAKE_DIR})

# The Debian package; its dependencies are read off the program (dpkg-shlibdeps), but for what it starts or offers.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Koshi developers <koshi@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "From Young's modulus, Poisson's ratio and a body of cubic cells Koshi makes springs
between the cells' corners, and solves for motion by explicit steps or for
equilibrium by multigrid, on any number of ranks. The package holds the
program, the static library with its headers, and the Python module.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "libopenmpi-dev, petsc-dev, libvtk9-dev, libhdf5-openmpi-dev, zlib1g-dev, libeigen3-dev, libtomlplusplus-dev, libudunits2-dev, libmuparser-dev, libfmt-dev, nlohmann-json3-dev, pkg-config, cmake")
include(CPack)
