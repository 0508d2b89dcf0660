// A variable of the environment with another value, or none, for as long as it lives.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace pierce::test {

class EnvironmentVariable {
  public:
    /// `value`: null for none. `name` must live as long.
    EnvironmentVariable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        set(value);
    }
    ~EnvironmentVariable() { set(before_ ? before_->c_str() : nullptr); }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

  private:
    void set(const char* value) const {
#if defined(_WIN32)
        _putenv_s(name_, value != nullptr ? value : "");
#else
        if (value != nullptr) setenv(name_, value, 1);
        else unsetenv(name_);
#endif
    }

    const char* name_;
    std::optional<std::string> before_;
};

}  // namespace pierce::test
