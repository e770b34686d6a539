include(${CMAKE_CURRENT_LIST_DIR}/KoshiDependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/koshiTargets.cmake)
