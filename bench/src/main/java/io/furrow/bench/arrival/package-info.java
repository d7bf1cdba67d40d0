/** What a measurement sees of the records that arrive on a topic. */
package io.furrow.bench.arrival;
