#pragma once

/// \file ljus/version.hpp
/// \brief The version of Ljus, and what it asks of the compiler.

/// The version of the library; CMake reads it from here.
#define LJUS_VERSION_MAJOR 0
/// \see LJUS_VERSION_MAJOR
#define LJUS_VERSION_MINOR 1
/// \see LJUS_VERSION_MAJOR
#define LJUS_VERSION_PATCH 0

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#error "Ljus needs C++20: add -std=c++20 (g++, clang) or /std:c++20 (MSVC)."
#endif

#if defined(__FAST_MATH__)
#error "Ljus relies on NaN and infinity: compile without -ffast-math."
#endif

/// Before a function that is no template and that ljus::core has compiled: `inline` to
/// those who use headers alone.
#ifndef LJUS_CORE_INLINE
#ifdef LJUS_CORE
#define LJUS_CORE_INLINE
#else
#define LJUS_CORE_INLINE inline
#endif
#endif
