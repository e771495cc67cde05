#pragma once

#include <filesystem>
#include <string>

/// The folder of the Python package that belongs to this executable, in the build tree or installed. Empty if neither
/// exists.
std::filesystem::path package_folder();

/// The folder of the explorer's page next to this executable, in the build tree or installed. It may be missing.
std::filesystem::path shipped_page();

/// The Python interpreter that runs the subcommands of the package: the environment variable SLIPFRONT_PYTHON, which
/// the launcher of a wheel sets, or that of the build.
std::string python_interpreter();
