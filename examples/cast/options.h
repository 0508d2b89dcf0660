// What the command line of `cast` says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pierce/types.h>

#include "show/camera.h"

/// What is asked of each segment.
enum class Question { first, all, any };

struct PictureOptions {
    std::filesystem::path file;
    show::View view;
    unsigned threads = 2;
};

struct Options {
    std::filesystem::path mesh;
    bool in_float = false;

    std::string segment_file;                ///< "-" for standard input; empty: none
    std::vector<std::string> segment_texts;  ///< each "x y z x y z"
    std::uint64_t random_count = 0;
    std::uint64_t seed = 1;
    std::optional<double> length;  ///< of the segments that are made up

    Question question = Question::first;
    pierce::Sides sides = pierce::Sides::front;
    double max_fraction = 1;

    std::optional<std::string> csv;  ///< a file; "-" for standard output
    bool all_rows = false;
    std::optional<PictureOptions> picture;
};

/// Empty if the user only asked for help, and got it. Throws InputError for a command line that can't be understood.
std::optional<Options> read_options(int argc, char** argv);
