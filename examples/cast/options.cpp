// See options.h. CLI11 splits the command line and writes the help; all numbers are read by our own parser.
#include "cast/options.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

#include "cast/numbers.h"

namespace {

constexpr auto examples =
    "Examples:\n"
    "  cast bunny.off                                   ten made-up segments near the surface\n"
    "  cast bunny.off --random 100000 --sides both      how fast?\n"
    "  cast bunny.off --segment \"0 0 9  0 0 -9\" --all   everything that one segment runs through\n"
    "  cast level.obj --segments steps.txt --csv hits.csv\n"
    "  cast bunny.off --picture bunny.png --view 30,20 --samples 3\n"
    "\n"
    "A segment file has six numbers a line, x y z of the start and x y z of the end; '#' starts a comment.\n"
    "Segments, faces and triangles are counted from 0.";

/// Adds an option with one value; `read` may throw InputError.
CLI::Option* add_value(CLI::App& app, const std::string& name, const char* type, const std::string& help,
                       std::function<void(const std::string&)> read) {
    const auto read_result = [name, read = std::move(read)](const CLI::results_t& results) {
        // What follows an option is its value for CLI11, even if it looks like the next option.
        if (results.front().empty() || results.front().starts_with("--"))
            throw InputError("cast: " + name + " needs a value");
        try {
            read(results.front());
        } catch (const InputError& error) {
            throw InputError("cast: " + name + ": " + error.what());
        }
        return true;
    };
    return app.add_option(name, read_result, help)->type_name(type)->option_text(type)->expected(1);
}

template <class Number>
Number number_between(Number least, Number most, std::string_view text) {
    const auto number = parse_number<Number>(text);
    if (number < least || number > most)
        throw InputError(in_quotes(text) + " is not between " + shortest(static_cast<double>(least)) + " and " +
                         shortest(static_cast<double>(most)));
    return number;
}

/// The two parts of a text such as 800x600.
std::pair<std::string_view, std::string_view> split(std::string_view text, char separator, const char* shape) {
    const auto place = text.find(separator);
    if (place == text.npos) throw InputError(in_quotes(text) + " is not " + shape);
    return {text.substr(0, place), text.substr(place + 1)};
}

pierce::Sides parse_sides(std::string_view text) {
    if (text == "front") return pierce::Sides::front;
    if (text == "back") return pierce::Sides::back;
    if (text == "both") return pierce::Sides::both;
    throw InputError(in_quotes(text) + " is not front, back or both");
}

bool parse_z_is_up(std::string_view text) {
    if (text != "y" && text != "z") throw InputError(in_quotes(text) + " is not y or z");
    return text == "z";
}

void add_segment_options(CLI::App& app, Options& options) {
    app.option_defaults()->group("Segments");
    add_value(app, "--segments", "FILE", "Read segments from a file, '-' for standard input",
              [&](const auto& text) { options.segment_file = text; });
    app.add_option("--segment", options.segment_texts, "A segment; may be given again")
        ->option_text("\"X Y Z X Y Z\"")
        ->allow_extra_args(false);
    auto* random = add_value(
        app, "--random", "N", "Make up N segments near the surface (10, if no others are given)",
        [&](const auto& text) { options.random_count = number_between<std::uint64_t>(0, 100'000'000, text); });
    auto* seed = add_value(app, "--seed", "S", "Seed of the made-up segments (1)",
                           [&](const auto& text) { options.seed = parse_number<std::uint64_t>(text); });
    auto* length = add_value(app, "--length", "L", "Length of the made-up segments (four mean edge lengths)",
                             [&](const auto& text) {
                                 options.length = parse_number<double>(text);
                                 if (*options.length <= 0) throw InputError(in_quotes(text) + " is not greater than 0");
                             });
    app.callback([&options, random, seed, length] {
        const bool given = !options.segment_file.empty() || !options.segment_texts.empty();
        if (random->empty() && !given) options.random_count = 10;
        if (random->empty() && given && !(seed->empty() && length->empty()))
            throw InputError("cast: " + (seed->empty() ? length : seed)->get_name() +
                             " is for made-up segments: add --random N");
    });
}

void add_answer_options(CLI::App& app, Options& options) {
    app.option_defaults()->group("Hits");
    auto* all = app.add_flag_callback(
        "--all", [&] { options.question = Question::all; }, "All hits of each segment");
    app.add_flag_callback(
           "--any", [&] { options.question = Question::any; }, "Only whether there is a hit")
        ->excludes(all);
    add_value(app, "--sides", "SIDES", "Sides that can be hit: front, back or both (front)",
              [&](const auto& text) { options.sides = parse_sides(text); });
    add_value(app, "--max-fraction", "F", "Only hits up to this part of the segment (1)",
              [&](const auto& text) { options.max_fraction = number_between(0.0, 1.0, text); });
    app.add_option(
           "--csv",
           [&](const CLI::results_t& results) {
               options.csv = results.front().empty() ? "-" : results.front();
               return true;
           },
           "Hits as CSV, to a file or standard output")
        ->option_text("[FILE]")
        ->expected(0, 1);
    app.add_flag("--all-rows", options.all_rows, "Do not cut the table of hits");
    app.add_flag("--float", options.in_float, "Single precision: the mesh, the segments and the answers");
}

/// `picture` is written to whether or not there is to be one.
CLI::Option* add_picture_options(CLI::App& app, PictureOptions& picture) {
    app.option_defaults()->group("Picture");
    picture.threads = std::max(2u, std::thread::hardware_concurrency());
    auto* file = add_value(app, "--picture", "FILE", "Draw the mesh by casting, as PNG; the options below need it",
                           [&](const auto& text) { picture.file = text; });
    add_value(app, "--view", "AZIMUTH,ELEVATION", "Where to look from, in degrees (30,20)", [&](const auto& text) {
        const auto [azimuth, elevation] = split(text, ',', "two numbers such as 30,20");
        picture.view.azimuth = number_between(-360.0, 360.0, azimuth);
        picture.view.elevation = number_between(-90.0, 90.0, elevation);
    })->needs(file);
    add_value(app, "--up", "y|z", "The axis that points up (y)", [&](const auto& text) {
        picture.view.z_is_up = parse_z_is_up(text);
    })->needs(file);
    add_value(app, "--size", "WxH", "Pixels (800x600)", [&](const auto& text) {
        const auto [width, height] = split(text, 'x', "a size such as 800x600");
        picture.view.width = number_between(1, 10'000, width);
        picture.view.height = number_between(1, 10'000, height);
    })->needs(file);
    add_value(app, "--samples", "N", "N times N samples a pixel, for smooth edges (1)", [&](const auto& text) {
        picture.view.samples = number_between(1, 16, text);
    })->needs(file);
    add_value(app, "--threads", "N", "Threads that draw (one a processor)", [&](const auto& text) {
        picture.threads = number_between(1u, 1024u, text);
    })->needs(file);
    return file;
}

}  // namespace

std::optional<Options> read_options(int argc, char** argv) {
    Options options;
    PictureOptions picture;
    CLI::App app("Casts segments at a triangle mesh and prints where they hit.", "cast");
    app.get_formatter()->column_width(30);
    app.footer(examples);
    add_value(app, "MESH", "", "A mesh: OBJ, OFF, PLY or STL", [&](const auto& text) {
        options.mesh = text;
    })->required();
    add_segment_options(app, options);
    add_answer_options(app, options);
    const auto* picture_file = add_picture_options(app, picture);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return {};
    } catch (const CLI::ParseError& error) {
        // What is not known at all is told before what is missing, perhaps because of it.
        if (const auto unknown = app.remaining(); !unknown.empty())
            throw InputError("cast: " + in_quotes(unknown.front()) + " was not expected (see cast --help)");
        throw InputError(std::string("cast: ") + error.what() + " (see cast --help)");
    }
    if (!picture_file->empty()) options.picture = picture;
    return options;
}
