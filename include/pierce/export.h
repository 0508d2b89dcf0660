// What the shared library shows to its users: the names that carry this macro, and no other.
#pragma once

/// pierce is compiled with hidden visibility. Classes and functions that public headers declare and lib/ defines carry
/// this. A class that is thrown carries it as well: its type information is then one and the same on both sides.
/// PIERCE_HIDDEN keeps what is declared inside of such a class from being shown with it.
#if defined(__GNUC__) && !defined(_WIN32)
#define PIERCE_EXPORT __attribute__((visibility("default")))
#define PIERCE_HIDDEN __attribute__((visibility("hidden")))
#else
#define PIERCE_EXPORT
#define PIERCE_HIDDEN
#endif
