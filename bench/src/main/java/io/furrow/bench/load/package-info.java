/** Load through the whole path, measured at the last topic from what the record headers say. */
package io.furrow.bench.load;
