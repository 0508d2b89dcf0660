// From what is thrown to what is said: for everything that must let no exception out.
#pragma once

#include <new>
#include <stdexcept>

#include <pierce/mesh_view.h>
#include <pierce/result.h>

namespace pierce::detail {

/// Calls `call()`, and says what became of it. `of_mesh`: what a `MeshError` stands for.
template <class Call>
[[nodiscard]] Status without_exceptions(Call&& call, Status of_mesh, std::string& message) noexcept {
    // To keep the text may take memory that there is not. What is said then fits into a string that takes none.
    const auto say = [&message](Status status, const char* text) {
        try {
            message = text;
            return status;
        } catch (...) {
            message = "out of memory";
            return Status::out_of_memory;
        }
    };
    try {
        call();
        return Status::ok;
    } catch (const MeshError& error) {
        return say(of_mesh, error.what());
    } catch (const std::invalid_argument& error) {
        return say(Status::bad_argument, error.what());
    } catch (const std::bad_alloc&) {
        return say(Status::out_of_memory, "out of memory");
    } catch (const std::length_error&) {
        return say(Status::out_of_memory, "out of memory");
    } catch (const std::exception& error) {
        return say(Status::failed, error.what());
    } catch (...) {
        return say(Status::failed, "failed");
    }
}

}  // namespace pierce::detail
