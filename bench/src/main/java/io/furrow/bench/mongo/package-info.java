/** Measures how fast missions are written to MongoDB, against a bare loop around its driver. */
package io.furrow.bench.mongo;
