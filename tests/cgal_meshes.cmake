# Real meshes: unpacks those of Debian's libcgal-demo into the build folder, and sets PIERCE_CGAL_MESHES to where they are.
set(PIERCE_CGAL_MESHES ${PROJECT_BINARY_DIR}/cgal_meshes)
execute_process(COMMAND ${PROJECT_SOURCE_DIR}/tests/real_meshes ${PIERCE_CGAL_MESHES} COMMAND_ERROR_IS_FATAL ANY)
