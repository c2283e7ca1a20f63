/* Random calls: what the fuzzers of both facades share. Deterministic for a seed. */
#ifndef FUZZ_H
#define FUZZ_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"
#include "state.h"

enum { MAX_LIST = 6, N_SNAPSHOTS = 4 };

/* The fuzzer's own idea of the state machine: bits. */
enum {
    INSTANTIATED_ = 1,
    INITIALIZING_ = 2,
    STEPPING_ = 4,
    EVENT_ = 8,
    CONTINUOUS_ = 16,
    TERMINATED_ = 32,
    FAILED_ = 64
};
enum { ALWAYS_ = 127, EVALUABLE_ = 126, SETTABLE_ = 31 };

static uint64_t fuzz_random;
static long fuzz_calls;
static long fuzz_accepted;
static long fuzz_steps;
static long fuzz_messages;
static long fuzz_messages_before;
static const char *fuzz_last = "nothing";

/* xorshift64* (Vigna 2016) */
static uint32_t draw(uint32_t below)
{
    fuzz_random ^= fuzz_random >> 12;
    fuzz_random ^= fuzz_random << 25;
    fuzz_random ^= fuzz_random >> 27;
    return (uint32_t)((fuzz_random * 0x2545f4914f6cdd1du) >> 33) % below;
}

static bool rarely(void) { return draw(20) == 0; }

static double uniform(double from, double to) { return from + (to - from) * draw(1000001) / 1e6; }

static double odd_number(void)
{
    static const double odd[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 1e-300, 5e-324, -0.0, 0.0, -1.0};
    return odd[draw(sizeof odd / sizeof *odd)];
}

static double number(double start) { return rarely() ? odd_number() : start * uniform(0.5, 1.5) + uniform(-0.1, 0.1); }

static unsigned reference(void) { return rarely() ? draw(3) * 1000000u + N_VARIABLES : draw(N_VARIABLES); }

static size_t length(void) { return draw(MAX_LIST + 1); }

static void list(unsigned references[MAX_LIST], double values[MAX_LIST])
{
    for (int i = 0; i < MAX_LIST; i++) {
        references[i] = reference();
        values[i] = number(references[i] < N_VARIABLES ? variable_info[references[i]].start : 1.0);
    }
}

/* One byte of a saved state changed, its checksum (FNV-1a) right: it must be refused or do no harm. */
static void make_up(unsigned char *bytes, size_t size)
{
    unsigned char *state = bytes + size - sizeof(State);
    uint64_t sum = 0xcbf29ce484222325u;
    state[draw(sizeof(State))] ^= (unsigned char)(1 + draw(255));
    for (size_t i = 0; i < sizeof(State); i++) sum = (sum ^ state[i]) * 0x100000001b3u;
    memcpy(state - sizeof sum, &sum, sizeof sum);
}

static void fail(const char *why)
{
    fprintf(stderr, "call %ld, %s: %s\n", fuzz_calls, fuzz_last, why);
    exit(1);
}

/* After each call: a refusal has a reason, an illegal call is refused, and nothing is OK that is not finite. */
static void check(const char *name, bool ok, bool error, bool legal, const double values[], size_t n)
{
    fuzz_last = name;
    fuzz_calls++;
    fuzz_accepted += ok;
    if (ok && !legal) {
        fail("an illegal call is accepted");
    }
    if (error && fuzz_messages == fuzz_messages_before) {
        fail("an error without a message");
    }
    for (size_t i = 0; ok && i < n; i++) {
        if (!isfinite(values[i])) {
            fail("OK with a value that is not finite");
        }
    }
    fuzz_messages_before = fuzz_messages;
}

#endif
