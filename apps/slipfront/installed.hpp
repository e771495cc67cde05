#pragma once

#include <filesystem>
#include <string>

/// The folder of the Python package that belongs to this executable, in the build tree or installed. Empty if neither
/// exists.
std::filesystem::path package_folder();

/// The explorer's page that belongs to this executable, in the build tree or installed. Empty if it does not exist.
std::string shipped_page();

/// The Python interpreter that runs the subcommands of the package: the environment variable SLIPFRONT_PYTHON, which
/// the launcher of a wheel sets, or that of the build.
std::string python_interpreter();
