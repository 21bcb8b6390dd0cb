#pragma once

/// \file ljus/version.hpp
/// \brief The version of Ljus, and its requirements on the compiler.

/// The version of the library; CMake reads it from here.
#define LJUS_VERSION_MAJOR 0
/// \see LJUS_VERSION_MAJOR
#define LJUS_VERSION_MINOR 2
/// \see LJUS_VERSION_MAJOR
#define LJUS_VERSION_PATCH 0

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#error "Ljus needs C++20: add -std=c++20 (g++, clang) or /std:c++20 (MSVC)."
#include <add -std=c++20> // there is none: here the compiler stops, before it says more
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Ljus needs NaN and infinity: compile without -ffast-math, -ffinite-math-only."
#endif

#if defined(__GNUC__) && !defined(__cpp_exceptions) && !defined(__EMSCRIPTEN__)
#error "Ljus says what is wrong by exceptions: compile without -fno-exceptions."
#endif

#if defined(GLM_FORCE_INTRINSICS)
#error "Ljus computes with GLM's plain vectors: compile without GLM_FORCE_INTRINSICS."
#endif

/// Marks a function that is not a template and that ljus::core compiles; it is `inline`
/// without ljus::core.
#ifndef LJUS_CORE_INLINE
#ifdef LJUS_CORE
#define LJUS_CORE_INLINE
#else
#define LJUS_CORE_INLINE inline
#endif
#endif

/// Marks a search that ljus::core compiles for several generations of processors. The
/// instructions that the processor at hand has are chosen when the program starts.
/// Without ljus::core it means nothing.
#ifndef LJUS_CORE_CLONES
#define LJUS_CORE_CLONES
#endif
