/// @file toml++ itself, as {fmt} (fmt_static.cpp): its shared library would bring another libstdc++ along.

#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
