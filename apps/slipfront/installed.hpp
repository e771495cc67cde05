#pragma once

#include <filesystem>

/// The folder of the Python package that belongs to this executable, in the build tree or installed. Empty if neither
/// exists.
std::filesystem::path package_folder();

/// The folder of the explorer's page next to this executable, in the build tree or installed. It may be missing.
std::filesystem::path shipped_page();
