# The OpenCV modules used here, and imgcodecs for tests (OpenCVImage::Codecs): it brings a hundred
# libraries, which take longer to load than a small scan to read. A full OpenCV brings a CMake
# config; Debian's separate packages do not, so headers and libraries are then looked up directly.
find_package(OpenCV CONFIG QUIET COMPONENTS core imgproc OPTIONAL_COMPONENTS imgcodecs)
if(OpenCV_FOUND)
  set(OpenCVImage_INCLUDE_DIR ${OpenCV_INCLUDE_DIRS})
  set(OpenCVImage_LIBRARIES opencv_core opencv_imgproc)
  set(OpenCVImage_imgcodecs_LIBRARY opencv_imgcodecs)
else()
  find_path(OpenCVImage_INCLUDE_DIR opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
  foreach(module core imgproc imgcodecs)
    find_library(OpenCVImage_${module}_LIBRARY opencv_${module})
  endforeach()
  set(OpenCVImage_LIBRARIES ${OpenCVImage_core_LIBRARY} ${OpenCVImage_imgproc_LIBRARY})
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVImage REQUIRED_VARS OpenCVImage_LIBRARIES
                                  OpenCVImage_INCLUDE_DIR)
if(OpenCVImage_FOUND AND NOT TARGET OpenCVImage::OpenCVImage)
  add_library(OpenCVImage::OpenCVImage INTERFACE IMPORTED)
  target_include_directories(OpenCVImage::OpenCVImage SYSTEM INTERFACE "${OpenCVImage_INCLUDE_DIR}")
  target_link_libraries(OpenCVImage::OpenCVImage INTERFACE ${OpenCVImage_LIBRARIES})
  add_library(OpenCVImage::Codecs INTERFACE IMPORTED)
  target_link_libraries(OpenCVImage::Codecs
    INTERFACE OpenCVImage::OpenCVImage ${OpenCVImage_imgcodecs_LIBRARY})
endif()
