#include "results.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace pierce::bench {
namespace {

std::string key(std::string_view mesh, std::string_view set, std::string_view column) {
    std::string key;
    for (const std::string_view part : {mesh, set, column}) (key += part) += '\t';
    return key;
}

}  // namespace

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

void Results::add(std::string_view mesh, std::string_view set, std::string_view column, double value) {
    values_[key(mesh, set, column)].push_back(value);
}

const std::vector<double>* Results::find(std::string_view mesh, std::string_view set, std::string_view column) const {
    const auto at = values_.find(key(mesh, set, column));
    return at == values_.end() ? nullptr : &at->second;
}

std::optional<double> Results::value(std::string_view mesh, std::string_view set, std::string_view column) const {
    const std::vector<double>* values = find(mesh, set, column);
    if (values == nullptr) return std::nullopt;
    return median(*values);
}

std::optional<double> Results::ratio(std::string_view mesh, const std::vector<std::string_view>& sets,
                                     std::string_view peer, std::string_view ours) const {
    std::vector<double> peer_sums;
    std::vector<double> our_sums;
    for (const std::string_view set : sets) {
        const std::vector<double>* theirs = find(mesh, set, peer);
        const std::vector<double>* own = find(mesh, set, ours);
        if (theirs == nullptr || own == nullptr) return std::nullopt;
        const std::size_t repetitions = std::min(theirs->size(), own->size());
        peer_sums.resize(repetitions);
        our_sums.resize(repetitions);
        for (std::size_t r = 0; r < repetitions; ++r) {
            peer_sums[r] += (*theirs)[r];
            our_sums[r] += (*own)[r];
        }
    }
    std::vector<double> ratios;
    for (std::size_t r = 0; r < our_sums.size(); ++r) ratios.push_back(peer_sums[r] / our_sums[r]);
    return median(ratios);
}

void Results::write(const std::filesystem::path& path,
                    const std::map<std::string, std::size_t, std::less<>>& faces) const {
    std::ofstream out(path);
    out << "mesh\tfaces\tset\tcolumn\tmedian\trepetitions\n";
    for (const auto& [key, values] : values_) {
        const std::size_t tab = key.find('\t');
        const auto count = faces.find(key.substr(0, tab));
        out << key.substr(0, tab + 1) << (count == faces.end() ? 0 : count->second) << key.substr(tab) << median(values)
            << '\t';
        for (const double v : values) out << v << ' ';
        out << '\n';
    }
    if (!out.flush()) throw std::runtime_error("can't write " + path.string());
}

}  // namespace pierce::bench
