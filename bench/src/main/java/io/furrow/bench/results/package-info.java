/** Stores figures of several measurements until they are complete. */
package io.furrow.bench.results;
