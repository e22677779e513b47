include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/radiosity)
install(EXPORT radiosity NAMESPACE radiosity:: DESTINATION ${config_dir} FILE RadiosityTargets.cmake)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/radiosityConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/radiosityConfig.cmake ${CMAKE_BINARY_DIR}/radiosityConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/RadiosityDependencies.cmake DESTINATION ${config_dir})
install(TARGETS radiosity RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
