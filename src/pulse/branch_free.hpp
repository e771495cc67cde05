#pragma once

#include "../elementary.hpp"
#include "elliptic_fit.hpp"
