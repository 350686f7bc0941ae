// The same test, compiled as C++.
#include "tests/models/compensate/compensate_test.c"
