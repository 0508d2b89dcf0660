# Real meshes: unpacks those of Debian's libcgal-demo into the build folder, and sets PIERCE_CGAL_MESHES to where they are.
set(cgal_data /usr/share/doc/libcgal-dev/data.tar.gz)
if(NOT EXISTS ${cgal_data})
  message(FATAL_ERROR "${cgal_data} is missing: tests/install_packages tests (package libcgal-demo)")
endif()
set(PIERCE_CGAL_MESHES ${PROJECT_BINARY_DIR}/cgal/data/meshes)
if(NOT EXISTS ${PIERCE_CGAL_MESHES}/elephant.off)
  file(ARCHIVE_EXTRACT INPUT ${cgal_data} DESTINATION ${PROJECT_BINARY_DIR}/cgal PATTERNS data/meshes/*)
endif()
