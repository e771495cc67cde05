#pragma once

#include "foundation/simd/elementary.hpp"
#include "foundation/simd/elliptic_fit.hpp"
