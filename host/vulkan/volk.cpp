// The one translation unit that holds volk, which loads libvulkan at run time: a machine without
// it still runs the program and gets a message rather than a link error.
#define VOLK_IMPLEMENTATION
#include <volk.h>
