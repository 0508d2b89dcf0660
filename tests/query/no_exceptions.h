// What joins the two halves of the program that is compiled without exceptions, but for one function.
#pragma once

#include <string>

/// The text of the `MeshError` that comes out of `call`; empty if none does.
std::string caught(void (*call)());
