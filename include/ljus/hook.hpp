#pragma once

/// \file ljus/hook.hpp
/// \brief Hooks: optional functions and constants of a type.

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <typeinfo>

#include "ljus/version.hpp"

namespace ljus::detail {

// A row of a table of hooks. A hook with a misspelt name is never called. The survey
// prints the table, which then shows the hook as missing.
struct Hook {
    const char* name;    // the name of the function or constant
    const char* purpose; // what the hook does
    const char* without; // what happens without it
    bool provided;       // whether the type has it
};

// A stand-in for S that tells which hooks S itself provides. Functions written for S
// accept the stand-in, because it derives from S. The generic defaults do not accept
// it, because it is neither a Shape nor a Material.
template <typename S>
struct OwnOf : S {
    using Scalar = void; // in a Material, Scalar is a floating-point type
};

// Whether a type is an OwnOf.
template <typename S>
inline constexpr bool is_stand_in = false;
template <typename S>
inline constexpr bool is_stand_in<OwnOf<S>> = true;

// OwnOf<S>, or S itself if S is final and no type can derive from it.
template <typename S>
using Own = std::conditional_t<std::is_final_v<S>, S, OwnOf<S>>;

// The name of a type in the compiler's text, without this namespace.
[[nodiscard, gnu::cold]] inline std::string name_within(std::string text) {
#ifdef __GNUC__ // "... [with T = ljus::SphereT<float>; ...]", or "[T = ...]" of clang
    text.erase(0, text.find("T = ") + 4);
    text.erase(std::min(text.find(';'), text.rfind(']')));
#endif
    for (std::size_t at; (at = text.find("ljus::")) != std::string::npos;)
        text.erase(at, 6);
    return text;
}

// The name of a type as the compiler spells it. Most compilers give it only within the
// name of a function.
template <typename T>
[[nodiscard, gnu::cold]] std::string type_name() {
#ifdef __GNUC__
    return name_within(__PRETTY_FUNCTION__);
#else
    return name_within(typeid(T).name());
#endif
}

// One line of text: the hooks that the type has, and what happens without the others.
template <typename Rows>
[[nodiscard]] std::string to_line(const Rows& rows) {
    std::string has, lacks;
    for (const Hook& hook : rows) {
        std::string& list = hook.provided ? has : lacks;
        list.append(list.empty() ? "" : ", ").append(hook.name);
        if (!hook.provided) list.append(" (").append(hook.without).append(")");
    }
    std::string line = has.empty() ? "has no hook" : "has " + has;
    return lacks.empty() ? line : line.append("; without ").append(lacks);
}

} // namespace ljus::detail
