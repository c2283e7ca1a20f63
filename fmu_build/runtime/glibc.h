/* A shared library that is compiled on a new Linux runs on an old one: mathematical functions that glibc has given a
 * second version, for how they report errors, are taken in their first. The digits are the same. */
#ifndef GLIBC_H
#define GLIBC_H

#include <math.h>

#if defined __GLIBC__ && (defined FMI2_OVERRIDE_FUNCTION_PREFIX || defined FMI3_OVERRIDE_FUNCTION_PREFIX)
#if defined __x86_64__
#define FIRST_VERSION(name) __asm__(".symver " #name ", " #name "@GLIBC_2.2.5")
#elif defined __aarch64__
#define FIRST_VERSION(name) __asm__(".symver " #name ", " #name "@GLIBC_2.17")
#endif
#endif

#ifdef FIRST_VERSION
FIRST_VERSION(exp);
FIRST_VERSION(fmod);
FIRST_VERSION(hypot);
FIRST_VERSION(log);
FIRST_VERSION(pow);
#endif

#endif
