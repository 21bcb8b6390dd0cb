// The library ljus::core: compiles once what ljus/core.hpp lists. By a compiler line,
//
//     g++ -std=c++20 -O2 -fopenmp -Iinclude -c core/core.cpp
//     g++ -std=c++20 -O2 -fopenmp -Iinclude -DLJUS_CORE app.cpp core.o
#define LJUS_CORE_EXTERN // not extern, and not inline: here they are made
#define LJUS_CORE_INLINE
#include "ljus/core.hpp"
