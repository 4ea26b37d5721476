# Debian packages: `cpack` in a build with the preset "package" (./run package does all of it).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The CurveFusion maintainers <maintainers@curvefusion.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program python development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME curvefusion)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, gnuplot-nox")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "curve skeletons of wire objects from RGB-D scans\n\
 Turns a scan with a handheld depth camera into the network of curves that wires\n\
 follow, with junctions and diameters, and into a watertight mesh of tubes.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-curvefusion)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-networkx)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "curve skeletons of wire objects from RGB-D scans (Python)\n\
 The Python module curvefusion: sequences, reconstruction, skeleton graphs and meshes.")
if(TARGET curvefusion_python)
  # A module is for one version of Python.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(python_versions "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), \
python3 (<< ${Python_VERSION_MAJOR}.${next_minor})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${python_versions}, python3-numpy")
endif()

# The libraries are static: their users link what these need.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcurvefusion-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "curve skeletons of wire objects from RGB-D scans (C++ libraries)\n\
 Static libraries, headers and what find_package(curvefusion) needs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libcgal-dev, libboost-graph-dev, libdxflib-dev, libeigen3-dev, libopenmesh-dev, \
libsuitesparse-dev, libtbb-dev, libopencv-core-dev, libopencv-imgproc-dev, \
libjpeg-dev, libspng-dev, zlib1g-dev, libbz2-dev, liblz4-dev, libtinygltf-dev, \
lib3mf-dev, libcli11-dev, nlohmann-json3-dev, libtomlplusplus-dev, libspdlog-dev, libfmt-dev")
include(CPack)
