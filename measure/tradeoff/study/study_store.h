// Searches that were made, kept for the next call.
//
// An entry is named by a key that the caller makes from everything that the search read. Entries that are
// damaged, or of another layout, are ignored and replaced. Ownership: study_recall fills a study that
// tradeoff_finish frees. Errors: every failure is silent, as if there were no store. Thread safety: several
// processes may share a store.
#ifndef GLINT_MEASURE_TRADEOFF_STUDY_STUDY_STORE_H
#define GLINT_MEASURE_TRADEOFF_STUDY_STUDY_STORE_H

#include "measure/tradeoff/study/study.h"

// Under the user's cache folder (folder_store_path), and its size.
#define STUDY_CACHE_NAME  "studies"
#define STUDY_CACHE_BYTES (UINT64_C(16) << 20)

// false: there is none, and *study is empty.
bool study_recall(const struct folder_store *store, const uint64_t key[2], struct tradeoff *study);
void study_keep(const struct folder_store *store, const uint64_t key[2], const struct tradeoff *study);

#endif
