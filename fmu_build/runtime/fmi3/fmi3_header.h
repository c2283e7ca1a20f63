/* The standard's header: the importer's own where it is on the include path, as FMI asks for, else the one that lies in
 * a folder beside. The prefix of its functions is defined before, in unit.h. */
#ifndef FMI3_HEADER_H
#define FMI3_HEADER_H

#include "unit.h"

#if defined __has_include
#if __has_include("fmi3Functions.h")
#include "fmi3Functions.h"
#else
#include "fmi3/fmi3Functions.h"
#endif
#else
#include "fmi3/fmi3Functions.h"
#endif

#endif
