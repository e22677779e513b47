include("${CMAKE_CURRENT_LIST_DIR}/RadiosityDependencies.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/RadiosityTargets.cmake")
