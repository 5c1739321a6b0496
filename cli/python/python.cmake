# The Python package: its compiled module, and the whole package in <build>/python, for use with PYTHONPATH.
set(PULVIS_PYTHON AUTO CACHE STRING
    "Build the Python module: AUTO (where Python's headers and pybind11 are), ON or OFF")
set_property(CACHE PULVIS_PYTHON PROPERTY STRINGS AUTO ON OFF)
set(PULVIS_PYTHON_DESTINATION "lib/python3/dist-packages" CACHE STRING
    "Where the Python package is installed, from the prefix")

set(PULVIS_HAS_PYTHON OFF)
# Prefer Debian's Python, which has the modules from Debian packages, over another one on the path.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
if(NOT PULVIS_PYTHON STREQUAL "OFF" AND NOT PULVIS_PYTHON STREQUAL "0")
  if(PULVIS_PYTHON STREQUAL "AUTO")
    find_package(Python3 3.9 COMPONENTS Interpreter Development.Module QUIET)
    find_package(pybind11 2.9 CONFIG QUIET)
  else()
    find_package(Python3 3.9 COMPONENTS Interpreter Development.Module REQUIRED)
    find_package(pybind11 2.9 CONFIG REQUIRED)
  endif()
  if(Python3_Development.Module_FOUND AND pybind11_FOUND)
    set(PULVIS_HAS_PYTHON ON)
  endif()
endif()

# For libraries linked into the module. No other library replaces our functions, so calls can stay direct.
function(for_python target)
  if(PULVIS_HAS_PYTHON)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    endif()
  endif()
endfunction()

# add_python_module(LIBRARY): links the module with LIBRARY, in addition to its own sources.
function(add_python_module library)
  set(folder ${CMAKE_SOURCE_DIR}/cli/python)
  set(package ${CMAKE_BINARY_DIR}/python/pulvis)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/module/*.cpp)
  pybind11_add_module(pulvis_python NO_EXTRAS ${sources})
  file(RELATIVE_PATH core /prefix/${PULVIS_PYTHON_DESTINATION}/pulvis /prefix/${CMAKE_INSTALL_LIBDIR}/pulvis)
  set_target_properties(pulvis_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package}
                        INSTALL_RPATH "$ORIGIN/${core}")
  add_library(python_rules INTERFACE)  # linked last, so that its options come last
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # g++ 12 warns about a null pointer inside pybind11
    target_compile_options(python_rules INTERFACE -Wno-null-dereference)
  endif()
  target_link_libraries(pulvis_python PRIVATE ${library} pulvis_rules python_rules)
  # Column types are identified by addresses (engine/component.hpp), which the core library must see, too. Our
  # classes have members of hidden pybind11 types; nothing outside the module sees them.
  set_target_properties(pulvis_python PROPERTIES CXX_VISIBILITY_PRESET default)
  target_compile_options(pulvis_python PRIVATE -Wno-attributes)
  unity(pulvis_python)
  optimise(pulvis_python 2)

  # The package in the build tree consists of symbolic links: changes of Python files take effect at once.
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${folder}/pulvis ${folder}/pulvis/*.py ${folder}/pulvis/*.pyi
       ${folder}/pulvis/py.typed)
  foreach(file ${files})
    get_filename_component(below ${package}/${file} DIRECTORY)
    file(MAKE_DIRECTORY ${below})
    file(CREATE_LINK ${folder}/pulvis/${file} ${package}/${file} SYMBOLIC)
  endforeach()
  # The dataclasses of the scene language, generated from the declarations in its reader.
  add_custom_command(TARGET pulvis_python POST_BUILD VERBATIM
    COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${CMAKE_BINARY_DIR}/python PYTHONDONTWRITEBYTECODE=1
            ${Python3_EXECUTABLE} ${folder}/write_declarations.py ${package}/declarations.py)
  install(FILES ${package}/declarations.py DESTINATION ${PULVIS_PYTHON_DESTINATION}/pulvis COMPONENT python)
  install(DIRECTORY ${folder}/pulvis DESTINATION ${PULVIS_PYTHON_DESTINATION} COMPONENT package
          PATTERN __pycache__ EXCLUDE)
  install(TARGETS pulvis_python LIBRARY DESTINATION ${PULVIS_PYTHON_DESTINATION}/pulvis COMPONENT python)
  # The module is built for one Python version.
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS
      "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy" PARENT_SCOPE)
endfunction()
