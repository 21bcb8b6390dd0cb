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

// A row of a table of hooks. A function with a misspelt name is never called; the
// survey prints the table, which then shows that the hook is missing.
struct Hook {
    const char* name;    // of the function, or of the constant
    const char* purpose; // its purpose
    const char* without; // what happens without it
    bool provided;       // whether the type has it
};

// Derives from S to tell which hooks S itself provides. Overloads written for S accept
// it. The generic defaults do not, because it is neither a Shape nor a Material.
template <typename S>
struct OwnOf : S {
    using Scalar = void; // a material's is a number
};

// Whether a type is such a stand-in.
template <typename S>
inline constexpr bool is_stand_in = false;
template <typename S>
inline constexpr bool is_stand_in<OwnOf<S>> = true;

// The stand-in for any type; a final type stands for itself.
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

// A table in one line: the hooks of the type, and what happens without the others.
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
