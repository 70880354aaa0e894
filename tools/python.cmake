# What of the Python package swiftlet knows nothing of Python.
swiftlet_add_library(swiftlet_python
  SOURCES python/mapping_thread.cpp python/message_listener.cpp python/run_arrays.cpp
  LINK swiftlet_live swiftlet_map swiftlet_publish swiftlet_lcm_types)

if(NOT SWIFTLET_BUILDS_PYTHON)
  return()
endif()

# The package. In the build tree it lies in python/.

set(python_files __init__.py _mapping.py _messages.py _native.pyi py.typed)
set(python_dir ${PROJECT_BINARY_DIR}/python/swiftlet)
Python_add_library(swiftlet_native MODULE WITH_SOABI python/native_module.cpp)
# GCC 12 sees null pointers in pybind11's headers, where there are none.
set_source_files_properties(python/native_module.cpp PROPERTIES COMPILE_OPTIONS -Wno-null-dereference)
target_link_libraries(swiftlet_native PRIVATE
  pybind11::headers swiftlet_python swiftlet_version swiftlet_compile_options)
set_target_properties(swiftlet_native PROPERTIES OUTPUT_NAME _native LIBRARY_OUTPUT_DIRECTORY ${python_dir}
  CXX_VISIBILITY_PRESET hidden)
target_link_options(swiftlet_native PRIVATE -Wl,--exclude-libs,ALL)  # nothing of ours meets another module's names
foreach(file IN LISTS python_files)
  configure_file(python/swiftlet/${file} ${python_dir}/${file} COPYONLY)
  list(APPEND installed_files ${python_dir}/${file})
endforeach()

set(SWIFTLET_PYTHON_DIR lib/python3/dist-packages CACHE STRING
  "Where the Python package is installed, below the prefix")
install(FILES ${installed_files} DESTINATION ${SWIFTLET_PYTHON_DIR}/swiftlet COMPONENT python)
install(TARGETS swiftlet_native LIBRARY DESTINATION ${SWIFTLET_PYTHON_DIR}/swiftlet COMPONENT python)
