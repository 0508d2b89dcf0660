// The figures of a run, and the ratios between them.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pierce::bench {

double median(std::vector<double> values);

/// For each mesh, set and column the value of each repetition: ns a query, as a rule. Builds and memory are sets, too.
class Results {
  public:
    void add(std::string_view mesh, std::string_view set, std::string_view column, double value);

    [[nodiscard]] std::optional<double> value(std::string_view mesh, std::string_view set,
                                              std::string_view column) const;
    /// The median of the repetitions' ratios, each of sums over the sets.
    [[nodiscard]] std::optional<double> ratio(std::string_view mesh, const std::vector<std::string_view>& sets,
                                              std::string_view peer, std::string_view ours) const;

    /// One line for each value: mesh, faces, set, column, median, and all repetitions.
    void write(const std::filesystem::path& path, const std::map<std::string, std::size_t, std::less<>>& faces) const;

  private:
    [[nodiscard]] const std::vector<double>* find(std::string_view mesh, std::string_view set,
                                                  std::string_view column) const;

    std::map<std::string, std::vector<double>, std::less<>> values_;
};

}  // namespace pierce::bench
