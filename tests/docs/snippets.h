#ifndef OBSCURA_TESTS_DOCS_SNIPPETS_H_
#define OBSCURA_TESTS_DOCS_SNIPPETS_H_

// The blocks of C++ in the pages, each in a function. They return false where they did not work.
bool run_readme();
bool run_sweeping();

#endif  // OBSCURA_TESTS_DOCS_SNIPPETS_H_
