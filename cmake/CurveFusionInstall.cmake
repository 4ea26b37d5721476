include(CMakePackageConfigHelpers)
set(curvefusion_cmake_dir "${CMAKE_INSTALL_LIBDIR}/cmake/curvefusion")

install(TARGETS curvefusion_build_flags curvefusion_kernel curvefusion_capture curvefusion_graph
                curvefusion_fusion curvefusion_meshing curvefusion_experiments
        EXPORT curvefusion ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
        COMPONENT development)
install(TARGETS curvefusion RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
install(EXPORT curvefusion NAMESPACE curvefusion:: FILE curvefusionTargets.cmake
        DESTINATION "${curvefusion_cmake_dir}" COMPONENT development)
# What users include is include/curvefusion; that includes headers of the folders, which may change.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/curvefusion"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
foreach(folder kernel capture graph fusion meshing experiments)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/curvefusion/detail" COMPONENT development
          FILES_MATCHING PATTERN "*.h")
endforeach()
configure_package_config_file(cmake/curvefusionConfig.cmake.in
  "${PROJECT_BINARY_DIR}/curvefusionConfig.cmake" INSTALL_DESTINATION "${curvefusion_cmake_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/curvefusionConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/curvefusionConfig.cmake"
              "${PROJECT_BINARY_DIR}/curvefusionConfigVersion.cmake"
              cmake/CurveFusionDependencies.cmake cmake/FindCHOLMOD.cmake
              cmake/FindOpenCVImage.cmake
        DESTINATION "${curvefusion_cmake_dir}" COMPONENT development)

# Each package brings the licence; that of the program also the documents its messages name.
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/curvefusion" RENAME copyright
        COMPONENT program)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libcurvefusion-dev" RENAME copyright
        COMPONENT development)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/python3-curvefusion" RENAME copyright
        COMPONENT python EXCLUDE_FROM_ALL)
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/curvefusion" COMPONENT program
        FILES_MATCHING PATTERN "*.md" PATTERN images EXCLUDE)
