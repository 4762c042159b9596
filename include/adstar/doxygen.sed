# The lines at the head of a file, after `#pragma once`, are what it is about.
1s|^#pragma once$|#pragma once\n/// @file|
2,/^\(#include.*\)\?$/s|^//|///|
