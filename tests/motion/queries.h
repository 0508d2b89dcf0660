// Reads vertex-face queries with ground truth: eight rows a query, each of three fractions, as
// PIERCE_SHARED/ccd/README.md says.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <motion/moving.h>

namespace pierce::test {

struct SharedQuery {
    detail::MovingPoint point;
    detail::MovingTriangle triangle;
    bool truth;
};

inline std::vector<std::string> scenes_of(const std::filesystem::path& folder) {
    std::vector<std::string> scenes;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (std::filesystem::exists(entry.path() / "vertex_face.csv"))
            scenes.push_back(entry.path().filename().string());
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

inline std::vector<SharedQuery> read_queries(const std::filesystem::path& scene) {
    std::vector<bool> truths;
    if (std::ifstream json(scene / "truth.json"); json) {
        std::stringstream text;
        text << json.rdbuf();
        const std::string all = text.str();
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i] == 't' || all[i] == 'f') {
                truths.push_back(all[i] == 't');
                i += 3;  // past the letters of the word
            }
    }
    std::vector<SharedQuery> queries;
    std::ifstream csv(scene / "vertex_face.csv");
    std::string line;
    for (std::size_t row = 0; std::getline(csv, line); ++row) {
        double field[7] = {};
        std::stringstream cells(line);
        std::string cell;
        for (int i = 0; i < 7 && std::getline(cells, cell, ','); ++i) field[i] = std::strtod(cell.c_str(), nullptr);
        // Whole numbers below 2^53 but for zeros at the end, and powers of two: what is read and the quotient are
        // exact.
        const detail::Point p = {field[0] / field[1], field[2] / field[3], field[4] / field[5]};
        if (row % 8 == 0) queries.emplace_back();
        SharedQuery& q = queries.back();
        const std::size_t i = row % 8 / 4;
        if (row % 4 == 0)
            q.point.at[i] = p;
        else
            q.triangle.at[i][row % 4 - 1] = p;
        q.truth = truths.empty() ? field[6] != 0 : truths[row / 8];
    }
    return queries;
}

}  // namespace pierce::test
