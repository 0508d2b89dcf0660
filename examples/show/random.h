// Random numbers that are the same on every machine: the distributions of the standard library are not.
#pragma once

#include <random>

namespace show {

class Random {
  public:
    /// Uniform in [0, 1).
    float operator()() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }

  private:
    std::mt19937 engine_{1};
};

}  // namespace show
