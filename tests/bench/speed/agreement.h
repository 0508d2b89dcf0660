// Whether pierce and its peers answer the same, before time is taken of them: else they are not to be compared.
#pragma once

#include <string_view>

#include "../table.h"
#include "column.h"

namespace pierce::bench {

/// How often answers differed, over everything compared.
class Agreement {
  public:
    /// What Embree, which is not exact, may differ in from pierce; CGAL may not at all.
    static constexpr double k_tolerated = 1e-3;

    /// Compares `count` answers of pierce with those of Embree and, if they are among the columns, of CGAL, and stops
    /// after `seconds`.
    void compare(std::string_view mesh, std::string_view set, const Columns& columns, std::size_t count,
                 double seconds);

    /// Prints a table; whether all is well.
    [[nodiscard]] bool report() const;

  private:
    struct Row {
        std::string place;
        Share at_ends;
        Share embree;
        Share cgal;
        Share hits;
    };
    std::vector<Row> rows_;
};

}  // namespace pierce::bench
