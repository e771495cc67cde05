#pragma once

#include "json.hpp"

/// Versions of slipfront, of its compiler and of the libraries that it was built with, and what this build can do.
Json build_facts();
