// The interface as a C++ program sees it.
#include "interface.c"
