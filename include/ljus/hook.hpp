#pragma once

/// \file ljus/hook.hpp
/// \brief Hooks: what a type may have beside what its concept asks for.

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <typeinfo>

#include "ljus/version.hpp"

namespace ljus::detail {

// A row of a table of hooks. A function whose name is misspelt is never called; the
// survey, which prints the table, shows that this hook is missing.
struct Hook {
    const char* name;    // of the function, or of the constant
    const char* purpose; // what it is for
    const char* without; // what happens if it is not there
    bool provided;       // whether the type has it
};

// Stands for a type S where it is asked what S itself has. As S is its base, functions
// for S take it; but it is neither a shape nor a material, so that the defaults, which
// are functions for every shape or every material, do not.
template <typename S>
struct OwnOf : S {
    using Scalar = void; // a material's is a number
};

// Whether a type is such a stand-in.
template <typename S>
inline constexpr bool is_stand_in = false;
template <typename S>
inline constexpr bool is_stand_in<OwnOf<S>> = true;

// The stand-in for any type; one that is final can only stand for itself.
template <typename S>
using Own = std::conditional_t<std::is_final_v<S>, S, OwnOf<S>>;

// The name of a type as a compiler spells it, without this namespace. Most compilers
// tell it only as part of a function's name.
template <typename T>
[[nodiscard]] std::string type_name() {
#ifdef __GNUC__ // "... [with T = ljus::SphereT<float>; ...]", or "[T = ...]" of clang
    std::string name = __PRETTY_FUNCTION__;
    name.erase(0, name.find("T = ") + 4);
    name.erase(std::min(name.find(';'), name.rfind(']')));
#else
    std::string name = typeid(T).name();
#endif
    for (std::size_t at; (at = name.find("ljus::")) != std::string::npos;)
        name.erase(at, 6);
    return name;
}

// A table in one line: what the type has, and what happens without the rest.
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
