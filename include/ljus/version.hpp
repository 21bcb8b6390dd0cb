#pragma once

/// \file ljus/version.hpp
/// \brief The version of Ljus, and its requirements on the compiler.

/// The library's major version. CMake reads the version from this file.
#define LJUS_VERSION_MAJOR 0
/// The library's minor version.
#define LJUS_VERSION_MINOR 2
/// The number of corrections since the minor version.
#define LJUS_VERSION_PATCH 0

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#error "Ljus needs C++20: add -std=c++20 (g++, clang) or /std:c++20 (MSVC)."
#include <add -std=c++20> // no such file: the compiler stops here, without more errors
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Ljus needs NaN and infinity: compile without -ffast-math, -ffinite-math-only."
#endif

#if defined(__GNUC__) && !defined(__cpp_exceptions) && !defined(__EMSCRIPTEN__)
#error "Ljus reports errors by exceptions: compile without -fno-exceptions."
#endif

#if defined(GLM_FORCE_INTRINSICS)
#error "Ljus computes with GLM's plain vectors: compile without GLM_FORCE_INTRINSICS."
#endif

/// Marks a function, not a template, that is compiled once, in the optional library
/// ljus::core. In a program without that library the function is `inline`.
#ifndef LJUS_CORE_INLINE
#ifdef LJUS_CORE
#define LJUS_CORE_INLINE
#else
#define LJUS_CORE_INLINE inline
#endif
#endif

/// Marks a search that ljus::core compiles several times, for several generations of
/// processors. The program chooses the version for its processor when it starts.
/// Without ljus::core the macro is empty.
#ifndef LJUS_CORE_CLONES
#define LJUS_CORE_CLONES
#endif
