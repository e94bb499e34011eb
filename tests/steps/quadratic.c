// What the test must tell apart: work that grows with n, and work that grows with its square, in loops and
// inside the C library. Usage: quadratic linear|loop|library N
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t linear(uint32_t n) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < n; i++)
        sum += i ^ sum >> 3;
    return sum;
}

// Compares each with each.
static uint32_t loop(uint32_t n) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < i; k++)
            sum += (i ^ k) == sum;
    return sum + linear(n);
}

// Copies the whole text for each character that is added.
static uint32_t library(uint32_t n) {
    char *text = calloc(n + 1, 1);
    char *copy = calloc(n + 1, 1);
    for (uint32_t i = 0; i < n && text && copy; i++) {
        memcpy(copy, text, i);
        copy[i] = 'a';
        memcpy(text, copy, i + 1);
    }
    uint32_t sum = text ? (uint32_t)strlen(text) : 0;
    free(text);
    free(copy);
    return sum + linear(n);
}

int main(int argc, char **argv) {
    if (argc != 3)
        return 2;
    uint32_t n = (uint32_t)strtoul(argv[2], NULL, 10);
    uint32_t sum = strcmp(argv[1], "loop") == 0      ? loop(n)
                   : strcmp(argv[1], "library") == 0 ? library(n)
                                                     : linear(n);
    printf("%u\n", (unsigned)sum);
    return 0;
}
