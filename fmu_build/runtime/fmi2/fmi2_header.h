/* The standard's header: the importer's own where it is on the include path, as FMI asks for, else the one that lies in
 * a folder beside. The prefix of its functions is defined before, in unit.h. */
#ifndef FMI2_HEADER_H
#define FMI2_HEADER_H

#include "unit.h"

#if defined __has_include
#if __has_include("fmi2Functions.h")
#include "fmi2Functions.h"
#else
#include "fmi2/fmi2Functions.h"
#endif
#else
#include "fmi2/fmi2Functions.h"
#endif

#endif
