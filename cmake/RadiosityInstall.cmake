include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/radiosity)
install(EXPORT radiosity NAMESPACE radiosity:: DESTINATION ${config_dir} FILE RadiosityTargets.cmake)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/radiosityConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/radiosityConfig.cmake ${CMAKE_BINARY_DIR}/radiosityConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/RadiosityDependencies.cmake DESTINATION ${config_dir})
file(RELATIVE_PATH to_libraries "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
set_target_properties(radiosity PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}/radiosity")  # its modules
install(TARGETS radiosity RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
