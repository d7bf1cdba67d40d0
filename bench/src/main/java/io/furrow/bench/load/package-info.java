/** Measures load through the whole path at the last topic, from the record headers. */
package io.furrow.bench.load;
