#pragma once

/// \file ljus/progress.hpp
/// \brief What a long loop reports to, and is stopped by.

#include <concepts>
#include <type_traits>

#include "ljus/version.hpp"

namespace ljus {

/// \addtogroup parallel
/// \{

/// A reference to what a loop reports to: anything that can be called as
/// `bool progress(long long done, long long total)`; false stops the loop.
///
/// It refers to a callable with a name and does not own it, so that the callable must
/// live as long as the loop:
///
///     auto progress = [&](long long done, long long total) { return !stopped; };
///     parallel_blocks(count, body, {.progress = progress});
class Progress {
public:
    /// Nothing to report to.
    constexpr Progress() noexcept = default;

    /// Reports to `callable`.
    template <typename F>
    requires(!std::same_as<std::remove_cv_t<F>, Progress> && std::is_object_v<F> &&
             std::is_invocable_r_v<bool, F&, long long,
                                   long long>) constexpr Progress(F& callable) noexcept
        : callable_(&callable),
          call_([](const void* f, long long done, long long total) {
              return static_cast<bool>(
                  (*static_cast<F*>(const_cast<void*>(f)))(done, total));
          }) {}

    /// Not to a temporary: give the callable a name.
    template <typename F>
    requires(!std::same_as<std::remove_cvref_t<F>, Progress>)
        Progress(const F&& callable)
    = delete;

    /// \return Whether to go on; true if there is nothing to report to.
    bool operator()(long long done, long long total) const {
        return call_ == nullptr || call_(callable_, done, total);
    }

private:
    const void* callable_ = nullptr;
    bool (*call_)(const void*, long long, long long) = nullptr;
};

/// \}

} // namespace ljus
