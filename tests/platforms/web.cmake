# Browsers: Debian's Emscripten, whose programs node runs. Exceptions and vectors of four floats are WebAssembly's own:
# every browser of 2023 has them.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -msimd128 -include ${CMAKE_CURRENT_LIST_DIR}/old_libcxx.h")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-fwasm-exceptions -sALLOW_MEMORY_GROWTH -sTOTAL_STACK=8MB")
# Node 18 and 20 can fetch, which this Emscripten takes for a browser.
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)
