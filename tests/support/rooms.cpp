// Instantiates the templates listed in rooms_core.hpp.
#define LJUS_TEST_ROOMS_EXTERN // not extern: defined here
#include "support/rooms_core.hpp"
