#pragma once

/// \file ljus/ref.hpp
/// \brief References that refuse temporaries: to an object, and to what can be called.

#include <concepts>
#include <type_traits>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup ref References
/// \brief A constructor that stores a reference to its argument takes a Ref; a function
/// that calls its argument may take a FunctionRef.
/// \{

/// A reference to an object, which must outlive the reference. A temporary does not
/// compile, because its lifetime would end before the reference is used.
template <typename X>
class Ref {
public:
    /// Refers to an object with a name.
    constexpr Ref(const X& object) noexcept : object_(&object) {}
    Ref(const X&&) = delete; ///< A temporary ends too early: give the object a name.

    /// The object.
    [[nodiscard]] constexpr const X& get() const noexcept { return *object_; }

private:
    const X* object_;
};

/// A FunctionRef is made for a signature, such as R(A...).
template <typename Signature>
class FunctionRef;

/// A reference to an object that can be called with arguments of the types A and
/// returns an R. A function that takes a FunctionRef is compiled once, not once per
/// type of callable. The class resembles std::function_ref of C++26, but cannot refer
/// to a plain function.
template <typename R, typename... A>
class FunctionRef<R(A...)> {
public:
    /// Refers to a callable, which must outlive the reference.
    template <typename F>
    requires(
        !std::same_as<std::remove_cv_t<F>, FunctionRef> && std::is_object_v<F> &&
        std::is_invocable_r_v<R, F&, A...>) constexpr FunctionRef(F& callable) noexcept
        : callable_(&callable), call_([](const void* f, A... a) -> R {
              return static_cast<R>(
                  (*static_cast<F*>(const_cast<void*>(f)))(static_cast<A&&>(a)...));
          }) {}

    /// A temporary would not live long enough: give the callable a name.
    template <typename F>
    requires(!std::same_as<std::remove_cvref_t<F>, FunctionRef>) FunctionRef(const F&&)
    = delete;

    /// Calls the callable.
    R operator()(A... a) const { return call_(callable_, static_cast<A&&>(a)...); }

private:
    const void* callable_;
    R (*call_)(const void*, A...);
};

/// \}

} // namespace ljus
