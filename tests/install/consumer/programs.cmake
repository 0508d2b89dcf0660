# One program for each target that a user can link to.
foreach(program IN ITEMS core errors)
  add_executable(${program} ${CMAKE_CURRENT_LIST_DIR}/${program}.cpp)
  target_link_libraries(${program} PRIVATE pierce::pierce)
endforeach()
# And one in C: with a static pierce the C++ compiler links it.
enable_language(C)
add_executable(core_c ${CMAKE_CURRENT_LIST_DIR}/core_c.c)
target_link_libraries(core_c PRIVATE pierce::pierce)
# A user who hides what is his own still meets the library's errors.
set_target_properties(errors PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
if(WITH_OPENMESH)
  add_executable(openmesh ${CMAKE_CURRENT_LIST_DIR}/openmesh.cpp)
  target_link_libraries(openmesh PRIVATE pierce::openmesh)
endif()
if(WITH_TBB)
  add_executable(tbb ${CMAKE_CURRENT_LIST_DIR}/tbb.cpp)
  target_link_libraries(tbb PRIVATE pierce::tbb)
endif()
