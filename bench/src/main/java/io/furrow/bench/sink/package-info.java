/** Measures how fast the NGSI sink writes entities into a receiver that only answers. */
package io.furrow.bench.sink;
