// The names in a file, each once, and which of them the next face has.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <pierce/triangle_soup.h>

namespace pierce::detail {

class NameTable {
  public:
    /// The faces from here on have this name; "" is none.
    void select(std::string_view name) {
        if (name.empty()) {
            selected_ = k_no_name;
        } else if (selected_ == k_no_name || names_[selected_] != name) {
            const auto [entry, is_new] = places_.try_emplace(std::string(name), names_.size());
            if (is_new) {
                names_.emplace_back(name);
            }
            selected_ = static_cast<std::uint32_t>(entry->second);
        }
    }

    [[nodiscard]] std::uint32_t selected() const { return selected_; }
    /// In the order of their first `select`.
    [[nodiscard]] std::vector<std::string> take_names() { return std::move(names_); }

  private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::size_t> places_;
    std::uint32_t selected_ = k_no_name;
};

}  // namespace pierce::detail
