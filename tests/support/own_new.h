// An operator new that tells the program of every call, which may count it or throw. For executables of their own: each
// has one.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace pierce::test {
void before_new();  ///< for the program to define
inline void* told(std::size_t size) {
    before_new();
    if (void* memory = std::malloc(size != 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
}  // namespace pierce::test

void* operator new(std::size_t size) { return pierce::test::told(size); }
void* operator new[](std::size_t size) { return pierce::test::told(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
