# Embeds the report pages (page/) and the Python files needed by `pulvis figure` as bytes into a target, and links
# the compression for the page data.

set(report_folder ${CMAKE_CURRENT_LIST_DIR})

function(add_report_assets target)
  find_package(ZLIB REQUIRED)
  set(package ${report_folder}/../python/pulvis)
  file(GLOB assets CONFIGURE_DEPENDS ${report_folder}/page/*.html ${report_folder}/page/*.css
       ${report_folder}/page/*.js ${report_folder}/page/space/*.js ${report_folder}/page/library/*.js ${package}/__init__.py ${package}/arguments.py ${package}/errors.py ${package}/frames.py ${package}/results.py
       ${package}/lever_results.py ${package}/particle_table.py ${package}/figures/*.py ${package}/preview/*.py)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/report_assets.cpp)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -D "ASSETS=${assets}" -D "OUTPUT=${source}"
            -P ${report_folder}/write_assets.cmake
    DEPENDS ${assets} ${report_folder}/write_assets.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${source})
  target_link_libraries(${target} PRIVATE ZLIB::ZLIB)
endfunction()
