// The half with exceptions: `no_exceptions.cpp` calls it, and is called back.
#include "no_exceptions.h"

#include <pierce/mesh_error.h>

std::string caught(void (*call)()) {
    try {
        call();
    } catch (const pierce::MeshError& error) {
        return error.what();
    }
    return {};
}
