// Which wide kernels there are, and which of them this machine runs.
#include <kernel/backends.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace pierce::detail {

const std::vector<const Backend*>& backends() {
    static const std::vector<const Backend*> all = [] {
        std::vector<const Backend*> found;
#if defined(__x86_64__)
        __builtin_cpu_init();
        const bool avx2 =
            __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
        const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                            __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
        if (avx512) found.push_back(&k_avx512);
        if (avx2) found.push_back(&k_avx2);
        found.push_back(&k_sse2);
#elif defined(__aarch64__)
        found.push_back(&k_neon);
#endif
        found.push_back(&k_plain);
        return found;
    }();
    return all;
}

const Backend& choose_backend(std::string_view name) {
    std::string wanted(name);
    if (wanted.empty())
        if (const char* from_environment = std::getenv("PIERCE_BACKEND")) wanted = from_environment;
    if (wanted.empty()) return *backends().front();
    std::string names;
    for (const Backend* backend : backends()) {
        if (backend->name == wanted) return *backend;
        names += std::string(" ") + backend->name;
    }
    throw std::invalid_argument("no backend '" + wanted + "' on this machine, which has:" + names);
}

}  // namespace pierce::detail
