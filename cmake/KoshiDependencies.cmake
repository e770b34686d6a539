# The libraries Koshi is made with, gathered in one target; packages.txt says why each is there. Installed beside
# koshiConfig.cmake, so that a consumer of the static library links the same set.
find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(BZip2 REQUIRED)
find_package(EXPAT REQUIRED)
find_package(TIFF REQUIRED)
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOCore IOXML)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-openmpi)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)
find_library(UDUNITS2_LIBRARY udunits2 REQUIRED)
find_path(UDUNITS2_INCLUDE udunits2.h REQUIRED)

add_library(koshi_dependencies INTERFACE IMPORTED)
target_link_libraries(koshi_dependencies INTERFACE
  Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json MPI::MPI_CXX PkgConfig::PETSC
  PkgConfig::TOMLPLUSPLUS PkgConfig::MUPARSER PkgConfig::HDF5 ZLIB::ZLIB BZip2::BZip2 EXPAT::EXPAT TIFF::TIFF ${VTK_LIBRARIES} ${UDUNITS2_LIBRARY})
target_include_directories(koshi_dependencies SYSTEM INTERFACE ${UDUNITS2_INCLUDE})
