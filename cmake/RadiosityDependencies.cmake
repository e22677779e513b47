# The libraries, all from Debian. Shared with the installed package's configuration, so that both find the same.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(Spectra 1.0 REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(embree 3 REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(assimp REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenBLAS REQUIRED)

# Debian's OpenImageIO target names an include folder that does not exist (/usr/include/opencv4); its headers
# are in /usr/include.
if(TARGET OpenImageIO::OpenImageIO)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "")
endif()

# OpenBLAS and LAPACKE under one name.
if(NOT TARGET radiosity_external::lapacke)
  add_library(radiosity_external::lapacke INTERFACE IMPORTED)
  target_link_libraries(radiosity_external::lapacke INTERFACE lapacke openblas)
  target_include_directories(radiosity_external::lapacke SYSTEM INTERFACE ${OpenBLAS_INCLUDE_DIRS})
endif()

# OpenGL's and EGL's functions, which libepoxy finds when the program runs: no driver is needed to build or to start.
if(NOT TARGET radiosity_external::epoxy)
  find_library(RADIOSITY_EPOXY_LIBRARY epoxy REQUIRED)
  find_path(RADIOSITY_EPOXY_INCLUDE epoxy/gl.h REQUIRED)
  add_library(radiosity_external::epoxy INTERFACE IMPORTED)
  target_link_libraries(radiosity_external::epoxy INTERFACE ${RADIOSITY_EPOXY_LIBRARY})
  target_include_directories(radiosity_external::epoxy SYSTEM INTERFACE ${RADIOSITY_EPOXY_INCLUDE})
endif()
